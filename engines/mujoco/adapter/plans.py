"""Plans of MuJoCo's settings for a scene: ways, exponents, and the protocol's words."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from ....cases.scene import CENTER, Scene
from ....cases.scene.frame import SPACE
from ...engine import Choice, Plan, Realised, Start
from ...foot_contact import strides
from ...law import one_number
from ..callbacks.contact_friction import one_touch
from ..callbacks.friction import one_slide, smooth_only
from ..callbacks.rope_limit import ropes_of
from ..callbacks.stepping import Stepper, at_strikes, by_law, native
from ..model.bounce import spread
from ..model.contact import falls
from ..model.force import lacking
from ..model.planes import met
from ..model.scene import HEAVY, LEAST
from ..model.tree import driven, dry_joints
from ..settings.settings import only_slides
from .compilation import NOMINAL, placed

Numbers = Callable[[float], Sequence[Choice]]


STEPPERS: dict[Realised, Stepper] = {"native": native, "law": by_law, "driver": at_strikes}
"""How steps are taken in each way."""


def ways(scene: Scene, start: Start, *, tuned: bool) -> tuple[Realised, ...]:
    """MuJoCo's own elements; our laws for what it has no element for, our driver for feet.

    Dry friction also by our law, if tuned: MuJoCo's has one number. Of what comes down the normal
    force is anything, which no law of friction follows.
    """
    if strides(scene):
        return ("driver",)
    if scene.constraints or lacking(scene):
        return ("law",)
    ruled = one_slide(scene) or (one_touch(scene) and not falls(scene, start))
    return ("native", "law") if tuned and ruled else ("native",)


def _ours(scene: Scene, realised: Realised) -> list[str]:
    """Describes what our law or driver does."""
    if realised == "native":
        return []
    words = []
    if realised == "driver":
        words.append("the foot that stands is pinned; steps are cut where one strikes: an impulse")
    if scene.constraints:
        words.append(f"{', '.join(scene.constraints)} held by our law at every stage")
    if one_slide(scene) or one_touch(scene):
        when = "stage" if smooth_only(scene) and not met(scene) else "step"
        words.append(f"dry friction by our law before every {when}")
    if names := ", ".join(force.name for force, _ in lacking(scene)):
        words.append(f"{names} by our law at every stage, which the script has not")
    return words


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
    of other laws and the mean of a force that jumps 2, 3; soft constraints that follow the step
    2, 3.
    """
    integrator = {choice.name: choice.value for choice in numbers(NOMINAL)}["option.integrator"]
    switches = [*met(scene), *dry_joints(scene), *scene.one_sided(), *scene.limits()]
    first = integrator != "RK4" or bool(switches)
    corners = any(force.corner for force in scene.forces.values())
    corners |= any(law.corners for law in scene.laws())
    bare = Plan(
        realised,
        held=(1, 2) if first else (2, 3) if corners else (4, 5),
        following=((1, 2) if first else (2, 3)) if follows(numbers) else None,
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
    words += _ours(scene, plan.realised)
    if tuned and met(scene) and falls(scene, start):
        words.append("starts above the floor: contacts are tuned for impacts")
    if tuned and (thrown := max((contact.restitution for contact in met(scene)), default=0.0)):
        lasts, kept = spread(thrown)
        words.append(f"a bounce lasts {lasts:.0f} steps, and keeps its speed to about {kept:.2g} %")
    words += [f"{name} has {LEAST:g} kg m² about its own axis" for name in _slender(scene)]
    if settles and (met(scene) or any(ropes_of(scene))):
        *_, moved = placed(scene, start, step, plan, settles=True)
        words += _begun(scene, moved)
    return "; ".join(words)


def _slender(scene: Scene) -> list[str]:
    """The bodies in space without a moment about their own axis."""
    bodies: Mapping[str, Any] = scene.bodies if scene.frame is SPACE else {}
    return [n for n, body in bodies.items() if body.turns and min(body.inertia[:3]) == 0.0]


def _begun(scene: Scene, moved: Mapping[str, Any]) -> list[str]:
    """How much too long ropes are started [m]; how deep in the floor what touches is [m].

    In space with how fast it creeps there [m/s].
    """
    both = {**scene.touching, **scene.pairs}
    words = [f"{name} started {m:.1e} m too long" for name, m in moved.items() if name not in both]
    for contact, (depth, creep) in ((both[n], size) for n, size in moved.items() if n in both):
        if depth:
            space = scene.frame is SPACE
            at = contact.body if space or contact.at.point == CENTER else str(contact.at)
            creeps = f", creeping {creep:.1e} m/s" if space else ""
            words.append(f"{at} started {depth:.1e} m in the {contact.on}{creeps}")
    return words
