"""MuJoCo's element for each force element, and what is read back of it: one table, ELEMENTS.

A tendon carries a spring or a damper. An actuator carries what follows a law in time: control 1
makes a constant, the integral of 1 a ramp; any other law's control is a callback.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.fields.signal import Signal
from ....cases.scene import CENTER, GROUND, Anchor, Limit, Scene
from ....cases.scene.forces.force import (
    Couple,
    Damper,
    Drag,
    Force,
    Line,
    LinearMuscle,
    Magnetic,
    Muscle,
    Push,
    Rope,
    Spring,
    Stops,
    Torque,
    Viscous,
    of_kind,
)
from ....cases.scene.forces.muscle import Contracting
from ....cases.scene.forces.turning import Motor, Torsion, TorsionDamper
from ....cases.trajectory import Array
from .drag import damped_slides, not_damping
from .hinge import Hinge, hinge
from .limit import (
    finish_rope,
    finish_stops,
    lean_back,
    pushing,
    rope_length,
    stop_numbers,
    tension,
    write_rope,
    write_stops,
)
from .number_text import section, soft, written

# Viscous friction along a slide as MuJoCo's damping of a joint: a v + b v|v| + c v³.


_POWERS = (1.0, 2.0, 3.0)


def not_polynomial(force: Viscous) -> str | None:
    """Why it is not such a damping: another exponent, or another coefficient each way."""
    if force.exponent in _POWERS and force.coefficient.forward == force.coefficient.backward:
        return None
    return "engine: MuJoCo damps a joint by a v + b v|v| + c v³, alike both ways"


def write_viscous(sections: object, force: Viscous, along: Hinge) -> None:
    """The coefficient of its power, if MuJoCo has that."""
    if not_polynomial(force):
        return
    assert along.element is not None
    d, power = force.coefficient.forward, _POWERS.index(force.exponent)
    along.element.set("damping", written(*[d if i == power else 0.0 for i in range(3)]))


def damping(force: Viscous, slip: Array) -> Array:
    """(N,) what such a damping exerts along the slide, by the slip [m/s]."""
    return -force.coefficient.forward * np.abs(slip) ** force.exponent * np.sign(slip)


def viscous_numbers(model: mujoco.MjModel, force: Viscous, along: Hinge) -> dict[str, float]:
    """The coefficient, as the compiled model holds it."""
    dof = model.jnt_dofadr[model.joint(along.name).id]
    held = [model.dof_damping[dof], *np.ravel(model.dof_dampingpoly[dof])]
    d = float(held[_POWERS.index(force.exponent)])
    return {"forward": d, "backward": d}


# Linear drag of a body, as the damping of its slides.


def write_drag(sections: object, force: Drag, *slides: Hinge) -> None:
    """Its coefficient, of each slide by which the body moves; of none where it is no damping."""
    for slide in slides:
        slide.give("damping", force.coefficient)


def drag_damping(force: Drag, slip: Array) -> Array:
    """(N,) what it exerts along a slide, by the slip [m/s]."""
    return -force.coefficient * slip


def drag_numbers(model: mujoco.MjModel, force: Drag, *slides: Hinge) -> dict[str, float]:
    """The coefficient, as the compiled model holds it: where its slides differ, as no number."""
    dofs = (model.jnt_dofadr[model.joint(slide.name).id] for slide in slides)
    held = {float(np.ravel(model.dof_damping[dof])[0]) for dof in dofs}
    return {"coefficient": held.pop() if len(held) == 1 else math.nan}


# Forces about a joint: MuJoCo's own of the joint, or an actuator.


def torsion(sections: Mapping[str, ET.Element], force: Torsion, about: Hinge) -> None:
    """A torsion spring is a joint's own."""
    about.give("stiffness", force.stiffness)
    about.give("springref", math.degrees(force.rest_angle))


def torsion_numbers(model: mujoco.MjModel, force: Torsion, about: Hinge) -> dict[str, float]:
    """Stiffness and rest angle of a torsion spring, as the compiled joint holds them."""
    number = model.joint(about.name).id
    rest = model.qpos_spring[model.jnt_qposadr[number]]
    return {"stiffness": np.ravel(model.jnt_stiffness[number])[0], "rest_angle": rest}


def torsion_damper(sections: Mapping[str, ET.Element], force: TorsionDamper, about: Hinge) -> None:
    """A damper is a joint's own too."""
    about.give("damping", force.damping)


def torsion_damping(model: mujoco.MjModel, force: TorsionDamper, about: Hinge) -> dict[str, float]:
    """The damping of a torsion damper, as the compiled joint holds it."""
    dof = model.jnt_dofadr[model.joint(about.name).id]
    return {"damping": np.ravel(model.dof_damping[dof])[0]}


