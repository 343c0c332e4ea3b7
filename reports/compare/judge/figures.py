"""Plain numbers of one run, as a person asks for them: how fast it loses energy, sinks, creeps.

What the reference itself loses, or slips, is no part of them.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Scene
from ....cases.scene.motion import Motion
from ....cases.scene.observe import observe
from ....cases.scene.quantity import table
from ....cases.trajectory import Array, Trajectory
from ..trial.answers import moved
from ..trial.impacts import BESIDE
from ..trial.trial import Trial

Rows = NDArray[np.bool_]
"""(N,) which samples count."""

# A plain number: one that a person asks for, and on which no verdict hangs.


ROUNDING = 1e-12  # in any unit: nobody asks for less
WHOLE = 100.0  # %


@dataclass(frozen=True)
class Plain:
    """A number with its name, as `creep of touch`; wanted: the textbook's, where it is not 0."""

    what: str
    value: float
    unit: str
    wanted: float = 0.0

    def __str__(self) -> str:
        if not self.unit:
            return f"{self.what}: {_number_text(self.value)} (textbook {_number_text(self.wanted)})"
        if self.unit.startswith("%") and self.value > WHOLE:
            times = _number_text(self.value / WHOLE)
            return f"{self.what}: {times} times the largest kinetic energy a second"
        if self.unit.startswith("m") and abs(self.value) < 0.1:
            return f"{self.what}: {_number_text(1e3 * self.value)} m{self.unit}"
        return f"{self.what}: {_number_text(self.value)} {self.unit}"


def _number_text(value: float) -> str:
    return f"{value:.3g}" if abs(value) > ROUNDING else "0"


RESTS = 1e-12  # J: what has less kinetic energy all along has none to lose


def plain(trial: Trial) -> list[Plain]:
    """Plain numbers of the trial's engine at its judged step: one run, with every step looked at.

    Raises Diverged.
    """
    scene, plan = trial.case.scene, trial.plan
    touching = (*scene.contacts, *scene.pairs)
    asked = [f"{name}.{field}" for name in touching for field in ("normal", "tangent")]
    wanted = tuple(name for name in asked if name in table(scene) and name not in plan.withheld)
    times = trial.case.times
    answer = trial.engine.run(
        scene, trial.start, times, trial.step, plan, reactions=wanted, record=True
    )
    motion = moved(answer, scene, times)
    return list(numbers(scene, trial.reference, motion, BESIDE * trial.step))


def numbers(
    scene: Scene, reference: Trajectory, motion: Trajectory, near: float = 0.0
) -> Iterator[Plain]:
    """Plain numbers of a motion at the reference's samples; impacts and depths in its record.

    near [s]: so close to an impact a sample says nothing of energy, creep and friction, for one of
    the two motions is before it and the other behind it.
    """
    gaps = np.abs(reference.times[:, None] - reference.blows[None, :])
    away: Rows = np.min(gaps, axis=1, initial=np.inf) > near
    yield from _energy(scene, reference, motion, away)
    yield from _gap(scene, motion)
    yield from _passed(scene, motion)
    for contact in (*scene.contacts.values(), *scene.pairs.values()):
        yield from depth(scene, contact, motion)
        yield from restitution(scene, contact, reference, motion)
        yield from friction(scene, contact, reference, motion, away)
    for name in (*scene.contacts, *scene.pairs, *scene.joints):
        if f"{name}.slip" in table(scene):
            yield from creep(scene, name, reference, motion, away)


def _energy(scene: Scene, reference: Trajectory, motion: Trajectory, away: Rows) -> Iterator[Plain]:
    """Yields the energy lost or gained per second, in % of the reference's largest kinetic energy.

    It is the slope of the line through 0 that fits best.
    """
    size = float(np.max(observe(scene, reference, "energy.kinetic")))
    if size <= RESTS:
        return
    try:
        lost = _gain(scene, reference) - _gain(scene, motion)
    except KeyError:  # the inner state of a muscle that the producer does not tell
        return
    t, lost = motion.times[away], lost[away]
    if not np.any(t):
        return
    rate = 100 * float(t @ lost) / float(t @ t) / size
    yield Plain("energy lost" if rate >= 0 else "energy gained", abs(rate), "% a second")


def _gain(scene: Scene, trajectory: Trajectory) -> Array:
    energy = observe(scene, trajectory, "energy.total")
    return energy - energy[0]


def _gap(scene: Scene, motion: Trajectory) -> Iterator[Plain]:
    """Yields the gap of the joint that is widest open."""
    gaps = {
        name: float(np.max(np.abs(observe(scene, motion, f"{name}.gap"))))
        for name in scene.joints
        if f"{name}.gap" in table(scene)
    }
    if gaps:
        worst = max(gaps, key=lambda name: gaps[name])
        yield Plain(f"gap of {worst}", gaps[worst], "m")


def _passed(scene: Scene, motion: Trajectory) -> Iterator[Plain]:
    """Yields by how much each rope or stop is exceeded at most."""
    whole = _motion(scene, motion.record or motion)
    for limit in scene.limits():
        least = min(float(np.min(gaps, initial=0.0)) for gaps in limit.gaps(whole))
        unit = table(scene)[f"{limit.name}.{limit.measured}"].unit
        yield Plain(f"how far past {limit.name}", -least, unit)


# Plain numbers of contacts: how deep, how fast it creeps, what is left of friction and bounce.


STILL = 1e-9  # m/s (rad/s, m): what slips less in the reference sticks there, or touches
SLIPS = 1e-2  # of the fastest slip: near a stop friction is neither moving nor at rest
BESIDES = 0.05  # of the fastest growth by what else acts: an engine has it by a step of its own


