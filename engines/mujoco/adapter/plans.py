"""Plans of MuJoCo's settings for a scene: ways, exponents, and the protocol's words."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from ....cases.scene import CENTER, Contact, Pair, Scene
from ....cases.scene.frame import SPACE
from ...engine import Choice, Plan, Realised, Start
from ...foot_contact import strides
from ...law import one_number
from ..callbacks.contact_friction import one_touch
from ..callbacks.friction import one_slide, smooth_only
from ..callbacks.rope_impact import catches
from ..callbacks.rope_limit import ropes_of
from ..callbacks.spring_switch import has_corners
from ..callbacks.stepping import (
    Stepper,
    at_catches,
    at_corners,
    at_friction,
    at_strikes,
    by_law,
    native,
)
from ..model.bounce import spread
from ..model.contact import falls
from ..model.force import lacking
from ..model.planes import met
from ..model.scene import HEAVY, LEAST
from ..model.tree import driven, dry_joints
from ..settings.settings import only_slides
from .compilation import NOMINAL, placed

Numbers = Callable[[float], Sequence[Choice]]


@dataclass(frozen=True)
class Way:
    """One way of running a scene, natively, by law or by driver.

    applies: whether a scene is one for it; ways of one name exclude each other. words: what it
    does, for the protocol. beside: whether the scene can be run without it, so that the tuned
    setting alone offers it.
    """

    realised: Realised
    applies: Callable[[Scene], bool]
    steps: Stepper
    words: Callable[[Scene], list[str]] = lambda scene: []
    beside: bool = False


def ways(scene: Scene, start: Start, *, tuned: bool) -> tuple[Realised, ...]:
    """The ways in which a setting runs the scene."""
    # Of what comes down the normal force is anything, which no law of friction follows.
    beside = tuned and not (one_touch(scene) and falls(scene, start))
    found = (way for way in WAYS if way.applies(scene) and (beside or not way.beside))
    return tuple(way.realised for way in found)


def way(scene: Scene, realised: Realised) -> Way:
    """The one way of that name for the scene."""
    (found,) = (way for way in WAYS if way.realised == realised and way.applies(scene))
    return found


def _own(scene: Scene) -> bool:
    """Whether MuJoCo has something of its own for all of the scene."""
    return not (scene.constraints or strides(scene) or lacking(scene))


def _lacks_forces(scene: Scene) -> bool:
    return bool(lacking(scene)) and not (scene.constraints or strides(scene))


def _switches(scene: Scene) -> bool:
    """Whether one dry joint, or one contact by itself, sticks and slides."""
    if scene.constraints or strides(scene):
        return False
    return (one_slide(scene) and not smooth_only(scene)) or (_own(scene) and one_touch(scene))


def _held(scene: Scene) -> list[str]:
    return [f"{', '.join(scene.constraints)} held by our law at every stage", *_told(scene)]


def _rubbed(scene: Scene) -> list[str]:
    when = "stage" if smooth_only(scene) and not met(scene) else "step"
    rubs = one_slide(scene) or one_touch(scene)
    return [f"dry friction by our law before every {when}"] if rubs else []


def _told(scene: Scene) -> list[str]:
    ours = ", ".join(force.name for force, _ in lacking(scene))
    return [f"{ours} by our law at every stage, which the script has not"] if ours else []


def _cut(where: str) -> Callable[[Scene], list[str]]:
    return lambda scene: [*_told(scene), where]


WAYS = (
    Way("native", _own, native),
    Way("law", lambda scene: bool(scene.constraints), by_law, _held),
    Way("law", _lacks_forces, by_law, lambda scene: [*_rubbed(scene), *_told(scene)]),
    Way(
        "law",
        lambda scene: _own(scene) and (one_slide(scene) or one_touch(scene)),
        by_law,
        _rubbed,
        beside=True,
    ),
    Way(
        "driver",
        lambda scene: strides(scene) and not scene.constraints,
        at_strikes,
        _cut("the foot that stands is pinned; steps are cut where one strikes: an impulse"),
    ),
    Way(
        "driver",
        _switches,
        at_friction,
        _cut("steps cut at the events of dry friction"),
        beside=True,
    ),
    Way(
        "driver",
        lambda scene: _own(scene) and catches(scene),
        at_catches,
        _cut("steps cut where a rope comes taut, and the impact taken there"),
        beside=True,
    ),
    Way(
        "driver",
        lambda scene: _own(scene) and has_corners(scene),
        at_corners,
        _cut("steps cut where a spring begins or ends to act"),
        beside=True,
    ),
)
"""MuJoCo's own elements; our laws for edges, for forces that it has no element for, and for dry
friction, of which it knows one number; and our drivers, which cut a step where it would cross what
no integrator knows."""


def plan(
    scene: Scene,
    start: Start,
    realised: Realised,
    numbers: Numbers,
    *,
    settles: bool,
    tuned: bool,
) -> Plan:
    """One way's plan. Nothing is withheld: a joint's force and moment can be read, a contact's too.

    Exponents: Euler, contacts, corners of dry friction and of springs 1, 2; RK4 4, 5, with corners
    of other laws and the mean of a force that jumps 2, 3, which a driver of dry friction cuts where
    it passes a bound, and not the force: 1, 2; soft constraints that follow the step 2, 3.
    """
    integrator = {choice.name: choice.value for choice in numbers(NOMINAL)}["option.integrator"]
    dry = bool(dry_joints(scene))
    jumps = any(law.corners for law in scene.laws())
    first = integrator != "RK4" or bool(met(scene)) or (dry and (realised != "driver" or jumps))
    first |= any(scene.one_sided()) and realised != "driver"
    first |= any(scene.limits()) and not (realised == "driver" and catches(scene))
    corners = any(force.corner for force in scene.forces.values())
    following = (1, 2) if first else (4, 5) if dry else (2, 3)
    bare = Plan(
        realised,
        held=(1, 2) if first else (2, 3) if corners or jumps else (4, 5),
        following=following if follows(numbers) else None,
        alike=realised != "native" and only_slides(scene),  # what our law holds lies still
        numbers=numbers,
        simplified=one_number(scene) if realised == "native" else "",
    )
    return replace(bare, protocol=partial(_words, scene, start, bare, settles, tuned))


def follows(numbers: Numbers) -> bool:
    """Whether a number follows the step."""
    here, there = ([c.value for c in numbers(step)] for step in (NOMINAL, 2 * NOMINAL))
    return here != there


def _words(scene: Scene, start: Start, plan: Plan, settles: bool, tuned: bool, step: float) -> str:
    """Driven points, laws and drivers, and how deep a disk is started in the floor."""
    words = []
    if any(driven(scene)):
        words.append(f"driven points are masses of {HEAVY:g} kg")
    if scene.drives:
        words.append(f"prescribed rates are armatures of {HEAVY:g} kg m² (kg of a slide)")
    if plan.simplified:
        words.append(plan.simplified)
    words += way(scene, plan.realised).words(scene)
    if tuned and met(scene) and falls(scene, start):
        words.append("starts above the floor: contacts are tuned for impacts")
    if tuned and (thrown := max((one.restitution for one in met(scene)), default=0.0)):
        lasts, kept = spread(thrown)
        words.append(f"a bounce lasts {lasts:.0f} steps, and keeps its speed to about {kept:.2g} %")
    words += [f"{name} has {LEAST:g} kg m² about its own axis" for name in _slender(scene)]
    if settles and (met(scene) or any(ropes_of(scene))):
        *_, moved = placed(scene, start, step, plan, settles=True)
        words += _begun_in_space(moved) if scene.frame is SPACE else _begun(scene, moved)
    return "; ".join(words)


def _slender(scene: Scene) -> list[str]:
    """The bodies in space without a moment about their own axis."""
    bodies: Mapping[str, Any] = scene.bodies if scene.frame is SPACE else {}
    return [n for n, body in bodies.items() if body.turns and min(body.inertia[:3]) == 0.0]


def _begun(scene: Scene, moved: Mapping[str, float]) -> list[str]:
    """How much too long ropes are started [m], and how deep in the floor what touches."""
    both = {**scene.touching, **scene.pairs}
    words = [f"{name} started {m:.1e} m too long" for name, m in moved.items() if name not in both]
    deep = ((both[name], depth) for name, depth in moved.items() if depth and name in both)
    return words + [f"{_at(c)} started {depth:.1e} m in the {c.on}" for c, depth in deep]


def _begun_in_space(moved: Mapping[str, tuple[float, float]]) -> list[str]:
    """How deep bodies are started in the floor [m], and how fast they creep there [m/s]."""
    return [
        f"{name} started {depth:.1e} m in the floor, creeping {creep:.1e} m/s"
        for name, (depth, creep) in moved.items()
        if depth
    ]


def _at(contact: Contact | Pair) -> str:
    """`wheel`, `rod.end`."""
    return contact.body if contact.at.point == CENTER else str(contact.at)
