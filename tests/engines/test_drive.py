"""Prescribed rates in every engine that has them: motion, what the drive exerts, refusals."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.adapters.planning import TUNED, apart, every, moved, refused

from textmech.cases.scene import Anchor, GroundPoint, Push, Scene, Signal
from textmech.cases.scene.joint import planar_joint
from textmech.cases.scene.shape import disk, particle
from textmech.engines import make, signal
from textmech.engines.engine import Engine
from textmech.engines.mujoco.callbacks.signal import Corners
from textmech.engines.mujoco.read import reaction
from textmech.engines.pymunk.read import samples
from textmech.engines.pymunk.stepping import run as told
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

# The knee is named backward, from the shank to the ground, and has all that may act beside a drive.
LEG = """\
scene:
  points: {O: [0, 0]}
  bodies: {shank: {bar: {mass: 1.2, length: 0.8}}, foot: {bar: {mass: 0.4, length: 0.3}}}
  joints: {knee: {pin: [shank.start, ground.O]}, ankle: {pin: [shank.end, foot.start]}}
  forces:
    coil: {torsion: knee, stiffness: 10.0, rest_angle: 0.3}
    oil: {torsion_damper: knee, damping: 0.4}
    help: {motor: knee, sine: {amplitude: 1.5, angular_frequency: 4.0}}
    hand: {push: foot.end, constant: [2.0, 1.0]}
  drive: {knee.omega: {table: {times: [0, 0.3141, 0.8], values: [0, 2.0, -1.0]}}}
initial: {knee: {angle: 0}, ankle: {angle: 20 deg, omega: 1.0}}
allow: {knee.angle: 1.0e-2, knee.torque: 1.0, foot.angle: 1.0}
"""
# Measured: MuJoCo 1.4e-6 rad and 1e-5 N, as a corner lies inside a step; pymunk 1.2e-5 rad.
REACHED = {"mujoco": 1e-5, "pymunk": 5e-5}
FORCES = ("knee.fx", "knee.fy", "knee.torque")


def off(engine: str, folder: Path) -> tuple[float, float]:
    """Of the motion [rad, m], and of what holds and drives the knee [N, N m]."""
    case = scenes.typed(folder, LEG, tail=scenes.tail(1.0, 11))
    known = solve(case).trajectory
    wanted = FORCES if engine == "mujoco" else ()
    found = moved(TUNED[engine], case.scene, first(known), case.times, 5e-4, reactions=wanted,
                  realised="law" if engine == "pymunk" else "native")  # fmt: skip
    forces = [np.max(np.abs(found.reactions[n] - known.reactions[n])) for n in wanted]
    return float(apart(known, found)[:3].max()), float(max(forces, default=0.0))


@pytest.mark.slow
@pytest.mark.parametrize("engine", REACHED)
def test_engines_move_as_the_reference(engine: str, tmp_path: Path) -> None:
    motion, forces = off(engine, tmp_path)
    assert motion < REACHED[engine]
    assert forces < 1e-4


ARM = """\
scene:
  points: {O: [0, 0]}
  bodies: {arm: {bar: {mass: 1.2, length: 0.8}}}
  joints: {hinge: {pin: ENDS}}
  forces: {help: {motor: hinge, constant: 1.5}}
  drive: {hinge.omega: 2.0}
