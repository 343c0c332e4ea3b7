"""How long what a person types takes, in a fresh clone: `make speed` writes reports/speed.csv.

Seconds are a machine's own. So each stands beside its bound, which is meant for two idle cores of a
server, and its CPU time is told as a ratio too: over that of a plain loop of MuJoCo's steps, which
is measured before and after it, for a machine that others use is now fast and now slow. The next
reader compares the ratios.
"""

import csv
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from textmech.reports.tables.row import SPEED

ROOT = Path(__file__).parents[1]
LIST = ROOT / "reports" / SPEED
LOOP = """
import mujoco
model = mujoco.MjModel.from_xml_string(
    "<mujoco><worldbody><body><joint type='hinge' axis='0 1 0'/>"
    "<geom type='capsule' size='.01' fromto='0 0 0 1 0 0'/></body></worldbody></mujoco>"
)
data = mujoco.MjData(model)
for _ in range(400):
    mujoco.mj_step(model, data, 1000)
"""
"""The unit: 400,000 steps of a pendulum, and the import."""


@dataclass(frozen=True)
class Figure:
    """A row of the list. bound: of `wall`, or of `cpu` where what is typed takes one process."""

    what: str
    wall: float  # s
    cpu: float  # s
    ratio: float  # of cpu, over the plain loop's
    bound: float  # s
    of: str
    kept: str


@dataclass(frozen=True)
class Spent:
    """wall and cpu [s] of a command and its children."""

    wall: float
    cpu: float

    def __add__(self, other: "Spent") -> "Spent":
        return Spent(self.wall + other.wall, self.cpu + other.cpu)

    def __sub__(self, other: "Spent") -> "Spent":
        return Spent(self.wall - other.wall, self.cpu - other.cpu)


@dataclass(frozen=True)
class Clone:
    """A fresh clone, with a store of its own."""

    folder: Path
    store: Path

    def spent(self, *words: str | Path, fresh: bool = False) -> Spent:
        """Raises SystemExit with what the command says where it fails."""
        if fresh:
            subprocess.run(["rm", "-rf", self.store], check=True)
        told = {k: v for k, v in os.environ.items() if k not in ("PYTEST_ADDOPTS", "VIRTUAL_ENV")}
        before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(
            list(map(str, words)),
            cwd=self.folder,
            env={**told, "TEXTMECH_CACHE": str(self.store)},
            capture_output=True,
            text=True,
            check=False,
        )
        wall, after = time.monotonic() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise SystemExit(
                f"{' '.join(map(str, words))}\n{done.stdout[-4000:]}{done.stderr[-4000:]}"
            )
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return Spent(wall, cpu)

    def least(self, *words: str | Path, of: int = 5) -> Spent:
        """Of so many: what is short is disturbed easily."""
        return min((self.spent(*words) for _ in range(of)), key=lambda spent: spent.cpu)


def measured(clone: Clone) -> Iterator[tuple[str, Spent, float, str]]:
    """What is typed, what it took, its bound [s] and of which of both."""
    bin_ = clone.folder / ".venv" / "bin"
    textmech, python = bin_ / "textmech", bin_ / "python"
    set_up = clone.spent("make", "install")
    reports = clone.spent("make", "reports", fresh=True)
    yield "make reports, in a fresh clone, with its set-up", set_up + reports, 120.0, "wall"
    yield "make reports, nothing changed", clone.spent("make", "reports"), 10.0, "wall"
    run = clone.spent(textmech, "run", "--out", clone.folder / "out", fresh=True)
    yield "a run of all cases, nothing known", run, 60.0, "wall"
    (clone.folder / "reports" / "causes.csv").unlink()
    searched = clone.spent(textmech, "run", "--causes", "--out", clone.folder / "out")
    yield "a search of all causes beside it", searched, 60.0, "wall"
    clone.spent("git", "checkout", "--", ".")
    yield "make test, nothing known", clone.spent("make", "test", fresh=True), 240.0, "wall"
    yield "make test again", clone.spent("make", "test"), 90.0, "wall"
    case = clone.folder / "cases" / "four_bar.yaml"
    imported = (python, "-c", "from textmech.reports import run")
    yield "textmech check of one file", clone.least(textmech, "check", case), 0.8, "cpu"
    yield "textmech list", clone.least(textmech, "list"), 0.5, "cpu"
    shown = clone.least(textmech, "show", "four_bar", "--engine", "mujoco.tuned")
    yield "textmech show four_bar", shown, 0.5, "cpu"
    yield "from textmech.reports import run", clone.least(*imported), 0.5, "cpu"


def figures(clone: Clone) -> Iterator[Figure]:
    """Each as soon as it is known."""
    before: float | None = None
    for what, spent, bound, of in measured(clone):
        after = clone.least(clone.folder / ".venv" / "bin" / "python", "-c", LOOP).cpu
        unit = after if before is None else (before + after) / 2
        kept = "yes" if getattr(spent, of) <= bound else "no"
        yield Figure(what, spent.wall, spent.cpu, spent.cpu / unit, bound, of, kept)
        before = after


def write(found: Sequence[Figure]) -> None:
    """The list, as it is committed."""
    with LIST.open("w", encoding="utf-8", newline="") as lines:
        out = csv.DictWriter(lines, [f.name for f in fields(Figure)], lineterminator="\n")
        out.writeheader()
        for figure in found:
            numbers = {n: f"{getattr(figure, n):.3g}" for n in ("wall", "cpu", "ratio", "bound")}
            out.writerow({**asdict(figure), **numbers})


def main() -> None:
    """Measures in a clone of the last commit, and writes what is found as it comes."""
    found: list[Figure] = []
    with tempfile.TemporaryDirectory(prefix="textmech-speed-") as place:
        clone = Clone(Path(place) / "clone", Path(place) / "store")
        subprocess.run(["git", "clone", "--quiet", ROOT, clone.folder], check=True)
        for figure in figures(clone):
            found.append(figure)
            write(found)
            print(f"{figure.what:50} {figure.wall:7.1f} s, {figure.cpu:7.1f} s of CPU", flush=True)
    sys.exit(any(figure.kept == "no" for figure in found))


if __name__ == "__main__":
    main()
