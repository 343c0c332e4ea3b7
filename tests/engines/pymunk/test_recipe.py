"""pymunk's tuned recipe: each of its numbers is needed, for without it a bound is broken."""

from dataclasses import replace

import numpy as np
import pytest
from given.closed_motions import drawn, pendulum
from given.engine_scenes import BLOCK, DRAWN, RESTS, guided, incline, thrown, touching
from given.planning import TUNED, begun, every, moved
from given.scenes import SHIPPED
from given.swings import energy_drift, swing_error

from textmech.cases.scene import Bounds, DryFriction, Joint
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import ANGLE, X, Y
from textmech.engines.engine import Choice
from textmech.engines.pymunk.callbacks import friction
from textmech.engines.pymunk.settings.recipe import Recipe
from textmech.engines.pymunk.stepping import scene as builder
from textmech.reports.compare.events.times import engine_events

ENGINE = TUNED["pymunk"]
STEP = 1e-4


def without(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """The tuned recipe without one of its numbers."""
    whole = Recipe.__call__
    monkeypatch.setattr(
        Recipe, "__call__", lambda self, h: [c for c in whole(self, h) if c.name != name]
    )


@pytest.mark.slow
@pytest.mark.parametrize("number", ["constraint.error_bias", "time.midpoint"])
def test_a_pendulum_misses_its_bar_without(monkeypatch: pytest.MonkeyPatch, number: str) -> None:
    without(monkeypatch, number)
    scene, start = begun("bar_pendulum")
    times = SHIPPED["bar_pendulum"].times
    run = moved(ENGINE, scene, start, times, STEP)
    error = np.abs(run.states["bar"][:, ANGLE] - pendulum(times)[0]).max()
    assert error > 10 * 2e-5  # rad, the case's reach


def test_a_wheel_that_only_touches_falls_for_one_step(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "start.seed")
    scene, start = begun("rolling_wheel.downhill")
    run = moved(ENGINE, scene, start, SHIPPED["rolling_wheel.downhill"].times, 1e-3)
    assert np.abs(observe(scene, run, "touch.gap")).max() > 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "often"), [(1e-8, 1), (1e-9, 3)])
def test_a_ladder_uses_up_a_smaller_seed(
    monkeypatch: pytest.MonkeyPatch, seed: float, often: int
) -> None:
    """Then its contacts open for a step on the way, and its event happens three times."""
    whole = Recipe.__call__

    def seeded(self: Recipe, h: float) -> list[Choice]:
        return [replace(c, value=seed) if c.name == "start.seed" else c for c in whole(self, h)]

    monkeypatch.setattr(Recipe, "__call__", seeded)
    case, (scene, start) = SHIPPED["sliding_ladder"], begun("sliding_ladder")
    times, wanted = np.linspace(0.0, 0.6, 7), ("top.normal",)
    run = moved(ENGINE, scene, start, times, STEP, reactions=wanted, record=True)
    found = engine_events(scene, every(run), case.events["leaves"])
    assert len(found) == often
    assert abs(found[-1] - 0.5175626) < 2 * STEP


def test_a_block_falls_for_one_step_without_the_seed(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "start.seed")
    scene, times = incline(BLOCK, touching("block", 0.4)), np.linspace(0.0, 2.0, 21)
    run = moved(ENGINE, scene, thrown(1.0), times, STEP)
    assert np.abs(run.states["block"][:, Y]).max() > 1e-8


def test_a_slide_is_worse_where_a_user_would_put_the_groove(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def naive(world: builder.World, joint: Joint) -> tuple[tuple[float, float], ...]:
        (x, y), (ux, uy) = world.local(joint.a), joint.along
        return (x - 3 * ux, y - 3 * uy), (x + 3 * ux, y + 3 * uy), world.local(joint.b)

    monkeypatch.setattr(builder, "groove", naive)
    angle, force = swing_error(ENGINE, "slide")
    assert angle > 1e-4
    assert force > 0.1


def test_a_chain_with_the_default_iterations_gains_energy(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = Recipe.__call__
    monkeypatch.setattr(
        Recipe,
        "__call__",
        lambda self, h: [replace(c, value=10) if "iter" in c.name else c for c in whole(self, h)],
    )
    assert energy_drift(ENGINE, 12) > 1.0


@pytest.mark.mutant("friction of a whole step where a block breaks loose")
@pytest.mark.slow
def test_a_whole_step_at_the_onset_is_of_first_order(monkeypatch: pytest.MonkeyPatch) -> None:
    def plain(law: DryFriction, middle: float, end: float) -> float:
        return friction.dry_friction(law, 0.0, middle)

    monkeypatch.setattr(friction, "_from_rest", plain)
    times = np.linspace(0.0, 10.0, 101)
    run = moved(ENGINE, guided(DRAWN), RESTS, times, STEP, realised="law")
    assert 1e-7 < np.abs(run.states["block"][:, X] - drawn(times)).max() < 2 * STEP


@pytest.mark.parametrize("bounds", [(Bounds(2, 4), Bounds(1, 3)), (Bounds(1, 3), Bounds(1, 3))])
@pytest.mark.parametrize("speed", [0.0, 2e-3, -2e-3, 0.5])
@pytest.mark.parametrize("force", [-6.0, -3.5, 0.0, 1.9, 6.0])
def test_mean_over_a_step_is_the_law_stepped_finely(
    bounds: tuple[Bounds, Bounds], speed: float, force: float
) -> None:
    law, h, n = DryFriction(*bounds), 1e-3, 5000
    v, rate = speed, 20.0  # N/s
    for i in range(n):
        applied = force + rate * (i + 0.5) * h / n
        after = v + (applied + friction.dry_friction(law, v, applied)) * h / n
        v = 0.0 if after * v < 0 else after
    mean = friction.mean_friction(law, speed, 1.0, lambda ahead: force + rate * ahead, h)
    assert speed + (force + rate * h / 2 + mean) * h == pytest.approx(v, abs=2e-5)
