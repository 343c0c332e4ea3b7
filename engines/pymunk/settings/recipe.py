"""The tuned recipe: each number with its reason, as attributes of pymunk's Space and constraints.

`start.seed`, `start.iterations`, `slot.across` and `time.midpoint` are what is done around the
engine, see run.py and slot.py.
"""

from typing import Any

import numpy as np

from ....cases.scene import GROUND, Contact, Scene
from ...engine import Choice, Start
from ..model.contact import closed, is_tip
from ..model.slot import oblique
from .options import BY_THE_SCENE, OPTIONS, Numbers
from .solver_iterations import holding

_MIDPOINT = Choice(
    "time.midpoint",
    True,
    "pymunk drifts, then kicks: started h/2 back and read h/2 ahead this is position Verlet, "
    "of second order",
)
_SEED = Choice(
    "start.seed",
    1e-9,
    "a circle that only touches falls freely for one step; 1e-9 m is above rounding and "
    "below every reach",
)
_TIP_SEED = Choice(
    "start.seed",
    1e-6,
    "the curved path of a bar's end lifts it by some h³ in each step: less would be used up, 1e-8 "
    "m by a smooth ladder of 3 m in 200 steps of 0.5 ms, and the contact would open for a step",
)
_LYING_SEED = Choice(
    "start.seed",
    1e-8,
    "what lies on two of its points does not turn, and their frictions hold against each other by "
    "what is left of the seed: of 1e-6 m 7e-5 N",
)
_PAIR_SEED = Choice(
    "start.seed",
    1e-6,
    "bodies that turn on each other from the start on part by some h² in the first half step, and "
    "one rim's path around another lifts it: 1e-8 m were used up, and the contact would open",
)
_PIVOT_SEED = Choice(
    "start.seed",
    1e-6,
    "a tip about which a body turns from the start on rises by v² h²/(8 l) in half a step: less "
    "would open the contact, and leave no force for a step and the double for the next",
)
_REFLECTS = Choice(
    "contact.reflects",
    True,
    "a bar's end that stays on the floor has elasticity 1: else its curved path opens the contact "
    "every few steps, and its force is 0 in some and the double in others",
)
_ACROSS = Choice(
    "slot.across",
    True,
    "a groove that lies oblique to what the solver inverts lets its point cross it while it "
    "slides; a pin joint across the groove, carried along it, does not",
)
_LANDING = Choice(
    "space.collision_bias",
    0.0,
    "a body lands up to v h deep, and this bias lifts it in one step; the default closes 6.3 h of "
    "the depth in each, and a spring on top is wrong all the while",
)
_REST = "so deep a body rests after an impact; above the seed, or the contact opens every few steps"
_SLOP = Choice("space.collision_slop", 1e-6, _REST)
_TIP_SLOP = Choice(
    "space.collision_slop",
    1e-5,
    "so deep a body rests after an impact; above what the curved path of a bar's end rises and "
    "falls in a step, or the contact opens",
)


def recipe(scene: Scene, start: Start) -> Numbers:
    """The best recipe; what nothing would feel is left as it is shipped."""
    always = [_MIDPOINT]
    contacts = [contact for contact in scene.contacts.values() if contact.switches]
    tips = [*(c for c in contacts if is_tip(scene, c)), *scene.pairs.values()]
    if scene.pressed:
        pivots = any(contact.ideal == "pivot" for contact in scene.contacts.values())
        tip = _LYING_SEED if _lies(scene, start) else _TIP_SEED
        tip = _PAIR_SEED if scene.pairs else tip
        always.append(_PIVOT_SEED if pivots else tip if tips else _SEED)
    if contacts or scene.pairs:
        always.append(_TIP_SLOP if tips else _SLOP)
        always += [_REFLECTS] if tips else []
        stays = [*contacts, *scene.pairs.values()]
        always += [_LANDING] if all(_rises(scene, contact) for contact in stays) else []
    if any(oblique(scene, joint) for joint in scene.joints.values()):
        always.append(_ACROSS)
    held = holding(scene, start)
    by_scene = ["constraint.error_bias", "space.iterations", "start.iterations"] if held else []
    by_scene += ["limit.error_bias"] if any(scene.limits()) else []  # the last: they are joints
    return Numbers(tuple(always), tuple(by_scene), held)


def as_options(scene: Scene, start: Start) -> dict[str, Any]:
    """The tuned recipe as own options; what it finds in the scene is left to the scene."""
    best = recipe(scene, start)
    numbers = {choice.name: choice.value for choice in best.always}
    decided = ("limit.error_bias", "space.iterations", "start.iterations")
    numbers |= {name: BY_THE_SCENE for name in decided if name in best.by_scene}
    numbers["constraint.error_bias"] = BY_THE_SCENE if best.biased else 0.0
    option = {known.name: option for option, known in OPTIONS.items() if known.matters(scene)}
    return {option[name]: value for name, value in numbers.items() if name in option}


def _lies(scene: Scene, start: Start) -> bool:
    """Whether a body starts on a plane with two of its points."""
    on = [(c.body, c.plane.name) for c in closed(scene, start) if is_tip(scene, c)]
    return len(set(on)) < len(on)


def _rises(scene: Scene, contact: Contact) -> bool:
    """Whether it lands and stays, and no joint holds down what is lifted out of its plane.

    Between a plane and a pin each would undo what the other corrects: measured, 0.02 rad.
    """
    if contact.restitution:
        return False
    return all(
        joint.shifts and joint.a.body == GROUND and not np.dot(joint.along, contact.plane.along)
        for joint in scene.joints.values()
        if contact.body in (joint.a.body, joint.b.body)
    )
