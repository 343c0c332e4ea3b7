"""How many of mistakes drawn by chance `make quick` sees at the first try: `make mutants`.

cosmic-ray plants each alone in a clone of the last commit, never here, and runs there what `make
quick` asks of the changed file. The list, reports/mutation.csv, is written at the end. Its last two
columns are typed by a person: why a mistake survives, and what was done then.
"""

import argparse
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import threading
import uuid
from collections import defaultdict
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pandas as pd

from textmech.reports.tables.row import MUTATION

ROOT = Path(__file__).parents[1]
NAME = "textmech"  # of the folder of a clone: as the package is called, so that it is imported
FOLDERS = ["cases", "reference", "engines", "reports"]
EACH = 60  # s of one test: it takes 1.5 s where it is sound
ALL = 1200.0  # s of all tests of one mistake
MEMORY = 8_000_000  # KiB of one process

# What stays among numbers or truths: a shift of floats, or a decorator that is gone, only raises.
NUMBERS, ORDERED = "Add|Sub|Mul|Div|FloorDiv|Mod|Pow", "Lt|LtE|Gt|GtE|Eq|NotEq"
OPERATORS = re.compile(
    rf"core/(ReplaceBinaryOperator_({NUMBERS})_({NUMBERS})"
    rf"|ReplaceComparisonOperator_(({ORDERED})_({ORDERED})|Is_IsNot|IsNot_Is)"
    r"|AddNot|ExceptionReplacer|NumberReplacer|ReplaceAndWithOr|ReplaceOrWithAnd"
    r"|ReplaceBreakWithContinue|ReplaceContinueWithBreak|ReplaceFalseWithTrue|ReplaceTrueWithFalse"
    r"|ReplaceUnaryOperator_Delete_(Not|USub)|ZeroIterationForLoop)"
)
COMMAND = (
    "sh -c 'ulimit -c 0 -v {memory}; files=$({python} tests/touched.py); exec {python} -m pytest "
    '-x -q -m "not slow" -p no:cacheprovider --timeout {each} {engines} $files\''
)
CONFIG = """\
[cosmic-ray]
module-path = {folders}
timeout = {all}
excluded-modules = []
test-command = {command}
[cosmic-ray.distributor]
name = "local"
"""


def kind(operator: str) -> str:
    """Returns what all operators share that put another thing of the same kind there."""
    return operator.rsplit("_", 2)[0] if "Operator_" in operator else operator


def draw(items: Sequence[Any], count: int, seed: int) -> list[Any]:
    """Returns so many work items of cosmic-ray, drawn by chance, each on another place.

    The place and the kind first: a product has six operators in its place, a truth one.
    """
    places: defaultdict[tuple[str, ...], list[Any]] = defaultdict(list)
    for item in items:
        (mutation,) = item.mutations
        if OPERATORS.fullmatch(mutation.operator_name):
            place = (str(mutation.module_path), str(mutation.start_pos))
            places[*place, kind(mutation.operator_name)].append(item)
    chance = random.Random(seed)
    chosen = chance.sample(sorted(places), min(count, len(places)))
    return [chance.choice(sorted(places[place], key=_order)) for place in chosen]


def _order(item: Any) -> tuple[str, int]:
    (mutation,) = item.mutations
    return mutation.operator_name, mutation.occurrence


def changed(diff: str) -> str:
    """Returns `before -> after` of the lines that a diff changes, each on one line."""
    lines = [line for line in diff.splitlines() if not line.startswith(("---", "+++"))]
    before, after = (" ".join(x[1:].strip() for x in lines if x[:1] == sign) for sign in "-+")
    return f"{before} -> {after}"


def outcome(result: Any) -> tuple[str, str]:
    """Returns `seen`, `timeout` or `survived`, and the test that saw it."""
    if result.test_outcome == "survived":
        return "survived", ""
    output = result.output or ""
    test = re.search(r"^(?:FAILED|ERROR) (\S+)", output, re.MULTILINE)
    if "Timeout" in output or output == "timeout":
        return "timeout", test[1] if test else ""
    return "seen", test[1] if test else "no test starts"


