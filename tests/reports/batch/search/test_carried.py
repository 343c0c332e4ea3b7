"""Causes that a committed table knows are not searched while what they stand on is the same."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from given import scenes

from textmech.reports.batch import suite
from textmech.reports.batch.cache.store import Store
from textmech.reports.batch.search.causes import Known
from textmech.reports.batch.search.why import Key, key_of
from textmech.reports.batch.selection import choose_engines
from textmech.reports.data.row import Cause, Comparison, as_written
from textmech.reports.show.cures import carried


@dataclass(frozen=True)
class Told:
    """Causes and rows of a run, and whether anything was run for the causes."""

    causes: Sequence[Cause]
    rows: Sequence[Comparison]
    searched: bool

    @property
    def read(self) -> dict[Key, list[Cause]]:
        """As causes.csv holds them."""
        known: dict[Key, list[Cause]] = {}
        for one in self.causes:
            before, allow = as_written(one.error), as_written(one.allowed)
            known.setdefault(key_of(one), []).append(replace(one, error=before, allowed=allow))
        return known

    @property
    def verdicts(self) -> dict[tuple[str, ...], str]:
        """As tolerance.csv holds them."""
        return {(r.case, r.engine, r.setting, r.realised, r.quantity): r.verdict for r in self.rows}


def run(place: Path, known: Known | None = None) -> Told:
    """One case in one setting, of which nothing is remembered."""
    searched = False

    def progress(what: str, *_: object) -> None:
        nonlocal searched
        searched |= what == "causes"

    report = suite.measure(
        [scenes.EVERY["bar_pendulum"]],
        choose_engines(["mujoco.shipped"], []),
        progress=progress,
        causes=True,
        known=known,
        store=Store(place),
        book=False,
    )
    return Told(report.causes, report.comparisons, searched)


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> Told:
    found = run(tmp_path_factory.mktemp("first"))
    assert found.searched
    return found


@pytest.mark.slow
def test_what_stands_on_the_same_is_carried_over(first: Told, tmp_path: Path) -> None:
    found = run(tmp_path, Known(first.read, first.verdicts))
    assert not found.searched
    assert found.read == first.read
    assert carried(found.causes, first.read).startswith(
        f"causes: {len(first.read)} rows keep the committed ones"
    )
    assert carried(first.causes, {}) == ""


Change = Callable[[Cause], Cause]
CHANGES: Mapping[str, Change] = {
    "of another version or adapter": lambda c: replace(c, searched_with="4.0.0 0123456789ab"),
    "of another error": lambda c: replace(c, error=1.01 * (c.error or 0.0)),
    "of another tolerance": lambda c: replace(c, allowed=2 * (c.allowed or 0.0)),
    "of no search": lambda c: replace(c, searched_with=""),
}


@pytest.mark.slow
@pytest.mark.mutant("causes are carried over {what}")
@pytest.mark.parametrize("what", [*CHANGES, "beside another verdict"])
def test_what_does_not_is_searched(what: str, first: Told, tmp_path: Path) -> None:
    change = CHANGES.get(what, lambda cause: cause)
    verdicts = first.verdicts
    if what not in CHANGES:
        verdicts = {key: f"{verdict}?" for key, verdict in verdicts.items()}
    known = {key: [change(one) for one in some] for key, some in first.read.items()}
    found = run(tmp_path, Known(known, verdicts))
    assert found.searched
    assert found.causes == first.causes
