"""MuJoCo's element for each force element, and what is read back of it: one table, ELEMENTS.

A tendon carries a spring or a damper. An actuator carries what follows a law in time: control 1
makes a constant, the integral of 1 a ramp; any other law's control is a callback.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ...cases.fields.signal import Signal
from ...cases.scene import CENTER, GROUND, Anchor, Scene
from ...cases.scene.forces.force import (
    Couple,
    Damper,
    Drag,
    Force,
    Line,
    LinearMuscle,
    Magnetic,
    Motor,
    Muscle,
    Push,
    Rope,
    Spring,
    Stops,
    Torque,
    Torsion,
    TorsionDamper,
    Viscous,
)
from ...cases.trajectory import Array
from .couple import couple_outer, write_couple
from .hinge import Hinge, hinge
from .muscle import ANOTHER, NOTHING, write_muscle
from .rope import rope_length, write_rope
from .stops import stop_numbers, write_stops
from .turning import motor, torsion, torsion_damper, torsion_damping, torsion_numbers
from .viscous import damping, not_polynomial, viscous_numbers, write_viscous
from .written import written

NEVER = 1e6  # m: a length that no tendon has
BY_ITSELF = ("constant", "ramp")  # the laws that need no callback

Sections = Mapping[str, ET.Element]
Outer = tuple[Anchor, Array, Array]
"""A body's point at which a force (N, 2) [N] and a torque (N,) [N m] act; in space (N, 3) each."""


@dataclass(frozen=True)
class Element:
    """MuJoCo's element of one kind; called with the force element, and if it acts about a joint
    with that joint's `Hinge`.

    write: into the file's sections. numbers: for the audit. Of what has an actuator, signal: the
    law that its control follows; outer: what it exerts on bodies at its force (N,), by its gear,
    unless through a tendon, whose forces MuJoCo counts rightly itself. lacks: why MuJoCo has no
    element for it, so that it is told by our law; or None. damping: of what is its joint's damping,
    what it exerts (N,) at the slips (N,).
    """

    write: Callable[..., None] = lambda *_: None
    numbers: Callable[..., dict[str, float]] = lambda model, force, *about: {}
    signal: Callable[[Any], Signal] | None = None
    outer: Callable[[Any, Array, Array], Iterator[Outer]] = lambda *_: iter(())
    lacks: Callable[[Any], str | None] = lambda force: None
    damping: Callable[[Any, Array], Array] | None = None


def lacking(scene: Scene) -> list[tuple[Force, str]]:
    """The forces that MuJoCo has no element for, and why."""
    found = ((force, ELEMENTS[type(force)].lacks(force)) for force in scene.forces.values())
    return [(force, why) for force, why in found if why is not None]


def write(root: ET.Element, scene: Scene) -> None:
    """The sections of the scene's forces."""
    sections = {name: ET.Element(name) for name in ("tendon", "actuator")}
    for force in scene.forces.values():
        ELEMENTS[type(force)].write(sections, force, *_about(scene, force, root))
    root.extend(section for section in sections.values() if len(section))


def signals(scene: Scene) -> list[Signal]:
    """The laws of the actuators' controls, in MuJoCo's order."""
    return [signal(force) for force, signal in _actuated(scene)]


def begun_with(scene: Scene) -> list[float]:
    """The activations at the start, in MuJoCo's order: of ramps, and of what has an inner state."""
    return [
        force.begins if force.inner else 0.0
        for force, signal in _actuated(scene)
        if force.inner or signal(force).law == "ramp"
    ]


def numbers(scene: Scene, model: mujoco.MjModel) -> dict[str, float]:
    """What the compiled model holds of the forces, as `Force.numbers` names it."""
    return {
        f"{force.name}.{key}": number
        for force in scene.forces.values()
        if ELEMENTS[type(force)].lacks(force) is None
        for key, number in _held(scene, model, force).items()
    }


def _held(scene: Scene, model: mujoco.MjModel, force: Force) -> dict[str, float]:
    return ELEMENTS[type(force)].numbers(model, force, *_about(scene, force))


def _about(scene: Scene, force: Force, root: ET.Element | None = None) -> Iterator[Hinge]:
    if force.about is not None:
        yield hinge(scene, force, root)


def outer(scene: Scene, model: mujoco.MjModel, sizes: Array) -> Iterator[Outer]:
    """What the actuators exert on bodies, when their forces are `sizes` (N, actuators)."""
    for i, (force, _) in enumerate(_actuated(scene)):
        gear = model.actuator_gear[i]
        yield from ELEMENTS[type(force)].outer(force, sizes[:, i], gear)


