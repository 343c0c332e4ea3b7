"""The MuJoCo adapter: audit, order, divergence, callbacks, script, and what it refuses."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from planning import planned, refused

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.scene import (
    Anchor,
    Body,
    Contact,
    Damper,
    GroundPoint,
    Joint,
    Push,
    Scene,
    Signal,
    Spring,
)
from textmech.cases.shape import bar, block, disk, particle, rigid
from textmech.cases.trajectory import ANGLE, Array, Trajectory, X
from textmech.engines.engine import Diverged, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco import scene as builder
from textmech.engines.mujoco.law import signal as control
from textmech.engines.mujoco.tree import spanning_tree
from textmech.reference.generated.mode import Multibody
from textmech.reference.start.assembly import assemble
from textmech.reports.trial.audit import EQUAL, expected

CASES = sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))
TUNED, SHIPPED = MuJoCo("tuned"), MuJoCo("shipped")
O = Anchor("ground", "O")


@cache
def case(name: str) -> Case:
    path = next(path for path in CASES if path.stem == name.partition(".")[0])
    return next(c for c in load(path) if c.name == name)


def start(scene_case: Case) -> Start:
    mechanism = Multibody(scene_case.scene, assemble(scene_case))
    return mechanism.poses(0.0, *mechanism.start())


def moved(
    scene: Scene, begin: Start, times: Array, step: float, engine: MuJoCo = TUNED, **given: Any
) -> Trajectory:
    plan = planned(engine, scene, begin)
    wanted: dict[str, Any] = {"reactions": (), **given}
    return engine.run(scene, begin, times, step, plan, **wanted)


def rest(scene: Scene, begin: Start) -> Trajectory:
    return Trajectory(np.zeros(1), {n: np.array([s]) for n, s in begin.items()}, {})


def worst(scene: Scene, begin: Start) -> float:
    """As `reports.audit` judges: relative to the number, or to 1."""
    wanted, found = expected(scene, rest(scene, begin)), TUNED.measure(scene, begin)
    return max(abs(v - wanted[n]) / max(abs(wanted[n]), 1.0) for n, v in found.items())


NAMES = [c.name for path in CASES for c in load(path)]


@pytest.mark.parametrize("name", NAMES)
def test_audit(name: str) -> None:
    scene, begin = case(name).scene, start(case(name))
    assert worst(scene, begin) <= EQUAL
    lost = set(expected(scene, rest(scene, begin))) - set(TUNED.measure(scene, begin))
    driven = any(point.driven for point in scene.points.values())
    means = {  # of two bounds MuJoCo holds the mean, which is neither
        f"{joint.name}.friction_{way}"
        for joint in scene.joints.values()
        for way in ("forward", "backward")
        if (dry := joint.dry_friction) and dry.kinetic.forward != dry.kinetic.backward
    }
    assert lost == means | ({"energy.kinetic", "momentum.x", "momentum.y"} if driven else set())


WRONG: dict[str, tuple[str, Callable[[Scene], Scene]]] = {
    "mass": ("double_pendulum", lambda s: bodies(s, lambda b: replace(b, mass=1.05 * b.mass))),
    "inertia": (
        "four_bar",
        lambda s: bodies(s, lambda b: replace(b, inertia=1.05 * (b.inertia or 0))),
    ),
    "stiffness": (
        "rhombus",
        lambda s: forces(s, Spring, lambda f: replace(f, stiffness=1.05 * f.stiffness)),
    ),
    "rest_length": (
        "rhombus",
        lambda s: forces(s, Spring, lambda f: replace(f, rest_length=1.05 * f.rest_length)),
    ),
    "damping": (
        "slider_crank",
        lambda s: forces(s, Damper, lambda f: replace(f, damping=1.05 * f.damping)),
    ),
    "friction": (
        "rolling_wheel.pushed",
        lambda s: replace(
            s, contacts={n: replace(c, kinetic=1.05 * c.kinetic) for n, c in s.contacts.items()}
        ),
    ),
    "gravity": (
        "bar_pendulum",
        lambda s: replace(s, gravity=(s.gravity[0], -s.gravity[1])),
    ),
}


def bodies(scene: Scene, change: Callable[[Body], Body]) -> Scene:
    return replace(scene, bodies={name: change(body) for name, body in scene.bodies.items()})


def forces(scene: Scene, kind: type, change: Callable[[Any], Any]) -> Scene:
    changed = {n: change(f) if isinstance(f, kind) else f for n, f in scene.forces.items()}
    return replace(scene, forces=changed)


@pytest.mark.parametrize("what", WRONG)
def test_audit_sees(what: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name, change = WRONG[what]
    built = builder.mjcf
    monkeypatch.setattr(
        "textmech.engines.mujoco.compilation.mjcf",
        lambda scene, *rest, **more: built(change(scene), *rest, **more),
    )
    assert (
        worst(case(name).scene, start(case(name))) > 1e-3
    )  # 5 % of the 0.053 kg m² of a bar at least


def test_a_held_particle_adds_no_inertia() -> None:
    """It is a point: fixed on a bar it adds m r², and nothing else."""
    rod = bar(name="rod", mass=1.0, length=1.0, points={})
    bob = particle(name="bob", mass=2.0)
    pins = [Joint("A", "pin", O, Anchor("rod", "start")), pin("B", "rod.end", "bob.center")]
    scene = still({"rod": rod, "bob": bob}, pins)
    begin = {"rod": (0.5, 0, 0, 0, 0.5, 1.0), "bob": (1.0, 0, 0, 0, 1.0, 0.0)}
    energy = TUNED.measure(scene, begin)["energy.kinetic"]
    assert energy == pytest.approx(0.5 / 3 + 1.0, rel=1e-14)


def order(run: Callable[[float], Array], steps: tuple[float, float, float]) -> float:
    """log2 of the ratio of neighbouring differences, in max-norm."""
    a, b, c = (run(step) for step in steps)
    return math.log2(np.max(np.abs(a - b)) / np.max(np.abs(b - c)))


def pendulum(step: float, engine: MuJoCo) -> Array:
    c, times = case("bar_pendulum"), np.linspace(0.0, 1.6, 6)
    return moved(c.scene, start(c), times, step, engine).states["bar"][:, ANGLE]


def test_rk4_is_of_fourth_order() -> None:
    assert order(lambda h: pendulum(h, TUNED), (8e-3, 4e-3, 2e-3)) == pytest.approx(4, abs=0.05)


def test_euler_is_of_first_order() -> None:
    assert order(lambda h: pendulum(h, SHIPPED), (2e-3, 1e-3, 5e-4)) == pytest.approx(1, abs=0.05)


def shaken() -> tuple[Scene, Start]:
    """A mass on a rail between a spring and a fast sine."""
    push = Push("push", Anchor("m", "center"), Signal("sine", (9.0, 1.0), 12.0, 0.4))
    coil = Spring(
        "coil", O, Anchor("m", "center"), 50.0, 1.8
    )  # far from length 0, where it would have a kink
    slide = Joint("rail", "slide", O, Anchor("m", "center"), (1.0, 0.0))
    made = still({"m": block(name="m", mass=1.0, width=0.1, height=0.1, points={})}, [slide])
    return replace(made, forces={"push": push, "coil": coil}), {"m": (2.0, 0, 0, 0, 0, 0)}


TIMES = np.linspace(0.0, 0.8, 11)
STEPS = (8e-3, 4e-3, 2e-3)


def test_a_sine_is_taken_at_the_stages() -> None:
    scene, begin = shaken()
    assert order(lambda h: moved(scene, begin, TIMES, h).states["m"][:, X], STEPS) == pytest.approx(
        4, abs=0.1
    )


def test_a_sine_between_steps_is_of_first_order() -> None:
    """The mutant: the same control, set before each step and held during it."""
    scene, begin = shaken()

    def held(h: float) -> Array:
        model, data = loaded(TUNED.script(scene, begin, h, planned(TUNED, scene, begin)))
        found = [data.qpos[0]]
        for _ in range(len(TIMES) - 1):
            for _ in range(round(TIMES[1] / h)):
                data.ctrl[0] = math.sin(12.0 * data.time + 0.4)
                mujoco.mj_step(model, data)
            found.append(data.qpos[0])
        return np.array(found)

    assert order(held, STEPS) == pytest.approx(1, abs=0.1)


def test_the_callback_is_removed_and_the_users_comes_back() -> None:
    scene, begin = shaken()
    moved(scene, begin, TIMES, 2e-3)
    assert mujoco.get_mjcb_control() is None
    assert mujoco.get_mju_user_warning() is None
    seen: list[float] = []

    def mine(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        seen.append(data.time)

    listening: list[str] = []
    mujoco.set_mjcb_control(mine)
    mujoco.set_mju_user_warning(listening.append)
    try:
        plain = case("bar_pendulum")
        moved(plain.scene, start(plain), TIMES, 2e-3)
        assert mujoco.get_mjcb_control() is mine
        assert not seen
        assert mujoco.get_mju_user_warning() is not None
    finally:
        mujoco.set_mjcb_control(None)
        mujoco.set_mju_user_warning(None)


def test_the_callback_is_removed_when_the_run_raises(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(angle: float) -> float:
        raise ArithmeticError("sine")

    monkeypatch.setattr(control.math, "sin", fails)
    with pytest.raises(ArithmeticError):
        moved(*shaken(), TIMES, 2e-3)
    assert mujoco.get_mjcb_control() is None
    assert mujoco.get_mju_user_warning() is None


@pytest.mark.parametrize("name", ["towed_pendulum", "slider_crank", "rolling_wheel.pushed"])
def test_two_runs_are_equal(name: str) -> None:
    c = case(name)
    wanted = tuple(f"{j}.fx" for j in c.scene.joints)
    a, b = (moved(c.scene, start(c), c.times[:6], c.interval / 20, reactions=wanted) for _ in "ab")
    assert all(np.array_equal(a.states[n], b.states[n]) for n in a.states)
    assert all(np.array_equal(a.reactions[n], b.reactions[n]) for n in wanted)


@pytest.mark.parametrize("engine", [SHIPPED, TUNED], ids=lambda e: e.setting)
def test_a_blow_up_is_diverged(
    engine: MuJoCo, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """MuJoCo alone would go back to its start without a word, and write a file here."""
    monkeypatch.chdir(tmp_path)
    scene, begin = shaken()
    stiff = forces(scene, Spring, lambda f: replace(f, stiffness=1e9))
    with pytest.raises(Diverged, match=r"MuJoCo warns: .*unstable"):
        moved(stiff, begin, np.linspace(0, 100.0, 11), 0.1, engine)
    engine.loop(stiff, begin, 0.1, planned(engine, stiff, begin))(1000)
    model, _ = loaded(engine.script(stiff, begin, 0.1, planned(engine, stiff, begin)))
    assert model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_AUTORESET
    assert not list(tmp_path.iterdir())


def test_other_warnings_are_diverged_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    built = builder.mjcf

    def mixed(*given: Any) -> str:  # MuJoCo says so in the first step, and takes another pair
        return built(*given).replace('solref="0.02 1.0"', 'solref="0.02 -1.0"')

    monkeypatch.setattr("textmech.engines.mujoco.compilation.mjcf", mixed)
    c = case("four_bar")
    with pytest.raises(Diverged, match=r"MuJoCo warns: .*solref"):
        moved(c.scene, start(c), c.times[:3], 2e-3, SHIPPED)
    assert not list(tmp_path.iterdir())


def loaded(text: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


@pytest.mark.parametrize("engine", [SHIPPED, TUNED], ids=lambda e: e.setting)
@pytest.mark.parametrize("name", NAMES)
def test_the_script_moves_as_the_run(name: str, engine: MuJoCo) -> None:
    c, step = case(name), case(name).interval / 40
    begin, times = start(c), c.times[:5]
    model, data = loaded(engine.script(c.scene, begin, step, planned(engine, c.scene, begin)))
    with control.signals(c.scene):
        mujoco.mj_step(model, data, 40 * (len(times) - 1))
    mujoco.mj_kinematics(model, data)
    found = moved(c.scene, begin, times, step, engine)
    for body, rows in found.states.items():
        assert tuple(data.body(body).xipos[:2]) == tuple(rows[-1, :2])


def pin(name: str, a: str, b: str, kind: Any = "pin", **given: Any) -> Joint:
    (p, q), (r, s) = a.split("."), b.split(".")
    return Joint(name, kind, Anchor(p, q), Anchor(r, s), **given)


def still(parts: dict[str, Body], joints: list[Joint]) -> Scene:
    points = {"O": GroundPoint((0.0, 0.0)), "Q": GroundPoint((1.0, 0.0))}
    return Scene((0.0, -9.8), points, parts, {j.name: j for j in joints}, {}, {})


ROD = bar(name="rod", mass=1.0, length=1.0, points={})
BOX = block(name="box", mass=1.0, width=0.2, height=0.2, points={})
BOB = particle(name="bob", mass=1.0)
WHEEL = disk(name="wheel", mass=1.0, radius=0.3, points={})
REFUSED = {
    "engine: MuJoCo has no constraint that closes a loop by the slide B": still(
        {"box": BOX},
        [pin("A", "ground.O", "box.center", "slide"), pin("B", "ground.Q", "box.center", "slide")],
    ),
    "adapter: B closes a loop by a weld": still(
        {"box": BOX},
        [pin("A", "ground.O", "box.center", "weld"), pin("B", "ground.Q", "box.center", "weld")],
    ),
    "adapter: B would have to let rod both shift and turn": still(
        {"bob": BOB, "rod": ROD},
        [pin("A", "ground.O", "bob.center", "slide"), pin("B", "bob.center", "rod.start", "slide")],
    ),
    "adapter: B starts at a particle": still(
        {"rod": ROD, "bob": BOB},
        [pin("A", "ground.O", "rod.start"), pin("B", "bob.center", "rod.end", "slide")],
    ),
    "engine: MuJoCo does not take the scene: .*mjMINVAL": still(
        {"dust": rigid(name="dust", mass=1e-9, inertia=1e-18, points={})}, []
    ),
    "engine: MuJoCo does not take the scene: .*world": still(
        {"world": replace(ROD, name="world")}, []
    ),
    "adapter: first is not the only contact of wheel": replace(
        still({"wheel": WHEEL}, []),
        contacts={
            n: Contact(n, Anchor("wheel", "center"), 0.5, 0.5, ideal="rolling")
            for n in ("first", "second")
        },
    ),
}


@pytest.mark.parametrize("why", REFUSED)
def test_refused(why: str) -> None:
    for engine in (TUNED, SHIPPED):
        found = refused(engine, REFUSED[why])
        assert found is not None
        assert found.startswith(("engine: ", "adapter: "))
        assert re.match(why, found), found


ODD_NAMES = ("floor", "ground_link", "groundhog", "start", "center", "x", "textmech")


@pytest.mark.parametrize("name", ODD_NAMES)
def test_odd_names(name: str) -> None:
    """A body, and a joint or contact beside it, may be called what MuJoCo's file also uses."""
    wheel = disk(name=name, mass=1.0, radius=0.3, points={})
    scene = still({name: wheel, "rod": ROD}, [pin("start_", f"{name}.center", "rod.start")])
    scene = replace(
        scene,
        contacts={"touch": Contact("touch", Anchor(name, "center"), 0.5, 0.5, ideal="rolling")},
    )
    begin = {name: (0.0, 0.3, 0.0, 0, 0, 0), "rod": (0.5, 0.3, 0.0, 0, 0, 0)}
    assert refused(TUNED, scene) is None
    found = moved(scene, begin, np.linspace(0, 0.1, 3), 1e-3)
    assert np.all(np.isfinite(found.states[name]))
    assert worst(scene, begin) <= EQUAL
    hung = still({name: replace(ROD, name=name)}, [pin("A", "ground.O", f"{name}.start")])
    assert not spanning_tree(hung).loops
    assert refused(TUNED, hung) is None


