"""Forces that jump inside a step: an engine is given the mean, and so the right momentum."""

import numpy as np
import pytest
from given.planning import TUNED, every, moved

from textmech.cases.scene import Anchor, GroundPoint, Push, Scene, Signal
from textmech.cases.scene.joint import planar_joint
from textmech.cases.scene.shape import disk, particle
from textmech.engines import make, signal
from textmech.engines.engine import Engine
from textmech.engines.mujoco.callbacks.signal import Corners
from textmech.engines.pymunk.read import samples

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


def off(engine: str, law: Signal) -> float:
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
    assert off(engine, LAWS[law]) < 1e-11
    assert off(engine, ON_STEPS[law]) < 1e-11


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
        assert off(engine, LAWS[law]) > 1e-4


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
    assert off("mujoco", ON_STEPS[law]) == pytest.approx(F * 1e-3 / 6 / M, rel=1e-6)


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