def about(scene: Scene, model: mujoco.MjModel, joint: str, sizes: Array) -> Array:
    """(N,) what the actuators exert about a joint, as MuJoCo counts its angle."""
    total = np.zeros(len(sizes))
    for i, (force, _) in enumerate(_actuated(scene)):
        if force.about == joint:
            total += sizes[:, i] * model.actuator_gear[i, 0]
    return total


def _actuated(scene: Scene) -> Iterator[tuple[Force, Callable[[Any], Signal]]]:
    for force in scene.forces.values():
        if signal := ELEMENTS[type(force)].signal:
            yield force, signal


def tendon(sections: Sections, force: Line, **attributes: float | tuple[float, ...]) -> None:
    """A tendon between the two ends."""
    texts = {
        key: written(*(value if isinstance(value, tuple) else (value,)))
        for key, value in attributes.items()
    }
    spatial = ET.SubElement(sections["tendon"], "spatial", texts, name=force.name)
    for end in (force.a, force.b):
        ET.SubElement(spatial, "site", site=str(end))


def _spring(sections: Sections, force: Spring) -> None:
    rest = force.rest_length
    dead = {"compression": (rest, NEVER), "tension": (0.0, rest)}.get(force.only or "", (rest,))
    tendon(sections, force, stiffness=force.stiffness, springlength=dead)


def _spring_numbers(model: mujoco.MjModel, force: Spring) -> dict[str, float]:
    """Between two lengths MuJoCo's spring is dead."""
    number = model.tendon(force.name).id
    low, high = model.tendon_lengthspring[number].tolist()
    pulls, pushes = high < NEVER, low == high or high == NEVER
    numbers = {"stiffness": model.tendon_stiffness[number], "rest_length": high if pulls else low}
    return numbers | {"pulls": float(pulls), "pushes": float(pushes)}


def _damper(sections: Sections, force: Damper) -> None:
    tendon(sections, force, damping=force.damping)


def _damper_numbers(model: mujoco.MjModel, force: Damper) -> dict[str, float]:
    return {"damping": model.tendon_damping[model.tendon(force.name).id]}


def _actuator(
    sections: Sections, force: Push | Torque, site: str, gear: tuple[float, ...]
) -> ET.Element:
    given = {"name": force.name, "site": site, "gear": written(*gear)}
    element = ET.SubElement(sections["actuator"], "general", given)
    if force.signal.law == "ramp":
        element.set("dyntype", "integrator")
    return element


def _push(sections: Sections, force: Push) -> None:
    along = force.signal.amplitude
    rest = [0] * (6 - len(along))
    element = _actuator(sections, force, str(force.at), (*along, *rest))
    element.set("refsite", GROUND)  # the force keeps the ground's axes


def _push_outer(force: Push, size: Array, gear: Array) -> Iterator[Outer]:
    if len(force.signal.amplitude) == 3:
        yield force.at, size[:, None] * gear[:3], np.zeros((len(size), 3))
    else:
        yield force.at, size[:, None] * gear[:2], np.zeros(len(size))


def _torque(sections: Sections, force: Torque) -> None:
    site, about = f"{force.body}.{CENTER}", force.signal.amplitude
    rest = [0] * (6 - len(about))
    element = _actuator(sections, force, site, (*rest, *about))
    if len(about) == 3:
        element.set("refsite", GROUND)  # the torque keeps the ground's axes


def _torque_outer(force: Torque, size: Array, gear: Array) -> Iterator[Outer]:
    at = Anchor(force.body, CENTER)
    if len(force.signal.amplitude) == 3:
        yield at, np.zeros((len(size), 3)), size[:, None] * gear[3:]
    else:
        yield at, np.zeros((len(size), 2)), size * gear[5]


ELEMENTS: dict[type[Force], Element] = {
    Spring: Element(_spring, _spring_numbers),
    Damper: Element(_damper, _damper_numbers),
    Push: Element(_push, signal=lambda force: force.signal, outer=_push_outer),
    Torque: Element(_torque, signal=lambda force: force.signal, outer=_torque_outer),
    Couple: Element(write_couple, signal=lambda force: force.signal, outer=couple_outer),
    Torsion: Element(torsion, torsion_numbers),
    TorsionDamper: Element(torsion_damper, torsion_damping),
    Motor: Element(motor, signal=lambda force: force.signal),
    Drag: Element(lacks=lambda force: "engine: MuJoCo has no drag at a point of a body"),
    Viscous: Element(write_viscous, viscous_numbers, lacks=not_polynomial, damping=damping),
    Magnetic: Element(lacks=lambda force: "engine: MuJoCo has no force of a magnetic field"),
    Muscle: Element(write_muscle, signal=lambda force: NOTHING, lacks=lambda force: ANOTHER),
    LinearMuscle: Element(write_muscle, signal=lambda force: NOTHING, lacks=lambda force: ANOTHER),
    Rope: Element(write_rope, rope_length),
    Stops: Element(write_stops, stop_numbers),
}
