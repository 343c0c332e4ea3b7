"""Friction at unrelated states: three writings of its laws, and mistakes planted in each."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene import Bounds, Drag
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.kinematics.frame import Vec
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


@pytest.mark.slow
def test_friction_takes_energy_and_of_an_edge_not_only_against_the_velocity() -> None:
    """Dry, the ball's always has its size μ F_N; the sled's is between F₊ and that of a slip."""
    found, _ = answered(CASE)
    ball = found.states["ball"][:, 3:5]
    pad = np.column_stack([found.reactions[f"pad.{field}"] for field in ("fx", "fy")])
    assert np.hypot(*pad.T) == pytest.approx(2.1, rel=1e-14)
    assert np.sum(pad * ball, axis=1) == pytest.approx(-2.1 * np.hypot(*ball.T), rel=1e-14)
    sizes = np.unique(np.round(found.reactions["scales.force"], 12))
    assert sizes == pytest.approx([np.hypot(1.5, 9.0), np.hypot(4.0, 9.0)])


def unturned(ways: Any) -> Any:
    """An edge along the axes of the ground, wherever its body is turned to."""

    def planted(self: Any, k: Any) -> Any:
        along, r_dot = Vec(self.force.along), k.point(self.force.at).r_dot
        both = (along, Vec((-along[1], along[0])))
        return [(d, e, e @ r_dot) for d, e in zip(self.force.ways, both, strict=True)]

    return planted


def powered(*, edge: bool) -> Any:
    """A power that is 1 % off, of edges or of points: these go all ways alike, and say 1."""

    def change(law: Any) -> Any:
        def planted(self: Any, squared: Any, way: Any) -> Any:
            alpha = self.alpha * (1.01 if edge == (way != 1.0) else 1.0)
            return law(replace(self, alpha=alpha), squared, way)

        return planted

    return change


PLANTED: dict[str, tuple[Any, str, Any]] = {
    "an edge that does not turn": (action.Dragged, "_ways", unturned),
    "forward for backward": (
        action, "one_way", lambda law: lambda d, v: law(Bounds(d.backward, d.forward), v),
    ),
    "a power of an edge that is 1 % off": (action.Lost, "__call__", powered(edge=True)),
    "a power of a point that is 1 % off": (action.Lost, "__call__", powered(edge=False)),
    "dry friction that pushes": (
        sliding_points, "coulomb", lambda law: lambda mu, F, v: -law(mu, F, v),
    ),
    "a wrong bound": (
        sliding_points, "stiction", lambda law: lambda dry, v, F: law(dry, -v, F),
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("sliding points: {planted}")
@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_mistake_is_seen(planted: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module, name, change = PLANTED[planted]
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    with pytest.raises(AssertionError):
        assert apart() < 1e-3


@pytest.mark.slow
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
