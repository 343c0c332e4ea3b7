"""What is kept of a motion: samples, changes, and on demand its steps."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given.watched import Oscillator, Watched

from textmech.reference.motion import follow as module
from textmech.reference.motion.follow import Followed, Kept, follow
from textmech.reference.system import Array, Guard
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk

DISK = BouncingDisk(m=1.0, R=0.25, e=1.0, y0=0.75)
TIMES = np.linspace(0.0, 3.0, 4)


def test_sample_on_an_event_holds_the_state_after_it():
    times = [t for _, t in DISK.closed_events(3.0)]
    found = follow(DISK, np.array([0.0, *times]))
    assert len(found.events) == len(times)
    for row, e in zip(found.y[1:], found.events, strict=True):
        np.testing.assert_array_equal(row, e.after)
        assert row[1] > 0.0 > e.before[1]


def test_change_without_a_name_is_no_event():
    found = follow(Watched([(None, lambda t, x, v: x)], Oscillator(), "off"), TIMES)
    assert found.events == ()
    assert [(c.mode_before, c.mode_after) for c in found.changes] == [("on", "off")]
    assert found.modes == ("on", "on", "off", "off")


def swinging() -> Followed:
    """x = cos t with a change of phase, but not of motion, at each zero on the way down."""
    swing = Watched([("down", lambda t, x, v: x)], Oscillator())
    return follow(swing, np.linspace(0.0, 10.0, 11), every=True)


def bouncing() -> Followed:
    return follow(DISK, TIMES, every=True)


def by_phase(found: Followed) -> list[list[Kept]]:
    return [[row for row in found.rows if row[1] == k] for k in range(len(found.phases))]


def loose_ends(found: Followed, end: float) -> int:
    """How many phases do not run from change to change, in times that only grow."""
    begins = [(0.0, found.y[0]), *((c.time, c.after) for c in found.changes)]
    ends = [*((c.time, c.before) for c in found.changes), (end, found.y[-1])]
    wrong = int(any(a[:2] > b[:2] for a, b in zip(found.rows, found.rows[1:], strict=False)))
    for rows, begin, last in zip(by_phase(found), begins, ends, strict=True):
        times = [row[0] for row in rows]
        wrong += not (
            bool(np.all(np.diff(times) > 0.0))
            and (rows[0][0], rows[-1][0]) == (begin[0], last[0])
            and np.array_equal(rows[0][2], begin[1])
            and np.array_equal(rows[-1][2], last[1])
        )
    return wrong


def off(found: Followed, known: Callable[[float], Array]) -> float:
    """How far the rows inside the phases are from the known motion."""
    inside = [row for rows in by_phase(found) for row in rows[1:-1]]
    return max(float(np.abs(y - known(t)).max()) for t, _, y in inside)


def cosine(t: float) -> Array:
    return np.array([np.cos(t), -np.sin(t)])


def test_no_rows_unless_asked_for():
    assert follow(DISK, TIMES).rows == ()


@pytest.mark.parametrize(("motion", "end", "count"), [(swinging, 10.0, 2), (bouncing, 3.0, 5)])
def test_rows_of_each_phase_run_from_change_to_change(
    motion: Callable[[], Followed], end: float, count: int
):
    found = motion()
    assert len(found.changes) == count
    assert loose_ends(found, end) == 0


def test_rows_inside_the_steps_lie_on_the_motion():
    found = swinging()
    assert len(found.rows) > 3 * found.steps  # three of them inside each step
    assert off(found, cosine) < 1e-12
    assert off(bouncing(), lambda t: np.concatenate(DISK.closed_form(t))) < 1e-12


def test_rows_do_not_change_the_motion():
    one, other = bouncing(), follow(DISK, TIMES)
    np.testing.assert_array_equal(one.y, other.y)
    assert [c.time for c in one.changes] == [c.time for c in other.changes]


@pytest.mark.mutant("a straight line inside the steps")
def test_interpolated_rows_are_seen(monkeypatch: pytest.MonkeyPatch):
    """A straight line inside the steps, in place of shorter steps."""

    def within(step: Any, probe: Any) -> Callable[[float], Array]:
        length = step.t_next - step.t
        return lambda h: step.y + h / length * (step.y_next - step.y)

    monkeypatch.setattr(module, "inside", within)
    assert off(swinging(), cosine) > 1e-4


@pytest.mark.mutant("a phase without its first row")
def test_a_phase_without_its_first_row_is_seen(monkeypatch: pytest.MonkeyPatch):
    def enter(self: Any, mode: str) -> None:
        self.phases.append(mode)

    monkeypatch.setattr(module._Walk, "_enter", enter)
    assert loose_ends(bouncing(), 3.0) == 6


@pytest.mark.mutant("rows of a phase beyond its end")
def test_rows_beyond_an_event_are_seen(monkeypatch: pytest.MonkeyPatch):
    """Those of the whole step, of which only a part belongs to the phase."""
    note = module._Walk._note

    def whole(self: Any, t: float, lengths: list[float], *states: Any) -> None:
        note(
            self, t, [1.5 * length for length in lengths] if len(states) == 1 else lengths, *states
        )

    monkeypatch.setattr(module._Walk, "_note", whole)
    assert loose_ends(bouncing(), 3.0) >= 5


class Rounded(Watched):
    """Guards of which it is known what of them is rounding, as it is of gaps."""

    def guards(self, mode: str) -> list[Guard]:
        return [replace(guard, rounds=lambda q: 1e-16) for guard in super().guards(mode)]


def soon() -> list[float]:
    """When a guard falls that is zero at first, and below zero from 0.05 to 1.5 ms."""
    dips = lambda t, x, v: t * (5e-5 - t) * (1.5e-3 - t)  # noqa: E731
    return [e.time for e in follow(Rounded([("down", dips)], Oscillator()), TIMES).events]


def test_what_begins_at_zero_and_falls_at_once_for_a_moment_falls() -> None:
    """The first step takes 9 ms; so a disk's last bounces were missed before it was lifted."""
    assert soon() == pytest.approx([5e-5], abs=1e-14)


@pytest.mark.mutant("a fall soon after a guard's own zero, between places where it is looked at")
def test_a_fall_before_the_first_look_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "SOON", ())
    assert soon() == []