@pytest.mark.parametrize("mass", [1e-9, 1e9])
def test_masses_far_from_one_fall_alike(mass: float) -> None:
    rod = bar(name="rod", mass=mass, length=1.0, points={})
    scene = still({"rod": rod}, [Joint("A", "pin", O, Anchor("rod", "start"))])
    unit = still({"rod": ROD}, [Joint("A", "pin", O, Anchor("rod", "start"))])
    begin = {"rod": (0.5, 0.0, 0.0, 0.0, 0.0, 0.0)}
    a, b = (moved(s, begin, TIMES, 2e-3).states["rod"] for s in (scene, unit))
    assert np.max(np.abs(a - b)) < 1e-12


def test_angles_stay_on_their_turn() -> None:
    """A slide that holds 10° holds 370° too, and what hangs on it counts from there."""
    turn = 2 * math.pi + 0.2
    scene = still(
        {"box": BOX, "rod": ROD},
        [
            pin("A", "ground.O", "box.center", "slide", angle=0.2),
            pin("B", "box.center", "rod.start"),
        ],
    )
    end = (0.5 * math.cos(8.0), 0.5 * math.sin(8.0))
    begin = {"box": (0, 0, turn, 0, 0, 0), "rod": (*end, 8.0, 0, 0, 0)}
    found = moved(scene, begin, np.linspace(0, 0.01, 3), 1e-3)
    assert found.states["box"][:, ANGLE] == pytest.approx(turn, abs=1e-14)
    assert found.states["rod"][0, ANGLE] == pytest.approx(8.0, abs=1e-14)


