"""The nouns that an adapter meets, as their own source says them: every field, unit and meaning."""

import ast
import inspect
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields
from functools import cache
from typing import Any

from ....cases.fields.friction import Bounds, DryFriction, Smooth, Stribeck
from ....cases.fields.signal import Signal
from ....cases.language.grammar.joint import KINDS
from ....cases.scene import Scene, quantity
from ....cases.scene.body import Body
from ....cases.scene.constraint import Edge
from ....cases.scene.contact import Contact
from ....cases.scene.forces.force import NOUNS
from ....cases.scene.frame import PLANE, SPACE, Frame
from ....cases.scene.joint import FREEDOMS, Freedom, Joint
from ....cases.scene.pair import Pair
from ....cases.scene.plane import Plane
from ....cases.scene.point import Anchor, GroundPoint
from ....cases.scene.quantity import Quantity
from ....cases.trajectory import Trajectory
from ....engines.engine import (
    Choice,
    Claims,
    Engine,
    Maker,
    Paced,
    Plain,
    Plan,
    Refusal,
    Shape,
    Tunable,
)
from .table import markdown

PARTS: Mapping[str, tuple[type, ...]] = {
    "The scene": (Scene,),
    "Points of bodies and of the ground": (Anchor, GroundPoint),
    "Bodies": (Body,),
    "Joints": (Joint, Freedom, DryFriction, Bounds, Stribeck, Smooth),
    "Contacts": (Contact, Plane, Pair),
    "Constraints": (Edge,),
    "Forces": NOUNS,
    "Laws in time": (Signal,),
    "What an engine answers with": (Plan, Choice, Refusal, Shape, Trajectory),
    "Quantities": (Quantity,),
    "The engine": (Maker, Engine, Tunable, Plain, Claims, Paced),
}
"""What stands in which section."""
TOLD = ("Scene", "Body", "Contact", "Pair", "Joint")
"""Those of whose properties an adapter needs some."""


def nouns() -> str:
    """The page: for each noun what it is, its fields, and what can be asked of it."""
    return "\n".join(_page())


def _page() -> Iterator[str]:
    yield _frames()
    for head, kinds in PARTS.items():
        yield f"## {head}\n"
        if head == "Joints":
            yield _joints()
        for kind in kinds:
            yield from _noun(kind)
        if head == "Quantities":
            yield _quantities()


def _noun(kind: type) -> Iterator[str]:
    yield f"### {kind.__name__}\n"
    word = getattr(kind, "word", None)
    if isinstance(word, str):
        yield f"In a case file `{word}`.\n"
    yield f"{_text(kind)}\n"
    fields = described(kind)
    if fields:
        rows = [
            [f"`{name}`", f"`{_cell(of)}`", unit, _cell(said)] for name, of, unit, said in fields
        ]
        yield markdown([["field", "type", "unit", "what it is"], *rows])
    methods = [[f"`{name}`", _cell(said)] for name, said in _members(kind)]
    if methods:
        yield markdown([["member", "what it is"], *methods])


def described(kind: type) -> list[tuple[str, str, str, str]]:
    """Returns name, type, unit and meaning of each field of a noun: empty where nobody says it."""
    entries: dict[str, tuple[str, str, str]] = {}
    for base in reversed(kind.__mro__[:-1]):
        own = _fields(base) if base.__module__.startswith("textmech") else {}
        for name, (type_, unit, said) in own.items():
            _, older_unit, older = entries.get(name, ("", "", ""))
            entries[name] = type_, unit or older_unit, said or older
    names = [f.name for f in fields(kind)] if hasattr(kind, "__dataclass_fields__") else []
    said = _field_texts(kind)
    return [(n, *entries[n][:2], said.get(n) or entries[n][2]) for n in names if n in entries]


def _fields(kind: type) -> dict[str, tuple[str, str, str]]:
    """Type, unit and meaning of the fields that the class itself declares."""
    tree, lines = _source(kind)
    cells = {}
    for node, after in zip(tree.body, [*tree.body[1:], None], strict=True):
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            type_, unit = _annotated(node.annotation)
            said = " ".join(_comments(lines, node)) or _string(after)
            name = node.target.id
            cells[name] = type_, unit or _unit(said), said or ("its name" if name == "name" else "")
    return cells


def _comments(lines: list[str], node: ast.AST) -> Iterator[str]:
    """Yields the comments that stand behind the lines of a field."""
    for line in lines[node.lineno - 1 : node.end_lineno]:  # type: ignore[attr-defined]
        _, mark, said = line.partition("  # ")
        if mark and not said.startswith(("pyright", "type:", "fmt")):
            yield said.strip()


def _annotated(annotation: ast.expr) -> tuple[str, str]:
    """The type without its marks, and the unit that these give."""
    source = ast.unparse(annotation)
    units = re.findall(r"\b(?:In|InTime|PrescribedLaw)\('([^']+)'", source)
    unit = units[0] if units else "rad" if "Angle" in source else ""
    if "Direction" in source:
        return "Vector | None" if "None" in source else "Vector", "1"
    plain = re.sub(r"Annotated\[(\w+)(?:\[.*?\])?, (?:[^\[\]]|\[[^\]]*\])*\]", r"\1", source)
    plain = re.sub(r"\bAngle\b", "float", plain)
    return plain.replace("'", ""), unit


