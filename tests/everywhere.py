"""Whether textmech installs and works without pins: `make everywhere`, and `.ci/run` with --smoke.

On each Python that is there it makes an environment of the lowest versions that pyproject.toml
allows, and one of the newest that there are, runs three cases and the quick tests in it, and says
whether it is green. The lowest are read from pyproject.toml: what it requires as `>=` is installed
as `==`.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from packaging.requirements import Requirement
from packaging.version import Version

ROOT = Path(__file__).parents[1]
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
CASES = ("four_bar", "tilting_disk.falls", "bouncing_ball")  # a loop, space, impacts: both engines
QUICK = ("-m", "not slow", "tests")
# Seconds of what asks each library that is required, and not only numpy through the references:
# ruamel and pydantic read a file, pint its units, click its mistakes, filelock a cache, pandas and
# matplotlib write a table and a picture, jinja a page, numpy and scipy make tables and roots.
SMOKE = (
    "-m", "not slow", "tests/cases/test_units.py", "tests/cases/test_mistakes.py",
    "tests/reference/integrators/test_accuracy.py::test_radau_conditions",
    "tests/reference/systems/test_closed_forms.py::test_no_number_is_complex",
    "tests/reports/runs/test_cache.py", "tests/reports/front/page/test_rows.py",
    "tests/reports/front/test_cli.py::test_a_mistake_outweighs_a_verdict",
    "tests/reports/tables/test_replace.py",
    "tests/reports/front/test_readme_parts.py", "tests/reports/tables/test_write.py",
)  # fmt: skip
LINES = 40  # of what went wrong


@dataclass(frozen=True)
class Python:
    """An interpreter that runs, with its version."""

    program: str
    version: str

    @property
    def minor(self) -> str:
        """3.12 of 3.12.1."""
        return ".".join(self.version.split(".")[:2])


class Red(Exception):
    """The step that failed and what it said."""


def pythons(minors: Sequence[str] = PYTHONS) -> Iterator[Python]:
    """Yields one interpreter of each minor version: of the path, or else of pyenv."""
    root = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    for minor in minors:
        name = f"python{minor}"
        ours = sorted(root.glob(f"versions/{minor}.*/bin/{name}"), key=_release, reverse=True)
        for program in [shutil.which(name), *ours]:
            asked = [program, "-c", "import ensurepip, platform; print(platform.python_version())"]
            if program and not (told := subprocess.run(asked, capture_output=True)).returncode:
                yield Python(str(program), told.stdout.decode().strip())
                break


def _release(program: Path) -> tuple[int, ...]:
    return tuple(map(int, re.findall(r"\d+", program.parts[-3])))


def lowest(project: dict, python: str) -> list[str]:
    """`name==version` of each library that a user or a test needs, on that version of Python."""
    floors: dict[str, Version] = {}
    for text in (*project["dependencies"], *project["optional-dependencies"]["test"]):
        required = Requirement(text)
        if required.marker and not required.marker.evaluate({"python_version": python}):
            continue
        given = [Version(each.version) for each in required.specifier if each.operator == ">="]
        if not given:
            raise ValueError(f"pyproject.toml: {text!r} names no least version")
        floors[required.name] = max(*given, floors.get(required.name, Version("0")))
    return [f"{name}=={version}" for name, version in floors.items()]


def tried(python: Python, which: str, folder: Path, words: Sequence[str]) -> str:
    """Installs the versions and runs all of it. Returns what is there of numpy; raises Red."""
    program, constraints = folder / "venv" / "bin" / "python", folder / "constraints.txt"
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    pins = lowest(project, python.minor) if which == "lowest" else []
    constraints.write_text("\n".join(pins), encoding="utf-8")
    pip = [program, "-m", "pip", "--disable-pip-version-check"]
    options = [
        "--quiet",
        "--no-compile",
        "--constraint",
        constraints,
        "--editable",
        f"{ROOT}[test]",
    ]
    _run(folder, "no environment", python.program, "-m", "venv", folder / "venv")
    _run(folder, "cannot be installed", *pip, "install", *options)
    _run(folder, "versions do not fit together", *pip, "check")
    _run(folder, "textmech run fails", program, "-m", "textmech", "run", *CASES)
    # What old libraries say of each other (matplotlib 3.9 of a new pyparsing) is not ours to mend.
    old = ["-W", "ignore::DeprecationWarning"] if which == "lowest" else []
    _run(folder, "tests fail", program, "-m", "pytest", "-q", "-n", "auto", *old, *words)
    asked = "import numpy, scipy; print('numpy', numpy.__version__, 'scipy', scipy.__version__)"
    return _run(folder, "no numpy", program, "-c", asked).strip()


def _run(folder: Path, wrong: str, *words: object) -> str:
    """The output. Raises Red: what is wrong then, and the last lines."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    own = clean | {"TEXTMECH_CACHE": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}
    line = [*map(str, words)]
    done = subprocess.run(line, cwd=ROOT, env=own, text=True, stdout=-1, stderr=subprocess.STDOUT)
    if done.returncode:
        said = [each for each in done.stdout.splitlines() if each.strip()]
        raise Red(f"{wrong} (exit code {done.returncode}):", *said[-LINES:])
    return done.stdout


def main(*words: str) -> int:
    """Tries each, says how it is, and returns the exit code: 1 if any is red."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n\n")[0])
    parser.add_argument("--smoke", action="store_true", help="the lowest on the oldest Python, the "
        "newest on the newest, and a few tests: what lies between is seldom worse")  # fmt: skip
    parser.add_argument("--python", action="append", choices=PYTHONS, help="only this one")
    parser.add_argument("tests", nargs="*", help="in place of all quick tests")
    asked = parser.parse_args(words)
    there = [*pythons(asked.python or PYTHONS)]
    environments = [(python, which) for python in there for which in ("lowest", "newest")]
    if asked.smoke and there:
        environments = [(there[0], "lowest"), (there[-1], "newest")]
    for minor in asked.python or PYTHONS:
        if minor not in {python.minor for python in there}:
            print(f"Python {minor}: not here", flush=True)
    reds = 0
    for python, which in environments:
        begun, told = time.monotonic(), ""
        with tempfile.TemporaryDirectory(prefix="textmech-everywhere-") as folder:
            try:
                chosen = asked.tests or (SMOKE if asked.smoke else QUICK)
                told = f"green, {tried(python, which, Path(folder), chosen)}"
            except Red as red:
                reds += 1
                told = "red: " + "\n    ".join(map(str, red.args))
        lasted = time.monotonic() - begun
        print(f"Python {python.version}, {which}: {told} ({lasted:.0f} s)", flush=True)
    return 1 if reds or not environments else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
