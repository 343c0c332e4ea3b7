"""Scenes in space on which engines are tried, and a run of MuJoCo on them."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from textmech.cases.scene import Anchor, Force, GroundPoint, Scene, Signal
from textmech.cases.scene.body import Body
from textmech.cases.scene.contact import Contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.rotation import Vector3
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Plan, Start
from textmech.engines.mujoco import MuJoCo

G = 9.80665  # m/s²
STILL = (0.0, 0.0, 0.0)
LOPSIDED = ((0.02, 0.003, -0.001), (0.003, 0.035, 0.002), (-0.001, 0.002, 0.04))
"""A tensor [kg m²] whose principal axes are nobody's."""


def vector(values: Any) -> Vector3:
    """Three floats."""
    x, y, z = np.asarray(values, dtype=float).tolist()
    return x, y, z


def unit(values: Any) -> Vector3:
    """The direction of a vector."""
    return vector(np.asarray(values, dtype=float) / np.linalg.norm(values))


def attitude(values: Any) -> tuple[float, ...]:
    """A unit quaternion along four numbers."""
    return tuple((np.asarray(values, dtype=float) / np.linalg.norm(values)).tolist())


def rigid(
    name: str, mass: float, tensor: Any, points: dict[str, Any] | None = None, **given: Any
) -> Body:
    """A body by its tensor (3, 3) or its principal moments (3,) in body axes."""
    J = np.asarray(tensor, dtype=float)
    J = np.diag(J) if J.ndim == 1 else J
    entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
    inertia: Any = tuple(float(J[at]) for at in entries)
    named = {"center": STILL, **{k: vector(at) for k, at in (points or {}).items()}}
    return Body(name, "rigid", mass, inertia, named, frame=SPACE, **given)


def particle(name: str, mass: float) -> Body:
    """A body without attitude."""
    return Body(name, "particle", mass, (), {"center": STILL}, frame=SPACE)


def joint(name: str, kind: Any, a: str, b: str, *freedoms: Freedom) -> Joint:
    """A joint between `body.point` and `body.point`."""
    (p, q), (r, s) = a.split("."), b.split(".")
    return Joint(name, kind, Anchor(p, q), Anchor(r, s), freedoms, frame=SPACE)


def hinge(name: str, a: str, b: str, axis: Any) -> Joint:
    """A hinge about an axis of the first part."""
    return joint(name, "hinge", a, b, Freedom.turn(unit(axis), "angle"))


def ball(name: str, a: str, b: str) -> Joint:
    """A ball joint."""
    return joint(name, "ball", a, b, Freedom("ball"))


def point(at: Any, velocity: Any = STILL) -> GroundPoint:
    """A point of the ground."""
    return GroundPoint(vector(at), vector(velocity))  # type: ignore[arg-type]


def spatial(
    bodies: Sequence[Body],
    joints: Sequence[Joint] = (),
    *,
    contacts: Sequence[Contact] = (),
    forces: Sequence[Force] = (),
    gravity: Vector3 = (0.0, 0.0, -G),
    points: dict[str, GroundPoint] | None = None,
    drives: dict[str, Signal] | None = None,
) -> Scene:
    """Bodies under gravity, with the ground's point O at the origin."""
    return Scene(
        gravity,
        {"O": point(STILL), **(points or {})},
        {body.name: body for body in bodies},
        {joint.name: joint for joint in joints},
        {contact.name: contact for contact in contacts},
        {force.name: force for force in forces},
        drives=drives or {},
        frame=SPACE,
    )


def state(r: Any, q: Any, v: Any, omega: Any) -> tuple[float, ...]:
    """A body's state; ω in its own axes."""
    return tuple(np.concatenate([r, q, v, omega]).astype(float).tolist())


def simulated(
    scene: Scene,
    start: Start,
    times: Array,
    step: float,
    reactions: Sequence[str] = (),
    *,
    setting: str = "tuned",
    record: bool = False,
) -> Trajectory:
    """MuJoCo's motion by its only plan."""
    engine = MuJoCo(setting)
    (plan,) = engine.plans(scene, start)
    assert isinstance(plan, Plan), plan
    return engine.run(scene, start, times, step, plan, reactions=tuple(reactions), record=record)
