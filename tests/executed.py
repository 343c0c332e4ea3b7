"""Which shipped cases execute a program: tests/executed.csv, by which `make quick` chooses some.

`python tests/executed.py` writes it anew, in some ten minutes: it is worth it where many functions
have come. Of each program it names those of a panel of cheap cases, the cheapest first, that
together execute every function of it that any of them does.
"""

import argparse
import csv
import json
import re
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
LIST = Path(__file__).with_suffix(".csv")
FOLDERS = ("cases", "reference", "engines", "reports")
ENGINES = ("mujoco.tuned", "pymunk.tuned")  # as `make quick` asks for: what is shipped runs less
MOST = 4  # case files of one program
AT_LEAST = 2  # a second one runs other branches of the same functions

PANEL = [
    f"cases/{name}.yaml"
    for name in (
        *("bar_pendulum", "four_bar", "cradle", "friction_of_rest", "gyroscope", "muscle_load"),
        *(
            "tipping_block",
            "pulled_hook",
            "top_on_floor",
            "skew_chain",
            "running_gait",
        ),
        *("torsion_pendulum", "driven_wheel", "sliding_points", "hung_shapes"),
        *("stribeck_brake", "tethered_box", "rolling_sphere", "compass_walker"),
        *("sliding_ladder", "elastic_pendulum", "knife_edge", "disk_on_disk", "robot_knife"),
    )
]
"""Cheap cases of every kind of element; a hand-written system has its own case beside them."""

Executed = Mapping[str, frozenset[str]]
"""By program, the functions of it that a case file executes, as `name:line`."""


def executed(file: Path) -> tuple[Executed, float]:
    """What one case file executes here and now, and the CPU time [s] that it takes."""
    from textmech.reports.runs import suite
    from textmech.reports.runs.request import Request
    from textmech.reports.runs.selection import choose_cases, choose_engines

    seen = set[Any]()

    def profile(frame: Any, event: str, _: Any) -> None:
        if event == "call":
            seen.add(frame.f_code)

    cases, engines = choose_cases([str(file)]), choose_engines(ENGINES, [])
    began = time.process_time()
    threading.setprofile(profile)
    with ThreadPoolExecutor(1) as here:
        suite.measure(Request(cases, engines, executor=here))
    threading.setprofile(None)  # type: ignore[arg-type]
    took, found = time.process_time() - began, dict[str, set[str]]()
    for code in seen:
        path = Path(code.co_filename)
        if path.is_relative_to(ROOT) and path.relative_to(ROOT).parts[0] in FOLDERS:
            name = f"{code.co_qualname}:{code.co_firstlineno}"
            found.setdefault(path.relative_to(ROOT).as_posix(), set()).add(name)
    return {program: frozenset(names) for program, names in found.items()}, took


def chosen(program: str, found: Mapping[str, tuple[Executed, float]]) -> list[str]:
    """The case files for a program, those that cost least for what they add; then the cheapest."""
    functions = {case: ran[program] for case, (ran, _) in found.items() if program in ran}
    left, names = frozenset[str]().union(*functions.values()), list[str]()
    while left and len(names) < MOST:
        best = max(functions, key=lambda case: (len(functions[case] & left) / found[case][1], case))
        names.append(best)
        left -= functions[best]
    more = sorted(functions.keys() - {*names}, key=lambda case: (found[case][1], case))
    names += more[: max(0, AT_LEAST - len(names))]
    return sorted(names, key=lambda case: (found[case][1], case))


def read(file: Path = LIST) -> dict[str, list[str]]:
    """By program, the case files that execute it."""
    with file.open(encoding="utf-8", newline="") as lines:
        return {row["program"]: row["cases"].split() for row in csv.DictReader(lines)}


def of_systems() -> dict[str, list[str]]:
    """By program with hand-written systems, the case files that name one of them."""
    tables = ("reference/systems/__init__.py", "reference/systems/states/stated.py")
    text = "".join((ROOT / table).read_text(encoding="utf-8") for table in tables)
    modules = dict(re.findall(r'"(\w+)": "([\w.]+):', text))
    found: dict[str, list[str]] = {}
    for file in sorted((ROOT / "cases").glob("*.yaml")):
        for name in re.findall(r"^system: (\w+)", file.read_text(encoding="utf-8"), re.MULTILINE):
            program = f"reference/systems/{modules[name].replace('.', '/')}.py"
            found.setdefault(program, []).append(file.relative_to(ROOT).as_posix())
    return found


def write(found: Mapping[str, tuple[Executed, float]], file: Path = LIST) -> None:
    """Writes them for every program that any case executes."""
    programs = sorted({program for ran, _ in found.values() for program in ran})
    with file.open("w", encoding="utf-8", newline="") as lines:
        out = csv.writer(lines, lineterminator="\n")
        out.writerow(["program", "cases"])
        out.writerows([program, " ".join(chosen(program, found))] for program in programs)


def _apart(file: Path) -> tuple[Executed, float]:
    """The same in a process of its own, where nothing is remembered."""
    words = [sys.executable, __file__, "--one", str(file)]
    said = subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT).stdout
    ran, took = json.loads(said.splitlines()[-1])
    print(f"{took:6.1f} s  {file.name}", flush=True)
    return {program: frozenset(names) for program, names in ran.items()}, took


def all_of_them(files: Iterable[Path], jobs: int) -> dict[str, tuple[Executed, float]]:
    """By case file, relative to the checkout, what it executes and what it costs [s]."""
    files = list(files)
    with ThreadPoolExecutor(jobs) as pool:
        found = zip(files, pool.map(_apart, files), strict=True)
        return {file.relative_to(ROOT).as_posix(): ran for file, ran in found}


def main(words: Sequence[str]) -> None:
    """Writes the list; with --one prints what one case file executes."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--one", type=Path)
    asked.add_argument("files", nargs="*", type=Path, default=[ROOT / name for name in PANEL])
    asked.add_argument("--jobs", type=int, default=2)
    told = asked.parse_args(words)
    if told.one is not None:
        ran, took = executed(told.one)
        print(json.dumps([{program: sorted(names) for program, names in ran.items()}, took]))
        return
    write(all_of_them((file.resolve() for file in told.files), told.jobs))


if __name__ == "__main__":
    main(sys.argv[1:])
