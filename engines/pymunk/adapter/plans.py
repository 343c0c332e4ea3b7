"""Plans of pymunk's settings for a scene: ways, exponents, and the protocol's words."""

from collections.abc import Sequence
from functools import partial
from typing import Any

from ....cases.scene import Scene
from ....cases.scene.quantity import table
from ...engine import Choice, Plan, Realised, Start
from ...foot_contact import strides
from ...law import one_number
from ..callbacks.cut import cuts
from ..callbacks.force import damped, lacking
from ..callbacks.friction import ruled
from ..model.contact import closed
from ..model.damping import slowing
from ..model.edge import alone
from ..model.pair import closed_pairs
from ..model.slot import oblique
from ..settings.options import Numbers

NOMINAL = 1e-3  # s; whether a bias is 0 depends on no step
SIGNED = ("fx", "fy", "torque", "drive", "friction")


def ways(scene: Scene, start: Start) -> tuple[Realised, ...]:
    """Feet by our driver, edges and forces that pymunk has no element for by our law.

    Dampers also by their law: pymunk applies its own after the kick, a first order. So does its
    space's damping, beside anything else that acts.

    Dry friction too: pymunk's has one bound, where the textbook's has up to four.
    """
    if strides(scene):
        return ("driver",)
    if scene.constraints or lacking(scene, start):
        return ("law",)
    law = damped(scene) or any(scene.dampers()) or bool(slowing(scene)) or ruled(scene)
    return ("native", "law") if law else ("native",)


def plan(
    scene: Scene, start: Start, realised: Realised, numbers: Numbers, *, shipped: bool = False
) -> Plan:
    """One way's plan. A bias that stays while h falls is of first order, as pymunk's own is."""
    order = (2, 3) if _second(scene, realised, numbers) else (1, 2)
    return Plan(
        realised,
        held=(1, 2) if numbers.follows else order,
        following=order if numbers.follows else None,
        numbers=numbers,
        protocol=partial(_words, scene, start, realised, numbers),
        withheld=_withheld(scene, realised),
        simplified=one_number(scene) if not (shipped or _lawful(scene, realised)) else "",
    )


def _lawful(scene: Scene, realised: Realised) -> bool:
    """Whether dry friction goes by our law: elsewhere it is pymunk's, whatever else is ours."""
    return realised != "native" and ruled(scene)


def numbers_by_name(choices: Sequence[Choice]) -> dict[str, Any]:
    """The numbers without their reasons."""
    return {choice.name: choice.value for choice in choices}


def _second(scene: Scene, realised: Realised, numbers: Numbers) -> bool:
    """Whether errors are of second order: by the midpoint protocol, with whole gaps closed."""
    known = numbers_by_name(numbers(NOMINAL))
    closes = not scene.joints or numbers.biased or known.get("constraint.error_bias") == 0.0
    touches = not scene.pressed or bool(known.get("start.seed"))
    midpoint = bool(known.get("time.midpoint"))
    return midpoint and closes and touches and not _spoilt(scene, realised)


def _spoilt(scene: Scene, realised: Realised) -> bool:
    """Where pymunk spoils the midpoint protocol's second order.

    An impact, and a part that turns back without a rest, take whole steps: measured, 1. So does a
    force that jumps where something rubs: its mean breaks loose at a step's begin. Of a step in
    which a spring begins or ends to act, what is left is anything up to its second order.
    """
    native = realised == "native"
    rubs = any(joint.dry_friction for joint in scene.joints.values())
    brakes = rubs and not _lawful(scene, realised)
    met = bool(scene.pairs) or any(contact.switches for contact in scene.contacts.values())
    sided, roped = any(scene.one_sided()), any(scene.limits())
    jumps = (rubs or met) and any(law.corners for law in scene.laws())
    whole_steps = brakes or jumps or strides(scene) or sided or roped
    pulled = any(scene.gravity) or len(scene.forces) > len(slowing(scene))
    slowed = bool(slowing(scene)) and (pulled or met)
    return whole_steps or (native and (damped(scene) or met or slowed))


def _withheld(scene: Scene, realised: Realised) -> dict[str, str]:
    """A constraint's impulse has no direction; beside others, not even a sign."""
    edges = {
        name: "engine: pymunk reports a joint's impulse as a magnitude only"
        for name, quantity in table(scene).items()
        if quantity.part in scene.constraints and quantity.field in ("force", "drive")
        if not alone(scene, quantity.part)
    }
    moved = {
        name: "engine: pymunk knows velocities and impulses, and no accelerations"
        for name, quantity in table(scene).items()
        if quantity.kind == "acceleration"
    }
    joints = {
        name: "engine: pymunk reports a joint's impulse as a magnitude only"
        for name, quantity in table(scene).items()
        if quantity.part in scene.joints and quantity.kind == "force"
        if quantity.field in SIGNED or scene.joints[quantity.part].swings
    }
    blurred = {
        f"{name}.force": f"adapter: {name} rubs by a force of ours, which no impulse counts"
        for name, joint in scene.joints.items()
        if joint.shifts and joint.dry_friction and joint.dry_friction.smooth
    }
    ours = realised == "law" and ruled(scene)
    return edges | moved | joints | (blurred if ours else {})


def _words(scene: Scene, start: Start, realised: Realised, numbers: Numbers, step: float) -> str:
    """The half step along the velocities, contacts' depth at the start, and what holds a slot."""
    known, words = numbers_by_name(numbers(step)), []
    if known.get("time.midpoint"):
        words.append(f"started {step / 2:g} s back, positions read {step / 2:g} s ahead")
    seed, touching = known.get("start.seed"), [*closed(scene, start), *closed_pairs(scene, start)]
    if seed and touching:
        bodies = ", ".join(dict.fromkeys(contact.body for contact in touching))
        planes = " and the ".join(dict.fromkeys(contact.on for contact in touching))
        words.append(f"{bodies} started {seed:g} m in the {planes}")
    slots = [joint.name for joint in scene.joints.values() if oblique(scene, joint)]
    if slots and known.get("slot.across"):
        words.append(f"{', '.join(slots)} held across by a pin joint that is carried along")
    lacked = [force.name for force, _ in lacking(scene, start)]
    if lacked:
        words.append(f"{', '.join(lacked)} by our law before each step, which the script has not")
    elif realised != "native" and (ours := [force.name for force in slowing(scene)]):
        what = "by our law before each step, in place of the space's damping"
        words.append(f"{', '.join(ours)} {what}")
    if strides(scene):
        words.append("before each step the floor is told which foot it meets")
    if cuts(scene):
        words.append("a step is cut where a foot strikes, which the script does not")
    if scene.constraints:
        words.append(
            f"{', '.join(scene.constraints)} held by pin joints that are laid anew before each step"
        )
    return "; ".join(words)
