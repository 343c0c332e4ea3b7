"""A difference in words: what every form of it says alike."""

from collections.abc import Iterable, Iterator
from itertools import groupby

from .change import BETTER, CHANGED, KINDS, LOST, NEW, WORSE, Change, Seen
from .compare import Difference
from .folder import Folder

TITLES = {
    WORSE: "Regressions",
    BETTER: "Better",
    CHANGED: "Changed",
    LOST: "Lost rows",
    NEW: "New rows",
}
PLURALS = {WORSE: "regressions", BETTER: "better", CHANGED: "changed", LOST: "lost", NEW: "new"}
NAMES = 6  # of cases that only one folder has


def head(side: str, folder: Folder) -> str:
    """`OLD reports: run 48c1babb8100, mujoco 4.0.0, pymunk 7.3.1`."""
    engines = ", ".join(f"{engine} {version}" for engine, version in folder.versions.items())
    return f"{side} {folder.name}: run {folder.run}, {engines or 'no engine'}"


def summary(found: Difference) -> str:
    """`2 regressions, 3 better, 24 changed`, or that nothing is."""
    counts = ((kind, len(found.of(kind))) for kind in KINDS)
    told = [f"{n} {kind if n == 1 else PLURALS[kind]}" for kind, n in counts if n]
    return ", ".join(told) or "nothing changed"


def looked_at(found: Difference) -> Iterator[str]:
    """How many rows were compared, and what was not, with its reason."""
    rows = sum(count.compared for count in found.counts.values())
    cases, columns = len(found.scope.cases), len(found.scope.columns)
    yield f"compared: {_many(rows, 'row')} of {_many(cases, 'case')} in {_many(columns, 'column')}"
    for side, folder in (("OLD", found.old), ("NEW", found.new)):
        counts = found.counts.values()
        left = sum(count.old if side == "OLD" else count.new for count in counts)
        if left:
            yield f"not looked at: {_many(left, 'row')} of {side}: {_why(found, folder)}"
    for name, count in found.counts.items():
        if any(count.searched):
            old, new = count.searched
            rows = f"{_many(old, 'row')} of OLD and {new} of NEW in {name}"
            yield f"not looked at: {rows}: one of the runs, or both, did not search for causes"
    for name in found.alone:
        side = "OLD" if name in found.old.tables else "NEW"
        yield f"not looked at: {name}, which only {side} has"


def verdict(change: Change) -> str:
    """`agrees → beyond`, or the one that both say; of the old one without its reason."""
    if change.was is None or change.now is None or change.was.words == change.now.words:
        return (change.now or change.was or Seen("")).words
    return f"{change.was.words.partition(':')[0]} → {change.now.words}"


def numbers(change: Change) -> str:
    """`0.0021 → 0.0042 rad ×2, allowed 0.001`, as far as there are numbers."""
    told = [_number(seen) for seen in (change.was, change.now) if seen]
    text = told[0] if len({*told}) == 1 else " → ".join(word or "none" for word in told)
    if not text:
        return ""
    label = f"{change.label} " if change.label else ""
    unit = f" {change.unit}" if change.unit not in ("", "1") else ""
    times = f" ×{change.times:.3g}" if change.times is not None else ""
    allowed = f", allowed {change.allowed:.3g}" if change.allowed is not None else ""
    return f"{label}{text}{unit}{times}{allowed}"


def note(change: Change) -> str:
    """Returns what else is to be said of a change, and whether only one folder has its row."""
    if change.now is None:
        return "no such row any more"
    return change.note or ("not in OLD" if change.was is None else "")


def sentence(change: Change) -> str:
    """Says a change without its name: `agrees → beyond; 0.0021 → 0.0042 rad ×2, allowed 0.001`."""
    if change.now is None:
        return note(change)
    if change.was is not None and change.was.words != change.now.words:
        if change.now.number is None:
            return f"now {change.now.words}"
        if change.was.number is None:
            return verdict(change)
    return "; ".join(filter(None, (verdict(change), numbers(change), note(change))))


def alike(changes: Iterable[Change]) -> list[tuple[str, str]]:
    """Returns each change as its name and a sentence; names of one sentence stand together."""
    names: dict[str, list[str]] = {}
    for change in changes:
        names.setdefault(sentence(change), []).append(change.place.what)
    return [(", ".join(some), said) for said, some in names.items()]


def by_place(changes: Iterable[Change]) -> Iterator[tuple[str, str, str, list[tuple[str, str]]]]:
    """Case, column and file of neighbours, and what is said of them."""
    for (case, column, file), some in groupby(
        changes, key=lambda change: (change.place.case, change.place.column, change.file)
    ):
        yield case, column, file, alike(some)


def _number(seen: Seen) -> str:
    return "" if seen.number is None else f"{seen.number:.9g}"


def _why(found: Difference, folder: Folder) -> str:
    cases = sorted(folder.scope.cases - found.scope.cases)
    columns = sorted(".".join(c) for c in folder.scope.columns - found.scope.columns)
    named = (("case", cases), ("column", columns))
    told = [f"{what} {_first(names)}" for what, names in named if names]
    if not told:
        return "of cases that its tolerance.csv does not name"
    return f"only it has {' and '.join(told)}"


def _first(names: list[str]) -> str:
    more = f" and {len(names) - NAMES} more" if len(names) > NAMES else ""
    return f"{', '.join(names[:NAMES])}{more}"


def _many(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
