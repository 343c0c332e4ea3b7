"""A run beside the reference, coarsely; and which typical mistake brings a wrong one back to it."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from math import degrees, pi, radians

import numpy as np
from numpy.typing import NDArray

from ...cases.case import Case
from ...cases.scene import Scene
from ...cases.scene.frame import SPACE
from ...cases.scene.rotation import angle_between, turned
from ...cases.trajectory import ANGLE, Array, Trajectory

ROUGH = 0.05  # of the motion's size: a coarse step costs an engine some percent, a mistake more
CURES = 5.0  # times nearer: what explains an error leaves little of it
SHIFTS = 1e-6  # of the motion's size: an error below is that of a fine step, and tells no shift
STILL = 1e-6  # m, rad, m/s, rad/s, N: below it nothing moves

States = Mapping[str, Array]
Shares = dict[str, float]
"""By what is off, as `place of bar`, how far (rms) over the size of that in the motion."""


@dataclass(frozen=True)
class Compared:
    """A run beside the reference: samples of bodies, and of reactions by quantity.

    keep: the samples (N,) that are compared: none where the reference jumps.
    """

    case: Case
    step: float
    reference: Trajectory
    states: States
    reactions: Mapping[str, Array]
    keep: NDArray[np.bool_]

    def off(self, states: States | None = None, wanted: States | None = None) -> Shares:
        """Returns how far the bodies are off, with other samples or beside another motion.

        Of what nobody does in the reference, as turning, there is no size, and nothing is told.
        """
        frame, bodies, shares = self.case.scene.frame, self.case.scene.bodies, Shares()
        states, true = states or self.states, self.reference.states
        wanted = wanted or true
        columns = {"place": frame.place, "velocity": frame.velocity, "rate": frame.spin}
        columns |= {} if frame is SPACE else {"angle": frame.attitude}
        for what, where in columns.items():
            since = float(what in ("place", "angle"))  # the start: of rates, nothing
            size = max(_far(rows[:, where] - since * rows[0, where]) for rows in true.values())
            for name, body in bodies.items() if size > STILL else ():
                if body.turns or what in ("place", "velocity"):
                    a, b = (motion[name][self.keep][:, where] for motion in (states, wanted))
                    shares[f"{what} of {name}"] = _share(a, b, size)
        for name in bodies if frame is SPACE else ():
            if bodies[name].turns:
                a, b = (motion[name][self.keep][:, SPACE.attitude] for motion in (states, wanted))
                shares[f"attitude of {name}"] = _share(angle_between(a, b)[:, None], 0.0, 1.0)
        return shares

    def forces_off(self, sign: float = 1.0) -> Shares:
        """Returns how far each element's reactions are off, but for the first sample."""
        parts: dict[str, list[str]] = {}
        for name in self.reactions:
            parts.setdefault(name.rpartition(".")[0], []).append(name)
        keep = self.keep & (np.arange(len(self.keep)) > 0)
        shares = Shares()
        for part, names in parts.items():
            forces = np.stack([sign * self.reactions[name] for name in names], axis=1)[keep]
            wanted = [self.reference.reactions[name] for name in names]
            rows = np.stack(wanted, axis=1)[keep]
            shares[f"forces of {part}"] = _share(forces, rows, max(_far(rows), STILL))
        return shares


def explained(compared: Compared) -> tuple[str, ...]:
    """Returns the mistakes that explain a wrong motion, the likeliest first; none if none does."""
    frame = compared.case.scene.frame
    errors = {
        what: _worst(compared.off({name: undo(rows) for name, rows in compared.states.items()}))
        for what, undo in (IN_SPACE if frame is SPACE else IN_THE_PLANE).items()
    }
    now, opposite = _worst(compared.forces_off()), _worst(compared.forces_off(-1.0))
    signs = now > ROUGH and opposite <= ROUGH / 2  # of which the motion says nothing
    return _cures(errors, _worst(compared.off())) + (FORCES,) * signs


def shifted(compared: Compared) -> tuple[str, ...]:
    """Returns whether the samples are those of another time: a step, or half, late or early."""
    worst = _worst(compared.off())
    if not worst > SHIFTS:
        return ()
    return _cures({what: _worst(compared.off(wanted=w)) for what, w in _late(compared)}, worst)


