"""The simplest walker: its limit cycle, found again by other means, and published numbers."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from given.walkers import SLOPE, returned
from scipy.integrate import solve_ivp

from textmech.reference.motion.cycle import Cycle, NoCycle, cycle, derivative
from textmech.reference.system import Array
from textmech.reference.systems.walkers.simplest_walker import G, SimplestWalker

# Garcia, Chatterjee, Ruina and Coleman 1998, for a slope of 0.009 and legs of one unit: given to 13
# digits or so; the time in √(l/g).
PUBLISHED = (0.200310900544287, -0.199832473004977)
LASTS = 3.882


def walker(x: Array, *, slope: float = SLOPE, l: float = G) -> SimplestWalker:
    """With l = g the time is that of the paper."""
    return SimplestWalker(l, slope, float(x[0]), float(x[1]))


@cache
def found(slope: float = SLOPE) -> Cycle:
    return cycle(lambda x: returned(walker(x, slope=slope), (0, 2))[0], np.array([0.2, -0.2]))


@pytest.mark.slow
def test_limit_cycle_is_the_published_one():
    assert found().error < 1e-14
    assert found().state == pytest.approx(PUBLISHED, abs=1e-12)
    after, lasts = returned(walker(found().state), (0, 2))
    assert after == pytest.approx(found().state, abs=1e-14)
    assert lasts == pytest.approx(LASTS, abs=1e-3)


def slopes(t: float, y: Array) -> Array:
    """(θ, φ, θ̇, φ̇) and a 4 × 4 matrix of its variations, in units of √(l/g)."""
    theta, phi, theta_dot, _ = y[:4]
    sin, cos = math.sin(theta - SLOPE), math.cos(theta - SLOPE)
    pulled = theta_dot**2 - cos
    f = [y[2], y[3], sin, sin + pulled * math.sin(phi)]
    jacobian = np.zeros((4, 4))
    jacobian[0, 2] = jacobian[1, 3] = 1.0
    jacobian[2, 0] = cos
    jacobian[3] = [
        cos + sin * math.sin(phi),
        pulled * math.cos(phi),
        2 * theta_dot * math.sin(phi),
        0.0,
    ]
    return np.concatenate([f, (jacobian @ y[4:].reshape(4, 4)).ravel()])


@pytest.mark.slow
def test_multipliers_are_those_of_the_variational_equations():
    """Φ along the step, then what a later or earlier strike makes of it, then the impact."""
    theta, theta_dot = found().state
    start = [theta, 2 * theta, theta_dot, (1 - math.cos(2 * theta)) * theta_dot]
    # how the state after a strike follows from θ and θ̇
    enters = np.array(
        [
            [1.0, 0.0],
            [2.0, 0.0],
            [0.0, 1.0],
            [2 * math.sin(2 * theta) * theta_dot, 1 - math.cos(2 * theta)],
        ]
    )

    def strikes(t: float, y: Array) -> float:
        return float(y[1] - 2 * y[0]) if t > 2.0 else -1.0

    strikes.terminal = True  # type: ignore[attr-defined]
    y0 = np.concatenate([start, np.eye(4).ravel()])
    run: Any = solve_ivp(slopes, (0.0, 5.0), y0, "DOP853", events=strikes, rtol=1e-13, atol=1e-14)
    end, phi = run.y_events[0][0][:4], run.y_events[0][0][4:].reshape(4, 4)
    flow, normal = slopes(0.0, run.y_events[0][0])[:4], np.array([-2.0, 1.0, 0.0, 0.0])
    phi = phi - np.outer(flow, normal @ phi) / (normal @ flow)
    a, w = float(end[0]), float(end[2])
    leaves = np.array([[-1.0, 0, 0, 0], [-2 * math.sin(2 * a) * w, 0, math.cos(2 * a), 0]])
    values = np.linalg.eigvals(leaves @ phi @ enters)
    assert np.sort_complex(values) == pytest.approx(np.sort_complex(found().multipliers), abs=1e-10)


@pytest.mark.slow
@pytest.mark.mutant(
    "simplest walker: no slope",
    "simplest walker: a strike that keeps all speed",
    "simplest walker: a swinging leg that the hip does not pull",
)
@pytest.mark.parametrize("wrong", ["gravity", "impact", "swing"])
def test_a_mistake_is_seen_in_the_cycle(wrong: str, monkeypatch: pytest.MonkeyPatch):
    """Gravity straight down; a strike that keeps all; a swinging leg that the hip does not pull."""
    x = found().state
    if wrong == "gravity":
        off = walker(x, slope=0.0)
    elif wrong == "impact":
        off = walker(np.array([x[0], x[1] / math.cos(2 * x[0])]))
    else:
        off = walker(x)
        mode: Any = off.modes["lifts"]
        sound = type(mode).accelerations

        def pulled(self: Any, t: float, q: Array, v: Array) -> Array:
            return sound(self, t, q, v) - [0.0, v[0] ** 2 * math.sin(q[1])]

        monkeypatch.setattr(type(mode), "accelerations", pulled)
    with pytest.raises((AssertionError, IndexError)):
        assert returned(off, (0, 2))[0] == pytest.approx(x, abs=1e-4)


def test_a_map_without_a_fixed_point_is_said():
    with pytest.raises(NoCycle, match="no cycle near"):
        cycle(lambda x: np.array([math.cos(x[0]) + x[0] + 2.0]), np.array([0.3]))


def test_derivative_is_of_eighth_order():
    slope = derivative(lambda x: np.exp(x), np.array([1.0]), part=0.1)
    assert slope[0, 0] == pytest.approx(math.e, rel=1e-10)
    assert slope[0, 0] != pytest.approx(math.e, rel=1e-14)
