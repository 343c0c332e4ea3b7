"""Every engine holds the case's physics before it takes a step, and the audit sees where not."""

from collections.abc import Callable, Mapping
from dataclasses import astuple, replace
from typing import Any

import numpy as np
import pytest
from given.adapters.engine_scenes import machine, pin, with_bodies, with_forces
from given.adapters.planning import (
    EVERY,
    NAMES,
    PAIRS,
    TUNED,
    begun,
    damps,
    own,
    pair,
    planned,
    refused,
    way_of,
)

from textmech.cases.scene import Damper, Scene, Spring, Torsion, TorsionDamper
from textmech.cases.scene.forces.force import of_kind
from textmech.cases.scene.frame import PLANE
from textmech.cases.scene.shape import bar, particle
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Engine, Start
from textmech.reports.compare.trial.audit import EQUAL, audit
from textmech.reports.compare.trial.trial import Trial

# Where a scene is handed to what builds it.
BUILDER = {
    "mujoco": "textmech.engines.mujoco.adapter.compilation.mjcf",
    "pymunk": "textmech.engines.pymunk.build",
}


BOTH = ("forward", "backward")


def expected(scene: Scene, poses: Start) -> dict[str, float]:
    """The physics of a scene, by the test's own formulas."""
    return elements(scene) | (in_plane if scene.frame is PLANE else in_space)(scene, poses)


def elements(scene: Scene) -> dict[str, float]:
    """What is the same in the plane and in space."""
    found = {f"{b.name}.mass": b.mass for b in scene.bodies.values()}
    touching = (*scene.touching.values(), *scene.pairs.values())
    found |= {f"{c.name}.friction": c.friction for c in touching}
    for spring in scene.springs():
        found[f"{spring.name}.stiffness"] = spring.stiffness
        found[f"{spring.name}.rest_length"] = spring.rest_length
        found[f"{spring.name}.pulls"] = 0.0 if spring.only == "compression" else 1.0
        found[f"{spring.name}.pushes"] = 0.0 if spring.only == "tension" else 1.0
    found |= {f"{d.name}.damping": d.damping for d in scene.dampers()}
    for limit in scene.limits():
        found |= {f"{limit.name}.{key}": number for key, number in limit.numbers().items()}
    for wire in of_kind(Torsion, scene.forces.values()):
        found[f"{wire.name}.stiffness"] = wire.stiffness
        found[f"{wire.name}.rest_angle"] = wire.rest_angle
    found |= {f"{d.name}.damping": d.damping for d in of_kind(TorsionDamper, scene.forces.values())}
    return found


def in_plane(scene: Scene, poses: Start) -> dict[str, float]:
    """Gravity, J, dry friction, ½ m v² + ½ J ω² and m v."""
    found = {"gravity.x": scene.gravity[0], "gravity.y": scene.gravity[1]}
    found |= {f"{b.name}.inertia": b.moment for b in scene.bodies.values() if b.turns}
    for joint in scene.joints.values():
        # Of two bounds an engine holds one number, which is neither.
        if joint.dry_friction and len({*astuple(joint.dry_friction.kinetic)}) == 1:
            found[f"{joint.name}.friction_forward"] = joint.dry_friction.kinetic.forward
            found[f"{joint.name}.friction_backward"] = joint.dry_friction.kinetic.backward
    motions = [(b.mass, b.moment, poses[b.name][3:]) for b in scene.bodies.values()]
    found["energy.kinetic"] = sum(
        (m * (vx**2 + vy**2) + J * w**2) / 2 for m, J, (vx, vy, w) in motions
    )
    found["momentum.x"] = sum(m * v[0] for m, _, v in motions)
    found["momentum.y"] = sum(m * v[1] for m, _, v in motions)
    return found


def in_space(scene: Any, poses: Start) -> dict[str, float]:
    """Gravity, the tensor J, ½ m v² + ½ ω·J ω, all in body axes, and m v."""
    found = dict(zip(("gravity.x", "gravity.y", "gravity.z"), scene.gravity, strict=True))
    T, p = 0.0, np.zeros(3)
    for body in scene.bodies.values():
        v, (w1, w2, w3) = np.array(poses[body.name][7:10]), poses[body.name][10:]
        T, p = T + body.mass * float(v @ v) / 2, p + body.mass * v
        if body.turns:
            J11, J22, J33, J12, J13, J23 = body.inertia
            T += (J11 * w1**2 + J22 * w2**2 + J33 * w3**2) / 2
            T += J12 * w1 * w2 + J13 * w1 * w3 + J23 * w2 * w3
            entries = {"11": J11, "22": J22, "33": J33, "12": J12, "13": J13, "23": J23}
            found |= {f"{body.name}.inertia_{ik}": J for ik, J in entries.items()}
    momentum = dict(zip(("momentum.x", "momentum.y", "momentum.z"), p.tolist(), strict=True))
    return found | momentum | {"energy.kinetic": T}


def unknown(engine: Engine, scene: Scene) -> set[str]:
    """What the engine does not hold."""
    driven = any(point.driven for point in scene.points.values())
    # MuJoCo's driven points are heavy bodies, which move, and its driven freedoms heavy armatures.
    if engine.name == "mujoco" and (driven or getattr(scene, "drives", {})):
        return {"energy.kinetic", *(f"momentum.{axis}" for axis in scene.frame.axes)}
    # A foot is pinned there.
    feet = [c.name for c in scene.contacts.values() if c.ahead_of and engine.name == "mujoco"]
    return {f"{name}.friction" for name in feet}