def motor(sections: Mapping[str, ET.Element], force: Motor, about: Hinge) -> None:
    """An actuator of the joint."""
    gear = written(force.signal.amplitude[0])
    given = {"name": force.name, "joint": about.name, "gear": gear}
    element = ET.SubElement(sections["actuator"], "general", given)
    if force.signal.law == "ramp":
        element.set("dyntype", "integrator")


# The inner state of a muscle, as the activation of an actuator that does nothing else.


# Set up as near to it as can be, it has a load that it lifts by 84 mm up to 10 mm elsewhere.
ANOTHER = (
    "engine: MuJoCo's muscle is another law: without an element in series, its force falls as a "
    "parabola of its speed"
)
NOTHING = Signal("constant", (0.0,))


def write_muscle(sections: Mapping[str, ET.Element], force: Contracting) -> None:
    """An actuator without gain, whose activation has the rate that our callback gives."""
    ET.SubElement(
        sections["actuator"], "general", name=force.name, site=GROUND, gear="0 0 0 0 0 0",
        dyntype="user", actdim="1", gainprm="0",
    )  # fmt: skip


# A torque between two bodies: an actuator at one body's site, against the site of the other.


def write_couple(sections: Mapping[str, ET.Element], force: Couple) -> None:
    """MuJoCo turns the second body against the first, about the first's z: in the plane, z."""
    sites = {"site": f"{force.second}.{CENTER}", "refsite": f"{force.first}.{CENTER}"}
    gear = written(0, 0, 0, 0, 0, *force.signal.amplitude)
    given = {"name": force.name, **sites, "gear": gear}
    element = ET.SubElement(sections["actuator"], "general", given)
    if force.signal.law == "ramp":
        element.set("dyntype", "integrator")


def couple_outer(force: Couple, size: Array, gear: Array) -> Iterator[tuple[Anchor, Array, Array]]:
    """The torque (N, 3) on each body."""
    for body, way in ((force.first, -1.0), (force.second, 1.0)):
        yield Anchor(body, CENTER), np.zeros((len(size), 3)), way * size[:, None] * gear[3:]


NEVER = 1e6  # m: a length that no tendon has
BY_ITSELF = ("constant", "ramp")  # the laws that need no callback

Sections = Mapping[str, ET.Element]
Outer = tuple[Anchor, Array, Array]
"""A body's point at which a force (N, 3) [N] and a torque (N, 3) [N m] act."""


@dataclass(frozen=True)
class Element:
    """MuJoCo's element of one kind; called with the force element, and if it acts about a joint
    with that joint's `Hinge`.

    write: into the file's sections. numbers: for the audit. Of what has an actuator, signal: the
    law that its control follows; outer: what it exerts on bodies at its force (N,), by its gear,
    unless through a tendon, whose forces MuJoCo counts rightly itself. lacks: why MuJoCo has no
    element for it, so that it is told by our law; or None. damping: of what is its joint's damping,
    what it exerts (N,) at the slips (N,). limit: of what holds on one side.
    """

    write: Callable[..., None] = lambda *_: None
    numbers: Callable[..., dict[str, float]] = lambda model, force, *about: {}
    signal: Callable[[Any], Signal] | None = None
    outer: Callable[[Any, Array, Array], Iterator[Outer]] = lambda *_: iter(())
    lacks: Callable[[Scene, Any], str | None] = lambda scene, force: None
    damping: Callable[[Any, Array], Array] | None = None
    limit: "Limited | None" = None


@dataclass(frozen=True)
class Limited:
    """The numbers, sensors and start of a limit, beside its range; called as the `Element`'s are.

    group: of soft constraints, whose numbers it has. finish: gives it these, and its sensors.
    sensed: what it exerts (N,) at one of its sides, from the sensors' rows (N, ·). lean: moves what
    starts at its end to where MuJoCo sees it.
    """

    group: str
    finish: Callable[..., None]
    sensed: Callable[[mujoco.MjModel, Any, str, Array], Array]
    lean: Callable[..., None] = lambda model, data, force, *about: None


def lacking(scene: Scene) -> list[tuple[Force, str]]:
    """The forces that MuJoCo has no element for, and why."""
    each = ((force, ELEMENTS[type(force)].lacks(scene, force)) for force in scene.forces.values())
    return [(force, why) for force, why in each if why is not None]


def write(root: ET.Element, scene: Scene) -> None:
    """The sections of the scene's forces."""
    sections = {name: ET.Element(name) for name in ("tendon", "actuator")}
    for force in scene.forces.values():
        ELEMENTS[type(force)].write(sections, force, *_about(scene, force, root))
    root.extend(section for section in sections.values() if len(section))


