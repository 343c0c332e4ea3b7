"""Case → every quantity of its states, and what its answers differ by."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from ...cases.scene import Scene
from ...cases.scene.frame import SPACE
from ...cases.scene.motion import Motion
from ...cases.scene.observe import observe
from ...cases.scene.states import coordinates
from ...cases.trajectory import Trajectory
from ..certificate.agreement import Check, difference, relative, worst
from ..certificate.errors import EPS, beyond, errors
from ..coverage import equation
from ..integrators.budget import spend
from ..integrators.now import doing
from ..mechanism.modes.spatial_mode import SpatialMultibody
from ..stated import Stated
from ..system import Array, Mass, Pose, Vector
from ..systems.states.stated import STATED
from .derived import by_virtual_work, derived, efforts, moving
from .spatial_chain import SpatialChain

LAW = 1e-12  # of the largest of a quantity: all of it is algebra, only rounding may differ
ROUNDED = 12  # states with rounded numbers: in fewer the effects of two may cancel in each
# Roundings of a number. With so many no torque of 500, of random chains, was further off than said;
# with half as many some were, up to three times.
OF_SCENE, OF_STATE = 8, 2

Row = tuple[Array, Array, Array]
"""q, q̇ and q̈ of a state."""
VARYING = ("coordinate", "velocity", "acceleration")  # kinds that no claim should leave constant


def answered(case: Case) -> tuple[Trajectory, tuple[Check, ...]]:
    """The states with all quantities, and every check of them.

    The times are the numbers of the states. Raises CaseError for a system that answers no states,
    a bound that asks more than can be certified, or one of what is the same in every state.
    """
    generated = generated_mode(case)
    written = _written(case, generated)
    tell = partial(derived, generated, case.scene, set(case.allow))
    built = _trajectory(case, generated, tell, rows(case, generated))
    motion, others, checks = built, {}, []
    if written is not None:
        own = _trajectory(case, written, written.quantities, rows(case, written))
        others = {"generated": built}
        # what a system does not tell is the generated mechanism's
        motion = replace(own, reactions={**built.reactions, **own.reactions})
        checks.append(Check("generated states", _difference(case, motion, built), LAW))
    if case.scene.frame is SPACE:
        worked, size = _worked(case, generated, built)
        checks += _chain_checks(case, generated, built, worked, size)
        others = {**others, "d'Alembert": worked}
    checks += errors(case, motion, {**others, **_rounding_answers(case)}, 0.0)
    if mistakes := [*beyond(case, checks), *_constant_mistakes(case, motion)]:
        raise CaseError(mistakes)
    return motion, tuple(checks)


def first_state(case: Case) -> dict[str, Pose]:
    """The state of each body in the first of the states, which nobody has solved."""
    mode = generated_mode(case)
    q, v, _ = next(rows(case, mode))
    return mode.poses(0.0, q, v)


def generated_mode(case: Case) -> Stated:
    """The mode that is built from the scene alone."""
    scene = case.scene
    return SpatialChain(scene) if scene.frame is SPACE else FreeBodies(scene)


def _written(case: Case, generated: Stated) -> Stated | None:
    if case.system is None:
        return None
    if case.system not in STATED:
        known = ", ".join(STATED)
        what = f"{case.system!r} answers for a motion; of states there are {known}"
        raise CaseError([case.mistake(("system",), what)])
    try:
        system = STATED[case.system](**case.parameters)
    except ValueError as error:
        raise CaseError([case.mistake(("parameters",), f"{case.system}: {error}")]) from error
    if set(system.coordinates) != set(generated.coordinates):
        ours, theirs = (", ".join(mode.coordinates) for mode in (system, generated))
        what = f"{case.system!r} has the coordinates {ours}; the scene has {theirs}"
        raise CaseError([case.mistake(("system",), what)])
    return system


def rows(case: Case, mode: Stated) -> Iterator[Row]:
    """q, q̇ and q̈ of every state, in the mode's order."""
    assert case.states is not None
    drawn = case.states.drawn(case.scene)
    stacked = np.stack([drawn[name] for name in mode.coordinates], axis=1)  # (N, n, 3)
    doing("its states", 0.0, len(stacked), unit="")
    for k, row in enumerate(stacked):
        spend(k)
        yield row[:, 0], row[:, 1], row[:, 2]