initial: {hinge: {angle: 0}}
allow: {hinge.angle: 1.0e-2, hinge.torque: 1.0}
"""


@pytest.mark.parametrize(
    ("ends", "way"), [("[ground.O, arm.start]", 1.0), ("[arm.start, ground.O]", -1.0)]
)
def test_a_motor_helps_the_drive(ends: str, way: float, tmp_path: Path) -> None:
    """At an even rate both carry the weight alone: M_drive + M_motor = m g (l/2) cos φ."""
    scene = scenes.typed(tmp_path, ARM.replace("ENDS", ends)).scene
    start = {"arm": (0.4, 0.0, 0.0, 0.0, way * 2.0 * 0.4, way * 2.0)}
    times = np.linspace(0.0, 0.1, 6)
    found = moved(TUNED["mujoco"], scene, start, times, 5e-4, reactions=("hinge.torque",))
    weight = 1.2 * 9.80665 * 0.4 * np.cos(2.0 * times)
    # measured 2e-15 N m: rounding of some 5 N m
    np.testing.assert_allclose(found.reactions["hinge.torque"], way * weight - 1.5, atol=1e-13)


@pytest.mark.slow
@pytest.mark.mutant("torques about a joint counted as the drive's")
def test_what_else_acts_about_the_joint_is_not_the_drive_s(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "TORQUES", {})
    assert off("mujoco", tmp_path)[1] > 1.0


@pytest.mark.slow
@pytest.mark.mutant("a motor of pymunk that is told the present rate")
def test_a_motor_told_the_present_rate_is_late(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = told.turned
    monkeypatch.setattr(
        told, "turned", lambda world, step, *, midpoint: sound(world, step, midpoint=False)
    )
    assert off("pymunk", tmp_path)[0] > 1e-4


def test_refusals(tmp_path: Path) -> None:
    rail = LEG.replace(
        "ankle: {pin: [shank.end, foot.start]}",
        "ankle: {slide: [shank.end, foot.start], along: [1, 0]}",
    )
    rail = rail.replace("drive: {", "drive: {ankle.speed: 0.2, ").replace(
        "ankle: {angle: 20 deg, omega: 1.0}", "ankle: {shift: 0}"
    )
    scene = scenes.typed(tmp_path, rail).scene
    assert refused(TUNED["pymunk"], scene) == (
        "engine: pymunk has no motor along a line, as ankle.speed is driven"
    )
    loop = LEG.replace("ankle: {pin", "tip: {pin: [ground.Q, foot.end]}, ankle: {pin")
    loop = loop.replace("O: [0, 0]", "O: [0, 0], Q: [1.0, 0]").replace(
        "drive: {", "drive: {tip.omega: 1, ankle.omega: 1, "
    )
    said = refused(TUNED["mujoco"], scenes.typed(tmp_path, loop).scene)
    assert said is not None
    assert said.endswith("is driven and closes a loop, where MuJoCo has no joint")


# Forces that jump inside a step: an engine is given the mean, and so the right momentum.


M, F = 1.5, 6.0
TIMES = np.linspace(0.0, 1.0, 11)
LAWS = {
    "step": Signal("step", (F, 0.0), times=(0.21374,)),
    "pulse": Signal("pulse", (F, 0.0), times=(0.21374, 0.21412)),
    "table": Signal("table", (F, 0.0), times=(0.21374, 0.5, 0.70777), values=(0.0, 1.0, -0.4)),
}
# Every corner where a step of 1 ms ends, some of which times are not that of the step in a double.
ON_STEPS = {
    "step": Signal("step", (F, 0.0), times=(0.3,)),
    "pulse": Signal("pulse", (F, 0.0), times=(0.3, 0.569)),
    "table": Signal("table", (F, 0.0), times=(0.3, 0.501, 0.7), values=(0.0, 1.0, -0.4)),
}
ENGINES = {"mujoco": 1e-3, "pymunk": 1e-3}


def scene(law: Signal) -> Scene:
    rail = planar_joint("rail", "slide", Anchor("ground", "O"), Anchor("cart", "center"))
    push = Push("hand", Anchor("cart", "center"), law)
    cart = particle(name="cart", mass=M)
    return Scene(
        (0.0, 0.0),
        {"O": GroundPoint((0.0, 0.0))},
        {"cart": cart},
        {"rail": rail},
        {},
        {"hand": push},
    )


def momentum_off(engine: str, law: Signal) -> float:
    """How far [m/s] the speed at the samples is from the force's area over the mass."""
    built = scene(law)
    found = moved(TUNED[engine], built, {"cart": (0.0,) * 6}, TIMES, ENGINES[engine])
    fine = np.linspace(0.0, 1.0, 1_000_001)  # a corner is a whole number of these
    area = np.concatenate([[0.0], np.cumsum(law.at(fine[:-1] + 5e-7)[:, 0])]) * 1e-6
    return float(np.max(np.abs(found.states["cart"][:, 3] - area[::100_000] / M)))


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("engine", ENGINES)
def test_the_momentum_is_that_of_the_force(engine: str, law: str) -> None:
    assert momentum_off(engine, LAWS[law]) < 1e-11
    assert momentum_off(engine, ON_STEPS[law]) < 1e-11


@pytest.mark.parametrize("law", LAWS)
def test_every_step_can_be_kept(law: str) -> None:
    """MuJoCo's own loop, which records them, knows no step of its own: ours takes its place."""
    start = {"cart": (0.0,) * 6}
    one = moved(TUNED["mujoco"], scene(LAWS[law]), start, TIMES, 1e-3)
    other = moved(TUNED["mujoco"], scene(LAWS[law]), start, TIMES, 1e-3, record=True)
    assert np.array_equal(one.states["cart"], other.states["cart"])
    assert np.array_equal(every(other).states["cart"][::100], one.states["cart"])


