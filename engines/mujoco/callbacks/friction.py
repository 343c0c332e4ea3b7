"""Dry friction of a joint that MuJoCo's one number cannot say: which way it slides, and when.

MuJoCo's `frictionloss` holds a joint with up to that force, and brakes it with just that force.
`friction_law.bounded` sets the force before every step.
"""

from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np

from ....cases.scene import DryFriction, Joint, Scene
from ....cases.trajectory import Array
from ...law import braking, dry_friction
from ..model.tree import dry_joints


@dataclass
class Slide:
    """One slide or pin with dry friction: 0 while it sticks, else the sign of its speed.

    What is a force [N], a speed [m/s] and a mass [kg] of a slide is a moment [N m], a rate [rad/s]
    and an inertia [kg m²] of a pin.

    MuJoCo's arrays are fetched once, and what its coefficients give is worked out once: it is asked
    before every step.
    """

    model: mujoco.MjModel
    data: mujoco.MjData
    joint: Joint
    sense: int = 0
    before: float | None = None  # the applied force [N] at the step before
    last: float = 0.0  # m/s, at the step before
    steady: bool = True  # its friction is always the same
    weakens: float = 0.0  # N: how much they fall in a step
    friction: DryFriction = field(init=False)
    effort: Array = field(init=False)

    def __post_init__(self) -> None:
        assert self.joint.dry_friction is not None
        self.friction = self.joint.dry_friction
        self.dof = int(self.model.joint(self.joint.name).dofadr[0])
        self._qvel, self._uncoupled = self.data.qvel, uncoupled(self.model, self.dof)
        self._loss, self._pushed = self.model.dof_frictionloss, self.data.qfrc_applied
        self._free, self._mass = self.data.qacc_smooth, 0.0
        static = self.friction.static
        self._holds = 2 * max(static.forward, static.backward)  # N, more than it has to at rest
        self.steady = self.friction.stribeck is None
        self._brakes = {s: braking(self.friction, s, 0.0) for s in (1, -1)}
        self.unit = np.zeros((1, self.model.nv))
        self.unit[0, self.dof] = 1.0
        self.effort = np.zeros((1, self.model.nv))
        self.last = self.speed
        self.sense = int(np.sign(self.last))

    @property
    def speed(self) -> float:
        return self._qvel.item(self.dof)

    def push(self, force: float) -> None:
        """Friction is this force [N], and nothing holds."""
        self._loss[self.dof] = 0.0
        self._pushed[self.dof] = force

    def hold(self) -> None:
        """Friction holds, whatever it takes."""
        self._loss[self.dof] = self._holds
        self._pushed[self.dof] = 0.0

    def remember(self) -> int:
        """The sense of the sliding, by which a reading restores this state."""
        return self.sense

    def recall(self, noted: int) -> None:
        """Friction as it was."""
        self.sense = noted
        engage(self)

    def brakes(self, sense: int, speed: float) -> float:
        """The size of the friction force [N] that slides this way, so fast."""
        return self._brakes[sense] if self.steady else braking(self.friction, sense, speed)

    def applied(self) -> tuple[float, float]:
        """Force along the slide [N] that would hold it at rest, and the mass [kg] it moves.

        Of the state that MuJoCo was last asked for.
        """
        gains = self._free.item(self.dof)
        if self.data.ne:
            gains, self._mass = closed(self.model, self.data, self.dof, self._free)
        elif not self._mass or not self._uncoupled:
            mujoco.mj_solveM(self.model, self.data, self.effort, self.unit)
            self._mass = 1.0 / self.effort.item(0, self.dof)
        pushed = self._pushed.item(self.dof)  # our friction
        return self._mass * gains - pushed, self._mass


def engage(slide: Any) -> None:
    """Hold what sticks, push what slides: a joint or a contact."""
    if slide.sense:
        slide.push(-slide.sense * slide.brakes(slide.sense, slide.speed))
    else:
        slide.hold()


def starts(friction: DryFriction, applied: float) -> int:
    """In which sense a force starts what rests, or 0."""
    force = dry_friction(friction, 0.0, applied)
    return 0 if force == -applied else 1 if applied > 0 else -1


def uncoupled(model: mujoco.MjModel, dof: int) -> bool:
    """Whether the slide is a tree of its own: then its mass is always the same."""
    return int(np.count_nonzero(model.dof_treeid == model.dof_treeid[dof])) == 1


def slides(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> list[Slide]:
    """The joints of the scene with dry friction."""
    return [Slide(model, data, joint) for joint in dry_joints(scene)]


def one_slide(scene: Scene) -> bool:
    """Whether friction can be told from outside: one joint, and no other force that gives way."""
    return len(dry_joints(scene)) == 1 and not scene.pressed and not any(scene.limits())


def smooth_only(scene: Scene) -> bool:
    """Whether no slide ever sticks."""
    return all(dry.smooth is not None for joint in dry_joints(scene) if (dry := joint.dry_friction))


# One freedom in a loop: constraints pass on to it what acts elsewhere, and more moves with it.


_LEAST = 1e-15  # 1/kg: in a dead centre nothing moves the freedom


def closed(
    model: mujoco.MjModel, data: mujoco.MjData, dof: int, free: Array
) -> tuple[float, float]:
    """Acceleration of a freedom [m/s²] while all loops stay closed, and the mass [kg] it moves.

    M a = M a₀ + Jᵀ f with J a + R f = a_ref of MuJoCo's equalities, and nothing else that gives
    way. free: a₀ (nv,). Of the state that MuJoCo was last asked for.
    """
    rows = data.efc_J.reshape(-1, model.nv)[: data.ne]
    unit = np.zeros((1, model.nv))
    unit[0, dof] = 1.0
    effort, passed = np.empty_like(unit), np.empty_like(rows)
    mujoco.mj_solveM(model, data, effort, unit)
    mujoco.mj_solveM(model, data, passed, np.ascontiguousarray(rows))
    lever, given = passed[:, dof], data.efc_aref[: data.ne] - rows @ free
    both = np.column_stack([given, lever])
    forces = np.linalg.solve(rows @ passed.T + np.diag(data.efc_R[: data.ne]), both)
    pulled, held = (lever @ forces).tolist()
    return float(free[dof]) + pulled, 1.0 / max(effort.item(0, dof) - held, _LEAST)
