"""Guesses of all places in space: along a tree of joints from the ground, at given coordinates."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ...cases.case import Placement
from ...cases.scene import GROUND, Anchor, Scene
from ...cases.scene.joint import Joint
from ...cases.scene.rotation import UPRIGHT, about, inverse, product, turned
from ..mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from ..system import Array

Pose = tuple[Array, Array]  # r (3,) and the quaternion (4,)


def laid_out(
    where: SpatialCoordinates,
    given: Mapping[str, Placement],
    seeds: Mapping[str, Mapping[str, float]],
) -> Array:
    """q (m,): bodies that are placed, then those that hang on them, then the rest at the origin.

    A body of which only the attitude is given hangs where its joint is. seeds: coordinates of
    joints that nobody gives; what is in neither is 0.
    """
    scene = where.scene
    known: dict[str, Pose] = {GROUND: (np.zeros(3), np.array(UPRIGHT))}
    for name in scene.bodies:
        placement = given.get(name)
        if placement is None:
            continue
        stands = placement.points or {*"xyz"} <= placement.given.keys()
        # Whose attitude nobody gives may be turned as its joint's seeds say, to find other ways.
        if stands and (placement.attitude is not None or (placement.points and not seeds)):
            known[name] = _placed(scene, name, placement)
    while len(known) <= len(scene.bodies):
        next_body = _next(scene, known, given, seeds)
        if next_body is None:
            unplaced = [name for name in scene.bodies if name not in known]
            placed = {name: given.get(name, Placement()) for name in unplaced}
            name = min(unplaced, key=lambda name: placed[name].attitude is None)
            next_body = name, _placed(scene, name, placed[name])
        known[next_body[0]] = next_body[1]
    poses = {name: (*r, *e, *np.zeros(6)) for name, (r, e) in known.items() if name != GROUND}
    return where.place(poses)[0]


def _placed(scene: Scene, name: str, placement: Placement) -> Pose:
    e = np.array(placement.attitude or UPRIGHT)
    r = np.array([placement.given.get(axis, 0.0) for axis in "xyz"])
    for point, place in placement.points.items():
        r = np.array(place) - turned(e, scene.bodies[name].points[point])
    return r, e


def _next(
    scene: Scene,
    known: Mapping[str, Pose],
    given: Mapping[str, Placement],
    seeds: Mapping[str, Mapping[str, float]],
) -> tuple[str, Pose] | None:
    """A body that hangs on a known one: first by a joint of which something is given or near."""
    for joint in sorted(scene.joints.values(), key=lambda joint: joint.name not in given):
        a, b = joint.a.body in known, joint.b.body in known
        if a == b:
            continue
        placement = given.get(joint.name, Placement())
        values = {**seeds.get(joint.name, {}), **placement.given}
        shift, turn = _relative_pose(joint, values, placement.attitude)
        if a:
            r, e = known[joint.a.body]
            own = _attitude_of(given, joint.b.body, product(e, turn))
            at = r + turned(e, _local(scene, joint.a) + shift)
            return joint.b.body, (at - turned(own, _local(scene, joint.b)), own)
        r, e = known[joint.b.body]
        own = _attitude_of(given, joint.a.body, product(e, inverse(turn)))
        at = r + turned(e, _local(scene, joint.b))
        return joint.a.body, (at - turned(own, _local(scene, joint.a) + shift), own)
    return None


def _attitude_of(given: Mapping[str, Placement], body: str, hung: Array) -> Array:
    """The attitude (4,) that is given of a body, or the one with which it hangs."""
    attitude = given.get(body, Placement()).attitude
    return hung if attitude is None else np.array(attitude)


def _relative_pose(
    joint: Joint, values: Mapping[str, float], attitude: tuple[float, ...] | None
) -> tuple[Array, Array]:
    """The shift (3,) in the axes of the first part, and the turn of the second (4,)."""
    shift, turn = np.zeros(3), np.array(attitude or UPRIGHT)
    for i, freedom in enumerate(joint.freedoms):
        value = values.get(freedom.name or f"#{i}", 0.0)
        if freedom.kind == "shift":
            shift = shift + value * np.array(freedom.axis)
        elif freedom.kind == "turn":
            turn = product(turn, np.array(about(freedom.axis, value)))
    return shift, turn


def _local(scene: Scene, anchor: Anchor) -> Array:
    if anchor.body == GROUND:
        return np.array(scene.points[anchor.point].at)
    return np.array(scene.bodies[anchor.body].points[anchor.point])


def together(
    initial: Mapping[str, Placement], near: Mapping[str, Placement]
) -> dict[str, Placement]:
    """The placements by name: what is given, and what is near where nothing is given."""
    both = {**near, **initial}
    for name in near.keys() & initial.keys():
        guess, given = near[name], initial[name]
        both[name] = replace(
            given,
            given={**guess.given, **given.given},
            points={**guess.points, **given.points},
            attitude=given.attitude or guess.attitude,
        )
    return both


def off_by(
    scene: Scene,
    near: Mapping[str, Placement],
    far: float,
    size: float,
    rng: np.random.Generator,
) -> dict[str, Placement]:
    """Placements as `near` says them, but off by up to `far`, in rad or sizes."""

    def off(turns: bool = False) -> float:
        return float(rng.uniform(-far, far)) * (1.0 if turns else size)

    placements: dict[str, Placement] = {}
    for name, said in near.items():
        joint = scene.joints.get(name)
        turns = {} if joint is None else {f.name: f.kind == "turn" for f in joint.named}
        given = {key: x + off(turns.get(key, False)) for key, x in said.given.items()}
        points = {key: tuple(x + off() for x in place) for key, place in said.points.items()}
        e = said.attitude
        if e is not None:
            x, y, z = rng.normal(size=3).tolist()
            length = math.hypot(x, y, z)
            turn = about((x / length, y / length, z / length), off(turns=True))
            e = tuple(product(np.array(e), np.array(turn)).tolist())
        placements[name] = replace(said, given=given, points=points, attitude=e)
    return placements
