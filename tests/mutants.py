"""How many of mistakes drawn by chance the tests see at the first try: `make mutants`.

Each is planted alone in a copy of the tree, never here, and asked of the tests of its own room. The
list, reports/mutation.csv, is written after each, and those in it are not tried again; of another
draw's it keeps none. Its last two columns are typed by a person and kept: why a mistake survives,
and what was done then.
"""

import argparse
import csv
import queue
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

from drawn import Mistake, draw, texts, tool
from tried import SEEN, SURVIVED, TIMED_OUT, UNDECIDED, Copy, Outcome, Sound, tried

from textmech.reports.data.row import MUTATION

ROOT = Path(__file__).parents[1]
LIST = ROOT / "reports" / MUTATION
FOLDERS = ("cases", "reference", "engines", "reports")


@dataclass
class Row:
    """A line of the list. outcome: at the first try, whatever was done after that."""

    seed: int
    number: int
    file: str
    line: int
    operator: str
    change: str
    outcome: str
    seen_by: str
    tests: int
    tool: str
    commit: str
    why: str = ""
    done: str = ""


def rows(file: Path) -> list[Row]:
    """What is in the list."""
    if not file.is_file():
        return []
    with file.open(encoding="utf-8", newline="") as lines:
        read = list(csv.DictReader(lines))
    return [_row(row) for row in read]


def _row(texts_: Mapping[str, Any]) -> Row:
    return Row(
        **{**texts_, **{name: int(texts_[name]) for name in ("seed", "number", "line", "tests")}}
    )


def write(file: Path, found: Iterable[Row]) -> None:
    """All at once: who is ended meanwhile leaves the list as it was."""
    beside = file.with_suffix(".new")
    with beside.open("w", encoding="utf-8", newline="") as lines:
        out = csv.DictWriter(lines, [f.name for f in fields(Row)], lineterminator="\n")
        out.writeheader()
        out.writerows(asdict(row) for row in sorted(found, key=lambda r: (r.seed, r.number)))
    beside.replace(file)


def key(row: Row | Mistake) -> tuple[str, str, str]:
    """What makes two mistakes the same, wherever the line has moved to."""
    return row.file, row.operator, row.change


def told(found: Sequence[Row], seed: int, drawn: int) -> str:
    """The numbers, and who survives, each with its place."""
    count = Counter(row.outcome for row in found)
    seen = count[SEEN] + count[TIMED_OUT]
    lines = [
        f"{row.file}:{row.line}: {row.change}" + (f"  ({row.why})" if row.why else "")
        for row in found
        if row.outcome in (SURVIVED, UNDECIDED)
    ]
    first = f"{seen} of {len(found)} planted mistakes seen at the first try"
    if count[TIMED_OUT]:
        first += f" ({count[TIMED_OUT]} by a time-out)"
    if count[UNDECIDED]:
        first += f"; {count[UNDECIDED]} not within the time for their tests"
    by = ", ".join(sorted({row.tool for row in found}))
    return "\n".join([*lines, f"{first}; seed {seed}, {drawn} drawn, by {by}"])


def run(
    mistakes: Sequence[Mistake],
    seed: int,
    jobs: int,
    file: Path,
    root: Path = ROOT,
    *,
    quick: bool = False,
) -> None:
    """Tries those that are not in the list yet, in the drawn order, on so many copies."""
    known = {key(row): row for row in chosen(file, mistakes)}
    free: queue.SimpleQueue[Copy] = queue.SimpleQueue()
    waiting = [one for one in mistakes if key(one) not in known]

    def one(mistake: Mistake) -> tuple[Mistake, Outcome]:
        copy = free.get()
        try:
            return mistake, tried(mistake, copy, sound, quick=quick)
        finally:
            free.put(copy)

    words = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    state = subprocess.run(words, cwd=root, capture_output=True, text=True, check=True).stdout
    with tempfile.TemporaryDirectory(prefix="textmech-mutants-") as place:
        sound = Sound(Copy(Path(place) / "sound").fill(root))
        for i in range(jobs):
            free.put(Copy(Path(place) / str(i)).fill(root))
        with ThreadPoolExecutor(jobs) as pool:
            tasks = [pool.submit(one, mistake) for mistake in waiting]
            try:
                for task in as_completed(tasks):
                    mistake, out = task.result()
                    known[key(mistake)] = row(seed, mistake, out, state.strip())
                    write(file, known.values())
                    print(_line(mistake, out), flush=True)
            finally:
                pool.shutdown(wait=False, cancel_futures=True)


def row(seed: int, one: Mistake, out: Outcome, state: str) -> Row:
    """What the list says of it."""
    place = (seed, one.number, one.file, one.line, one.operator, one.change)
    return Row(*place, out.said, out.by, out.run, tool(), state)


def _line(one: Mistake, out: Outcome) -> str:
    return f"{one.number:4} {out.said:16} {one.file}:{one.line}: {one.change}  {out.by}"


def chosen(file: Path, mistakes: Sequence[Mistake]) -> list[Row]:
    """Those of the list that are drawn now."""
    found: Mapping[tuple[str, str, str], Row] = {key(row): row for row in rows(file)}
    return [found[key(one)] for one in mistakes if key(one) in found]


def main(words: Sequence[str]) -> None:
    """Draws, tries, writes and tells."""
    asked = argparse.ArgumentParser(description="How many planted mistakes do the tests see?")
    asked.add_argument("--count", type=int, default=150, help="how many are drawn (150)")
    asked.add_argument("--seed", type=int, default=1, help="of the draw (1)")
    asked.add_argument("--jobs", type=int, default=2, help="how many at once (2)")
    asked.add_argument("--out", type=Path, default=LIST, help="the list (reports/mutation.csv)")
    asked.add_argument("--quick", action="store_true", help="only what `make quick` asks")
    told_ = asked.parse_args(words)
    if told_.quick and told_.out == LIST:
        asked.error("--quick needs --out: the list holds what all tests of a room see")
    mistakes = draw(texts(ROOT, FOLDERS), told_.count, told_.seed)
    run(mistakes, told_.seed, told_.jobs, told_.out, quick=told_.quick)
    print(told(chosen(told_.out, mistakes), told_.seed, len(mistakes)))


if __name__ == "__main__":
    main(sys.argv[1:])
