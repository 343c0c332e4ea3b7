"""What the reference says of its own error where modes switch: in its motion and in its events."""

import copy
from collections.abc import Iterator

import numpy as np

from ...cases.case import Case
from ...cases.trajectory import Trajectory
from ..generated.choosing import SwitchingMechanism
from ..mode import Switching
from ..motion.follow import Followed, follow
from ..motion.record import Motion
from ..system import Array
from .agreement import difference, reactions, relative, worst
from .certify import GENERATED, OWN_ERROR, SHARE, Check, laws, share

OWN_EVENTS = 1e-12  # s, against known functions
GENERATED_EVENTS = 1e-10  # s, against the generated motion
SWITCHED = 1e-11  # of the motion's size: an event is known to 1e-12 s, and what follows with it
STIFF = 1e-9  # of the motion's size: what two tolerances of a stiff integrator agree to
COARSER = 1e-13  # tolerance of the second answer where there is only one stiff integrator


def certify_switching(
    case: Case, answer: Motion, built: Motion, trajectory: Trajectory
) -> tuple[Check, ...]:
    """All checks that apply to a case whose modes switch; `built` is the generated motion."""
    times, system, followed, generated = case.times, answer.system, answer.followed, built.system
    assert isinstance(generated, SwitchingMechanism)
    name, other = _second(system, times)
    others = {name: Motion(system, other).trajectory(times)}
    bound = STIFF if system.implicit else SWITCHED
    checks = [
        Check(name, difference(trajectory, others[name]), bound),
        Check(f"{name}: events", _apart(followed, other), GENERATED_EVENTS),
    ]
    if system is not generated:
        checks.append(Check("start as assembled", _start(system, generated), OWN_ERROR))
        others["generated"] = built.trajectory(times)
        checks += [
            Check("generated motion", difference(trajectory, others["generated"]), GENERATED),
            Check("generated reactions", reactions(trajectory, others["generated"]), GENERATED),
            Check("generated events", _apart(followed, built.followed), GENERATED_EVENTS),
        ]
    closed = _closed_form(system, times)
    if closed is not None:
        others["closed form"] = answer.trajectory(times, closed)
        checks.append(Check("closed form", difference(trajectory, others["closed form"]), SWITCHED))
    events = system.closed_events(float(times[-1]))
    if events is not None:
        checks.append(Check("closed events", _known(followed, events), OWN_EVENTS))
    checks += _laws(answer, generated, times)
    checks.append(Check("modes possible", _impossible(system, times, followed), 0.0))
    checks.append(Check("share of the tolerances", share(case, trajectory, others), SHARE))
    return tuple(checks)


def _second(system: Switching, times: Array) -> tuple[str, Followed]:
    """The motion by another integrator, or where it is stiff, by another tolerance."""
    if system.implicit:
        return "another tolerance", follow(system, times, tolerance=COARSER)
    other = copy.copy(system)
    object.__setattr__(other, "implicit", True)  # systems are frozen
    return "implicit integrator", follow(other, times)


def _apart(one: Followed, other: Followed) -> float:
    """The largest difference [s] of the times at which modes change; infinite if counts differ."""
    return _times_apart([c.time for c in one.changes], [c.time for c in other.changes])


def _known(followed: Followed, events: list[tuple[str, float]]) -> float:
    """The largest distance [s] from the events by known functions, by name and order."""
    names = {name for name, _ in events} | {event.name for event in followed.changes if event.name}
    return worst(
        _times_apart(
            [event.time for event in followed.events if event.name == name],
            [t for known, t in events if known == name],
        )
        for name in names
    )


def _times_apart(one: list[float], other: list[float]) -> float:
    if len(one) != len(other):
        return float("inf")
    return worst(abs(a - b) for a, b in zip(one, other, strict=True))


def _start(system: Switching, generated: SwitchingMechanism) -> float:
    """A hand-written system states its own start: it must be the case's."""
    mode, *state = system.start()
    q, v = generated.base.place(system.modes[mode].poses(0.0, *state))
    _, q0, v0 = generated.start()
    return worst([relative(q0, q), relative(v0, v)])


def _closed_form(system: Switching, times: Array) -> Array | None:
    rows = [system.closed_form(t) for t in times.tolist()]
    if any(row is None for row in rows):
        return None
    return np.array([np.concatenate(row) for row in rows if row is not None])


def _laws(answer: Motion, generated: SwitchingMechanism, times: Array) -> Iterator[Check]:
    """The laws of every mode along its own part of the motion; the worst of each."""
    found: dict[str, Check] = {}
    followed, written = answer.followed, answer.system is not generated
    for name in dict.fromkeys(followed.modes):
        mine, mode = np.array(followed.modes) == name, answer.system.modes[name]
        for check in laws(mode, generated.base, times[mine], followed.y[mine], written=written):
            known = found.setdefault(check.name, check)
            if not check.difference <= known.difference:  # true for NaN
                found[check.name] = check
    yield from found.values()


def _impossible(system: Switching, times: Array, followed: Followed) -> int:
    """At how many samples the mode contradicts friction, contact or the direction of sliding."""
    rows = zip(times.tolist(), followed.modes, followed.y, strict=True)
    return sum(system.possible(mode, t, *np.split(y, 2)) is not None for t, mode, y in rows)