def finish(root: ET.Element, scene: Scene, numbers: Mapping[str, object]) -> None:
    """A setting's numbers for the limits, and their sensors behind those of contacts."""
    for limit in scene.limits():
        its, sensors = _limited(limit), section(root, "sensor")
        its.finish(
            root, sensors, limit, soft(numbers, its.group, limit.name), *_about(scene, limit, root)
        )


def limited(scene: Scene, group: str) -> list[Limit]:
    """The limits that have the numbers of a group of soft constraints."""
    return [limit for limit in scene.limits() if _limited(limit).group == group]


def limit_force(scene: Scene, model: mujoco.MjModel, quantity: str, sensed: Array) -> Array:
    """(N,) what a limit exerts at one of its sides, from the sensors' rows (N, ·)."""
    name, _, side = quantity.rpartition(".")
    limit = next(limit for limit in scene.limits() if limit.name == name)
    return _limited(limit).sensed(model, limit, side, sensed)


def lean(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Moves what starts at the end of a limit to where MuJoCo sees it."""
    for limit in scene.limits():
        _limited(limit).lean(model, data, limit, *_about(scene, limit))


def _limited(limit: Limit) -> Limited:
    limited = ELEMENTS[type(limit)].limit
    assert limited is not None, limit.word
    return limited


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
    """The numbers of all forces that the compiled model holds, as `Force.numbers` names them."""
    return {
        f"{force.name}.{key}": number
        for force in scene.forces.values()
        if ELEMENTS[type(force)].lacks(scene, force) is None
        for key, number in _held(scene, model, force).items()
    }


def _held(scene: Scene, model: mujoco.MjModel, force: Force) -> dict[str, float]:
    return ELEMENTS[type(force)].numbers(model, force, *_about(scene, force))


def _about(scene: Scene, force: Force, root: ET.Element | None = None) -> Iterator[Hinge]:
    if force.about is not None:
        yield hinge(scene, force, root)
    for drag in of_kind(Drag, (force,)):
        built = {} if root is None else {joint.get("name"): joint for joint in root.iter("joint")}
        yield from (Hinge(name, built.get(name)) for name in damped_slides(scene, drag))


def damps(scene: Scene, force: Force) -> list[str]:
    """The joints that a force is about, or whose slides it damps, by MuJoCo's names."""
    return [about.name for about in _about(scene, force)]


def outer(scene: Scene, model: mujoco.MjModel, sizes: Array) -> Iterator[Outer]:
    """Forces and torques of the actuators on bodies, when theirs are `sizes` (N, actuators)."""
    for i, (force, _) in enumerate(_actuated(scene)):
        gear = model.actuator_gear[i]
        yield from ELEMENTS[type(force)].outer(force, sizes[:, i], gear)


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
    yield force.at, size[:, None] * gear[:3], np.zeros((len(size), 3))


def _torque(sections: Sections, force: Torque) -> None:
    site, about = f"{force.body}.{CENTER}", force.signal.amplitude
    rest = [0] * (6 - len(about))
    element = _actuator(sections, force, site, (*rest, *about))
    if len(about) == 3:
        element.set("refsite", GROUND)  # the torque keeps the ground's axes


def _torque_outer(force: Torque, size: Array, gear: Array) -> Iterator[Outer]:
    yield Anchor(force.body, CENTER), np.zeros((len(size), 3)), size[:, None] * gear[3:]


ELEMENTS: dict[type[Force], Element] = {
    Spring: Element(_spring, _spring_numbers),
    Damper: Element(_damper, _damper_numbers),
    Push: Element(_push, signal=lambda force: force.signal, outer=_push_outer),
    Torque: Element(_torque, signal=lambda force: force.signal, outer=_torque_outer),
    Couple: Element(write_couple, signal=lambda force: force.signal, outer=couple_outer),
    Torsion: Element(torsion, torsion_numbers),
    TorsionDamper: Element(torsion_damper, torsion_damping),
    Motor: Element(motor, signal=lambda force: force.signal),
    Drag: Element(write_drag, drag_numbers, lacks=not_damping, damping=drag_damping),
    Viscous: Element(
        write_viscous,
        viscous_numbers,
        lacks=lambda scene, force: not_polynomial(force),
        damping=damping,
    ),
    Magnetic: Element(lacks=lambda scene, force: "engine: MuJoCo has no force of a magnetic field"),
    Muscle: Element(write_muscle, signal=lambda force: NOTHING, lacks=lambda scene, force: ANOTHER),
    LinearMuscle: Element(
        write_muscle, signal=lambda force: NOTHING, lacks=lambda scene, force: ANOTHER
    ),
    Rope: Element(write_rope, rope_length, limit=Limited("rope", finish_rope, tension)),
    Stops: Element(
        write_stops, stop_numbers, limit=Limited("stop", finish_stops, pushing, lean_back)
    ),
}