def _unit(said: str) -> str:
    """The unit that a comment gives, in brackets or behind a comma; of two both."""
    if brackets := re.search(r"\[([^\]]+)\]", said):
        return brackets[1]
    unit = r"(?:kg m²|kg|m/s²|m/s|rad/s|s/m|rad|N m|N|m|s)"
    units = re.search(rf"(?<![\w.]){unit}(?: or {unit})?(?=[,;:.]|$)", said)
    return units[0] if units else ""


def _field_texts(kind: type) -> dict[str, str]:
    """Returns what a docstring says of fields by name: `along: unit vector in body axes.`"""
    text = " ".join(_text(kind).split())
    names = "|".join(f.name for f in fields(kind)) if hasattr(kind, "__dataclass_fields__") else ""
    if not names:
        return {}
    said = re.split(rf"(?:(?<=\. )|^)({names}): ", text)
    return {name: what.strip() for name, what in zip(said[1::2], said[2::2], strict=True)}


def _members(kind: type) -> Iterator[tuple[str, str]]:
    """Yields the members: a protocol's all; of a noun what can be observed and what it answers."""
    protocol = getattr(kind, "_is_protocol", False)
    tree, _ = _source(kind)
    wanted = protocol or kind.__name__ in TOLD
    for node, after in zip(tree.body, [*tree.body[1:], None], strict=True):
        if protocol and isinstance(node, ast.AnnAssign):
            yield ast.unparse(node.target), _string(after)
        if not isinstance(node, ast.FunctionDef):
            continue
        said = " ".join((ast.get_docstring(node) or "").split())
        public = not node.name.startswith("_") or (protocol and node.name == "__call__")
        if node.name == "quantities":
            yield "quantities", said
        elif public and said and wanted and node.name not in ("quantities", "numbers"):
            asked = [arg.arg for arg in (*node.args.args, *node.args.kwonlyargs)][1:]
            known = any(ast.unparse(mark) == "property" for mark in node.decorator_list)
            yield node.name if known else f"{node.name}({', '.join(asked)})", said


def _joints() -> str:
    """Returns the freedoms that each kind of joint leaves, in the plane and in space."""
    plane = [
        [
            f"`{kind}`",
            ", ".join(sorted(freedom.kind for freedom in freedoms)) or "none",
            ", ".join(f"`{w}`" for f in freedoms if f.name for w in (f.name, f.rate, f.effort)),
        ]
        for kind, freedoms in FREEDOMS.items()
    ]
    space = [[f"`{kind}`", _cell(_text(made))] for kind, made in KINDS[3].items()]
    return (
        "Of the plane, `Joint.kind` and the freedoms of the second part against the first:\n\n"
        f"{markdown([['kind', 'leaves', 'place, rate and what a drive exerts'], *plane])}\n"
        "In space; all that an engine needs are its `freedoms`:\n\n"
        f"{markdown([['kind', 'leaves'], *space])}"
    )


def _quantities() -> str:
    """Returns the table of what can be observed of elements, and of the scene.

    The elements are those that have fields of their own; of forces see there.
    """
    rows = [["of", "quantity", "unit", "what it is"]]
    for kind in (kind for kinds in PARTS.values() for kind in kinds):
        module = inspect.getmodule(kind)
        if kind.__name__ in OBSERVED and module is not None:
            rows += [[kind.__name__, *row] for row in _quantity_rows(inspect.getsource(module))]
    rows += [["the scene", *row] for row in _quantity_rows(inspect.getsource(quantity), "_ENERGY")]
    return markdown(rows)


OBSERVED = [kind.__name__ for kind in (Body, Joint, Contact, Pair, Edge)]
"""The nouns beside which their file has what can be observed of them."""


def _quantity_rows(source: str, only: str = "") -> Iterator[list[str]]:
    """The quantities that a file declares: name, unit, and what the line says behind them."""
    lines = source.splitlines()
    for node in ast.parse(source).body:
        if not (isinstance(node, ast.AnnAssign) and ast.unparse(node.annotation) == "Fields"):
            continue
        if not isinstance(node.value, ast.Dict) or not ast.unparse(node.target).startswith(only):
            continue
        for key, value in zip(node.value.keys, node.value.values, strict=True):
            if isinstance(key, ast.Constant) and isinstance(value, ast.Tuple):
                unit = ast.literal_eval(value.elts[0])
                yield [f"`{key.value}`", unit, _cell(" ".join(_comments(lines, value)))]


def _frames() -> str:
    """Returns the table of the columns of a body's states, in the plane and in space."""
    rows = [[name, *_columns(frame)] for name, frame in (("PLANE", PLANE), ("SPACE", SPACE))]
    head = ["`scene.frame`", "place", "attitude", "velocity", "turning"]
    return f"{markdown([head, *rows])}\n{_frame_text()}\n"


def _columns(frame: Frame) -> list[str]:
    units = ("m", "rad" if frame is PLANE else "unit quaternion w, x, y, z", "m/s", "rad/s")
    slices = (frame.place, frame.attitude, frame.velocity, frame.spin)
    return [f"{s.start} to {s.stop - 1}: {unit}" for s, unit in zip(slices, units, strict=True)]


def _frame_text() -> str:
    from ....cases.scene import frame

    return (frame.__doc__ or "").strip()


def _text(kind: Any) -> str:
    return inspect.cleandoc(kind.__doc__ or "")


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def _string(node: ast.stmt | None) -> str:
    """Returns the docstring below a field."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return " ".join(str(node.value.value).split())
    return ""


@cache
def _source(kind: type) -> tuple[ast.ClassDef, list[str]]:
    text = inspect.getsource(kind)
    (tree,) = ast.parse(text).body
    assert isinstance(tree, ast.ClassDef)
    return tree, text.splitlines()
