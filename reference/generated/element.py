"""What contacts and slides with dry friction can do: open, slide either way, stick.

A mode of a scene names the state of each of them: `touch slides +, rail sticks`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from ...cases.scene import Contact, DryFriction, Joint, Scene
from ..laws.friction import Dry, stiction
from .constraint import Constraint
from .contact import Drag, Rub, at_rest, normal, tangent
from .coordinates import Coordinates

State = Literal["open", "slides +", "slides -", "sticks"]
REST: tuple[State, ...] = (
    "sticks",
    "slides +",
    "slides -",
)  # at slip 0, stiction first as in (2.89)


def sign(state: State) -> int:
    """Of the slip: 0 unless it slides."""
    return {"slides +": 1, "slides -": -1}.get(state, 0)


def sliding(direction: float) -> State:
    """The state that slides this way."""
    return "slides +" if direction > 0 else "slides -"


@dataclass(frozen=True)
class Touching:
    """A contact that switches."""

    name: str
    contact: Contact
    normal: Constraint
    tangent: Constraint

    def held(self, state: State) -> list[Constraint]:
        """The constraints of the state."""
        return {"open": [], "sticks": [self.normal, self.tangent]}.get(state, [self.normal])

    def rubs(self, state: State) -> list[Rub]:
        """(2.87) F = −μ F_N sign(v)."""
        s = sign(state)
        return [Rub(self.normal, self.tangent, -self.contact.kinetic * s)] if s else []

    def drags(self, state: State) -> list[Drag]:
        return []

    def margins(self, forces: dict[str, float]) -> tuple[float, float]:
        """(2.89) μ_s F_N ± F_fr [N]: negative where it breaks loose to + and to −."""
        bound = self.contact.static * forces[f"{self.name}.normal"]
        tangent = forces[f"{self.name}.tangent"]
        return bound + tangent, bound - tangent


@dataclass(frozen=True)
class Sliding:
    """A slide with exact dry friction."""

    name: str
    friction: DryFriction
    tangent: Constraint  # that holds it at rest along its line

    @property
    def dry(self) -> Dry:
        kinetic, static = self.friction.kinetic, self.friction.static
        return Dry(kinetic.backward, kinetic.forward, static.backward, static.forward)

    def held(self, state: State) -> list[Constraint]:
        """The constraint of the state."""
        return [self.tangent] if state == "sticks" else []

    def rubs(self, state: State) -> list[Rub]:
        return []

    def drags(self, state: State) -> list[Drag]:
        """(2.89) −F₊ forward, F₋ backward."""
        s = sign(state)
        force = stiction(self.dry, float(s), 0.0) if s else 0.0
        return [Drag(self.tangent, lambda t, q, v: force)] if s else []

    def margins(self, forces: dict[str, float]) -> tuple[float, float]:
        """(2.89) F_s₊ − F_a and F_s₋ + F_a [N], F_a = −F_fr: negative where it breaks loose."""
        F_a = -forces[f"{self.name}.friction"]
        return self.friction.static.forward - F_a, self.friction.static.backward + F_a


Element = Touching | Sliding


def elements(scene: Scene, where: Coordinates) -> Iterator[Element]:
    """All that switches, in the order of the scene."""
    for contact in scene.contacts.values():
        if contact.switches:
            yield Touching(contact.name, contact, normal(contact, where), tangent(contact, where))
    for joint in scene.joints.values():
        if exact(joint):
            assert joint.dry_friction is not None
            yield Sliding(joint.name, joint.dry_friction, at_rest(joint, where))


def exact(joint: Joint) -> bool:
    """Whether its dry friction switches, instead of being smooth."""
    return joint.dry_friction is not None and joint.dry_friction.smooth is None


def switches(scene: Scene) -> bool:
    """Whether its motion needs `follow`: more than one mode, or a smooth law that is stiff."""
    contacts = any(contact.switches for contact in scene.contacts.values())
    return contacts or any(joint.dry_friction is not None for joint in scene.joints.values())


def stiff(scene: Scene) -> bool:
    """Whether a slide has the smooth law of friction."""
    return any(joint.dry_friction and not exact(joint) for joint in scene.joints.values())
