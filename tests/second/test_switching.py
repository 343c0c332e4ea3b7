"""Every shipped case that switches moves the same, read a second time, with all its events.

It is followed from event to event too, but every mode is found by trying all of them, and every
blow by trying all impulses: nothing is taken for granted of which one comes next.
"""

import numpy as np
import pytest

from second import answer, both, events, size
from second.motion import Motion
from second.test_shipped import SMOOTH, at_samples, disagree, unhurried

EARLY = 1e-7  # of the duration: by so much may the time of an event differ
ROUND = 1e-5  # of the duration, where a speed ends as (T − t)²: it is 1e-10 m/s so much earlier
FLAT = {"drag_stops.root.stops"}
BAR = 1e-6  # of the largest: what is read where time is known to 1e-7 of the duration
NEAR = 1e-3  # of the motion: the band of the smooth law is 5e-4 m/s beside speeds of 2 m/s
SMOOTHED = {"dynamometer_smooth", "growing_force_smooth"}  # `words.py` says why
SHORT = {
    "ball_on_rope", "bouncing_ball", "creeping_block", "held_joint", "landing", "rolling_down",
    "running_step", "sinking_ball", "sliding_block", "spring_mass_jump", "stopped_pendulum",
    "stribeck_brake",
}  # fmt: skip
"""Files that take a fifth of a second a case."""
EVENTFUL = [name for name, case in both.EVERY.items() if case.events]
SWITCHING = [
    name
    for name, case in both.EVERY.items()
    if case.states is None and name not in SMOOTH and name not in SMOOTHED
]


def unlike(motion: Motion, name: str) -> dict[str, object]:
    """The events that happen at other times, or where something else is read."""
    case, told = both.reread(name), both.stored(name)
    found: dict[str, object] = {}
    mine = {event: events.times(motion, says) for event, says in case["events"].items()}
    for event, times in mine.items():
        known = both.happened(told, event)
        bar = (ROUND if f"{name}.{event}" in FLAT else EARLY) * case["duration"]
        if len(known) != len(times) or not np.allclose(known, times, rtol=0, atol=bar):
            found[event] = (known, times)
    for asked in case["allow"]:
        event, _, rest = asked.partition(".")
        if event not in mine or rest in ("time", "count"):
            continue
        quantity, _, side = rest.rpartition(".")
        if side not in ("before", "after"):
            quantity, side = rest, ""
        known = both.beside(told, asked)
        seen = [events.beside(motion, quantity, t, side) for t in mine[event]]
        if not np.allclose(known, seen, rtol=0, atol=BAR * max(1.0, *np.abs(known))):
            found[asked] = (known, seen)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", unhurried(SWITCHING, SHORT))
def test_a_case_that_switches_moves_the_same(name: str) -> None:
    case = both.reread(name)
    motion = answer.motion(case)
    assert disagree(motion, both.stored(name), at_samples(case)) == {}
    if case.get("events"):
        assert unlike(motion, name) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in EVENTFUL if name in SMOOTH])
def test_events_of_a_smooth_case_happen_at_the_same_times(name: str) -> None:
    assert unlike(answer.motion(both.reread(name)), name) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(SMOOTHED))
def test_the_smooth_law_moves_as_the_exact_one(name: str) -> None:
    """The second reading takes it as if `smooth` were not said, which is what the law is for."""
    motion, told = answer.motion(both.reread(name)), both.stored(name)
    for quantity in both.reread(name)["allow"]:
        known, seen = both.answered(told, quantity), answer.observed(motion, quantity)
        assert size.parts(motion, quantity, known, seen) < NEAR
