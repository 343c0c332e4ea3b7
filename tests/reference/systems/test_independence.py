"""A hand-written system shares no code with the answers it is compared with."""

import ast
from pathlib import Path

import pytest

from textmech.reference import systems

SYSTEMS = sorted(
    path for path in Path(next(iter(systems.__path__))).glob("*.py")
    if path.name not in ("__init__.py", "stated.py")  # the tables
)  # fmt: skip
ALLOWED = {
    *("numpy", "scipy.special", "math", "cmath", "dataclasses", "functools", "typing"),
    *("collections.abc", "itertools"),
    # The shape of an answer, and the book's laws of friction and of turning axes: no mechanics of a
    # scene.
    *("..system", "..mode", "..laws.friction", "..laws.rotation", ".stick_slip"),
    # And those of one body, that the generated answers do without (below).
    *("..stated", "..laws.inertia", "..laws.momentum", "..laws.energy"),
    # The mathematics of closed forms, and closed forms in files of their own.
    *(".elliptic", ".nutation", ".polhode"),
    ".tilting_ring",  # of which a disk is one
    ".dynamometer",  # by which a block on a floor is drawn
    ".elastic_pendulum",  # which a mass on a leg is
    ".spring_mass_jump",  # of which a run is several
    ".compass_walker",  # which the simplest walker is, before its limit
    ".muscle_load",  # of which one is held
    ".spoke_steps",
    *(".blade_on_plane", ".wheel_on_plane", ".triples", ".arm", ".serial_arm", ".quadrature"),
    *(".slope", ".block_on_guide"),
}


def imported(source: str) -> set[str]:
    """Modules named by the import statements anywhere in the source."""
    names = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            names.add("." * node.level + (node.module or ""))
    return names


@pytest.mark.parametrize("path", SYSTEMS, ids=lambda path: path.stem)
def test_system_imports_nothing_of_the_other_answers(path: Path):
    assert imported(path.read_text(encoding="utf-8")) <= ALLOWED


LAWS = {"laws.inertia", "laws.momentum", "laws.energy"}


@pytest.mark.slow
def test_no_law_of_one_body_is_shared_with_the_generated_answers():
    root = Path(next(iter(systems.__path__))).parent
    for room in ("generated", "states", "formalisms", "start"):
        for path in (root / room).rglob("*.py"):
            names = {name.lstrip(".") for name in imported(path.read_text(encoding="utf-8"))}
            assert not names & LAWS, path


def test_every_system_is_seen():
    assert {path.stem for path in SYSTEMS} >= {"bar_pendulum", "four_bar", "rolling_wheel"}


@pytest.mark.parametrize(
    "line",
    [
        "import textmech.cases", "from ...cases.shape import bar", "from ..inertia import disk",
        "from ..formalisms import lagrange", "from .. import mechanism",
        "from . import four_bar", "from .bar_pendulum import G",
        "def f():\n    from ...cases import scene",
    ],
)  # fmt: skip
def test_forbidden_import_is_seen(line: str):
    assert not imported(line) <= ALLOWED