@pytest.mark.mutant("a {law} of a force inside a step that is not cut")
@pytest.mark.parametrize("law", ["step", "pulse"])
def test_a_force_sampled_inside_the_step_is_seen(law: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Corners, "_touched", lambda self: iter(()))
    monkeypatch.setattr(signal, "touches", lambda *given: False)
    for engine in ENGINES:
        assert momentum_off(engine, LAWS[law]) > 1e-4


@pytest.mark.mutant("a {law} of a force that begins where a step ends, told to its last stage")
@pytest.mark.parametrize("law", ["step", "pulse"])
def test_a_stage_at_the_end_of_a_step_that_knows_the_jump_is_seen(
    law: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A sixth of a step's momentum: RK4 weighs its last stage so."""
    after = lambda self: (  # noqa: E731
        round(corner / self.step) for law in self.laws for corner in law.corners
    )
    monkeypatch.setattr(Corners, "_touched", after)
    assert momentum_off("mujoco", ON_STEPS[law]) == pytest.approx(F * 1e-3 / 6 / M, rel=1e-6)


def pressed(setting: Engine, at: float) -> float:
    """How far [N] a rail's force is at worst from what acts after a push across it has begun."""
    law = Signal("step", (0.0, -F), times=(at,))
    times = np.array([0.0, 0.499, 0.5, 0.501, 0.6])
    found = moved(
        setting, scene(law), {"cart": (0.0,) * 6}, times, 1e-3, reactions=("rail.force",)
    ).reactions["rail.force"]
    return float(np.max(np.abs(np.abs(found) - F * (times >= at))))


@pytest.mark.mutant("the force at a sample is the mean of what acts before and after its jump")
@pytest.mark.parametrize("at", [0.5, 0.4996, 0.5004])
def test_a_force_at_a_corner_is_what_acts_after_it(
    at: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ENGINES:
        assert pressed(TUNED[name], at) < 1e-9
    weights = samples._weights
    monkeypatch.setattr(samples, "_weights", lambda n, mid, corners: weights(n, mid, corners[:0]))
    assert pressed(TUNED["pymunk"], at) > 0.1 * F


@pytest.mark.mutant("the force at a sample is what led to its jump")
def test_a_force_as_shipped_is_what_acts_after_a_corner(monkeypatch: pytest.MonkeyPatch) -> None:
    shipped = make("pymunk", "shipped")
    assert pressed(shipped, 0.5) < 1e-9
    weights = samples._weights
    monkeypatch.setattr(samples, "_weights", lambda n, mid, corners: weights(n, mid, corners[:0]))
    assert pressed(shipped, 0.5) == pytest.approx(F)


RATES = Signal("table", (2.0,), times=(0.3, 0.501, 0.7), values=(0.0, 1.0, -0.4))


def turned(engine: str) -> tuple[float, float]:
    """How far the angle [rad] and the rate [rad/s] of a driven arm are from the law's."""
    hinge = planar_joint("hinge", "pin", Anchor("ground", "O"), Anchor("arm", "center"))
    built = Scene(
        (0.0, 0.0), {"O": GroundPoint((0.0, 0.0))},
        {"arm": disk(name="arm", mass=M, radius=0.2, points={})},
        {"hinge": hinge}, {}, {}, drives={"hinge.omega": RATES},
    )  # fmt: skip
    found = moved(TUNED[engine], built, {"arm": (0.0,) * 6}, TIMES, ENGINES[engine])
    rates = RATES.at(TIMES)[:, 0]
    fine = np.linspace(0.0, 1.0, 100_001)
    within = RATES.at((fine[1:] + fine[:-1]) / 2)[:, 0] * 1e-5  # lines between corners: exact
    angles = np.concatenate([[0.0], np.cumsum(within)])[::10_000]
    states = found.states["arm"]
    return float(np.max(np.abs(states[:, 2] - angles))), float(np.max(np.abs(states[:, 5] - rates)))


@pytest.mark.parametrize("engine", ENGINES)
def test_the_corners_of_a_drive_may_lie_on_steps(engine: str) -> None:
    """MuJoCo's angle and rate are exact there; pymunk's angle misses a kink by (Δα h²/4)."""
    angle, rate = turned(engine)
    assert angle < (1e-12 if engine == "mujoco" else 1e-5)
    assert rate < 1e-11


@pytest.mark.mutant("a corner of a drive where a step ends, told to its last stage")
def test_a_drive_told_its_corner_too_early_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    after = lambda self: (  # noqa: E731
        round(corner / self.step) for law in self.laws for corner in law.corners
    )
    monkeypatch.setattr(Corners, "_touched", after)
    assert turned("mujoco")[1] > 1e-4
