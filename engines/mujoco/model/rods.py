"""Massless rods, for which MuJoCo has no joint: light bars on two pins, one at each end.

In a tree they are its own joints, and as good as any. Where a rod closes a loop one of its pins
would be a `connect`, whose softness the light bar spoils, the more the lighter it is: 6e-5 m off
at a thousandth of the others' mass, 5e-3 m at 1e-5 of it. There a tendon is held instead: 8e-6 m
(all measured at 1e-4 s).
"""

import math
from dataclasses import replace

from ....cases.scene import Anchor, Scene
from ....cases.scene.body import Body
from ....cases.scene.joint import Joint, planar_joint
from ....cases.trajectory import Trajectory
from ...engine import Start
from .tree import place, spanned

LIGHT = 1e-13  # of the lightest body: below what the audit sees of its energy
LEAST = 2e-15  # kg and kg m²: MuJoCo takes half of that (mjMINVAL)


def called(joint: str) -> str:
    """The bar's name, which no case can give."""
    return f"{joint}-rod"


def with_rods(scene: Scene, start: Start) -> tuple[Scene, Start]:
    """The scene and its start with a bar for each rod.

    The pin at its first end has the rod's name: what it exerts on the bar is what the rod exerts on
    its second point.
    """
    rods = in_tree(scene)
    if not any(joint.swings for joint in scene.joints.values()):
        return scene, start
    mass = max(LEAST, LIGHT * min(body.mass for body in scene.bodies.values()))
    bodies, joints, begun = dict(scene.bodies), dict(scene.joints), dict(start)
    for name, joint in scene.joints.items():
        if joint.swings and joint not in rods:
            joints[name] = replace(joint, length=_between(scene, joint, start)[0])
    for rod in rods:
        name = called(rod.name)
        length, begun[name] = _between(scene, rod, start)
        points = {"center": (0.0, 0.0), "start": (-length / 2, 0.0), "end": (length / 2, 0.0)}
        bodies[name] = Body(name, "bar", mass, (max(LEAST, mass * length**2 / 12),), points)
        joints[rod.name] = planar_joint(rod.name, "pin", rod.a, Anchor(name, "start"))
        joints[f"{rod.name}-end"] = planar_joint(
            f"{rod.name}-end", "pin", Anchor(name, "end"), rod.b
        )
    return replace(scene, bodies=bodies, joints=joints), begun


def in_tree(scene: Scene) -> list[Joint]:
    """The rods that close no loop, other joints being taken into the tree before them."""
    joints = sorted(scene.joints.values(), key=lambda joint: joint.swings)
    closing = spanned(scene, joints).loops
    return [joint for joint in joints if joint.swings and joint not in closing]


def _between(scene: Scene, rod: Joint, start: Start) -> tuple[float, tuple[float, ...]]:
    """Length [m] and state of a bar from one point to the other."""
    if not any(map(any, start.values())):  # nobody asks where: the scene alone is looked at
        return rod.length or 1.0, (0.0,) * 6
    (ax, ay, au, av), (bx, by, bu, bv) = (place(scene, end, start) for end in (rod.a, rod.b))
    x, y, u, v = bx - ax, by - ay, bu - au, bv - av
    omega = (x * v - y * u) / (x * x + y * y)
    state = ((ax + bx) / 2, (ay + by) / 2, math.atan2(y, x), (au + bu) / 2, (av + bv) / 2, omega)
    return math.hypot(x, y), state


def of_scene(scene: Scene, motion: Trajectory) -> Trajectory:
    """The motion of the scene's own bodies."""
    own = {name: rows for name, rows in motion.states.items() if name in scene.bodies}
    record = motion.record and of_scene(scene, motion.record)
    return replace(motion, states=own, record=record)