def run(count: int, seed: int, jobs: int) -> Iterator[dict[str, Any]]:
    """Yields a row of the list for each mistake, tried in so many clones at once."""
    from cosmic_ray.work_db import WorkDB, use_db  # pyright: ignore[reportMissingImports]

    git = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    commit = subprocess.check_output(git, cwd=ROOT, text=True).strip()
    with tempfile.TemporaryDirectory(prefix="textmech-mutants-") as folder:
        clones = [Path(folder) / str(job) / NAME for job in range(jobs)]
        for clone in clones:
            _clone(clone)
        _cosmic_ray(clones[0], "baseline")  # what fails without a mistake sees none
        _cosmic_ray(clones[0], "init", "../all.sqlite")
        with use_db(str(clones[0].parent / "all.sqlite"), WorkDB.Mode.open) as db:
            drawn = draw(list(db.work_items), count, seed)
        threads = []
        for job, clone in enumerate(clones):
            with use_db(str(clone.parent / "drawn.sqlite"), WorkDB.Mode.create) as db:
                db.add_work_items(drawn[job::jobs])
            words = (clone, "exec", "../drawn.sqlite")
            threads.append(threading.Thread(target=_cosmic_ray, args=words))
            threads[-1].start()
        for thread in threads:
            thread.join()
        number = {str(item.job_id): i for i, item in enumerate(drawn, 1)}
        for clone in clones:
            with use_db(str(clone.parent / "drawn.sqlite"), WorkDB.Mode.open) as db:
                places = {str(item.job_id): item.mutations[0] for item in db.work_items}
                for job_id, result in ((str(key), each) for key, each in db.results):
                    place, (word, seen_by) = places[job_id], outcome(result)
                    yield {
                        "seed": seed, "number": number[job_id], "file": str(place.module_path),
                        "line": place.start_pos[0], "operator": place.operator_name,
                        "change": changed(result.diff or ""), "outcome": word, "seen_by": seen_by,
                        "tool": f"cosmic-ray {version('cosmic-ray')}", "commit": commit,
                        "why": "", "done": "",
                    }  # fmt: skip


def _clone(clone: Path) -> None:
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(clone)], check=True)
    engines = "--textmech-engine=mujoco.tuned --textmech-engine=pymunk.tuned"
    command = COMMAND.format(memory=MEMORY, python=sys.executable, each=EACH, engines=engines)
    text = CONFIG.format(folders=FOLDERS, all=ALL, command=json.dumps(command))
    (clone.parent / "config.toml").write_text(text, encoding="utf-8")


def _cosmic_ray(clone: Path, what: str, *session: str) -> None:
    words = [sys.executable, "-m", "cosmic_ray.cli", what, "../config.toml", *session]
    subprocess.run(words, cwd=clone, check=True, env=environment(clone))


def environment(clone: Path) -> dict[str, str]:
    """Returns the environment in which a clone's own package is imported."""
    path = f"{clone.parent}{os.pathsep}{clone / 'tests'}"
    cache = str(clone.parent / f"cache-{uuid.uuid4().hex}")
    return {**os.environ, "PYTHONPATH": path, "TEXTMECH_CACHE": cache, "OMP_NUM_THREADS": "1"}


def main(words: Sequence[str]) -> None:
    """Draws, tries, writes and prints the count."""
    parser = argparse.ArgumentParser(description="How many planted mistakes does make quick see?")
    parser.add_argument("--count", type=int, default=150, help="how many are drawn (150)")
    parser.add_argument("--seed", type=int, default=1, help="of the draw (1)")
    parser.add_argument("--jobs", type=int, default=2, help="how many at once (2)")
    parser.add_argument("--out", type=Path, default=ROOT / "reports" / MUTATION)
    chosen = parser.parse_args(words)
    table = pd.DataFrame(run(chosen.count, chosen.seed, chosen.jobs)).sort_values("number")
    table.to_csv(chosen.out, index=False)
    survived = table[table["outcome"] == "survived"]
    for row in survived.itertuples():
        print(f"{row.file}:{row.line}: {row.change}")
    print(f"{len(table) - len(survived)} of {len(table)} planted mistakes seen at the first try")


if __name__ == "__main__":
    main(sys.argv[1:])
