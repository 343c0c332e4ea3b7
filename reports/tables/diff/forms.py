"""The difference between two report folders as text for a terminal, as JSON and as Markdown.

Regressions come first; within a kind, changes of one case, engine and file stand together.
"""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from itertools import groupby
from math import isfinite
from textwrap import wrap
from typing import Any

from .columns import BETTER, CHANGED, KINDS, LOST, NEW, WORSE
from .compare import Change, Difference
from .folder import Folder

TITLES = {
    WORSE: "Regressions",
    BETTER: "Better",
    CHANGED: "Changed",
    LOST: "Lost rows",
    NEW: "New rows",
}
PLURALS = {kind: "regressions" if kind == WORSE else kind for kind in KINDS}
WIDTH = 80
MOST = 30  # changes shown of a kind: more have one cause as a rule, and are not read one by one
LISTED = 50  # the same in Markdown: a comment holds 65 000 letters
NAMES = 6  # of cases that only one folder has
HEAD = ("case", "engine", "what", "OLD → NEW", "file")
SPECIAL = str.maketrans(
    {c: f"\\{c}" for c in "\\`*_[]|~"} | {"<": "&lt;", ">": "&gt;", "&": "&amp;"}
)


def text(difference: Difference, *, width: int = WIDTH, every: bool = False) -> str:
    """Returns the difference in lines of at most `width` columns, or of 40 if that is less.

    every: all changes are shown, and not the first of a kind.
    """
    lines = [*looked_at(difference)]
    for _, title, places, hidden in _sections(difference, None if every else MOST):
        lines += ["", title]
        for (case, column, file), changes in places:
            lines.append(f"  {' '.join(filter(None, (case, column)))}  [{file}]")
            lines += [f"    {names}: {said}" for names, said in changes]
        lines += [f"  and {hidden} more: --all shows them"] if hidden else []
    lines += ["", _summary(difference)]
    return "\n".join(part for line in lines for part in fitted(line, width))


def fitted(line: str, width: int) -> list[str]:
    """Returns the lines of a line broken to this width; those after the first are indented more."""
    indent = len(line) - len(line.lstrip())
    further = " " * (indent + 4)
    return wrap(line, max(width, 40), subsequent_indent=further, break_on_hyphens=False) or [""]


def markdown(difference: Difference, *, every: bool = False) -> str:
    """Returns the difference for a pull request: regressions open, all else folded.

    every: all changes are shown, and not the first of a kind.
    """
    lines = [f"### {'❌' if difference.regressed else '✅'} textmech: {_summary(difference)}", ""]
    lines += [f"- {_plain(line)}" for line in looked_at(difference)]
    for kind, title, places, hidden in _sections(difference, None if every else LISTED):
        folded = kind != WORSE
        lines += ["", f"<details><summary>{title}</summary>" if folded else f"**{title}**", ""]
        lines += [_cells(HEAD), _cells(["---"] * len(HEAD))]
        for (case, column, file), changes in places:
            lines += [_cells(map(_plain, (case, column, *said, file))) for said in changes]
        lines += ["", f"and {hidden} more"] if hidden else []
        lines += ["", "</details>"] if folded else []
    return "\n".join([*lines, ""])


def _cells(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _plain(text: str) -> str:
    """Escapes text of a report, which is text, and never markup."""
    return " ".join(text.split()).translate(SPECIAL)


def as_json(difference: Difference) -> str:
    """Returns the whole difference as JSON text; a number that JSON has not (inf, NaN) is null."""
    sides = {
        side: {"folder": folder.name, "run": folder.run, "versions": folder.versions}
        for side, folder in (("old", difference.old), ("new", difference.new))
    }
    names = "compared", "not looked at", "not searched by both"
    document = {
        **sides,
        "rule": asdict(difference.rule),
        "regressed": difference.regressed,
        "counts": {kind: len(difference.of(kind)) for kind in KINDS},
        "rows": {
            file: dict(zip(names, count, strict=True)) for file, count in difference.counts.items()
        },
        "files of one folder": list(difference.alone),
        "changes": [_change(change) for change in difference.changes],
        "mistakes": [],
        "exit_code": int(difference.regressed),
    }
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)


def _change(change: Change) -> dict[str, Any]:
    return {
        "kind": change.kind,
        "file": change.file,
        **dict(zip(("case", "column", "what"), change.place, strict=True)),
        "old": change.old and {"words": change.old.words, "number": _finite(change.old.number)},
        "new": change.new and {"words": change.new.words, "number": _finite(change.new.number)},
        "number is": change.label,
        "unit": change.unit,
        "allowed": _finite(change.allowed),
        "times": _finite(change.times),
        "note": change.note,
    }


