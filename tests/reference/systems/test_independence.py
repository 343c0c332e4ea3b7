"""A hand-written system shares no code with the answers it is compared with."""

import ast
from pathlib import Path

import pytest
from given.command.tree import FILES, PACKAGES, ROOT, absolute

HERE = "reference.systems"
SYSTEMS = sorted(
    path
    for path in FILES
    if path.is_relative_to(ROOT / "reference" / "systems")
    and path.name not in ("__init__.py", "stated.py")  # the tables
)
ALLOWED = {
    *("numpy", "scipy.special", "math", "cmath", "dataclasses", "functools", "typing"),
    *("collections.abc", "itertools"),
    # The shape of an answer, and the book's laws of friction and of turning axes: no mechanics of a
    # scene.
    *("reference.system", "reference.laws.friction", "reference.laws.rotation"),
    # And those of one body, that the generated answers do without (below).
    *("reference.laws.inertia", "reference.laws.momentum"),
    "reference.stated",
    "reference.coverage",  # no mechanics: it notes which equations run
    # The mathematics of closed forms.
    *(f"{HERE}.elliptic", f"{HERE}.quadrature"),
    f"{HERE}.friction.dynamometer",  # by which a block on a floor is drawn
    f"{HERE}.pendula.elastic_pendulum",  # which a mass on a leg is
    f"{HERE}.walkers.compass_walker",  # which the simplest walker is, before its limit
    *(f"{HERE}.rolling.blade_on_plane", f"{HERE}.rolling.wheel_on_plane"),
    *(f"{HERE}.robots.{name}" for name in ("triples", "arm", "serial_arm")),
    *(f"{HERE}.friction.{name}" for name in ("stick_slip", "slope", "block_on_guide")),
}


def imported(source: str, file: Path) -> set[str]:
    """Modules named by the import statements anywhere in the source of a file."""
    names = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = absolute(file, node)
            whole = base.split(".")[0] in PACKAGES and (ROOT / base.replace(".", "/")).is_dir()
            names |= {f"{base}.{alias.name}" for alias in node.names} if whole else {base}
    return names


@pytest.mark.parametrize("path", SYSTEMS, ids=lambda path: path.stem)
def test_system_imports_nothing_of_the_other_answers(path: Path):
    assert imported(path.read_text(encoding="utf-8"), path) <= ALLOWED


LAWS = {f"reference.laws.{name}" for name in ("inertia", "momentum", "energy")}


@pytest.mark.slow
def test_no_law_of_one_body_is_shared_with_the_generated_answers():
    for room in ("mechanism", "states", "formalisms", "start"):
        files = [*(ROOT / "reference" / room).rglob("*.py")]
        assert files, room
        for path in files:
            assert not imported(path.read_text(encoding="utf-8"), path) & LAWS, path


def test_every_system_is_seen():
    assert {path.stem for path in SYSTEMS} >= {"bar_pendulum", "four_bar", "rolling_wheel"}


@pytest.mark.parametrize(
    "line",
    [
        "import textmech.cases", "from ....cases.shape import bar", "from ...laws.force import f",
        "from ...formalisms import lagrange", "from ... import mechanism",
        "from .. import four_bar", "from .bar_pendulum import G",
        "def f():\n    from ....cases import scene",
    ],
)  # fmt: skip
def test_forbidden_import_is_seen(line: str):
    assert not imported(line, ROOT / "reference/systems/pendula/bar_pendulum.py") <= ALLOWED
