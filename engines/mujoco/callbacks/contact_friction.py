"""Dry friction of a contact with two coefficients, as a law: MuJoCo's pair knows one.

What slides is pushed where it touches, with next to no friction of MuJoCo's; what sticks is held
by more friction than it needs.
"""

from dataclasses import dataclass

import mujoco

from ....cases.scene import Bounds, Contact, DryFriction, Scene
from ....cases.trajectory import Array
from ...engine import Diverged
from ...law import braking
from ..model.contact import alone
from ..model.tree import dry_joints
from .friction import engage

_LEAST = 1e-5  # of a coefficient of friction: MuJoCo takes no less


@dataclass
class Touch:
    """One disk's or particle's contact: 0 while it sticks, else the sign of its slip.

    Read from the state that MuJoCo was last asked for, with the sensors `along` and `up`.
    """

    model: mujoco.MjModel
    data: mujoco.MjData
    contact: Contact
    radius: float
    mass: float  # kg that resists the slip: 1/(1/m + R²/J)
    sense: int = 0
    before: float | None = None
    last: float = 0.0
    steady: bool = False  # its bounds change with the normal force, so it is asked at every step
    touches: bool = True  # as a scene starts that has these laws

    def __post_init__(self) -> None:
        body = self.contact.body
        self.pair = int(self.model.pair(self.contact.name).id)
        self.x = int(self.model.joint(f"{body}.x").dofadr[0])
        self.turn = int(self.model.joint(f"{body}.angle").dofadr[0]) if self.radius else None
        self.last = self.speed
        self.sense = 0 if abs(self.last) < _STILL else 1 if self.last > 0 else -1
        self.normal = self.normal_before = self.pushed = 0.0
        self.recall((self.sense, 0.0))

    @property
    def friction(self) -> DryFriction:
        static = self.contact.static * self.normal
        middle = self.normal + (self.normal - self.normal_before) / 2  # of the step that it brakes
        kinetic = self.contact.kinetic * max(0.0, middle)  # nothing where it lifts off
        return DryFriction(Bounds(static, static), Bounds(kinetic, kinetic))

    @property
    def speed(self) -> float:
        """The slip [m/s]."""
        return self._lowest(self.data.qvel)

    def _lowest(self, rates: Array) -> float:
        turning = 0.0 if self.turn is None else self.radius * float(rates[self.turn])
        return float(rates[self.x]) + turning

    def push(self, force: float) -> None:
        """Friction is this force [N], of which MuJoCo's least coefficient gives a little."""
        self._set(_LEAST, force + self.sense * _LEAST * self.normal)

    def hold(self) -> None:
        """Friction holds, whatever it takes."""
        self._set(2 * self.contact.static, 0.0)

    def look(self) -> None:
        """Whether it touches, in the state that MuJoCo was last asked for.

        Raises Diverged where it comes down again: the normal force of a blow is anything.
        """
        before, self.touches = self.touches, self.data.ncon > 0
        if self.touches and not before:
            raise Diverged(
                f"{self.contact.name} comes down again at {self.data.time:.3g} s, and no law of "
                "dry friction follows a blow"
            )

    def remember(self) -> tuple[int, float]:
        """Sense of the slip and normal force [N], by which a reading restores this state."""
        return self.sense, self.normal

    def recall(self, noted: tuple[int, float]) -> None:
        """Friction as it was."""
        self.sense, self.normal = noted
        self.normal_before = self.normal
        engage(self)

    def _set(self, coefficient: float, force: float) -> None:
        self.model.pair_friction[self.pair, :2] = coefficient
        self.pushed = force
        self.data.qfrc_applied[self.x] = force
        if self.turn is not None:
            self.data.qfrc_applied[self.turn] = self.radius * force

    def brakes(self, sense: int, speed: float) -> float:
        """The size of the friction force [N] that slides this way, at any speed."""
        return braking(self.friction, sense, speed)

    @property
    def weakens(self) -> float:
        """How much [N] the bound of static friction falls in a step."""
        return self.contact.static * (self.normal_before - self.normal)

    def applied(self) -> tuple[float, float]:
        """Force along the floor [N] that would hold it at rest, and the mass [kg] it moves."""
        along, normal = self.data.sensordata[0], float(self.data.sensordata[1])
        self.normal_before = normal if self.before is None else self.normal
        self.normal = normal
        slip = self._lowest(self.data.qacc)
        return self.mass * slip - float(along) - self.pushed, self.mass


def touches(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> list[Touch]:
    """The contacts of the scene with two coefficients."""
    touching = []
    for contact in scene.contacts.values():
        if contact.switches and contact.static != contact.kinetic:
            body = scene.bodies[contact.body]
            radius = body.radius or 0.0
            turns = radius**2 / body.moment if body.turns else 0.0
            mass = 1 / (1 / body.mass + turns)
            touching.append(Touch(model, data, contact, radius, mass))
    return touching


def one_touch(scene: Scene) -> bool:
    """Whether the law is known: one contact, whose normal force does not feel its friction.

    And no impact, in which the normal force is anything.
    """
    contacts = list(scene.contacts.values())
    return (
        len(contacts) == 1
        and not scene.pairs
        and not any(scene.limits())
        and contacts[0].switches
        and contacts[0].plane.level  # else friction is no force along one of its coordinates
        and contacts[0].static != contacts[0].kinetic
        and not contacts[0].restitution
        and alone(scene, contacts[0])
        and not dry_joints(scene)
    )


_STILL = 1e-9  # m/s
