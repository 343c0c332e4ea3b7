"""Forces that jump inside a step: an engine is given the mean, and so the right momentum."""

import numpy as np
import pytest
from given.planning import TUNED, every, moved

from textmech.cases.joint import Joint
from textmech.cases.scene import Anchor, GroundPoint, Push, Scene, Signal
from textmech.cases.shape import particle
from textmech.engines import signal
from textmech.engines.mujoco.law.signal import Corners

M, F = 1.5, 6.0
TIMES = np.linspace(0.0, 1.0, 11)
LAWS = {
    "step": Signal("step", (F, 0.0), times=(0.21374,)),
    "pulse": Signal("pulse", (F, 0.0), times=(0.21374, 0.21412)),
    "table": Signal("table", (F, 0.0), times=(0.21374, 0.5, 0.70777), values=(0.0, 1.0, -0.4)),
}
ENGINES = {"mujoco": 1e-3, "pymunk": 1e-3}


def scene(law: str) -> Scene:
    rail = Joint("rail", "slide", Anchor("ground", "O"), Anchor("cart", "center"))
    push = Push("hand", Anchor("cart", "center"), LAWS[law])
    cart = particle(name="cart", mass=M)
    return Scene(
        (0.0, 0.0),
        {"O": GroundPoint((0.0, 0.0))},
        {"cart": cart},
        {"rail": rail},
        {},
        {"hand": push},
    )


def off(engine: str, law: str) -> float:
    """How far [m/s] the speed at the samples is from the force's area over the mass."""
    built = scene(law)
    found = moved(TUNED[engine], built, {"cart": (0.0,) * 6}, TIMES, ENGINES[engine])
    fine = np.linspace(0.0, 1.0, 1_000_001)  # a corner of LAWS is a whole number of these
    area = np.concatenate([[0.0], np.cumsum(LAWS[law].at(fine[:-1] + 5e-7)[:, 0])]) * 1e-6
    return float(np.max(np.abs(found.states["cart"][:, 3] - area[::100_000] / M)))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("engine", ENGINES)
def test_the_momentum_is_that_of_the_force(engine: str, law: str) -> None:
    assert off(engine, law) < 1e-11


@pytest.mark.parametrize("law", LAWS)
def test_every_step_can_be_kept(law: str) -> None:
    """MuJoCo's own loop, which records them, knows no step of its own: ours takes its place."""
    start = {"cart": (0.0,) * 6}
    one = moved(TUNED["mujoco"], scene(law), start, TIMES, 1e-3)
    other = moved(TUNED["mujoco"], scene(law), start, TIMES, 1e-3, record=True)
    assert np.array_equal(one.states["cart"], other.states["cart"])
    assert np.array_equal(every(other).states["cart"][::100], one.states["cart"])


@pytest.mark.mutant("a {law} of a force inside a step that is not cut")
@pytest.mark.parametrize("law", ["step", "pulse"])
def test_a_force_sampled_inside_the_step_is_seen(law: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Corners, "_touched", lambda self: iter(()))
    monkeypatch.setattr(signal, "touches", lambda *given: False)
    for engine in ENGINES:
        assert off(engine, law) > 1e-4
