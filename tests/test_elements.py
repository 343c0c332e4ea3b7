"""Elements answer for themselves: nobody else asks what they are, and a new one fits in."""

import ast
import math
import subprocess
import sys
from pathlib import Path

import pytest
from scipy.integrate import quad

from textmech.cases.scene.forces.force import FORCES
from textmech.cases.scene.joint import FREEDOMS

ROOT = Path(__file__).parents[1]
FILES = [
    file
    for package in ("cases", "reference", "engines", "reports")
    for file in sorted((ROOT / package).rglob("*.py"))
]
KINDS = {noun.__name__ for noun in FORCES.values()} | {"Line"}


def asked(source: str) -> list[str]:
    """Where a program asks which kind of force or joint something is."""
    return [ast.unparse(node) for node in ast.walk(ast.parse(source)) if _asks(node)]


def _asks(node: ast.AST) -> bool:
    if isinstance(node, ast.Call) and ast.unparse(node.func) in ("isinstance", "issubclass"):
        return bool(KINDS & _words(node.args[1]))
    if isinstance(node, ast.MatchClass):
        return bool(KINDS & _words(node.cls))
    if isinstance(node, ast.Compare):
        texts = {n.value for n in ast.walk(node) if isinstance(n, ast.Constant)}
        kinds = [n for n in ast.walk(node) if isinstance(n, ast.Attribute) and n.attr == "kind"]
        words = [n for n in ast.walk(node) if isinstance(n, ast.Attribute) and n.attr == "word"]
        return bool((kinds and texts & set(FREEDOMS)) or (words and texts & set(FORCES)))
    return False


def _words(node: ast.AST) -> set[str]:
    names = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
    return names | {n.attr for n in ast.walk(node) if isinstance(n, ast.Attribute)}


@pytest.mark.slow
def test_nobody_asks_an_element_what_it_is() -> None:
    found = {str(file.relative_to(ROOT)): asked(file.read_text("utf-8")) for file in FILES}
    assert {file: places for file, places in found.items() if places} == {}


@pytest.mark.parametrize(
    "line",
    [
        "isinstance(force, Spring | Damper)", "isinstance(f, (scene.Push, Torque))",
        "match force:\n    case Damper(a=a):\n        pass", "joint.kind == 'pin'",
        "joint.kind not in ('slide', 'weld')", "force.word != 'spring'",
    ],
)  # fmt: skip
def test_asking_is_seen(line: str) -> None:
    assert asked(line)


def answers(script: str, folder: Path) -> dict[str, float]:
    """The numbers that a script beside this file prints, by their names."""
    run = subprocess.run(
        [sys.executable, Path(__file__).with_name(script), folder],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    return {name: float(size) for name, size in map(str.split, run.stdout.splitlines())}


@pytest.mark.slow
def test_a_new_force_element_is_said_in_five_places(tmp_path: Path) -> None:
    """tests/cable.py adds one to the tables, in a process of its own, and a case uses it."""
    found = answers("cable.py", tmp_path)
    assert found["energy"] < 1e-13  # J: the shared potential is that of the force
    assert found["mujoco"] < 1e-9
    assert found["hinge.fx"] < 1e-7
    assert found["pymunk"] < 1e-4


@pytest.mark.slow
def test_a_new_element_of_one_side_is_said_in_four_places(tmp_path: Path) -> None:
    """tests/strut.py adds one on which a ball lies, 30° from the top, and leaves where it has to.

    It leaves at cos θ = 2/3 cos 30°, after ∫ dθ/√(2 g/L (cos 30° − cos θ)), with θ = 30° + u².
    """
    found = answers("strut.py", tmp_path)
    begin, end = math.pi / 6, math.acos(2 / 3 * math.cos(math.pi / 6))

    def slowness(u: float) -> float:
        fallen = math.cos(begin) - math.cos(begin + u * u)
        return 2 * u / math.sqrt(2 * 9.80665 / 0.5 * fallen) if u else 0.0

    time, _ = quad(slowness, 1e-9, math.sqrt(end - begin), epsabs=1e-13, epsrel=1e-13)
    assert found["leaves"] == pytest.approx(time, rel=1e-7)
    for engine in ("mujoco", "pymunk"):
        assert found[engine] < 1e-4  # m: a step of 0.1 ms at 1 m/s
        assert found[f"{engine}.force"] < 1e-2  # N of 17


@pytest.mark.slow
def test_a_new_joint_is_said_in_one_place(tmp_path: Path) -> None:
    """tests/bearing.py adds one of a slide and a turn, on which a bar falls and turns evenly."""
    found = answers("bearing.py", tmp_path)
    assert found["turned"] < 1e-12
    assert found["fallen"] < 1e-12
    assert found["mujoco"] < 1e-9
