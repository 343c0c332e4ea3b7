"""Options as elements of an MJCF file, ready to paste between `<mujoco>` and `</mujoco>`."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any
from xml.etree import ElementTree as ET

from ....cases.scene import Scene
from ....cases.scene.frame import PLANE
from ...engine import Choice
from ...knobs import Options
from ..model.contact import worth
from ..model.force import BY_ITSELF
from ..model.number_text import EACH, attributes, section, written
from ..model.script import commented
from .groups import GROUPS

_ALONE = "solreffriction"  # which a geom has not
_KEPT = {
    "geom": "of two geoms that touch the one of higher priority tells, or both by solmix",
    "equality": "a <connect> or <weld> with numbers of its own keeps them: write these there",
    "joint": "a <joint> with numbers of its own keeps them: write these there",
    "tendon": "a tendon with numbers of its own keeps them: write these there",
}
"""What else decides, of an element of <default>."""
_PAIRS = (
    "a <pair> has no number of its geoms, nor their friction and condim: it takes these{need}. Of "
    "the geoms that touch: <contact>{pairs}</contact>"
)
_PAIR = '<pair geom1="…" geom2="…" condim="{condim}" friction="{friction} {friction}" />'
_SOFT = 0.01  # of d: below it a contact is a spring and a damper, as in our recipes
_POINTS = (
    "each point at which a body touches is a spring and a damper, and those of a body add up: this "
    "is for {points} of a body, where a ball has one, a lying cylinder two and a box geom four"
)
_MARGIN = (
    "by the margin what starts on the floor is carried from the first step on, and does not fall "
    "freely for one"
)
_NEED = "; and only a pair has a solreffriction, without which the rest makes it hop"
_PYRAMID = "with a pyramidal cone more friction makes a contact softer: this is for friction "
_CONTACTS = ("pair.", "option.impratio")  # what begins so acts on contacts alone


def snippet(
    choices: Sequence[Choice],
    shipped: Sequence[Choice],
    step: float,
    notes: Sequence[str],
    *,
    frictions: Mapping[str, float],
    points: int = 0,
) -> str:
    """MJCF elements for choices that differ from MuJoCo's own, for a model in which geoms touch.

    notes: what no element says. frictions: of the scene's contacts, by name. points: at most so
    many of them are of one body. Numbers that need a solreffriction beside them are for a <pair>
    alone: a geom has none, and hops with them.
    """
    friction = max(frictions.values(), default=None)
    before = {choice.name: choice.value for choice in shipped}
    changed = {c.name: c.value for c in choices if before.get(c.name) != c.value}
    option = ET.Element("option", {"timestep": written(step)} | attributes(changed, "option"))
    if flags := attributes(changed, "flag"):
        ET.SubElement(option, "flag", flags)
    default, beside = ET.Element("default"), list[str]()
    for word, group in GROUPS.items():
        given = attributes(changed, word)
        if given and not (word == "pair" and _ALONE in given):
            place = section(default, group.default)
            if any(place.get(name, value) != value for name, value in given.items()):
                beside.append(f"each {group.default} of a {word} has {_listed(given)} instead")
            else:
                place.attrib.update(given)
        if word == "pair" and given:
            ET.SubElement(default, "pair", given)
    beside += _keep(before | changed, changed, default)
    beside += [_KEPT[element.tag] for element in default if element.tag in _KEPT]
    if (pair := default.find("pair")) is not None:
        need = _NEED if _ALONE in pair.attrib else ""
        beside.append(_PAIRS.format(need=need, pairs=_pairs(frictions)))
        if "margin" in pair.attrib:
            beside.append(_MARGIN)
        if float(pair.get("solimp", "1").split()[0]) < _SOFT:
            beside.append(_POINTS.format(points="one" if points == 1 else points))
    pyramid = {choice.name: choice.value for choice in choices}.get("option.cone") == "pyramidal"
    if pyramid and friction and any(name.startswith(_CONTACTS) for name in changed):
        beside.append(_PYRAMID + written(friction))
    for name, value in changed.items():
        where, _, attribute = name.rpartition(".")
        if where.startswith(f"{EACH}."):
            beside.append(f"{where.partition('.')[2]} alone has {attribute}={written(value)!r}")
    return "".join(
        [commented([*notes, *beside]), _text(option), _text(default) if len(default) else ""]
    )


def _keep(
    numbers: Mapping[str, Any], changed: Mapping[str, Any], default: ET.Element
) -> Iterator[str]:
    """A sentence for each group whose element of <default> has changed, but not its own numbers."""
    for word, group in GROUPS.items():
        place = default.find(group.default)
        if place is None or word == "pair" or attributes(changed, word):
            continue
        others = {n: x for n, x in attributes(numbers, word).items() if place.get(n, x) != x}
        if others:
            yield f"each {group.default} of a {word} keeps {_listed(others)}"


def _listed(numbers: Mapping[str, str]) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in numbers.items())


def _pairs(frictions: Mapping[str, float]) -> str:
    """One <pair> for contacts that are alike, or one for each of them, by its name."""
    alike: dict[float, list[str]] = {}
    for name, friction in frictions.items():
        alike.setdefault(friction, []).append(name)
    pairs = {
        _PAIR.format(condim=3 if friction else 1, friction=written(friction)): " and ".join(names)
        for friction, names in (alike or {0.0: []}).items()
    }
    return ", ".join(
        f"{pair} for {names}" if len(pairs) > 1 else pair for pair, names in pairs.items()
    )


def option_notes(options: Options, scene: Scene, rods: Collection[str]) -> list[str]:
    """Notes on those of the options that no element says, and on how the scene is built.

    rods: bodies that stand for its distances.
    """
    notes, contacts = list[str](), bool(worth(scene))
    timed = any(law.law not in BY_ITSELF for law in scene.laws())
    drives = sorted({quantity.partition(".")[0] for quantity in scene.drives})
    if rods:
        are = "is a body" if len(rods) == 1 else "are bodies"
        notes.append(
            f"of a model in which {' and '.join(rods)} {are} of hardly any mass with a hinge at "
            "either end: a tendon that is held by an equality is soft, and another model"
        )
    if drives:
        notes.append(
            f"of a model in which {' and '.join(drives)} has a heavy armature that goes on at the "
            "given rate: a <velocity> actuator follows it softly, and is another model"
        )
    if timed and options.get("integrator") == "RK4":
        notes.append(
            "a control that follows a law in time is to be set in mjcb_control, which RK4 asks at "
            "every stage: set between steps it is held, and the error of first order. The callback "
            "stands in the file of `show`"
        )
    if contacts and options.get("settled"):
        notes.append("starts as deep in the floor as it is carried there: the keyframe of `show`")
    if contacts and scene.frame is PLANE and options.get("noslip_iterations"):
        notes.append(
            "noslip does nothing for a body that has no freedom along the third axis, and all else "
            "here counts on it: give such a body a slide along that axis, or it hardly has friction"
        )
    return notes


def _text(element: ET.Element) -> str:
    ET.indent(element)
    return ET.tostring(element, encoding="unicode") + "\n"
