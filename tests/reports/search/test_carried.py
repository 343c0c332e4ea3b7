"""Causes that a committed table knows are not searched while what they stand on is the same."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from given import scenes

from textmech.reports import suite
from textmech.reports.cache.store import Store
from textmech.reports.row import Cause, as_written
from textmech.reports.search.causes import Known
from textmech.reports.search.why import key_of
from textmech.reports.selection import choose_engines
from textmech.reports.show.cures import carried


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where runs of an engine are remembered, and nothing of a search."""
    return tmp_path_factory.mktemp("store")


def causes(place: Path, known: Known) -> tuple[list[Cause], bool]:
    """Of one case in one setting, and whether anything was run for them."""
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
    return report.causes, searched


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> list[Cause]:
    found, searched = causes(tmp_path_factory.mktemp("first"), {})
    assert searched
    return found


def as_read(found: list[Cause]) -> dict[tuple[str, str, str, str], list[Cause]]:
    """As causes.csv holds them."""
    known: dict[tuple[str, str, str, str], list[Cause]] = {}
    for one in found:
        numbers = {name: as_written(getattr(one, name)) for name in ("error_before", "allow")}
        known.setdefault(key_of(one), []).append(replace(one, **numbers))  # pyright: ignore[reportArgumentType]
    return known


@pytest.mark.slow
def test_what_stands_on_the_same_is_carried_over(first: list[Cause], tmp_path: Path) -> None:
    known = as_read(first)
    found, searched = causes(tmp_path, known)
    assert not searched
    assert as_read(found) == known
    assert carried(found, known).startswith(f"causes: those of {len(known)} rows")
    assert carried(first, {}) == ""


@pytest.mark.slow
@pytest.mark.mutant("causes are carried over {what}")
@pytest.mark.parametrize(
    ("what", "change"),
    [
        ("of another version or adapter", lambda c: replace(c, searched_with="4.0.0 0123456789ab")),
        ("of another error", lambda c: replace(c, error_before=1.01 * c.error_before)),
        ("of another tolerance", lambda c: replace(c, allow=2 * c.allow)),
        ("of no search", lambda c: replace(c, searched_with="")),
    ],
)
def test_what_does_not_is_searched(
    what: str, change: Callable[[Cause], Cause], first: list[Cause], tmp_path: Path
) -> None:
    known = {key: [change(one) for one in some] for key, some in as_read(first).items()}
    found, searched = causes(tmp_path, known)
    assert searched
    assert found == first