@pytest.mark.slow
@pytest.mark.parametrize(("name", "engine"), PAIRS, ids=pair)
def test_the_engine_holds_the_same_physics(name: str, engine: Engine) -> None:
    scene, start = begun(name)
    assert (refused(engine, scene, start) is None) == own(engine, scene)
    wanted, lost = expected(scene, start), unknown(engine, scene)
    assert lost <= set(wanted)
    wanted = {key: x for key, x in wanted.items() if key not in lost}
    for force in damps(engine, scene):
        wanted |= {f"{force.name}.{way}": force.coefficient.forward for way in BOTH}
    found = engine.measure(scene, start)
    # A zero beside numbers of about 1 (a tensor's axes are turned there and back): rounding.
    assert found == pytest.approx(wanted, rel=EQUAL, abs=1e-15)


def audited(name: str, engine: Engine) -> tuple[float, str]:
    """The suite's audit of a shipped case at its start: the largest difference, and of what."""
    scene, start = begun(name)
    begin = Trajectory(np.zeros(1), {n: np.array([row]) for n, row in start.items()}, {})
    realised = way_of(engine, scene)
    return audit(Trial(EVERY[name], begin, engine, planned(engine, scene, start, realised)))


def _friction(scene: Scene) -> Scene:
    more = {n: replace(c, kinetic=1.05 * c.kinetic) for n, c in scene.contacts.items()}
    return replace(scene, contacts=more)


def _pair_friction(scene: Scene) -> Scene:
    more = {n: replace(p, kinetic=1.05 * p.kinetic) for n, p in scene.pairs.items()}
    return replace(scene, pairs=more)


WRONG: Mapping[str, tuple[str, Callable[[Scene], Scene]]] = {
    "mass": ("double_pendulum", lambda s: with_bodies(s, lambda b: replace(b, mass=1.05 * b.mass))),
    "inertia": (
        "four_bar",
        lambda s: with_bodies(s, lambda b: replace(b, inertia=(1.05 * b.moment,))),
    ),
    "stiffness": (
        "rhombus",
        lambda s: with_forces(s, Spring, lambda f: replace(f, stiffness=1.05 * f.stiffness)),
    ),
    "rest_length": (
        "rhombus",
        lambda s: with_forces(s, Spring, lambda f: replace(f, rest_length=1.05 * f.rest_length)),
    ),
    "pulls": (
        "spring_mass_jump.best",
        lambda s: with_forces(s, Spring, lambda f: replace(f, only=None)),
    ),
    "pushes": (
        "rhombus",
        lambda s: with_forces(s, Spring, lambda f: replace(f, only="tension")),
    ),
    "damping": (
        "slider_crank",
        lambda s: with_forces(s, Damper, lambda f: replace(f, damping=1.05 * f.damping)),
    ),
    "friction": ("rolling_wheel.pushed", _friction),
    "touch.friction": ("disk_on_disk.rolls", _pair_friction),
    "gravity": ("bar_pendulum", lambda s: replace(s, gravity=(s.gravity[0], -s.gravity[1]))),
}


def _tensors(change: Callable[[list[float]], list[float]]) -> Callable[[Any], Scene]:
    def changed(body: Any) -> Any:
        return replace(body, inertia=tuple(change([*body.inertia])))

    return lambda scene: with_bodies(scene, changed)


WRONG_IN_SPACE: Mapping[str, Callable[[Any], Scene]] = {
    "mass": lambda s: with_bodies(s, lambda b: replace(b, mass=1.05 * b.mass)),
    "inertia_33": _tensors(lambda J: [*J[:2], 1.05 * J[2], *J[3:]]),
    "inertia_12": _tensors(lambda J: [*J[:3], -J[3], *J[4:]]),  # products without their minus
    "gravity.z": lambda s: replace(s, gravity=(*s.gravity[:2], -s.gravity[2])),
}


@pytest.mark.mutant("{what} in {name} not that of the scene")
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", WRONG)
def test_the_audit_sees(what: str, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """An engine that was given another scene: 5 % on one number, gravity upside down."""
    case, change = WRONG[what]
    given_another(BUILDER[name], change, monkeypatch)
    difference, because = audited(case, TUNED[name])
    assert difference > 1e-3  # 5 % of the 0.053 kg m² of a bar, relative to 1
    assert what in because


@pytest.mark.mutant("{what} in mujoco, in space, not that of the scene")
@pytest.mark.parametrize("what", WRONG_IN_SPACE)
def test_the_audit_sees_in_space(what: str, monkeypatch: pytest.MonkeyPatch) -> None:
    given_another(BUILDER["mujoco"], WRONG_IN_SPACE[what], monkeypatch)
    difference, because = audited("five_axis_robot.swinging", TUNED["mujoco"])
    assert difference > 1e-3
    assert what in because


def given_another(
    builder: str, change: Callable[[Any], Scene], monkeypatch: pytest.MonkeyPatch
) -> None:
    module, _, attribute = builder.rpartition(".")
    built = getattr(__import__(module, fromlist=[attribute]), attribute)
    monkeypatch.setattr(builder, lambda scene, *rest, **more: built(change(scene), *rest, **more))


@pytest.mark.parametrize("name", NAMES)
def test_a_held_particle_adds_no_inertia(name: str) -> None:
    """It is a point: fixed on a bar it adds m r², and nothing else."""
    parts = bar(name="rod", mass=1.0, length=1.0, points={}), particle(name="bob", mass=2.0)
    scene = machine(parts, [pin("A", "ground.O", "rod.start"), pin("B", "rod.end", "bob.center")])
    begin = {"rod": (0.5, 0, 0, 0, 0.5, 1.0), "bob": (1.0, 0, 0, 0, 1.0, 0.0)}
    energy = TUNED[name].measure(scene, begin)["energy.kinetic"]
    assert energy == pytest.approx(0.5 / 3 + 1.0, rel=1e-14)
