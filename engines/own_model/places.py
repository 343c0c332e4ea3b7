"""At which line of its file an element of a compiled model stands, where that is certain."""

from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

import mujoco

from .release import actuators

OBJECT = mujoco.mjtObj
Key = tuple[mujoco.mjtObj, int] | str
"""An element by its kind and number; an attribute of `option` or of its `flag` by its name."""


@dataclass(frozen=True)
class Places:
    """By element its line in a file, as far as that is known."""

    file: str = ""
    lines: Mapping[Key, int] = field(default_factory=dict[Key, int])

    def after(self, name: str, key: Key) -> str:
        """Returns a name, with file and line after it where they are known."""
        line = self.lines.get(key)
        return f"{name} ({self.file}:{line})" if line else name


def places(model: mujoco.MjModel, xml: str | Path | None, file: str) -> Places:
    """Returns the line in its file of each element and option of a model, where it is certain.

    An element is known by its name. One without a name is by its number, if the file holds as many
    of its kind as the model, all called alike and in the same order, and includes nothing.
    """
    reader = _Reader()
    try:
        text = xml.read_bytes() if isinstance(xml, Path) else (xml or "").encode()
        reader.parser.Parse(text, True)
    except (OSError, ValueError, expat.ExpatError):  # MuJoCo reads what is no XML as well
        return Places()
    lines: dict[Key, int] = {}
    for kind, elements in reader.elements.items():
        in_order = sorted(elements, key=lambda element: element[0])
        names = [name for _, name, _ in in_order]
        often, first = Counter(names), kind == OBJECT.mjOBJ_BODY  # whose first is the ground
        count = getattr(model, COUNTS[kind]) if kind in COUNTS else actuators(model)
        compiled = [mujoco.mj_id2name(model, kind, i) for i in range(first, count)]
        whole = compiled == names and not reader.makes_more
        for number, (_, name, line) in enumerate(in_order, first):
            if whole:
                lines[kind, number] = line
            elif name and often[name] == 1:
                lines[kind, mujoco.mj_name2id(model, kind, name)] = line
    options = {} if reader.makes_more else reader.options
    lines |= {key: at[0] for key, at in options.items() if len(at) == 1}
    return Places(Path(file).name, lines)


KINDS = {
    ("worldbody", "body"): OBJECT.mjOBJ_BODY, ("robot", "link"): OBJECT.mjOBJ_BODY,
    ("worldbody", "joint"): OBJECT.mjOBJ_JOINT, ("robot", "joint"): OBJECT.mjOBJ_JOINT,
    ("worldbody", "freejoint"): OBJECT.mjOBJ_JOINT, ("worldbody", "geom"): OBJECT.mjOBJ_GEOM,
    ("worldbody", "flexcomp"): OBJECT.mjOBJ_FLEX, ("deformable", "flex"): OBJECT.mjOBJ_FLEX,
    ("actuator", ""): OBJECT.mjOBJ_ACTUATOR, ("tendon", ""): OBJECT.mjOBJ_TENDON,
    ("sensor", ""): OBJECT.mjOBJ_SENSOR, ("equality", ""): OBJECT.mjOBJ_EQUALITY,
}  # fmt: skip
"""By section and tag; without a tag whatever stands in the section."""
COUNTS = {
    OBJECT.mjOBJ_BODY: "nbody", OBJECT.mjOBJ_JOINT: "njnt", OBJECT.mjOBJ_GEOM: "ngeom",
    OBJECT.mjOBJ_FLEX: "nflex", OBJECT.mjOBJ_TENDON: "ntendon", OBJECT.mjOBJ_SENSOR: "nsensor",
    OBJECT.mjOBJ_EQUALITY: "neq",
}  # fmt: skip
MAKES_MORE = {"include", "replicate", "attach", "composite", "flexcomp"}


class _Reader:
    """Notes of each element (the number of its body, its name, its line), and of options lines."""

    def __init__(self) -> None:
        self.parser = expat.ParserCreate("utf-8")  # as MuJoCo reads it, whatever the file says
        self.parser.StartElementHandler, self.parser.EndElementHandler = self._begin, self._end
        self.elements = defaultdict[mujoco.mjtObj, list[tuple[int, str | None, int]]](list)
        self.options = defaultdict[str, list[int]](list)
        self.path, self.bodies, self.count, self.makes_more = list[str](), [0], 0, False

    def _begin(self, tag: str, attributes: dict[str, str]) -> None:
        self.path.append(tag)
        root, section, *_ = [*self.path, ""]
        line, depth = self.parser.CurrentLineNumber, len(self.path)
        self.makes_more |= tag in MAKES_MORE
        kind = KINDS.get((root if depth == 2 else section, tag))
        if depth == 3:
            kind = KINDS.get((section, ""), kind)
        if tag == "body":
            self.count += 1
            self.bodies.append(self.count)
        if kind is not None:
            name = attributes.get("name") or None
            self.elements[kind].append((self.bodies[-1], name, line))
        for key in attributes if section == "option" else ():
            self.options[key].append(line)

    def _end(self, tag: str) -> None:
        self.path.pop()
        if tag == "body":
            self.bodies.pop()