def test_the_floor_carries_a_disk_from_the_start() -> None:
    """Settled at the depth where it neither falls nor rises, also under a sine's first push."""
    push = Push("push", Anchor("wheel", "center"), Signal("sine", (0.0, -30.0), 5.0, math.pi / 2))
    scene = replace(
        still({"wheel": WHEEL}, []),
        contacts={"touch": Contact("touch", Anchor("wheel", "center"), 0.5, 0.5, ideal="rolling")},
        forces={"push": push},
    )
    begin = {"wheel": (0.0, 0.3, 0.0, 0.0, 0.0, 0.0)}
    found = moved(scene, begin, np.linspace(0, 0.01, 3), 1e-4, reactions=("touch.normal",))
    assert found.reactions["touch.normal"][0] == pytest.approx(39.8, rel=1e-9)
    assert "in the floor" in planned(TUNED, scene, begin).protocol(1e-4)
    assert not planned(SHIPPED, scene, begin).protocol(1e-4)
    assert TUNED.measure(scene, begin)["momentum.y"] == 0.0


def test_a_wanted_size_is_that_of_the_components() -> None:
    c = case("double_pendulum")
    wanted = tuple(f"elbow.{field}" for field in ("fx", "fy", "force"))
    found = moved(c.scene, start(c), c.times[:3], 1e-3, reactions=wanted).reactions
    assert found["elbow.force"] == pytest.approx(np.hypot(found["elbow.fx"], found["elbow.fy"]))
