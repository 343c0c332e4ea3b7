"""Checks of what acts about or along a joint, or rubs in it: its parts may turn, or may shift."""

from collections.abc import Iterator
from typing import Any

from ...mistake import Path, listed, nearest
from ...scene import Force, Joint, Scene
from ..parse import Finding, Parsed


def about(parsed: Parsed, scene: Scene, path: Path, force: Force) -> Iterator[Finding]:
    """Yields what is wrong with the joint's name, the joint, or the turn that is meant."""
    name = force.about
    assert name is not None
    if name not in scene.joints:
        if not parsed.hides(name):
            known = parsed.names("joints", scene.joints)
            yield path, f"unknown joint {name!r}{nearest(name, known)}"
        return
    joint = scene.joints[name]
    if scene.frame.dimension == 2 and joint.swings:
        yield path, f"{name!r} is a {joint.kind}, and no axis about which anything could act"
        return
    if force.freedom == "shift":
        if not joint.shifts:
            yield path, f"{name!r} is a {joint.kind}, and lets nothing shift"
        return
    if not joint.turns:
        yield path, f"{name!r} is a {joint.kind}, and lets nothing turn"
        return
    if scene.frame.dimension == 3:
        if what := no_turn(joint, force):
            yield path, what
        return
    if force.turn:
        yield path, f"in the plane {name!r} has one turn without a name: write {name!r}"
    yield from turning(scene, path, joint)


def rubbing(scene: Scene) -> Iterator[Finding]:
    """Dry friction of a pin brakes a turn."""
    for name, joint in scene.joints.items():
        if joint.dry_friction is not None and not joint.shifts:
            yield from turning(scene, ("scene", "joints", name, "dry_friction"), joint)


def turning(scene: Scene, path: Path, joint: Joint) -> Iterator[Finding]:
    """Parts of the joint that cannot turn."""
    for at in joint.refers():
        if at.body in scene.bodies and not scene.bodies[at.body].turns:
            yield path, f"{joint.name!r} joins {at.body!r}, which is a particle and cannot turn"


# Forces about a joint in space: which of its turns is meant.


def no_turn(joint: Any, force: Force) -> str | None:
    """Why there is no such turn, or none about which anything can act."""
    found: Joint = joint
    name, freedom = found.name, force.turn
    turns = [f.name for f in found.turns if f.name]
    written = [f"{name}.{turn}" for turn in turns]
    if not found.holds_attitude:
        why = "their middle axis is fixed in neither part; put a body between, on a joint more"
        return f"{name!r} leaves three turns, and about these nothing can act: {why}"
    if not turns:
        return f"the turns of {name!r}, a {found.kind}, have no names: write it as `freedoms`"
    if not freedom and found.kind == "freedoms":
        return f"{name!r} leaves freedoms with names: write {' or '.join(map(repr, written))}"
    if freedom in found.rates:
        turn = f"{name}.{found.rates[freedom].name}"
        return f"{freedom!r} is a rate; the turn is {turn!r}"
    if freedom in [f.name for f in found.shifts]:
        return f"{freedom!r} slides, and nothing turns there{listed(written)}"
    if freedom and freedom not in turns:
        return f"{name!r} has no turn {freedom!r}{nearest(f'{name}.{freedom}', written)}"
    return None