def factor(name: str, read: float, wanted: float, scene: Scene) -> str:
    """Returns how a number is related to the wanted one; empty where it is nothing simple."""
    body = scene.bodies.get(name.partition(".")[0])
    if body is not None and name.endswith(".inertia"):
        for point in body.points:
            if any(body.points[point]) and _equal(read, body.about(point)):
                return f"it is about {body.name}.{point}, not about the centre of mass"
    return next((what for x, what in FACTORS.items() if wanted and _equal(read, x * wanted)), "")


FACTORS = {
    2.0: "it is twice what it should be",
    0.5: "it is half of what it should be",
    -1.0: "it has the opposite sign",
    degrees(1.0): "it is in degrees",
    radians(1.0): "radians were taken for degrees",
    1e3: "it is in units of a thousandth",
    1e-3: "it is in units of a thousand",
    0.0: "it is 0",
}
"""By how many times too large a number is, what that means."""


def _equal(one: float, other: float) -> bool:
    return bool(abs(one - other) <= 1e-9 * max(abs(one), abs(other)))


def _cures(errors: Mapping[str, float], worst: float) -> tuple[str, ...]:
    """Mistakes that leave little error, the least first; one that leaves far more is left out."""
    kept = {what: error for what, error in errors.items() if error <= min(ROUGH / 2, worst / CURES)}
    least = min(kept.values(), default=0.0)
    mistakes = sorted(kept, key=kept.__getitem__)
    return tuple(what for what in mistakes if kept[what] <= CURES * max(least, SHIFTS))


def _worst(shares: Shares) -> float:
    return max(shares.values(), default=0.0)


def _far(rows: Array) -> float:
    return float(np.max(np.linalg.norm(rows, axis=1)))


def _share(values: Array, wanted: Array | float, size: float) -> float:
    """Returns the rms of the difference over a size."""
    rms = float(np.sqrt(np.mean(np.sum((values - wanted) ** 2, axis=1))))
    return rms / size if np.isfinite(rms) else np.inf


def _times(*by: float) -> Callable[[Array], Array]:
    """Multiplies the columns x, y, angle, vx, vy, omega."""
    return lambda rows: rows * np.array(by)


def _unwound(rows: Array) -> Array:
    return np.column_stack([rows[:, :ANGLE], np.unwrap(rows[:, ANGLE]), rows[:, ANGLE + 1 :]])


def _into_body_axes(rows: Array) -> Array:
    to_body = rows[:, SPACE.attitude] * [1, -1, -1, -1]
    return np.hstack([rows[:, :10], turned(to_body, rows[:, SPACE.spin])])


IN_THE_PLANE = {
    "y points down": _times(1, -1, -1, 1, -1, -1),
    "y and vy have the opposite sign": _times(1, -1, 1, 1, -1, 1),
    "angle and omega are clockwise": _times(1, 1, -1, 1, 1, -1),
    "angle and omega are in degrees": _times(1, 1, pi / 180, 1, 1, pi / 180),
    "the angle is wound: whole turns are to be counted": _unwound,
}
IN_SPACE: dict[str, Callable[[Array], Array]] = {
    "y is up: z is": lambda rows: (
        rows[:, [0, 2, 1, 3, 4, 5, 6, 7, 9, 8, 10, 11, 12]]
        * np.array([1, -1, 1, 1, 1, 1, 1, 1, -1, 1, 1, 1, 1])
    ),
    "quaternions are x, y, z, w: w comes first": lambda rows: rows[
        :, [0, 1, 2, 6, 3, 4, 5, 7, 8, 9, 10, 11, 12]
    ],
    "ω is in ground axes: body axes are asked for": _into_body_axes,
}
FORCES = "forces have the opposite sign: what the first part exerts on the second"
"""What an adapter's author mistakes, and how the engine's samples of a body are without it."""


def _late(compared: Compared) -> Iterator[tuple[str, States]]:
    """Yields the reference where and when a mistake would have it."""
    from scipy.interpolate import CubicSpline

    times, states = compared.reference.times, compared.reference.states
    frame = compared.case.scene.frame
    at = {name: CubicSpline(times, rows) for name, rows in states.items()}
    columns = np.arange(frame.width)
    rates = np.isin(columns, [*columns[frame.velocity], *columns[frame.spin]])
    for steps, words in ((1.0, "one step"), (0.5, "half a step")):
        for sense, side in ((-1.0, "late"), (1.0, "ahead")):
            then = {name: at[name](times + sense * steps * compared.step) for name in states}
            for which, who in (
                (rates | ~rates, "all is"),
                (rates, "velocities are"),
                (~rates, "places are"),
            ):
                moved = {name: np.where(which, then[name], rows) for name, rows in states.items()}
                yield f"{who} {words} {side}", moved
