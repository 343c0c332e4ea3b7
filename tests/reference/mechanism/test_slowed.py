"""What goes with a velocity, in the generated mechanism: typed forces, laws, planted mistakes."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes, slowed
from given.multibody_laws import EXACT, balance, lagrangian

from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.forces.action import actions
from textmech.reference.mechanism.forces.ingredients import Ingredients
from textmech.reference.mechanism.kinematics.frame import Vec
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve


def built(folder: Path) -> Multibody:
    return scenes.mechanism(scenes.typed(folder, slowed.SLOWED)).base


def violated(mode: Multibody) -> float:
    """(2.60) and (2.51) at the start, and on the way back from there."""
    q, v = mode.start()
    return max(law(mode, 0.0, q, way * v) for law in (lagrangian, balance) for way in (1.0, -1.0))


def test_laws_and_typed_forces(tmp_path: Path) -> None:
    """Of the bob alone: drag 0.3 |v|^1.5 against v, and 2.1 N s/m × v to its right."""
    mode = built(tmp_path)
    assert violated(mode) < EXACT
    q, v = mode.start()
    speed = math.hypot(1.5, -0.4)
    size = 0.3 * speed**1.5 / speed
    expected = [-size * 1.5 + 2.1 * -0.4, size * 0.4 - 2.1 * 1.5 - 0.5 * 9.80665]
    assert mode.applied(0.0, q, v)[-2:] == pytest.approx(expected, rel=1e-14)


@pytest.mark.slow
def test_quantities_and_certificate(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, slowed.SLOWED)
    solution = solve(case)
    assert solution.holds
    assert {"2.48", "2.49", "2.84", "2.86"} <= solution.equations
    motion = solution.trajectory
    speed, force = (observe(case.scene, motion, f"oil.{field}") for field in ("speed", "force"))
    assert observe(case.scene, motion, "air.force")[0] == pytest.approx(0.4 * 1.6**2, rel=1e-12)
    assert min(speed) < -0.05
    assert max(speed) > 0.1
    d = np.where(speed > 0, 0.8, 1.7)
    np.testing.assert_allclose(force, -d * speed * np.sqrt(np.abs(speed)), rtol=1e-12)


def test_speed_along_a_slide_that_turns(tmp_path: Path) -> None:
    """d/dt u·(r_B − r_A), by the difference of two samples that are 0.2 ms apart."""
    case = scenes.typed(tmp_path, slowed.SLOWED, tail=scenes.tail(4e-4, 5))
    motion = solve(case).trajectory
    rod, cart = motion.states["rod"], motion.states["cart"]
    turn, lie = rod[:, 2] + math.atan2(0.3, 1.0), cart[:, 2]
    at = cart[:, :2] + np.column_stack(
        [0.1 * np.cos(lie) - 0.05 * np.sin(lie), 0.1 * np.sin(lie) + 0.05 * np.cos(lie)]
    )
    along = np.sum((at - rod[:, :2]) * np.column_stack([np.cos(turn), np.sin(turn)]), axis=1)
    slope = (along[3] - along[1]) / (motion.times[3] - motion.times[1])
    assert observe(case.scene, motion, "oil.speed")[2] == pytest.approx(slope, rel=1e-5)


def opposite(loads: Any) -> Any:
    return lambda *given: [(part, -F, None if M is None else -M) for part, F, M in loads(*given)]


def straight(along: Any) -> Any:
    """A rail that does not turn."""

    def planted(self: Any, k: Any) -> Any:
        a, b, _, _ = along(self, k)
        u = Vec((1.0, 0.3))
        return a, b, u, u @ (b.r_dot - a.r_dot)

    return planted


PLANTED: dict[str, tuple[Any, str, Any]] = {
    "power law with the wrong sign": (action, "power_law", lambda law: lambda *n: -law(*n)),
    "drag with the wrong sign": (action.Dragged, "loads", opposite),
    "magnetic force of −e": (action.Deflected, "loads", opposite),
    "another power": (
        action, "power_law", lambda law: lambda d, alpha, v: law(d, alpha + 0.01, v),
    ),
    "a dissipation of another power": (
        action.Lost, "__call__", lambda law: lambda *given: law(*given) * 1.01,
    ),
}  # fmt: skip
SHARED: dict[str, tuple[Any, str, Any]] = {
    "the coefficient of the other way": (
        action, "one_way", lambda law: lambda d, speed: law(d, -speed),
    ),
    "a rail that does not turn": (action.Slowed, "_along", straight),
}  # fmt: skip


@pytest.mark.mutant("what goes with a velocity: {planted}")
@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_mistake_is_seen_by_the_laws(
    planted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module, name, change = PLANTED[planted]
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    assert violated(built(tmp_path)) > 1e-4


@pytest.mark.slow
@pytest.mark.mutant("what goes with a velocity: {planted}")
@pytest.mark.parametrize("planted", SHARED)
def test_what_both_derivations_share_is_seen_by_quantities(
    planted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The power that the cart and the rod lose in the rail is force × speed, as observed."""
    module, name, change = SHARED[planted]
    mode, case = built(tmp_path), scenes.typed(tmp_path, slowed.SLOWED)
    motion = solve(case).trajectory
    speed, force = (observe(case.scene, motion, f"oil.{field}")[0] for field in ("speed", "force"))
    q, v = mode.start()

    def lost() -> float:
        oil = actions([case.scene.forces["oil"]])
        return Ingredients(mode.where, oil).D(0.0, q, v) * 2.5

    assert lost() == pytest.approx(-force * speed, rel=1e-12)
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    assert abs(lost() + force * speed) > 1e-2 * abs(force * speed)