def _finite(number: float | None) -> float | None:
    return None if number is None or not isfinite(number) else number


def looked_at(difference: Difference) -> Iterator[str]:
    """Yields which folders there are, how many rows were compared, and what was not, and why."""
    counts = difference.counts.values()
    sides = ("OLD", difference.old), ("NEW", difference.new)
    for side, folder in sides:
        engines = ", ".join(f"{engine} {version}" for engine, version in folder.versions.items())
        yield f"{side} {folder.name}: run {folder.run}, {engines or 'no engine'}"
    rows = sum(count.compared for count in counts)
    cases, columns = len(difference.cases), len(difference.engines)
    yield f"compared: {_many(rows, 'row')} of {_many(cases, 'case')} in {_many(columns, 'column')}"
    for i, (side, folder) in enumerate(sides):
        if skipped := sum(count.left[i] for count in counts):
            yield f"not looked at: {_many(skipped, 'row')} of {side}: {_why(difference, folder)}"
    for name, count in difference.counts.items():
        if any(count.searched):
            old, new = count.searched
            of_both = f"{_many(old, 'row')} of OLD and {new} of NEW in {name}"
            yield f"not looked at: {of_both}: one of the runs, or both, did not search for causes"
    for name in difference.alone:
        side = "OLD" if name in difference.old.tables else "NEW"
        yield f"not looked at: {name}, which only {side} has"


def _why(difference: Difference, folder: Folder) -> str:
    cases = sorted(folder.cases - difference.cases)
    columns = sorted(".".join(engine) for engine in folder.engines - difference.engines)
    named = [f"case {_first(cases)}"] * bool(cases) + [f"column {_first(columns)}"] * bool(columns)
    if not named:
        return "of cases that its tolerance.csv does not name"
    return f"only it has {' and '.join(named)}"


def _first(names: Sequence[str]) -> str:
    more = f" and {len(names) - NAMES} more" if len(names) > NAMES else ""
    return f"{', '.join(names[:NAMES])}{more}"


def _many(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"


def _summary(difference: Difference) -> str:
    """Returns `2 regressions, 3 better, 24 changed`, or that nothing is."""
    counts = ((kind, len(difference.of(kind))) for kind in KINDS)
    parts = [f"{n} {kind if n == 1 else PLURALS[kind]}" for kind, n in counts if n]
    return ", ".join(parts) or "nothing changed"


Neighbours = list[tuple[tuple[str, str, str], list[tuple[str, str]]]]
"""By case, column and file what is said: names and a sentence."""


def _sections(changed: Difference, most: int | None) -> Iterator[tuple[str, str, Neighbours, int]]:
    """Yields each kind that there is, its title, the first changes, and how many are left out."""
    for kind in KINDS:
        if changes := changed.of(kind):
            shown = changes[:most]
            title = f"{TITLES[kind]} ({len(changes)})"
            yield kind, title, _neighbours(shown), len(changes) - len(shown)


def _neighbours(changes: Iterable[Change]) -> Neighbours:
    """Sorts changes by their places; names of one sentence stand together."""
    neighbours: Neighbours = []
    for place, some in groupby(changes, key=lambda c: (*c.place[:2], c.file)):
        names: dict[str, list[str]] = {}
        for change in some:
            names.setdefault(_sentence(change), []).append(change.place[2])
        neighbours.append((place, [(", ".join(what), said) for said, what in names.items()]))
    return neighbours


def _sentence(change: Change) -> str:
    """Says a change without its name: `agrees → beyond; 0.0021 → 0.0042 rad ×2, allowed 0.001`."""
    was, now = change.old, change.new
    if now is None:
        return "no such row any more"
    words = now.words
    if was is not None and was.words != now.words:
        if now.number is None:
            return f"now {now.words}"
        words = f"{was.words.partition(':')[0]} → {now.words}"
        if was.number is None:
            return words
    note = change.note or ("not in OLD" if was is None else "")
    return "; ".join(filter(None, (words, _numbers(change), note)))


def _numbers(change: Change) -> str:
    """Returns `0.0021 → 0.0042 rad ×2, allowed 0.001`, as far as there are numbers."""
    contents = [content for content in (change.old, change.new) if content]
    numbers = ["" if content.number is None else f"{content.number:.9g}" for content in contents]
    text = numbers[0] if len({*numbers}) == 1 else " → ".join(word or "none" for word in numbers)
    if not text:
        return ""
    label = f"{change.label} " if change.label else ""
    unit = f" {change.unit}" if change.unit not in ("", "1") else ""
    times = f" ×{change.times:.3g}" if change.times is not None else ""
    allowed = f", allowed {change.allowed:.3g}" if change.allowed is not None else ""
    return f"{label}{text}{unit}{times}{allowed}"
