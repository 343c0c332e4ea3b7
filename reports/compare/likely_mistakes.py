"""Which mistake explains a wrong motion: one is named only if the motion agrees once it is undone.

A mistake of the readout is undone in the engine's own samples. A mistake of the physics is made in
the reference, which is solved once more. What explains nothing is not told.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import degrees, pi, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...cases.case import Case, Placement
from ...cases.scene import Scene
from ...cases.scene.frame import SPACE
from ...cases.scene.quantity import table
from ...cases.scene.rotation import angle_between, inverse, turned
from ...cases.trajectory import ANGLE, VX, VY, Array, Trajectory, X, Y
from ...reference.solve import solve

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
        """How far the bodies are off, with other samples or beside another motion.

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
        """How far the reactions are off, each element's together; the first sample is left out."""
        parts: dict[str, list[str]] = {}
        for name in self.reactions:
            parts.setdefault(name.rpartition(".")[0], []).append(name)
        keep = self.keep & (np.arange(len(self.keep)) > 0)
        shares = Shares()
        for part, names in parts.items():
            found = np.stack([sign * self.reactions[name] for name in names], axis=1)[keep]
            wanted = [self.reference.reactions[name] for name in names]
            rows = np.stack(wanted, axis=1)[keep]
            shares[f"forces of {part}"] = _share(found, rows, max(_far(rows), STILL))
        return shares


def explained(compared: Compared) -> tuple[str, ...]:
    """The mistakes that explain a wrong motion, the likeliest first; none where nobody knows."""
    shares = compared.off()
    found = {what: _worst(compared.off(states)) for what, states in _read(compared)}
    if not _cured(found, worst := _worst(shares)):
        found |= {
            what: _worst(compared.off(wanted=motion.states))
            for what, case in _otherwise(compared.case)
            if (motion := _moved(case)) is not None
        }
    return _cured(found, worst) + _forces(compared)


def shifted(compared: Compared) -> tuple[str, ...]:
    """Whether the samples are those of another time: of a step, or half a step, late or early."""
    worst = _worst(compared.off())
    if not worst > SHIFTS:
        return ()
    found = {what: _worst(compared.off(wanted=wanted)) for what, wanted in _late(compared)}
    return _cured(found, worst)


def factor(name: str, found: float, wanted: float, scene: Scene) -> str:
    """In words, how a number is related to the wanted one; empty where it is nothing simple."""
    body = scene.bodies.get(name.partition(".")[0])
    if body is not None and name.endswith(".inertia"):
        for point in body.points:
            if any(body.points[point]) and _equal(found, body.about(point)):
                return f"it is about {body.name}.{point}, not about the centre of mass"
    for times, what in FACTORS.items():
        if wanted and _equal(found, times * wanted):
            return what
    return ""


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


def _cured(found: Mapping[str, float], worst: float) -> tuple[str, ...]:
    """Mistakes that leave little error, the least first; one that leaves far more is left out."""
    kept = {what: left for what, left in found.items() if left <= min(ROUGH / 2, worst / CURES)}
    least = min(kept.values(), default=0.0)
    told = sorted(kept, key=kept.__getitem__)
    return tuple(what for what in told if kept[what] <= CURES * max(least, SHIFTS))


def _worst(shares: Shares) -> float:
    return max(shares.values(), default=0.0)


def _forces(compared: Compared) -> tuple[str, ...]:
    """The sign of reactions, of which the motion says nothing."""
    now, opposite = _worst(compared.forces_off()), _worst(compared.forces_off(-1.0))
    wrong = now > ROUGH and opposite <= ROUGH / 2
    return ("forces have the opposite sign: what the first part exerts on the second",) * wrong


def _far(rows: Array) -> float:
    return float(np.max(np.linalg.norm(rows, axis=1)))


def _share(found: Array, wanted: Array | float, size: float) -> float:
    """The rms of what is off, over a size."""
    rms = float(np.sqrt(np.mean(np.sum((found - wanted) ** 2, axis=1))))
    return rms / size if np.isfinite(rms) else np.inf


# Mistakes of the readout, undone in the samples of the engine.

Undone = tuple[str, Callable[[Array], Array]]


