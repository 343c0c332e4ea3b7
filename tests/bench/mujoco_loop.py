"""The plainest loop that a user of MuJoCo would write: the yardstick of `make bench`.

Natively it is `mj_step(model, data, n)` on the file that `show` prints, which is cheaper than a
loop in Python; signals in time are a callback. Of a law or a driver it is the force of the present
instant, set before each step of a loop in Python, which is of first order.
"""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Callable
from functools import partial

import mujoco
import numpy as np

from textmech.cases.scene import GROUND, Push, Scene, Signal
from textmech.cases.scene.forces.force import of
from textmech.cases.scene.frame import PLANE
from textmech.cases.trajectory import Array
from textmech.engines.engine import Plan, Start
from textmech.engines.law import dry_friction, smooth_friction
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.callbacks.friction import one_slide
from textmech.engines.mujoco.callbacks.signal import Control, installed, listening
from textmech.engines.mujoco.model.drive import controls
from textmech.engines.mujoco.model.force import BY_ITSELF
from textmech.engines.mujoco.model.rods import with_rods
from textmech.engines.mujoco.read.poses import poses
from textmech.engines.signal import factor, value

from .plain import Begin, Plain

Take = Callable[[int], None]


def plain(engine: MuJoCo, scene: Scene, start: Start, step: float, plan: Plan) -> Begin | None:
    """`mj_step(model, data, n)` on the file of `show`, or our law's force before each step.

    Another step is a number in the model. None: nobody has written the loop.
    """
    if scene.frame is not PLANE:
        return None
    _, text = engine._script(scene, start, step, plan)  # without what is only seen
    scene, start = with_rods(scene, start)
    native = plan.realised == "native"
    if not (native or (one_slide(scene) and _alone(scene))):
        return None
    model = data = None

    def begin(h: float) -> Plain:
        nonlocal model, data
        if model is None or data is None:
            with listening():
                model = mujoco.MjModel.from_xml_string(text)
                data = mujoco.MjData(model)
        model.opt.timestep = h
        mujoco.mj_resetDataKeyframe(model, data, 0)
        begun = data.qpos.copy()
        take = _bare(scene, model, data) if native else _told(scene, model, data)
        return Plain(take, lambda: _states(scene, model, data, begun, start))

    return begin


def _states(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, begun: Array, start: Start
) -> Start:
    """begun: the first positions, from whose angles turns are counted."""
    rows = np.array([begun, data.qpos]), np.array([data.qvel, data.qvel])
    found = poses(scene, model, *rows, start)
    return {name: tuple(row[1].tolist()) for name, row in found.items()}  # type: ignore[misc]


def _bare(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Take:
    control = _in_time(controls(scene))

    def take(n: int) -> None:
        with listening(), installed(control):
            mujoco.mj_step(model, data, n)

    return take


def _in_time(laws: list[Signal]) -> Control | None:
    told = [(i, factor(law)) for i, law in enumerate(laws) if law.law not in BY_ITSELF]

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        for i, size in told:
            data.ctrl[i] = size(data.time)

    return control if told else None


def _told(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Take:
    """(2.89) before each step; (2.95) at each of its stages, as before each step it is unstable."""
    (joint,) = (joint for joint in scene.joints.values() if joint.dry_friction)
    friction, dof = joint.dry_friction, int(model.joint(joint.name).dofadr[0])
    assert friction
    model.dof_frictionloss[dof] = 0.0
    mujoco.mj_forward(model, data)
    law = partial(smooth_friction, friction, smooth=friction.smooth) if friction.smooth else None
    laws, sense = _in_time(controls(scene)), np.sign(data.qvel[dof])
    pushes = [f for f in of(Push, scene.forces.values()) if f.at.body == joint.b.body]

    def pushed() -> float:
        """Force along the slide but friction [N]; at a stage MuJoCo does not know pushes yet."""
        force = data.qfrc_passive[dof] - data.qfrc_bias[dof]
        for push in pushes:
            fx, fy = value(push.signal, data.time)
            force += joint.along[0] * fx + joint.along[1] * fy
        return force

    def blurred(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        if laws:
            laws(model, data)
        assert law
        data.qfrc_applied[dof] = law(data.qvel[dof], pushed())

    def by_callback(n: int) -> None:
        with listening(), installed(blurred):
            mujoco.mj_step(model, data, n)

    def by_loop(n: int) -> None:
        nonlocal sense
        with listening(), installed(laws):
            for _ in range(n):
                if sense * data.qvel[dof] <= 0:
                    sense, data.qvel[dof] = 0, 0.0
                acting = pushed()
                force = dry_friction(friction, data.qvel[dof], acting)
                if not sense and force != -acting:
                    sense = 1 if acting > 0 else -1
                data.qfrc_applied[dof] = force
                mujoco.mj_step(model, data)

    return by_callback if law else by_loop


def _alone(scene: Scene) -> bool:
    """Whether all dry friction is of one slide, which guides a part that nothing else joins."""
    (joint,) = (joint for joint in scene.joints.values() if joint.dry_friction)
    others = (other for other in scene.joints.values() if other is not joint)
    return (
        joint.shifts
        and joint.a.body == GROUND
        and not any(joint.b.body in (other.a.body, other.b.body) for other in others)
    )
