"""Friction at unrelated states: three writings of its laws, and mistakes planted in each."""

from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene import Bounds, Drag
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.reference.mechanism.forces import directional_drag as scrape
from textmech.reference.mechanism.forces import drag
from textmech.reference.states.answer import LAW, answered
from textmech.reference.systems.states import sliding_points

CASE = scenes.CLAIMS["sliding_points"]


def apart() -> float:
    """By hand against −∂D/∂ṙ, relative."""
    _, checks = answered(CASE)
    return max(check.difference for check in checks if check.name == "generated states")


@pytest.mark.slow
def test_by_hand_from_its_dissipation_and_as_observed() -> None:
    assert apart() < LAW
    found, _ = answered(CASE)
    bare = Trajectory(found.times, found.states, {})
    for name in CASE.allow:
        told = found.reactions[name]
        assert observe(CASE.scene, bare, name) == pytest.approx(told, abs=1e-12 * np.ptp(told))


def test_friction_takes_energy_and_of_an_edge_not_only_against_the_velocity() -> None:
    """Dry, the ball's always has its size μ F_N; the sled's is between F₊ and that of a slip."""
    found, _ = answered(CASE)
    ball = found.states["ball"][:, 3:5]
    pad = np.column_stack([found.reactions[f"pad.{field}"] for field in ("fx", "fy")])
    assert np.hypot(*pad.T) == pytest.approx(2.1, rel=1e-14)
    assert np.sum(pad * ball, axis=1) == pytest.approx(-2.1 * np.hypot(*ball.T), rel=1e-14)
    sizes = np.unique(np.round(found.reactions["scales.force"], 12))
    assert sizes == pytest.approx([np.hypot(1.5, 9.0), np.hypot(4.0, 9.0)])


PLANTED: dict[str, tuple[Any, str, Any]] = {
    "an edge that does not turn": (
        scrape, "_resolved", lambda law: lambda u, p: law(u, p._replace(angle=0.0 * p.angle)),
    ),
    "forward for backward": (
        scrape, "one_way", lambda law: lambda d, v: law(Bounds(d.backward, d.forward), v),
    ),
    "a power of an edge that is 1 % off": (
        scrape, "power_loss", lambda law: lambda d, a, square: law(d, 1.01 * a, square),
    ),
    "a power of a point that is 1 % off": (
        drag, "power_loss", lambda law: lambda d, a, square: law(d, 1.01 * a, square),
    ),
    "dry friction that pushes": (
        sliding_points, "coulomb", lambda law: lambda mu, F, v: -law(mu, F, v),
    ),
    "a wrong bound": (
        sliding_points, "stiction", lambda law: lambda dry, v, F: law(dry, -v, F),
    ),
}  # fmt: skip


@pytest.mark.mutant("sliding points: {planted}")
@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_mistake_is_seen(planted: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module, name, change = PLANTED[planted]
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    with pytest.raises(AssertionError):
        assert apart() < 1e-3


@pytest.mark.mutant("sliding points: an observed edge 0.1 rad off")
def test_an_observed_edge_that_does_not_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    found, _ = answered(CASE)
    turned = Trajectory(found.times, dict(found.states), {})
    turned.states["sled"][:, 2] += 0.1  # type: ignore[index]
    off = observe(CASE.scene, turned, "skate.fx") - found.reactions["skate.fx"]
    assert np.abs(off).max() > 0.1


def test_a_drag_without_an_edge_has_no_sides() -> None:
    runner = CASE.scene.forces["skate"]
    assert isinstance(runner, Drag)
    assert runner.ways == (Bounds(0.8, 1.9), Bounds(6.0, 6.0))
    assert runner.corner
    assert not CASE.scene.forces["air"].corner
    assert CASE.scene.forces["pad"].ends
