"""Plain numbers of contacts: how deep, how fast it creeps, what is left of friction and bounce."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.motion import Motion
from ....cases.scene.observe import observe
from ....cases.scene.quantity import table
from ....cases.trajectory import Array, Trajectory
from .figure import Plain

STILL = 1e-9  # m/s (rad/s): what slips less in the reference sticks there
SLIPS = 1e-2  # of the fastest slip: near a stop friction is neither moving nor at rest


def depth(scene: Scene, contact: Any, motion: Trajectory) -> Iterator[Plain]:
    """How deep it is at most; feet that pass the floor are meant to."""
    whole = _motion(scene, motion.record or motion)
    if contact.name in scene.pairs:
        heights = [contact.observe(whole, "gap")[_faced(contact, whole)]]
    elif contact.ahead_of is None:
        heights = [one.observe(whole, "gap") for one in contact.each()]
    else:
        return
    yield Plain(f"depth of {contact.name}", -float(np.min(heights, initial=0.0)), "m")


def _faced(pair: Any, motion: Motion) -> Any:
    """(N,) where it touches a rim, or a face within its ends."""
    return slice(None) if pair.face is None else ~pair.beyond(motion)


def _motion(scene: Scene, trajectory: Trajectory) -> Motion:
    return Motion(scene.bodies, scene.points, trajectory, scene.joints)


def creep(scene: Scene, name: str, reference: Trajectory, motion: Trajectory) -> Iterator[Plain]:
    """The mean slip of what sticks in the reference, without the start."""
    slip = observe(scene, reference, f"{name}.slip")
    sticks = np.abs(slip) <= STILL
    if name in (*scene.contacts, *scene.pairs):
        sticks &= np.abs(observe(scene, reference, f"{name}.gap")) <= STILL
    sticks[0] = False
    if np.any(sticks):
        found = np.abs(observe(scene, motion, f"{name}.slip")[sticks])
        unit = table(scene)[f"{name}.slip"].unit
        yield Plain(f"creep of {name}", float(np.mean(found)), unit)


def friction(
    scene: Scene, contact: Any, reference: Trajectory, motion: Trajectory
) -> Iterator[Plain]:
    """The mean of tangent over normal force while it slips in the reference."""
    names = [f"{contact.name}.{field}" for field in ("tangent", "normal")]
    if not contact.friction or not all(name in motion.reactions for name in names):
        return
    slip = np.abs(observe(scene, reference, f"{contact.name}.slip"))
    along, normal = (motion.reactions[name] for name in names)
    slides = (slip > max(STILL, SLIPS * float(np.max(slip)))) & (normal > 0)
    slides[0] = False
    if np.any(slides):
        found = float(np.mean(np.abs(along[slides]) / normal[slides]))
        yield Plain(f"friction of {contact.name}", found, "", contact.kinetic)


def restitution(
    scene: Scene, contact: Any, reference: Trajectory, motion: Trajectory
) -> Iterator[Plain]:
    """Yields the restitution of the first impact: the fastest way back over the fastest approach.

    An engine may take a while for it: from the start to half the way to the next event.
    """
    plane = contact.name in scene.contacts
    if not contact.switches or (plane and contact.tips):  # in space nothing switches
        return
    record, every = reference.record, motion.record
    struck = _first_impact(scene, contact, record) if record else None
    if struck is None or every is None:
        return
    later = [t for t in reference.switches.tolist() if t > struck]
    last = (struck + later[0]) / 2 if later else float(every.times[-1])
    speed = _rising(scene, contact, every)[every.times <= last]
    lowest = int(np.argmin(speed))
    back = max(0.0, float(np.max(speed[lowest:])))
    yield Plain(
        f"restitution of {contact.name}", back / -float(speed[lowest]), "", contact.restitution
    )


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
        apart: Array = contact.moves(motion)[1]
        return apart
    _, _, vx, vy = motion.point(contact.at).T  # of a rim that of the centre
    nx, ny = contact.plane.normal
    return nx * vx + ny * vy
