"""Drag by a power below 1 of the speed: free where others move the point, and no stop."""

import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.refused import refused
from scipy.integrate import solve_ivp

from textmech.reference.mechanism.modes import mechanism
from textmech.reference.solve import solve

G = 9.80665
BALL = """\
scene:
{gravity}  bodies: {{b: {{particle: {{mass: 0.3}}}}}}
  forces: {{air: {{drag: b.center, coefficient: {d}, exponent: {alpha}}}}}
initial: {{b: {{x: 0, y: 3, vx: {vx}, vy: {vy}}}}}
allow: {{b.y: 1.0e-3, air.force: 1.0e-2}}
"""
TAIL = scenes.tail(1.2, 25)


def text(vx: float, vy: float, alpha: float, *, d: float = 0.8, gravity: str = "") -> str:
    return BALL.format(vx=vx, vy=vy, alpha=alpha, d=d, gravity=gravity)


@pytest.mark.slow
@pytest.mark.parametrize("alpha", [0.3, 0.5, 0.9])
@pytest.mark.parametrize(("vx", "vy"), [(0.0, 0.0), (0.0, 4.0), (2.0, 4.0)])
def test_under_its_weight_it_never_stops(
    tmp_path: Path, alpha: float, vx: float, vy: float
) -> None:
    """Let go, thrown up so that it turns back at rest, or thrown: against scipy's integrator."""
    found = solve(scenes.typed(tmp_path, text(vx, vy, alpha), tail=TAIL))
    assert found.holds

    def rates(t: float, y: np.ndarray) -> list[float]:
        speed = math.hypot(y[2], y[3])
        k = 0.8 / 0.3 * speed ** (alpha - 1) if speed else 0.0
        return [y[2], y[3], -k * y[2], -G - k * y[3]]

    known = solve_ivp(rates, (0, 1.2), [0, 3, vx, vy], method="DOP853", rtol=1e-12, atol=1e-13)
    b = found.trajectory.states["b"][-1]
    assert b[[0, 1, 3, 4]] == pytest.approx(known.y[:, -1], abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("alpha", [0.3, 0.5, 0.9])
def test_alone_it_stops_and_is_refused_from_there_on(tmp_path: Path, alpha: float) -> None:
    """v^{1−α} = v₀^{1−α} − (1 − α) (d/m) t."""
    ends = 2.0 ** (1 - alpha) / ((1 - alpha) * 2.0 / 0.3)
    stops = text(2.0, 0.0, alpha, d=2.0, gravity="  gravity: none\n").replace("b.y", "b.x")
    mistake = refused(scenes.typed(tmp_path, stops, tail=scenes.tail(1.5 * ends, 25)))
    assert mistake.where == "scene.forces.air"
    # it is told where a millionth of the speed is left
    left = 1e-6 ** (1 - alpha) * ends
    told = float(mistake.what.split("t = ")[1].split(" s")[0])
    assert ends - 1.01 * left - 1e-3 * ends <= told <= ends * 1.001
    assert solve(scenes.typed(tmp_path, stops, tail=scenes.tail(0.7 * ends, 25))).holds


@pytest.mark.slow
@pytest.mark.mutant("a stop of drag by a power below 1 taken for a passing")
def test_a_stop_taken_for_a_passing_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mechanism, "OTHERS", 0.0)
    stops = text(2.0, 0.0, 0.5, gravity="  gravity: none\n").replace("b.y", "b.x")
    assert "stops b.center" not in refused(scenes.typed(tmp_path, stops, tail=TAIL)).what
