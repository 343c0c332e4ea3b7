"""Numbers of a compiled model at its start that make a fault of its step likely: suspicions.

None of them is a finding: whether the model suffers from it only a run says.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from ...cases.trajectory import Array
from .model import OwnModel
from .numbers import named
from .quantities import called
from .release import mass_matrix

STIFF = 2.0  # (kv + damping) h / M_eff: an explicit step of v̇ = −c v overshoots, and grows above it
SHORT = 2.0  # steps of a time constant: below it `refsafe` writes another law
APART = 1e3  # of two neighbours' M_eff: three digits of each acceleration are the other joint's
FAST = 1.0  # kp h² / M_eff: a servo's period is below 2π steps
OBJECT = mujoco.mjtObj


@dataclass(frozen=True)
class Suspicion:
    """A number beyond its bound, in words; dof: the velocity that it is of, None: of no joint's."""

    words: str
    dof: int | None = None


def suspicions(own: OwnModel) -> list[Suspicion]:
    """Returns all that is suspicious at the start, in milliseconds: joints, then time constants."""
    return [*_joints(own), *_time_constants(own.model)]


def stiffness(own: OwnModel) -> Array:
    """(n,): (kv + damping) h / M_eff of each velocity, M_eff = 1/(M⁻¹)ᵢᵢ at the start."""
    kv = sum((-motor.bias[2] * motor.moments**2 for motor in own.tree.motors), np.zeros(own.tree.n))
    return (kv + own.tree.damping) * own.model.opt.timestep / effective_mass(own)


def effective_mass(own: OwnModel) -> Array:
    """(n,) [kg m², kg]: what a force on one velocity moves while all others are free to yield."""
    m, data = own.model, own.start()
    mujoco.mj_forward(m, data)
    return 1.0 / np.diag(np.linalg.inv(mass_matrix(m, data)))


def _joints(own: OwnModel) -> Iterator[Suspicion]:
    tree, h = own.tree, own.model.opt.timestep
    mass, ratio = effective_mass(own), stiffness(own)
    kp = sum((-motor.bias[1] * motor.moments**2 for motor in tree.motors), np.zeros(tree.n))
    before = _neighbours(own.model)
    for k in np.argsort(-ratio):
        name = called(own.model, OBJECT.mjOBJ_JOINT, int(own.model.dof_jntid[k]))
        if ratio[k] > STIFF:
            words = f"(kv + damping) h / M_eff = {ratio[k]:.3g}, above {STIFF:g}"
            yield Suspicion(f"{name}: {words}", int(k))
        if kp[k] * h**2 / mass[k] > FAST and not tree.armature[k]:
            words = f"no armature on a light link: kp h² / M_eff = {kp[k] * h**2 / mass[k]:.3g}"
            yield Suspicion(f"{name}: {words}, above {FAST:g}", int(k))
        if k in before and mass[before[k]] / mass[k] > APART:
            other = called(own.model, OBJECT.mjOBJ_JOINT, int(own.model.dof_jntid[before[k]]))
            words = f"M_eff is {mass[before[k]] / mass[k]:.2g} times smaller than that of {other}"
            yield Suspicion(f"{name}: its {words}, above {APART:g}", int(k))


def _neighbours(m: mujoco.MjModel) -> Mapping[int, int]:
    """Returns by velocity the one before it in its chain, where both turn or both shift."""
    kinds = m.jnt_type[m.dof_jntid]
    pairs = ((int(k), int(parent)) for k, parent in enumerate(m.dof_parentid))
    return {k: p for k, p in pairs if p >= 0 and kinds[k] == kinds[p] and kinds[k] in ALONE}


ALONE = (mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE)


def _time_constants(m: mujoco.MjModel) -> Iterator[Suspicion]:
    least = SHORT * m.opt.timestep
    collides = ((m.geom_contype != 0) | (m.geom_conaffinity != 0)) & bool(np.any(m.geom_contype))
    for kind, word, times, acts in (
        (OBJECT.mjOBJ_GEOM, "geom", m.geom_solref[:, 0], collides),
        (OBJECT.mjOBJ_JOINT, "limit of joint", m.jnt_solref[:, 0], m.jnt_limited != 0),
        (OBJECT.mjOBJ_EQUALITY, "equality", m.eq_solref[:, 0], m.eq_active0 != 0),
    ):
        for i in np.flatnonzero((times > 0) & (times < least) & acts):
            words = f"solref {times[i]:.3g} s is below 2h = {least:.3g} s"
            yield Suspicion(f"{word} {named(m, kind, int(i))}: {words}")
