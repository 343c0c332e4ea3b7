"""Numbers of a compiled model at its start that make a fault of its step likely: suspicions.

None of them is a finding: whether the model suffers from it only a run says.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np

from .model import OwnModel
from .numbers import element_name
from .quantities import label
from .release import mass_matrix

STIFF = 2.0  # (kv + damping) h / M_eff: an explicit step of v̇ = −c v overshoots, and grows above it
SHORT = 2.0  # steps of a time constant: below it `refsafe` writes another law
APART = 1e3  # of two neighbours' M_eff: three digits of each acceleration are the other joint's
FAST = 1.0  # kp h² / M_eff: a servo's period is below 2π steps
OBJECT, DISABLED = mujoco.mjtObj, mujoco.mjtDisableBit
ALONE = (int(mujoco.mjtJoint.mjJNT_SLIDE), int(mujoco.mjtJoint.mjJNT_HINGE))


@dataclass(frozen=True)
class Suspicion:
    """A number beyond its bound, in words; dof: the velocity that it is of, None: of no joint's."""

    words: str
    dof: int | None = None


def suspicions(own: OwnModel) -> list[Suspicion]:
    """Returns all that is suspicious at the start, in milliseconds: joints, then time constants."""
    least = f"is below 2h = {SHORT * own.model.opt.timestep:.3g} s"
    short = [Suspicion(f"{name}: solref {time:.3g} s {least}") for name, time in short_times(own)]
    return [*(_joints(own) if own.model.nv else ()), *short]


def _joints(own: OwnModel) -> Iterator[Suspicion]:
    m, tree, h = own.model, own.tree, own.model.opt.timestep
    data = own.start()
    mujoco.mj_forward(m, data)
    mass = 1.0 / np.diag(np.linalg.inv(mass_matrix(m, data)))  # others are free to yield
    kp, kv = (
        sum((-motor.bias[k] * motor.moments**2 for motor in tree.motors), np.zeros(tree.n))
        for k in (1, 2)
    )
    ratio, fast = (kv + tree.damping) * h / mass, kp * h**2 / mass
    for k in map(int, np.argsort(-ratio)):
        name = label(m, OBJECT.mjOBJ_JOINT, int(m.dof_jntid[k]))
        if ratio[k] > STIFF:
            why = f"(kv + damping) h / M_eff = {ratio[k]:.3g}, above {STIFF:g}"
            yield Suspicion(f"{name}: {why}; {_damping_words(m, kv[k])}", k)
        if fast[k] > FAST and not tree.armature[k]:
            why = f"no armature on a light link: kp h² / M_eff = {fast[k]:.3g}, above {FAST:g}"
            yield Suspicion(f"{name}: {why}", k)
        p = int(m.dof_parentid[k])
        if p >= 0 and _same_kind(m, k, p) and mass[p] / mass[k] > APART:
            other = label(m, OBJECT.mjOBJ_JOINT, int(m.dof_jntid[p]))
            why = f"{mass[p] / mass[k]:.2g} times smaller than that of {other}, above {APART:g}"
            yield Suspicion(f"{name}: its M_eff is {why}", k)


def _same_kind(m: mujoco.MjModel, k: int, p: int) -> bool:
    """Whether two velocities both turn or both shift, of joints that do no more than that."""
    kind, other = m.jnt_type[m.dof_jntid[[k, p]]]
    return kind == other and kind in ALONE


def _damping_words(m: mujoco.MjModel, kv: float) -> str:
    """Returns what the model's integrator makes of damping."""
    name = mujoco.mjtIntegrator(m.opt.integrator).name.removeprefix("mjINT_")
    if name.startswith("IMPLICIT"):
        return "implicit, but for a servo at its force limit" if kv else "implicit"
    implicit = name == "EULER" and not m.opt.disableflags & DISABLED.mjDSBL_EULERDAMP
    return f"{name} damps {'the joint' if implicit else 'nothing'} implicitly, and no servo"


def short_times(own: OwnModel, step: float | None = None) -> list[tuple[str, float]]:
    """Returns the elements whose time constant [s] `refsafe` raises to two steps, with it.

    step [s]: by default its own.
    """
    m, flags = own.model, own.model.opt.disableflags
    collides = (m.geom_contype != 0) | (m.geom_conaffinity != 0)
    collides &= not flags & DISABLED.mjDSBL_CONTACT
    short: list[tuple[str, float]] = []
    for kind, word, times, acts in (
        (OBJECT.mjOBJ_GEOM, "geom", m.geom_solref[:, 0], collides),
        (OBJECT.mjOBJ_JOINT, "limit of joint", m.jnt_solref[:, 0], m.jnt_limited != 0),
        (OBJECT.mjOBJ_EQUALITY, "equality", m.eq_solref[:, 0], m.eq_active0 != 0),
    ):
        least = 0.0 if flags & DISABLED.mjDSBL_REFSAFE else SHORT * (step or m.opt.timestep)
        for i in map(int, np.flatnonzero((times > 0) & (times < least) & acts)):
            name = own.places.after(f"{word} {element_name(m, kind, i)}", (kind, i))
            short.append((name, float(times[i])))
    return short