def _trajectory(
    case: Case,
    mode: Stated,
    tell: Callable[[Array, Array, Array], Mapping[str, Any]],
    given: Iterable[Row],
) -> Trajectory:
    """The poses of a mode, and what is told for each q, q̇ and q̈."""
    states: dict[str, list[object]] = {}
    quantities: dict[str, list[object]] = {}
    for q, v, a in given:
        for name, pose in mode.poses(0.0, q, v).items():
            states.setdefault(name, []).append(pose)
        for name, value in tell(q, v, a).items():
            quantities.setdefault(name, []).append(value)
    return Trajectory(
        case.times,
        {name: np.array(poses, float) for name, poses in states.items()},
        {name: np.array(values, float).ravel() for name, values in quantities.items()},
    )


def _rounding_answers(case: Case) -> dict[str, Trajectory]:
    """Answers for numbers that a few roundings have changed, of the scene and of the states.

    What cancels in a quantity, of long arms or of loads that are balanced, is not seen in its
    size: by how much these answers differ is how well it is known.
    """
    answers, random = dict[str, Trajectory](), np.random.default_rng(ROUNDED)
    assert case.states is not None
    turns = np.array([unit == "rad" for unit in coordinates(case.scene).values()])

    def off(x: Array) -> Array:
        return random.choice([-EPS, EPS], x.shape)

    def near(x: Array) -> Array:
        return x * (1.0 + OF_STATE * off(x))

    for k in range(-(-ROUNDED // case.states.random)):
        scene = _changed_scene(case.scene, lambda x: x * (1.0 + OF_SCENE * off(x)))
        mode = generated_mode(replace(case, scene=scene))
        tell = partial(derived, mode, scene, set(case.allow))
        moved = (
            (np.where(turns, q + OF_STATE * off(q), near(q)), near(v), near(a))
            for q, v, a in rows(case, mode)
        )
        answers[f"rounded {k}"] = _trajectory(case, mode, tell, moved)
    return answers


def _changed_scene(scene: Scene, alter: Callable[[Array], Array]) -> Scene:
    """The scene with other places, masses and inertias."""

    def all_of(x: Sequence[float]) -> tuple[float, ...]:
        return tuple(alter(np.array(x, float)).tolist())

    bodies = {
        name: replace(
            body,
            mass=all_of((body.mass,))[0],
            inertia=all_of(body.inertia),
            points={point: all_of(at) for point, at in body.points.items()},
        )
        for name, body in scene.bodies.items()
    }
    points = {name: replace(point, at=all_of(point.at)) for name, point in scene.points.items()}
    return replace(scene, bodies=bodies, points=points)


def _difference(case: Case, first: Trajectory, second: Trajectory) -> float:
    """The largest difference of states, of what both tell, and of all that is claimed.

    Relative to the largest of a unit: what stays zero, as the x of a vertical axis, trembles.
    """
    names = {*case.allow, *(first.reactions.keys() & second.reactions.keys())}
    known = case.quantities
    units = {name: known[name].unit if name in known else name for name in names}
    pairs = [
        (unit, *(observe(case.scene, motion, name) for motion in (first, second)))
        for name, unit in units.items()
        if not name.endswith(".attitude")  # of which the states tell
    ]
    sizes: dict[str, float] = {}
    for unit, own, _ in pairs:
        sizes[unit] = max(sizes.get(unit, 0.0), worst(np.abs(own)))
    differences = (relative(own, others, least=sizes[unit]) for unit, own, others in pairs)
    return worst([difference(first, second), *differences])


def _worked(case: Case, mode: Stated, built: Trajectory) -> tuple[Trajectory, float]:
    """The answer with d'Alembert's loads in place of Lagrange's, and their largest term."""
    each = [by_virtual_work(mode, case.scene.gravity, *row) for row in rows(case, mode)]
    loads = {
        effort: np.array([row[name][0] for row in each]) for name, effort in efforts(case.scene)
    }
    size = worst(term for row in each for _, term in row.values())
    return replace(built, reactions={**built.reactions, **loads}), size


def _chain_checks(
    case: Case, mode: Stated, built: Trajectory, worked: Trajectory, size: float
) -> Iterator[Check]:
    """The chain against what its joints hold, and Lagrange's equations against d'Alembert's."""
    assert case.states is not None
    yield Check("joints hold (2.10), (2.15)", unheld(mode, case.scene, rows(case, mode)), LAW)
    read = misread(case.scene, built, case.states.drawn(case.scene))
    yield Check("coordinates read back", read, LAW)
    error = (
        relative(built.reactions[effort], worked.reactions[effort], least=size)
        for _, effort in efforts(case.scene)
    )
    yield Check("Lagrange (2.44) against d'Alembert (2.39)", worst(error), LAW)


def _constant_mistakes(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    for name in case.allow:
        if case.quantities[name].kind in VARYING:
            samples = observe(case.scene, motion, name)
            if np.ptp(samples, axis=0).max() == 0.0:
                yield case.mistake(("allow", name), "is the same in every state; leave it out")


# A chain's places, velocities and accelerations against what its joints hold and leave.
#
# The rows of the mechanism in maximal coordinates know nothing of the chain's coordinates, and the
# joints read these back from the poses alone.


THREE = 3  # turns, of which other angles make the same attitude


@equation
def unheld(mode: Stated, scene: Scene, rows: Iterator[Row]) -> float:
    """(2.10), (2.15) The largest of f = 0, f_a v = 0 and f_a v̇ = γ, each of its largest term."""
    base = SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))
    errors: list[float] = []
    for q, v, a in rows:
        poses, changes = mode.poses(0.0, q, v), moving(mode, q, v, a)
        at, rates = base.place(poses)
        _, accelerations = base.place({name: tuple(x) for name, x in changes.items()})
        f_a, g, gamma = base.rows(0.0, at, rates)
        errors.append(worst(np.abs(base.f(0.0, at))) / max(1.0, _arms(scene), worst(np.abs(at))))
        for held, right in ((rates, g), (accelerations, gamma)):
            size = worst(np.abs(f_a * held).ravel()) or 1.0
            errors.append(worst(np.abs(f_a @ held - right)) / size)
    return worst(errors)


def misread(scene: Scene, trajectory: Trajectory, drawn: dict[str, Array]) -> float:
    """How far coordinates and rates that joints read from the poses are from what was drawn."""
    near = {  # states are unrelated: no turn is counted from one to the next
        joint.name: np.stack([drawn[f"{joint.name}.{turn.name}"][:, 0] for turn in joint.turns], 1)
        for joint in scene.joints.values()
        if joint.turns
    }
    motion = Motion(scene.bodies, scene.points, replace(trajectory, near=near))
    errors: list[float] = []
    places = [states[:, scene.frame.place] for states in trajectory.states.values()]
    size = max(_arms(scene), worst(np.abs(x).max() for x in places))  # of which shifts are left
    for joint in scene.joints.values():
        read, rates = joint.coordinates(motion)
        for k, freedom in enumerate(joint.freedoms):
            place, rate, _ = drawn[f"{joint.name}.{freedom.name}"].T
            if freedom.kind == "turn" and len(joint.turns) == THREE:
                continue
            errors.append(relative(rate, rates[:, k], least=1.0))
            error, least = place - read[:, k], size
            if freedom.kind == "turn":
                error, least = np.remainder(error + np.pi, 2 * np.pi) - np.pi, 1.0
            errors.append(worst(np.abs(error)) / max(1.0, least, worst(np.abs(place))))
    return worst(errors)


def _arms(scene: Scene) -> float:
    """The largest coordinate [m] of a point in its body or on the ground."""
    points = [point.at for point in scene.points.values()]
    points += [at for body in scene.bodies.values() for at in body.points.values()]
    return worst(abs(x) for at in points for x in at)


# Free bodies of the plane in x, y and angle: of which states are claimed.


class FreeBodies(Stated):
    """Nothing joins them."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.coordinates = scene, tuple(coordinates(scene))
        self.masses = {
            body.name: Mass(body.mass, body.moment if body.turns else None)
            for body in scene.bodies.values()
        }

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.9) X_k, E_k: a free body's coordinates are its own parameters."""
        at = {name: (q[i], v[i]) for i, name in enumerate(self.coordinates)}
        poses: dict[str, Pose] = {}
        for name in self.masses:
            both = [at.get(f"{name}.{own}", (0.0, 0.0)) for own in ("x", "y", "angle")]
            poses[name] = (*(place for place, _ in both), *(rate for _, rate in both))
        return poses

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = Σ ½ m ṙ_c² + ½ J₃₃ ω² [J]."""
        energy: Any = 0.0
        for name, (*_, vx, vy, omega) in self.poses(t, q, v).items():
            mass = self.masses[name]
            energy = energy + (mass.m * (vx**2 + vy**2) + (mass.J or 0.0) * omega**2) / 2
        return energy

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c [J]."""
        gx, gy = self.scene.gravity
        places = self.poses(t, q, 0.0 * q)
        return -sum(self.masses[n].m * (gx * x + gy * y) for n, (x, y, *_) in places.items())
