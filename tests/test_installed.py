"""The wheel in somebody else's environment, beside a project whose packages have our names."""

import csv
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path

import pytest
from given.scenes.swing import SWING

from textmech.reports.tables import write
from textmech.reports.tables.diff.folder import NOT_PACKED

ROOT = Path(__file__).parents[1]
OURS = ("cases", "reference", "engines", "reports")
NAMES = {"textmech", "__editable__"}  # what an installed suite leaves beside other packages


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    others = ("__init__.py", "__main__.py", "py.typed", "pyproject.toml", "README.md", "LICENSE")
    return built(ROOT, (*OURS, *others), tmp_path_factory)


@pytest.fixture(scope="module")
def python(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return environment(tmp_path_factory, wheel)


def built(root: Path, parts: Iterable[str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of a copy: setuptools keeps what it built once, and would pack removed files."""
    copy, out = tmp_path_factory.mktemp("source") / root.name, tmp_path_factory.mktemp("wheel")
    copy.mkdir()
    for name in parts:
        if (root / name).is_dir():
            shutil.copytree(root / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(root / name, copy / name)
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation",
        "--disable-pip-version-check", "--wheel-dir", out, copy, cwd=copy)  # fmt: skip
    (file,) = out.glob("*.whl")
    return file


def environment(tmp_path_factory: pytest.TempPathFactory, *wheels: Path) -> Path:
    """A fresh environment: the wheels, and the packages they need as links to those of this one."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder / "venv", with_pip=False, symlinks=True)
    python = folder / "venv" / "bin" / "python"
    site = Path(run(python, "-c", "import site; print(site.getsitepackages()[0])").stdout.strip())
    for package in Path(sysconfig.get_path("purelib")).iterdir():
        if not any(name in package.name for name in NAMES):
            (site / package.name).symlink_to(package)
    run(sys.executable, "-m", "pip", "--python", python, "install", "--quiet", "--no-deps",
        "--disable-pip-version-check", *wheels)  # fmt: skip
    return python


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project of a stranger with packages of the same four names, and tests that use them."""
    for name in OURS:
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(f"MINE = {name!r}\n", encoding="utf-8")
    uses = "\n".join(f"    import {name}\n    assert {name}.MINE == {name!r}" for name in OURS)
    (tmp_path / "test_mine.py").write_text(f"def test_mine():\n{uses}\n", encoding="utf-8")
    (tmp_path / "swing.yaml").write_text(SWING, encoding="utf-8")
    return tmp_path


def run(*words: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """As a user does, whose shell knows nothing of this checkout."""
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "PYTEST"))}
    clean["TEXTMECH_CACHE"] = os.devnull  # nothing is stored, and nothing found
    done = subprocess.run(
        [*map(str, words)], capture_output=True, text=True, cwd=cwd, env=clean, check=False
    )
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    return done


@pytest.mark.slow
def test_the_wheel_holds_one_package_and_its_data(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0].split("-")[0] for name in names} == {"textmech"}
    assert {"textmech/__init__.py", "textmech/py.typed"} <= set(names)
    data = ("cases", "*.yaml"), ("cases", "*.json"), ("cases/questions", "*.yaml")
    told = [(name, "*.md") for name in (*OURS, "cases/questions")]
    for folder, pattern in (*data, *told):
        files = [file.name for file in (ROOT / folder).glob(pattern)]
        assert files
        assert {f"textmech/{folder}/{file}" for file in files} <= set(names)
    tables = {name.removeprefix("textmech/reports/") for name in names if name.endswith(".csv")}
    assert tables == {*write.FILES} - {*NOT_PACKED}


@pytest.mark.slow
def test_a_strangers_tests_run_as_before(python: Path, project: Path) -> None:
    assert "1 passed" in run(python, "-m", "pytest", "-q", cwd=project).stdout


@pytest.mark.slow
def test_a_case_is_tested_beside_them(python: Path, project: Path) -> None:
    done = run(python, "-m", "pytest", "-v", "test_mine.py", "swing.yaml", cwd=project).stdout
    assert "test_mine.py::test_mine PASSED" in done
    for engine in ("mujoco", "pymunk"):
        assert f"swing.yaml::swing-{engine}.tuned-rod.angle PASSED" in done


@pytest.mark.slow
def test_the_command_runs_beside_them(python: Path, project: Path) -> None:
    done = run(python.parent / "textmech", "run", "swing.yaml", cwd=project)
    assert "swing in mujoco" in done.stdout
    assert "swing in pymunk" in done.stdout
    assert "bar_pendulum" in run(python.parent / "textmech", "list", cwd=project).stdout


@pytest.mark.slow
def test_a_run_is_compared_with_the_packed_tables(python: Path, project: Path) -> None:
    run(python, "-m", "textmech", "run", "translation", "--out", "mine", cwd=project)
    done = run(python, "-m", "textmech", "diff", "mine", cwd=project)
    for name in NOT_PACKED:
        assert f"not looked at: {name}, which only NEW has" in done.stdout


@pytest.mark.slow
def test_it_says_its_version(python: Path, project: Path) -> None:
    """Where it is asked for alone: reading it imports nothing of ours."""
    asked = "import sys, textmech; print(textmech.__version__, 'textmech.reports' in sys.modules)"
    assert run(python, "-c", asked, cwd=project).stdout.split() == [version("textmech"), "False"]


@pytest.mark.slow
def test_it_is_asked_from_python(python: Path, project: Path) -> None:
    asked = "from textmech.reports import run; print(run('swing.yaml').summary.worst.to_list())"
    assert "×" in run(python, "-c", asked, cwd=project).stdout


@pytest.mark.slow
def test_a_full_run_would_write_where_the_user_stands(python: Path, project: Path) -> None:
    asked = "from textmech.reports.tables import write; print(write.by_default())"
    assert run(python, "-c", asked, cwd=project).stdout == "textmech-reports\n"


@pytest.mark.slow
def test_the_plug_in_imports_nothing_of_ours_until_a_case_is_collected(
    python: Path, project: Path
) -> None:
    (project / "conftest.py").write_text(
        "import sys\n"
        "def pytest_unconfigure():\n"
        "    ours = sorted(name for name in sys.modules if name.startswith('textmech.'))\n"
        "    print('imported:', *ours)\n",
        encoding="utf-8",
    )
    done = run(python, "-m", "pytest", "-q", "-s", "test_mine.py", cwd=project)
    imported = done.stdout.partition("imported:")[2].split()
    front = "textmech.reports.front"
    assert imported == ["textmech.reports", front, f"{front}.pytest_plugin"]


BALL = """\
title: A ball on a spring, thrown
scene:
  points: {O: [0, 0]}
  bodies: {ball: {particle: {mass: 0.5}}}
  forces: {coil: {spring: [ground.O, ball.center], stiffness: 20.0, rest_length: 0.5}}
initial: {ball: {x: 0, y: -0.6, vx: 0.3, vy: 0}}
duration: 0.4
samples: 6
allow: {ball.x: 1.0e-2}
reach: {toy: {ball.x: 1.0e-2}}
"""


@pytest.mark.slow
def test_an_engine_of_somebody_else_is_a_column(
    wheel: Path, project: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Its wheel beside ours is all: no file of ours names it."""
    toy = ROOT / "tests" / "toy_engine"
    parts = ("pyproject.toml", "toy_engine.py")
    python = environment(tmp_path_factory, wheel, built(toy, parts, tmp_path_factory))
    (project / "ball.yaml").write_text(BALL, encoding="utf-8")
    command = (python.parent / "textmech", "run", "ball.yaml", "swing.yaml", "--out", "out")
    done = run(*command, cwd=project)
    assert "toy.shipped" in done.stdout
    with (project / "out" / "tolerance.csv").open(encoding="utf-8", newline="") as lines:
        toys = [row for row in csv.DictReader(lines) if row["engine"] == "toy"]
    assert [(row["case"], row["quantity"]) for row in toys] == [
        ("ball", "audit"),
        ("ball", "ball.x"),
        ("swing", "rod.angle"),
    ]
    assert [row["verdict"] for row in toys] == ["agrees", "agrees", "refused"]
    assert toys[-1]["because"] == "engine: toy has no joints and no contacts"
    checked = run(python.parent / "textmech", "check-engine", "toy", "falls", "spring", "pendulum")
    told = [line.split()[:2] for line in checked.stdout.splitlines() if line[:1].isalpha()]
    assert told[4:7] == [["works", "falls"], ["works", "spring"], ["refused", "pendulum"]]
    assert "as if places are half a step ahead" in checked.stdout  # semi-implicit Euler
    ladder = (project / "out" / "convergence.csv").read_text(encoding="utf-8")
    assert "ball,toy,1.0,shipped,native,held,ball.x" in ladder
    done = run(python, "-m", "pytest", "-v", "ball.yaml", "--textmech-engine", "toy", cwd=project)
    assert "ball.yaml::ball-toy.shipped-ball.x PASSED" in done.stdout
