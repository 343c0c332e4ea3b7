"""Mistakes drawn by chance: where in the four folders, and what stands there in place of what did.

What may be planted on a line says the tool cosmic-ray by its operators; which of its lines is drawn
by a seed, in each folder as many as it has a share of all lines of code. No person has a say in it.
"""

import ast
import difflib
import random
import tokenize
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from io import StringIO
from pathlib import Path

SILENT = {
    tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT,
    tokenize.ENDMARKER,
}  # fmt: skip
NUMBERS = ("Add", "Sub", "Mul", "Div", "FloorDiv", "Mod", "Pow")
ORDERED = ("Lt", "LtE", "Gt", "GtE", "Eq", "NotEq")
ALONE = (
    "core/AddNot", "core/ExceptionReplacer", "core/NumberReplacer", "core/ReplaceAndWithOr",
    "core/ReplaceBreakWithContinue", "core/ReplaceContinueWithBreak", "core/ReplaceFalseWithTrue",
    "core/ReplaceOrWithAnd", "core/ReplaceTrueWithFalse", "core/ReplaceUnaryOperator_Delete_Not",
    "core/ReplaceUnaryOperator_Delete_USub", "core/ZeroIterationForLoop",
    "core/ReplaceComparisonOperator_Is_IsNot", "core/ReplaceComparisonOperator_IsNot_Is",
)  # fmt: skip
TRIES = 1000  # lines that are drawn for one mistake: most have something to be planted on


@dataclass(frozen=True)
class Spot:
    """Where an operator of the tool can change a file: its how-manieth place there, from 0."""

    line: int
    operator: str
    occurrence: int

    @property
    def kind(self) -> str:
        """What all operators are that put another thing of the same kind there."""
        return self.operator.rsplit("_", 2)[0]


@dataclass(frozen=True)
class Mistake:
    """A mistake to be planted. change: `before -> after` of its line or lines."""

    number: int
    file: str
    line: int
    operator: str
    change: str
    source: str


def operators() -> list[str]:
    """Those of the tool that stay among numbers or truths: a shift of floats only raises."""
    pairs = [("Binary", a, b) for a in NUMBERS for b in NUMBERS if a != b]
    pairs += [("Comparison", a, b) for a in ORDERED for b in ORDERED if a != b]
    return sorted([*ALONE, *(f"core/Replace{kind}Operator_{a}_{b}" for kind, a, b in pairs)])


def tool() -> str:
    """Its name with its version."""
    return f"cosmic-ray {version('cosmic-ray')}"


def tool_spots(source: str) -> list[Spot]:
    """All that the tool can plant in a file."""
    from cosmic_ray.ast import ast_nodes, get_ast  # pyright: ignore[reportMissingImports]
    from cosmic_ray.plugins import get_operator  # pyright: ignore[reportMissingImports]

    nodes, found = list(ast_nodes(get_ast(source))), list[Spot]()
    for name in operators():
        one = get_operator(name)()
        places = [begin[0] for node in nodes for begin, _ in one.mutation_positions(node)]
        found += [Spot(line, name, i) for i, line in enumerate(places)]
    return found


def tool_planted(source: str, spot: Spot) -> str:
    """The file with the mistake."""
    from cosmic_ray.mutating import mutate_code  # pyright: ignore[reportMissingImports]
    from cosmic_ray.plugins import get_operator  # pyright: ignore[reportMissingImports]

    return mutate_code(source, get_operator(spot.operator)(), spot.occurrence) or source


def code(source: str) -> set[int]:
    """Lines that do something: neither blank, comment nor docstring, nor only for the types."""
    tokens = tokenize.generate_tokens(StringIO(source).readline)
    lines = {token.start[0] for token in tokens if token.type not in SILENT}
    for node in ast.walk(ast.parse(source)):
        idle = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        typed = isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        if isinstance(node, ast.stmt) and (idle or typed):
            lines -= set(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    return lines


def shares(lines: Mapping[str, int], count: int) -> dict[str, int]:
    """How many of each folder: in proportion, and together the count."""
    whole = sum(lines.values())
    found = {name: count * n // whole for name, n in lines.items()}
    rest = sorted(lines, key=lambda name: (-(count * lines[name] % whole), name))
    return {name: n + (name in rest[: count - sum(found.values())]) for name, n in found.items()}


def draw(
    folders: Mapping[str, Mapping[str, str]],
    count: int,
    seed: int,
    spots: Callable[[str], list[Spot]] = tool_spots,
    plant: Callable[[str, Spot], str] = tool_planted,
) -> list[Mistake]:
    """So many different mistakes in an order by chance; the texts of each folder by their names."""
    chance, spots = random.Random(seed), cache(spots)
    lines = {
        folder: [(name, line) for name in sorted(texts) for line in sorted(code(texts[name]))]
        for folder, texts in folders.items()
    }
    found = dict[tuple[str, str], tuple[str, Spot, str]]()
    for folder, share in shares({name: len(all_) for name, all_ in lines.items()}, count).items():
        wanted = len(found) + share
        for name, line in _lines(lines[folder], chance, wanted):
            text = folders[folder][name]
            drawn = _one([spot for spot in spots(text) if spot.line == line], chance)
            after = plant(text, drawn) if drawn else text
            if drawn and _differs(text, after):
                found[name, after] = name, drawn, after
            if len(found) == wanted:
                break
        else:
            raise ValueError(f"{folder} has no {share} mistakes to be drawn")
    order = chance.sample(list(found.values()), len(found))
    return [
        Mistake(
            i, name, spot.line, spot.operator, change(folders_text(folders, name), after), after
        )
        for i, (name, spot, after) in enumerate(order, 1)
    ]


def folders_text(folders: Mapping[str, Mapping[str, str]], name: str) -> str:
    """The text of a file, in whichever folder it lies."""
    return next(texts[name] for texts in folders.values() if name in texts)


def _lines(
    lines: list[tuple[str, int]], chance: random.Random, wanted: int
) -> Iterator[tuple[str, int]]:
    for _ in range(TRIES * wanted):
        yield chance.choice(lines)


def _one(spots: list[Spot], chance: random.Random) -> Spot | None:
    """The kind first: a product has six operators in its place, a truth one."""
    kinds = sorted({spot.kind for spot in spots})
    if not kinds:
        return None
    kind = chance.choice(kinds)
    return chance.choice([spot for spot in spots if spot.kind == kind])


def _differs(before: str, after: str) -> bool:
    """Whether the other text is a program, and runs otherwise: types that are told run nowhere."""
    try:
        return _run(before) != _run(after)
    except SyntaxError:
        return False


def _run(source: str) -> str:
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            node.returns = None
        if isinstance(node, ast.arg):
            node.annotation = None
        if isinstance(node, ast.AnnAssign):
            node.annotation = ast.Constant(0)
    return ast.dump(tree)


def change(before: str, after: str) -> str:
    """What stood there and what stands there now, each on one line."""
    told = difflib.ndiff(before.splitlines(), after.splitlines())
    kept = [line for line in told if line[:2] in ("- ", "+ ")]
    old = " ".join(line[2:].strip() for line in kept if line[0] == "-")
    new = " ".join(line[2:].strip() for line in kept if line[0] == "+")
    return f"{old} -> {new}"


def texts(root: Path, folders: tuple[str, ...]) -> dict[str, dict[str, str]]:
    """Each folder's programs by their path from the root."""
    return {
        folder: {
            file.relative_to(root).as_posix(): file.read_text(encoding="utf-8")
            for file in sorted((root / folder).rglob("*.py"))
        }
        for folder in folders
    }
