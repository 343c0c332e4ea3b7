"""The islands of a scene: what nothing joins moves as if each were there alone.

The ground joins nothing: whatever hangs on it feels its place, and not what else does.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from . import Anchor, Scene


def solved_scenes(scene: Scene, system: object, events: object) -> tuple[Scene, ...]:
    """The scenes that are solved separately: the islands, or the whole scene.

    A hand-written system is one, and events are read from the record of one motion.
    """
    return (scene,) if system or events else islands(scene)


def islands(scene: Scene) -> tuple[Scene, ...]:
    """Split a scene into its connected parts, with all that acts on each."""
    together = {name: {name} for name in scene.bodies}
    ends = {name: _bodies(scene, anchors) for name, anchors in _connections(scene)}
    for bodies in ends.values():
        joined = set[str]().union(*(together[name] for name in bodies))
        together |= dict.fromkeys(joined, joined)
    groups = {id(group): group for group in together.values()}.values()
    return (scene,) if len(groups) <= 1 else tuple(_part(scene, ends, group) for group in groups)


def _connections(scene: Scene) -> Iterator[tuple[str, tuple[Anchor, ...]]]:
    """Yields name and points of each element that connects bodies, or one with the ground."""
    for section in (scene.joints, scene.constraints, scene.contacts, scene.pairs):
        yield from ((element.name, element.refers()) for element in section.values())
    for force in scene.forces.values():
        if force.about is None or force.about in scene.joints:  # of a scene with mistakes
            yield force.name, scene.ends(force)


def _bodies(scene: Scene, ends: tuple[Anchor, ...]) -> set[str]:
    return {at.body for at in ends} & scene.bodies.keys()


def _part(scene: Scene, ends: Mapping[str, set[str]], group: set[str]) -> Scene:
    """These bodies with all that acts on them, in the scene's order; the ground stays whole."""

    def mine(section: Mapping[str, Any]) -> dict[str, Any]:
        return {name: each for name, each in section.items() if ends.get(name, set()) & group}

    joints = mine(scene.joints)
    return replace(
        scene,
        bodies={name: body for name, body in scene.bodies.items() if name in group},
        joints=joints,
        constraints=mine(scene.constraints),
        contacts=mine(scene.contacts),
        pairs=mine(scene.pairs),
        forces=mine(scene.forces),
        drives={q: law for q, law in scene.drives.items() if q.rpartition(".")[0] in joints},
    )
