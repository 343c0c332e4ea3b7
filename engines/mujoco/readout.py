"""What MuJoCo knows of a state, read from a second `MjData` so that the running one is untouched."""

from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

from cases.scene import GROUND, Anchor, Contact, Joint, Push, Scene
from cases.trajectory import Array
from engines.mujoco.tree import Branch, Tree, node, spanning_tree

Forward = Callable[[mujoco.MjModel, mujoco.MjData], None]


@dataclass(frozen=True)
class Readout:
    """Names of the scene ↔ numbers of the model."""

    scene: Scene
    tree: Tree
    model: mujoco.MjModel
    probe: mujoco.MjData

    @classmethod
    def of(cls, scene: Scene, model: mujoco.MjModel) -> "Readout":
        return cls(scene, spanning_tree(scene), model, mujoco.MjData(model))

    def at(self, time: float, qpos: Array, qvel: Array, act: Array, ctrl: Array) -> None:
        """Bring the probe to a state: positions, velocities, accelerations and forces."""
        self.probe.time = time
        self.probe.qpos, self.probe.qvel = qpos, qvel
        self.probe.act, self.probe.ctrl = act, ctrl
        mujoco.mj_forward(self.model, self.probe)
        mujoco.mj_rnePostConstraint(self.model, self.probe)

    def angle(self, body: str) -> float:
        """The angle, unwound: the sum of the hinges below the body, and what slides hold."""
        branches = {branch.body: branch for branch in self.tree.branches}
        total, name = 0.0, body
        while name in branches:
            total += self._turn(branches[name])
            name = branches[name].parent
        return total

    def _turn(self, branch: Branch) -> float:
        joint, turns = branch.joint, self.scene.bodies[branch.body].turns
        if not turns:
            return 0.0
        if joint is None:
            return float(self.probe.joint(f"{branch.body}.angle").qpos[0])
        if joint.kind == "pin":
            return float(self.probe.joint(joint.name).qpos[0])
        return joint.angle if branch.forward else -joint.angle

    def state(self, body: str) -> tuple[float, float, float, float, float, float]:
        """x, y, angle, vx, vy, omega of the centre of mass."""
        number = self.model.body(body).id
        velocity = np.zeros(6)  # angular, then linear, in world axes
        mujoco.mj_objectVelocity(
            self.model, self.probe, mujoco.mjtObj.mjOBJ_BODY, number, velocity, 0
        )
        x, y, _ = self.probe.xipos[number]
        turns = self.scene.bodies[body].turns
        angle, omega = (self.angle(body), velocity[2]) if turns else (0.0, 0.0)
        return (x, y, angle, velocity[3], velocity[4], omega)

    def reaction(self, quantity: str) -> float:
        """`joint.fx|fy` of the first part on the second, or `contact.normal|tangent`."""
        part, _, field = quantity.partition(".")
        if part in self.scene.contacts:
            tangent, normal = self._contact(self.scene.contacts[part])
            return normal if field == "normal" else tangent
        fx, fy = self._joint(self.scene.joints[part])
        return {"fx": fx, "fy": fy, "force": float(np.hypot(fx, fy))}[field]

    def _joint(self, joint: Joint) -> Array:
        if joint in self.tree.loops:
            rows = np.flatnonzero(
                (self.probe.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY)
                & (self.probe.efc_id == self.model.equality(joint.name).id)
            )
            return -self.probe.efc_force[rows[:2]]  # MuJoCo counts the force on the first part
        branch = next(b for b in self.tree.branches if b.joint is joint)
        # cfrc_int is what holds the subtree together with its parent: the joint's force, and
        # what tendons and actuators do to the subtree from outside, since they act on joints.
        held = self.probe.cfrc_int[self.model.body(branch.body).id][3:5].copy()
        held -= self._other_forces(self.tree.subtree(branch.body))
        return held if branch.forward else -held

    def _other_forces(self, bodies: set[str]) -> Array:
        total = np.zeros(2)
        for force in (*self.scene.springs(), *self.scene.dampers()):
            number = self.model.tendon(force.name).id
            inside = [node(self.scene, end) in bodies for end in (force.a, force.b)]
            if inside[0] == inside[1]:
                continue
            stretch = self.probe.ten_length[number] - self.model.tendon_lengthspring[number, 0]
            tension = self.model.tendon_stiffness[number] * stretch
            tension += self.model.tendon_damping[number] * self.probe.ten_velocity[number]
            line = self._site(force.b) - self._site(force.a)
            pull = tension * line / np.hypot(*line)
            total += pull if inside[0] else -pull
        for force in self.scene.signals():
            if isinstance(force, Push) and force.at.body in bodies:
                number = self.model.actuator(force.name).id
                gear = self.model.actuator_gear[number, :2]
                total += gear * self.probe.actuator_force[number]
        return total

    def _site(self, anchor: Anchor) -> Array:
        return self.probe.site_xpos[self.model.site(str(anchor)).id][:2]

    def _contact(self, contact: Contact) -> Array:
        """The floor's force on the disk, x and y."""
        total = np.zeros(3)
        disk = self.model.geom(contact.body).id
        for i in range(self.probe.ncon):
            touch = self.probe.contact[i]
            if disk in touch.geom:
                force = np.zeros(6)
                mujoco.mj_contactForce(self.model, self.probe, i, force)
                world = touch.frame.reshape(3, 3).T @ force[:3]  # on the second geom
                total += world if touch.geom[1] == disk else -world
        return total[:2]


def measured(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """The physics that MuJoCo holds, see `Engine.measure`."""
    found = {"gravity.x": model.opt.gravity[0], "gravity.y": model.opt.gravity[1]}
    for body in scene.bodies.values():
        number = model.body(body.name).id
        found[f"{body.name}.mass"] = model.body_mass[number]
        if body.turns:
            found[f"{body.name}.inertia"] = model.body_inertia[number, 2]
    for contact in scene.contacts:
        found[f"{contact}.friction"] = model.pair(contact).friction[0]
    for spring in scene.springs():
        number = model.tendon(spring.name).id
        found[f"{spring.name}.stiffness"] = model.tendon_stiffness[number]
        found[f"{spring.name}.rest_length"] = model.tendon_lengthspring[number, 0]
    for damper in scene.dampers():
        found[f"{damper.name}.damping"] = model.tendon_damping[model.tendon(damper.name).id]
    if not any(point.driven for point in scene.points.values()):  # their mass drowns the rest
        mujoco.mj_forward(model, data)
        mujoco.mj_energyVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        momentum = data.subtree_linvel[0] * model.body_subtreemass[0]
        found["energy.kinetic"] = data.energy[1]
        found["momentum.x"], found["momentum.y"] = momentum[0], momentum[1]
    return {name: float(value) for name, value in found.items()}