def depth(scene: Scene, contact: Any, motion: Trajectory) -> Iterator[Plain]:
    """Yields a contact's largest depth; feet that pass the floor are meant to."""
    whole = _motion(scene, motion.record or motion)
    if contact.name in scene.pairs:
        heights = [contact.observe(whole, "gap")[_faced(contact, whole)]]
    elif contact.ahead_of is None:
        heights = [point.observe(whole, "gap") for point in contact.each()]
    else:
        return
    yield Plain(f"depth of {contact.name}", -float(np.min(heights, initial=0.0)), "m")


def _faced(pair: Any, motion: Motion) -> Any:
    """Returns the samples (N,) at which a contact touches a rim, or a face within its ends."""
    return slice(None) if pair.face is None else ~pair.beyond(motion)


def _motion(scene: Scene, trajectory: Trajectory) -> Motion:
    return Motion(scene.bodies, scene.points, trajectory, scene.joints)


def creep(
    scene: Scene, name: str, reference: Trajectory, motion: Trajectory, away: Rows
) -> Iterator[Plain]:
    """Yields the mean slip where the reference sticks, without the start."""
    slip = observe(scene, reference, f"{name}.slip")
    sticks = (np.abs(slip) <= STILL) & away
    if name in (*scene.contacts, *scene.pairs):
        sticks &= np.abs(observe(scene, reference, f"{name}.gap")) <= STILL
    sticks[0] = False
    if np.any(sticks):
        speeds = np.abs(observe(scene, motion, f"{name}.slip")[sticks])
        unit = table(scene)[f"{name}.slip"].unit
        yield Plain(f"creep of {name}", float(np.mean(speeds)), unit)


def friction(
    scene: Scene, contact: Any, reference: Trajectory, motion: Trajectory, away: Rows
) -> Iterator[Plain]:
    """Yields the mean ratio of tangent to normal force while the reference touches and slips."""
    names = [f"{contact.name}.{field}" for field in ("tangent", "normal")]
    if not contact.friction or not all(name in motion.reactions for name in names):
        return
    slip = np.abs(observe(scene, reference, f"{contact.name}.slip"))
    along, normal = (motion.reactions[name] for name in names)
    touches = np.abs(observe(scene, reference, f"{contact.name}.gap")) <= STILL
    slides = (slip > max(STILL, SLIPS * float(np.max(slip)))) & (normal > 0) & touches & away
    slides[0] = False
    if np.any(slides):
        coefficient = float(np.mean(np.abs(along[slides]) / normal[slides]))
        yield Plain(f"friction of {contact.name}", coefficient, "", contact.kinetic)


def restitution(
    scene: Scene, contact: Any, reference: Trajectory, motion: Trajectory
) -> Iterator[Plain]:
    """Yields the restitution of the first impact: the speed after it over that before.

    An engine may take a while for it: it lasts as long as the speed grows faster than what acts
    besides makes it grow, as the reference knows, and is over where it has thrown back fastest.
    """
    plane = contact.name in scene.contacts
    if not contact.switches or (plane and contact.tips):  # in space nothing switches
        return
    record, every = reference.record, motion.record
    struck = _first_impact(scene, contact, record) if record else None
    if record is None or struck is None or every is None:
        return
    later = [t for t in reference.switches.tolist() if t > struck]
    last = (struck + later[0]) / 2 if later else float(every.times[-1])
    speed, times = _rising(scene, contact, every), every.times
    speed, times = speed[times <= last], times[times <= last]
    grows = np.diff(speed)
    strikes = grows > _besides(scene, contact, record, last) * np.diff(times)
    if not np.any(strikes):
        return
    calm, peak = np.flatnonzero(~strikes).tolist(), int(np.argmax(grows))
    begins = max((k + 1 for k in calm if k < peak), default=0)
    ends = [k for k in range(peak + 1, len(grows)) if strikes[k - 1] and not strikes[k]]
    back = np.max(speed[ends or [-1]])
    if speed[begins] < 0.0:
        share = max(0.0, float(back)) / -float(speed[begins])
        yield Plain(f"restitution of {contact.name}", share, "", contact.restitution)


def _besides(scene: Scene, contact: Any, record: Trajectory, last: float) -> float:
    """The fastest growth [m/s²] of the reference's normal velocity between impacts, and a bit."""
    assert record.phase is not None
    speed, times = _rising(scene, contact, record), record.times
    smooth = (np.diff(record.phase) == 0) & (np.diff(times) > 0) & (times[1:] <= last)
    grows = np.diff(speed)[smooth] / np.diff(times)[smooth]
    return float(np.max(grows, initial=0.0) + BESIDES * np.max(np.abs(grows), initial=0.0))


def _first_impact(scene: Scene, contact: Any, record: Trajectory) -> float | None:
    """When [s] the reference's normal velocity first jumps, from one piece to the next."""
    assert record.phase is not None
    speed = _rising(scene, contact, record)
    ends = np.flatnonzero(np.diff(record.phase))
    size = float(np.max(np.abs(speed)))
    for end in ends.tolist():
        if speed[end] < -SLIPS * size and speed[end + 1] - speed[end] > SLIPS * size:
            return float(record.times[end])
    return None


def _rising(scene: Scene, contact: Any, trajectory: Trajectory) -> Array:
    """(N,) the velocity [m/s] of what touches, off its plane or off the other body."""
    motion = _motion(scene, trajectory)
    if contact.name in scene.pairs:
        apart: Array = contact.slip_and_gap_rate(motion)[1]
        return apart
    _, _, vx, vy = motion.point(contact.at).T  # of a rim that of the centre
    nx, ny = contact.plane.normal
    return nx * vx + ny * vy
