"""The shipped cases read a second time, beside what the reference has stored, and how far apart."""

from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from given import scenes

from second import geometry, read
from second.motion import Motion
from second.moving import Array
from second.quantities import energy
from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import at_event
from textmech.reference.solve import Solution, solve
from textmech.reports.compare.events.states import reference_states
from textmech.reports.compare.events.times import reference_events

# What the reference answers, for comparison: the only file here that imports textmech.

FILES = [Path(path) for path in shipped().values()]
EVERY = scenes.EVERY
"""Every shipped case, as the suite reads it: which of them a test asks for is no answer."""
_file = cache(read.file)


def reread(name: str) -> dict[str, Any]:
    """A shipped case, read a second time."""
    (path,) = (path for path in FILES if path.stem == name.partition(".")[0])
    return _file(path)[name]


class Answer(NamedTuple):
    """A case as the suite reads it, and what the reference says of it."""

    case: Case
    solution: Solution


def stored(name: str) -> Answer:
    """What the reference says of a shipped case."""
    return Answer(EVERY[name], scenes.solved(name))


def solved(path: Path) -> dict[str, Answer]:
    """What the reference says of the cases of a file."""
    return {case.name: Answer(case, solve(case)) for case in load(path)}


def stated(answer: Answer, name: str) -> float:
    """The reference's own error of a quantity, as it states it."""
    return next(c.certified or 0.0 for c in answer.solution.checks if c.name == f"error of {name}")


def answered(answer: Answer, name: str) -> np.ndarray:
    """A quantity of the reference's motion; attitudes as matrices."""
    values = np.asarray(observe(answer.case.scene, answer.solution.trajectory, name))
    if name.endswith(".attitude") and values.shape[-1] == 4:
        return np.array([geometry.of_quaternion(q) for q in values])
    return values


def happened(answer: Answer, event: str) -> list[float]:
    """The times of an event in the reference's motion."""
    trajectory = answer.solution.trajectory
    record = trajectory.record or trajectory
    return reference_events(answer.case.scene, record, answer.case.events[event]).tolist()


def beside(answer: Answer, name: str) -> list[float]:
    """What a quantity is in the reference's motion whenever an event happens."""
    at = at_event(name, answer.case.events)
    record = answer.solution.trajectory.record
    assert at is not None
    assert record is not None
    times = np.array(happened(answer, at.event))
    return reference_states(answer.case, record, at, times).tolist()


# How large a motion is, and how far two answers lie apart in parts of that.

LITTLE = 1e-3
"""A quantity that is nearly zero in truth (a gap, a slip, a momentum that is kept) is a difference
of large numbers, and as good as they are: it counts as at least so much of the largest of its kind.
"""


SLOW = 1e-2  # 1/s: what rests counts as if it turned once in ten minutes
KINDS = ("m", "m/s", "N", "N m", "J", "kg m/s", "kg m²/s")


def kinds(motion: Motion) -> dict[str, float]:
    """The largest place, speed, force, moment, energy, momentum and its moment of a motion."""
    found: dict[str, float] = dict.fromkeys(KINDS, 0.0)
    m = motion.state.model
    for now, solved in motion.samples[:: max(1, len(motion.samples) // 20)]:
        force = momentum = spin = 0.0
        for name, b in m.bodies.items():
            center = now.poses[name].center
            a = center.J @ solved.a + center.b
            arm = max(float(np.linalg.norm(s)) for s in (*b.points.values(), [b.radius], [LITTLE]))
            arm += float(np.linalg.norm(center.p))
            force += b.mass * float(np.linalg.norm(a) + np.linalg.norm(m.gravity) + SLOW * arm)
            speed = float(
                np.linalg.norm(center.v) + (np.linalg.norm(now.poses[name].w) + SLOW) * arm
            )
            momentum += b.mass * speed
            spin += b.mass * speed * arm + float(np.linalg.norm(b.inertia @ now.poses[name].w))
            found["m"] = max(found["m"], arm)
            found["m/s"] = max(found["m/s"], speed)
        values = {
            "N": force,
            "J": energy(now)["kinetic"] + momentum * SLOW * found["m"],
            "kg m/s": momentum,
            "kg m²/s": spin,
        }
        for kind, value in values.items():
            found[kind] = max(found[kind], value)
    found["N m"] = found["N"] * found["m"]
    found["J"] = max(found["J"], LITTLE * found["N m"])
    return found


def kind(name: str) -> str:
    """Of which kind a quantity is; none of turns, of which a little is 1e-3 rad."""
    last = name.rsplit(".", 1)[-1]
    if name.startswith("energy.") or last == "work":
        return "J"
    if name.startswith("momentum."):
        return "kg m²/s" if "angular" in last else "kg m/s"
    if last in (
        "fx",
        "fy",
        "fz",
        "force",
        "normal",
        "tangent",
        "drive",
        "along",
        "side",
        "friction",
    ):
        return "N"
    if last in ("mx", "my", "mz", "moment") or last.endswith("torque"):
        return "N m"
    if last in ("x", "y", "z", "gap", "shift", "length", "drift", "contractile_length"):
        return "m"
    return "m/s" if last in ("vx", "vy", "vz", "speed", "slip") else ""


def apart(one: Array, other: Array) -> float:
    """The largest difference of two answers, of attitudes the angle between them."""
    if one.ndim == 3:
        between = np.einsum("nij,nik->njk", one, other) - np.eye(3)
        return float(np.max(np.linalg.norm(between, axis=(1, 2)))) / np.sqrt(2)
    return float(np.max(np.abs(one - other)))


def parts(motion: Motion, name: str, one: Array, other: Array) -> float:
    """How far two answers lie apart, in parts of the size of the motion."""
    return apart(one, other) / size(motion, name, one)


def size(motion: Motion, name: str, one: Array) -> float:
    """The size of a quantity: its largest value, or a little of the largest of its kind."""
    if one.ndim == 3:
        return 1.0  # rad
    least = LITTLE * kinds(motion)[kind(name)] if kind(name) else LITTLE
    return max(float(np.max(np.abs(one))), least)
