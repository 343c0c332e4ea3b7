"""A case asked at other times: its motion may not depend on how often it is looked at."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from textmech.cases.case import Case
from textmech.cases.fields.kind import WORK
from textmech.cases.scene.difference import deviation
from textmech.cases.scene.observe import observe
from textmech.reference.certificate.errors import ERROR
from textmech.reference.solve import Solution
from textmech.reports.compare.events.times import reference_events

# Times what both say of their own errors: the size of an error in one run and in another, as the
# certificate allows two answers to differ by.
LOOSER = 100
ROUNDED = 1e-12  # of a quantity's size: what a sample that lies on an event, or not, may change
ZERO = 1e-15  # in SI: what rounding makes of what is 0 all along
LATE = 1e-9  # s: how far apart two solutions have one event, if neither says more


def resampled(case: Case, intervals: int) -> Case:
    """With so many sample intervals. A sum over samples is known the worse the fewer they are: it
    is left out, as it says so itself."""
    known = case.quantities
    allow = {name: bar for name, bar in case.allow.items() if not _summed(case, name)}
    reach = {
        way: {name: bar for name, bar in bars.items() if name in allow}
        for way, bars in case.reach.items()
    }
    assert known
    return replace(case, samples=intervals + 1, allow=allow, reach=reach)


def _summed(case: Case, name: str) -> bool:
    quantity = case.quantities.get(name)
    return quantity is not None and quantity.field in WORK


def counts(case: Case) -> tuple[int, int]:
    """Three times as many intervals, and a third of them, or another part if that is none."""
    own = case.samples - 1
    part = next((n for n in (3, 4, 5, 2, 7) if own % n == 0 and own // n > 1), 1)
    return 3 * own, own // part


def differences(case: Case, one: Solution, other_case: Case, other: Solution) -> Iterator[str]:
    """What of two solutions differs at the times that both have, and of their events, in words."""
    if one.holds != other.holds:
        yield f"certified {one.holds}, {other.holds}: {[c for c in other.checks if not c.holds]}"
    mine, theirs = _common(case.times, other_case.times)
    sure = _errors(one), _errors(other)
    for name in other_case.allow:
        if name not in case.quantities:
            continue
        a = observe(case.scene, one.trajectory, name)[mine]
        b = observe(case.scene, other.trajectory, name)[theirs]
        size = float(np.max(np.abs(observe(case.scene, one.trajectory, name))))
        bar = LOOSER * sum(errors.get(name, 0.0) for errors in sure) + ROUNDED * size + ZERO
        if not (worst := float(np.max(deviation(a, b)))) <= bar:
            yield f"{name} differs by {worst:.2e}, and {bar:.2e} is allowed"
    yield from _events(case, one, other, sure)


def _events(
    case: Case, one: Solution, other: Solution, sure: tuple[Mapping[str, float], ...]
) -> Iterator[str]:
    for name, event in case.events.items():
        records = one.trajectory.record, other.trajectory.record
        first, second = (reference_events(case.scene, r, event) for r in records if r)
        late = LATE + 2 * sum(errors.get(f"{name}.time", 0.0) for errors in sure)
        if len(first) != len(second):
            yield f"{name} happens {len(first)} times, and {len(second)}"
        elif len(first) and not (worst := float(np.max(np.abs(first - second)))) <= late:
            yield f"{name} differs by {worst:.2e} s, and {late:.2e} s is allowed"


def _common(one: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which samples are at the same times, but for rounding."""
    off = np.abs(one[:, None] - other[None, :])
    near = np.argwhere(off <= 1e-12 * max(one[-1], other[-1]))
    return near[:, 0], near[:, 1]


def _errors(found: Solution) -> dict[str, float]:
    return {
        check.name.removeprefix(ERROR): check.certified or 0.0
        for check in found.checks
        if check.name.startswith(ERROR)
    }