def _times(**by: float) -> Callable[[Array], Array]:
    """Columns times a number."""
    names = ("x", "y", "angle", "vx", "vy", "omega")
    row = np.array([by.get(name, 1.0) for name in names])
    return lambda rows: rows * row


def _unwound(rows: Array) -> Array:
    rows = rows.copy()
    rows[:, ANGLE] = np.unwrap(rows[:, ANGLE])
    return rows


DOWN = "y points down"  # with both turns the other way, where something turns
PLANE: Sequence[Undone] = (
    (DOWN, _times(y=-1, vy=-1, angle=-1, omega=-1)),
    ("y and vy have the opposite sign", _times(y=-1, vy=-1)),
    ("x and vx have the opposite sign", _times(x=-1, vx=-1)),
    ("velocities have the opposite sign", _times(vx=-1, vy=-1, omega=-1)),
    ("angle and omega are clockwise", _times(angle=-1, omega=-1)),
    ("the angle is clockwise", _times(angle=-1)),
    ("omega is clockwise", _times(omega=-1)),
    ("angle and omega are in degrees", _times(angle=pi / 180, omega=pi / 180)),
    ("the angle is in degrees", _times(angle=pi / 180)),
    ("omega is in degrees a second", _times(omega=pi / 180)),
    ("the angle is wound: whole turns are to be counted", _unwound),
)  # fmt: skip


def _quaternion(by: Callable[[Array], Array]) -> Callable[[Array], Array]:
    def undone(rows: Array) -> Array:
        rows = rows.copy()
        rows[:, SPACE.attitude] = by(rows[:, SPACE.attitude])
        return rows

    return undone


def _into_body_axes(rows: Array) -> Array:
    rows = rows.copy()
    rows[:, SPACE.spin] = turned(inverse(rows[:, SPACE.attitude]), rows[:, SPACE.spin])
    return rows


def _z(rows: Array) -> Array:
    rows = rows.copy()
    rows[:, [2, 9]] *= -1
    return rows


def _y_up(rows: Array) -> Array:
    """From axes of which y is up: x, −z, y."""
    rows = rows.copy()
    for at in (0, 7):
        rows[:, at : at + 3] = rows[:, [at, at + 2, at + 1]] * [1, -1, 1]
    return rows


IN_SPACE: Sequence[Undone] = (
    ("z and vz have the opposite sign", _z),
    ("y is up: z is", _y_up),
    ("quaternions are x, y, z, w: w comes first", _quaternion(lambda q: q[:, [3, 0, 1, 2]])),
    ("quaternions turn ground axes into body axes: the other way round", _quaternion(inverse)),
    ("ω is in ground axes: body axes are asked for", _into_body_axes),
)


def _read(compared: Compared) -> Iterator[tuple[str, States]]:
    """For each mistake of the readout: its words, and the samples without it."""
    space = compared.case.scene.frame is SPACE
    turns = any(body.turns for body in compared.case.scene.bodies.values())
    for what, undo in IN_SPACE if space else PLANE:
        if what == DOWN and not turns:
            continue  # it is the same as y and vy
        yield what, {name: undo(rows) for name, rows in compared.states.items()}
    if not space:
        yield from _other_points(compared)


def _other_points(compared: Compared) -> Iterator[tuple[str, States]]:
    """Where it is not the centre of mass that is told, but another point that bodies have."""
    bodies = compared.case.scene.bodies
    for point in sorted(
        {p for body in bodies.values() for p in body.points if any(body.points[p])}
    ):
        found = dict(compared.states)
        for name, body in bodies.items():
            if any(body.points.get(point, ())):
                rows, arm = found[name].copy(), found[name].copy()
                arm[:, [X, Y, VX, VY]] = 0.0
                rows[:, [X, Y, VX, VY]] -= body.point(arm, point)
                found[name] = rows
        yield f"x and y are those of `{point}`, not of the centre of mass", found


