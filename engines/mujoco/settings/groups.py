"""The groups of soft constraints: how each is called, where its numbers stand, how it is tuned.

A group's choices are called by its word: `connect.solref`, `slide.solreffriction`. A user's options
have them under the name of an element: `joint` for dry friction and for stops, whose attributes end
in `friction` and in `limit`, `tendon` for ropes, which end in `limit`; only `rod`, a tendon that an
equality holds, is no element of MuJoCo's.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import mujoco

from ....cases.scene import Scene
from ...engine import Choice, Start
from ...foot_contact import strides
from ...options import Check, number, numbers
from ..model.contact import HARDEST, SOFTEST, recipe
from ..model.force import limited
from ..model.hinge import hinge
from ..model.limit import recipe as ropes
from ..model.limit import recipe_of_stops as stops
from ..model.loops import recipe as rods
from ..model.planes import met
from ..model.tree import dry_joints, spanning_tree

SOFT = {"solref": numbers(2, follow=True), "solimp": numbers(3, 5)}
"""The attributes that every group has, with what each may be."""

Places = Callable[[Scene, mujoco.MjModel], Any]
"""Where in the arrays of the compiled model the group's numbers stand."""


@dataclass(frozen=True)
class Group:
    """One group of soft constraints.

    of: whether the scene has any. recipe: the tuned numbers, in terms of h. option: the element
    under which a user's options have them; default: the one of <default> in a model as users write
    it, see `snippet`. ending: of its attributes' names. more: attributes that no other group has.
    fields: by attribute, the array of the compiled model that holds what may follow the step.
    places: where in it. single: the names of those that may have numbers of their own, and where
    these stand. springs, hardness: what else is worth trying, see `knobs`.
    """

    word: str
    whose: str  # in words
    of: Callable[[Scene], bool]
    recipe: Callable[[Scene, Start | None], list[Choice]]
    option: str
    default: str
    fields: Mapping[str, str]
    ending: str = ""
    more: Mapping[str, Check] = field(default_factory=dict)
    places: Places = lambda scene, model: slice(None)
    single: Callable[[Scene], Mapping[str, Places]] | None = None
    springs: Sequence[list[Any]] = ()
    hardness: Sequence[float] = ()

    def attribute(self, name: str) -> str:
        """`solref` as MJCF spells it for the group."""
        return f"{name}{self.ending}"

    def key(self, name: str) -> str:
        """How a choice of it is called: `slide.solreffriction`."""
        return f"{self.word}.{self.attribute(name)}"

    @property
    def attributes(self) -> dict[str, Check]:
        """Returns what each of its attributes may be."""
        return {self.attribute(name): check for name, check in SOFT.items()} | {**self.more}


def groups(scene: Scene) -> list[Group]:
    """The groups of which the scene has any, in the order of the table."""
    return [group for group in GROUPS.values() if group.of(scene)]


def single(scene: Scene) -> dict[str, Group]:
    """By name, the group of each contact or joint's stops that may have numbers of its own."""
    each = ((group, group.single) for group in GROUPS.values() if group.single)
    return {name: group for group, names in each for name in names(scene)}


def _held(group: str, steps: int, because: str, ending: str = "") -> list[Choice]:
    """The hardest constraint with a time constant of so many steps."""
    hard = [HARDEST, HARDEST, 0.001]
    return [
        Choice(f"{group}.solref{ending}", [f"{steps}h", 1.0], because),
        Choice(f"{group}.solimp{ending}", hard, "the hardest MuJoCo takes: d = 0.9999"),
    ]


def _pins(scene: Scene, start: Start | None) -> list[Choice]:
    because = (
        "8 h: forces 10 times nearer than with 4 h (in space 100 times than with 2 h), as stages "
        "jerk at the pin; places ∝ h²"
    )
    return _held("connect", 8, because)


def _slides(scene: Scene, start: Start | None) -> list[Choice]:
    still = Choice("option.noslip_iterations", 5, "what sticks does not creep")
    return [*_held("slide", 2, "the stiffest that stays stable: 2 h", "friction"), still]


def _closed(scene: Scene, *, by_rods: bool) -> bool:
    return any(joint.swings is by_rods for joint in spanning_tree(scene).loops)


def _equalities(kind: int) -> Places:
    return lambda scene, model: model.eq_type == kind


def _dofs(scene: Scene, model: mujoco.MjModel) -> list[int]:
    return [model.joint(joint.name).dofadr[0] for joint in dry_joints(scene)]


def _contacts(scene: Scene) -> dict[str, Places]:
    names = [contact.name for contact in met(scene)]
    return {name: lambda scene, model, name=name: model.pair(name).id for name in names}


def _stops(scene: Scene) -> dict[str, Places]:
    return {
        stops.name: lambda scene, model, stops=stops: model.joint(hinge(scene, stops).name).id
        for stops in limited(scene, "stop")
    }


GROUPS: Mapping[str, Group] = {
    group.word: group
    for group in (
        Group(
            "connect",
            "loops",
            of=lambda scene: strides(scene) or _closed(scene, by_rods=False),
            recipe=_pins,
            option="connect",
            default="equality",
            fields={"solref": "eq_solref"},
            places=_equalities(mujoco.mjtEq.mjEQ_CONNECT),
        ),
        Group(
            "rod",
            "rods in loops",
            of=lambda scene: _closed(scene, by_rods=True),
            recipe=lambda scene, start: rods(),
            option="rod",
            default="equality",
            fields={"solref": "eq_solref"},
            places=_equalities(mujoco.mjtEq.mjEQ_TENDON),
        ),
        Group(
            "slide",
            "dry joints",
            of=lambda scene: bool(dry_joints(scene)),
            recipe=_slides,
            option="joint",
            default="joint",
            fields={"solreffriction": "dof_solref"},
            ending="friction",
            places=_dofs,
        ),
        Group(
            "rope",
            "ropes",
            of=lambda scene: bool(limited(scene, "rope")),
            recipe=lambda scene, start: ropes(),
            option="tendon",
            default="tendon",
            fields={"solreflimit": "tendon_solref_lim"},
            ending="limit",
        ),
        Group(
            "stop",
            "stops",
            of=lambda scene: bool(limited(scene, "stop")),
            recipe=lambda scene, start: stops(limited(scene, "stop")),
            option="joint",
            default="joint",
            fields={"solreflimit": "jnt_solref"},
            ending="limit",
            single=_stops,
        ),
        Group(
            "pair",
            "contacts",
            of=lambda scene: bool(met(scene)),
            recipe=recipe,
            option="pair",
            default="geom",
            fields={"solref": "pair_solref", "solreffriction": "pair_solreffriction"},
            more={"solreffriction": SOFT["solref"], "margin": number()},
            single=_contacts,
            springs=(["-0.25/h2", "-1/h"], ["-0.04/h2", 0.0]),
            hardness=(SOFTEST,),
        ),
    )
}
"""By their words, in the order in which a recipe gives their numbers."""
