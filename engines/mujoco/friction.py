"""Dry friction on a slide that MuJoCo's one number cannot say: as a law, or by a driver.

MuJoCo's `frictionloss` holds a joint with up to that force, and brakes it with just that force.
The law sets it before every step. The driver repeats a step until its end falls on the event, so
that every step is smooth: what sticks is held, what slides is pushed by a constant force.
"""

from dataclasses import dataclass, field

import mujoco
import numpy as np

from cases.scene import DryFriction, Joint, Scene
from cases.trajectory import Array
from engines import law


@dataclass
class Slide:
    """One slide with dry friction: 0 while it sticks, else the sign of its speed."""

    model: mujoco.MjModel
    data: mujoco.MjData
    joint: Joint
    sense: int = 0
    before: float | None = None  # the applied force [N] at the step before
    effort: Array = field(init=False)

    def __post_init__(self) -> None:
        self.dof = int(self.model.joint(self.joint.name).dofadr[0])
        self.unit = np.zeros((1, self.model.nv))
        self.unit[0, self.dof] = 1.0
        self.effort = np.zeros((1, self.model.nv))
        self.sense = int(np.sign(self.data.qvel[self.dof]))

    @property
    def friction(self) -> DryFriction:
        assert self.joint.dry_friction is not None
        return self.joint.dry_friction

    @property
    def speed(self) -> float:
        return float(self.data.qvel[self.dof])

    @property
    def holds(self) -> float:
        """More than what it has to hold at rest [N]."""
        return 2 * max(self.friction.static.forward, self.friction.static.backward)

    def brakes(self, sense: int) -> float:
        """The size of the friction force [N] that slides this way."""
        return abs(law.dry_friction(self.friction, sense, 0.0))

    def starts(self, applied: float) -> int:
        """In which sense a force starts it from rest."""
        force = law.dry_friction(self.friction, 0.0, applied)
        return 0 if force == -applied else -int(np.sign(force))

    def applied(self) -> tuple[float, float]:
        """Force along the slide [N] that would hold it at rest, and the mass [kg] it moves.

        Of the state that MuJoCo was last asked for.
        """
        mujoco.mj_solveM(self.model, self.data, self.effort, self.unit)
        mass = 1.0 / self.effort[0, self.dof]
        pushed = self.data.qfrc_applied[self.dof]  # our friction
        return float(mass * self.data.qacc_smooth[self.dof] - pushed), float(mass)


def slides(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> list[Slide]:
    """The slides of the scene with dry friction."""
    return [Slide(model, data, j) for j in scene.joints.values() if j.dry_friction is not None]


def followed(scene: Scene) -> bool:
    """Whether friction can be told from outside: one slide, and no other force that gives way."""
    dry = [joint for joint in scene.joints.values() if joint.dry_friction is not None]
    return len(dry) == 1 and not scene.contacts


def smooth_only(scene: Scene) -> bool:
    """Whether no slide ever sticks."""
    dry = [joint.dry_friction for joint in scene.joints.values() if joint.dry_friction is not None]
    return all(friction.smooth is not None for friction in dry)


def bounded(slide: Slide) -> None:
    """Set the friction of the step to come by (2.89), averaged over a step that breaks loose."""
    model, data = slide.model, slide.data
    mujoco.mj_forward(model, data)
    now, mass = slide.applied()
    soon = now if slide.before is None else 2 * now - slide.before  # at the end of the step
    slide.before = now
    if slide.sense and slide.sense * slide.speed <= 0:
        slide.sense = 0
    if not slide.sense:
        slide.sense = slide.starts(now) or slide.starts(soon)
        model.dof_frictionloss[slide.dof] = _onset(slide, now, soon) if slide.sense else slide.holds
        return
    brakes = slide.brakes(slide.sense)
    model.dof_frictionloss[slide.dof] = brakes
    gained = model.opt.timestep * ((now + soon) / 2 - slide.sense * brakes) / mass
    if slide.sense * (slide.speed + gained) <= 0:
        slide.sense = 0  # it comes to rest in this step


def _onset(slide: Slide, now: float, soon: float) -> float:
    """A constant bound [N] with the impulse of holding first and braking then."""
    now, soon = slide.sense * now, slide.sense * soon
    static = slide.friction.static
    limit = static.forward if slide.sense > 0 else static.backward
    brakes = slide.brakes(slide.sense)
    if now >= limit:
        return brakes
    slipping = (soon - limit) / (soon - now)  # the part of the step
    return (now + soon) / 2 - slipping * ((limit + soon) / 2 - brakes)


def driven_step(slides: list[Slide], step: float) -> None:
    """One step, cut at every event in it."""
    model, data = slides[0].model, slides[0].data
    left = step
    while left > _SHORTEST * step:
        for slide in slides:
            engage(slide)
        taken = _until_event(model, data, slides, left)
        left -= taken
        for slide in slides:
            if _passed(slide) > 0:
                _switch(slide)
    model.opt.timestep = step


_SHORTEST = 1e-12  # of a step: what is left is rounding


def engage(slide: Slide) -> None:
    """Hold what sticks, push what slides."""
    slide.model.dof_frictionloss[slide.dof] = 0.0 if slide.sense else slide.holds
    pushed = -slide.sense * slide.brakes(slide.sense) if slide.sense else 0.0
    slide.data.qfrc_applied[slide.dof] = pushed


def _passed(slide: Slide) -> float:
    """Positive when the event is over: the speed has changed its sign, the force its bound."""
    if slide.sense:
        return -slide.sense * slide.speed
    mujoco.mj_forward(slide.model, slide.data)
    applied, _ = slide.applied()
    static = slide.friction.static
    return max(applied - static.forward, -static.backward - applied)


def _until_event(
    model: mujoco.MjModel, data: mujoco.MjData, slides: list[Slide], longest: float
) -> float:
    """Step to the first event, or the longest way [s]; the event is just over."""
    kept = np.empty(mujoco.mj_stateSize(model, _STATE))
    mujoco.mj_getState(model, data, kept, _STATE)

    def over(length: float) -> bool:
        model.opt.timestep = length
        mujoco.mj_step(model, data)
        return max(_passed(slide) for slide in slides) > 0

    if not over(longest):
        return longest
    low, high = 0.0, longest
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        mujoco.mj_setState(model, data, kept, _STATE)
        low, high = (low, middle) if over(middle) else (middle, high)
    mujoco.mj_setState(model, data, kept, _STATE)
    over(high)
    return high


_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_HALVINGS = 45  # 3e-14 of a step


def _switch(slide: Slide) -> None:
    """What has stopped rests, or goes on the way that the force points; what broke loose slides."""
    if slide.sense:
        slide.data.qvel[slide.dof] = 0.0
        slide.data.qfrc_applied[slide.dof] = 0.0
        mujoco.mj_forward(slide.model, slide.data)
    applied, _ = slide.applied()
    slide.sense = slide.starts(applied)