def _late(compared: Compared) -> Iterator[tuple[str, States]]:
    """The reference where and when a mistake would have it."""
    from scipy.interpolate import CubicSpline

    h, times = compared.step, compared.reference.times
    frame = compared.case.scene.frame
    at = {name: CubicSpline(times, rows) for name, rows in compared.reference.states.items()}
    rates = [*range(frame.width)[frame.velocity], *range(frame.width)[frame.spin]]
    places = [k for k in range(frame.width) if k not in rates]
    for steps, words in ((1.0, "one step"), (0.5, "half a step")):
        for sense, side in ((-1.0, "late"), (1.0, "ahead")):
            by = sense * steps * h
            for columns, who in (
                (None, "all is"),
                (rates, "velocities are"),
                (places, "places are"),
            ):
                moved = {}
                for name, rows in compared.reference.states.items():
                    then = at[name](times + by)
                    moved[name] = then if columns is None else rows.copy()
                    if columns is not None:
                        moved[name][:, columns] = then[:, columns]
                yield f"{who} {words} {side}", moved


# Mistakes of the physics, made in the case of the reference.


def _moved(case: Case) -> Trajectory | None:
    """The motion of such a case; None where it has none."""
    try:
        return solve(case).trajectory
    except Exception:  # a spring that pushes away, a body without a place to start
        return None


def _otherwise(case: Case) -> Iterator[tuple[str, Case]]:
    """Cases of which an adapter would give the motion that makes each mistake."""
    scene = case.scene

    def of(**changed: Any) -> Case:
        other = replace(scene, **changed)
        events = {name: e for name, e in case.events.items() if e.quantity in table(other)}
        return replace(case, system=None, scene=other, events=events)

    if any(scene.gravity):
        yield "gravity points the other way", of(gravity=tuple(-g for g in scene.gravity))
        yield "there is no gravity", of(gravity=tuple(0.0 for _ in scene.gravity))
    for name, force in scene.forces.items():
        others = {k: v for k, v in scene.forces.items() if k != name}
        if (opposite := _opposite(force)) is not None:
            yield f"{name} acts the other way", of(forces={**others, name: opposite})
        if not any(f.about == name for f in others.values()):
            yield f"{name} does not act", of(forces=others)
    for name, body in scene.bodies.items():
        for point in _joined(scene, name) if scene.frame is not SPACE and body.turns else ():
            heavier = replace(body, inertia=(body.about(point),))
            what = f"the inertia of {name} is about {name}.{point}, not about the centre of mass"
            yield what, of(bodies={**scene.bodies, name: heavier})
    for name, contact in scene.contacts.items():
        if hasattr(contact, "kinetic") and contact.friction > 0 and scene.frame is not SPACE:
            slippery = replace(contact, static=0.0, kinetic=0.0)
            yield f"{name} has no friction", of(contacts={**scene.contacts, name: slippery})
    for name, contact in scene.contacts.items():
        for e, what in ((0.0, "does not bounce"), (1.0, "gives all of the speed back")):
            if scene.frame is not SPACE and contact.restitution not in (0.0, e):
                other = replace(contact, restitution=e)
                yield f"{name} {what}", of(contacts={**scene.contacts, name: other})
    if at_rest := _at_rest(case):
        yield "the velocities of the start are not taken", at_rest


def _joined(scene: Scene, body: str) -> list[str]:
    """The body's points, beside its centre of mass, in which joints hold it."""
    ends = {at for joint in scene.joints.values() for at in joint.refers() if at.body == body}
    return sorted(at.point for at in ends if any(scene.bodies[body].points[at.point]))


def _opposite(force: Any) -> Any:
    """The force with the other sign, where it has one number or law that tells it."""
    if (signal := getattr(force, "signal", None)) is not None:
        amplitude = tuple(-a for a in signal.amplitude)
        return replace(force, signal=replace(signal, amplitude=amplitude))
    for number in ("stiffness", "damping"):
        if isinstance(value := getattr(force, number, None), float):
            return replace(force, **{number: -value}) if value else None
    return None


def _at_rest(case: Case) -> Case | None:
    initial: dict[str, Placement] = {}
    for name, placed in case.initial.items():
        rates = {k: v for k, v in placed.given.items() if k in RATES or k.endswith("_dot")}
        initial[name] = replace(placed, given={**placed.given, **dict.fromkeys(rates, 0.0)})
    return None if initial == case.initial else replace(case, system=None, initial=initial)


RATES = ("vx", "vy", "vz", "omega", "omega_1", "omega_2", "omega_3", "speed")
"""What a start says of velocities."""
