"""Pendula that a rope or a stop holds, and closed forms of what swings."""

import math
from dataclasses import replace
from typing import Any

import mpmath
import numpy as np
import pytest
from given import scenes
from given.laws.events import LOCATED, event_errors
from given.machines.examples import example
from given.otherwise import otherwise

from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array
from textmech.reference.mechanism.modes import unilateral
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.solve import solve
from textmech.reference.system import System
from textmech.reference.systems.bodies import spring_mass_damper
from textmech.reference.systems.pendula import stopped_pendulum
from textmech.reference.systems.pendula.ball_on_rope import BallOnRope
from textmech.reference.systems.pendula.stopped_pendulum import StoppedPendulum

# The closed form of the pendulum, by elliptic functions of another library.

_RATIOS = ("cd", "sd", "nd")  # Glaisher's cn/dn, sn/dn, 1/dn


@pytest.mark.parametrize("degrees", [24.6, -200.0, -89.0, 89.0, 89.999, 271.0, -269.999])
def test_bar_pendulum_closed_form_against_mpmath(degrees: float):
    """To 1e-13 over 10 s, if it is not released near the top.

    There the rounding of the angle of release, 1e-16 of 1, moves the later fall by
    1e-16 / cos(θ₀/2) s and more.
    """
    phi0 = math.radians(degrees)
    system = example("bar_pendulum", phi0=phi0)
    with mpmath.workdps(40):
        theta0 = mpmath.mpf(phi0) + mpmath.pi / 2
        theta0 -= 2 * mpmath.pi * mpmath.nint(theta0 / (2 * mpmath.pi))
        k, k1 = mpmath.sin(theta0 / 2), mpmath.cos(theta0 / 2)
        Omega = mpmath.sqrt(3 * mpmath.mpf(9.80665) / (2 * mpmath.mpf(0.8)))
        for t in np.linspace(0.0, 10.0, 21):
            cd, sd, nd = (mpmath.ellipfun(f, Omega * mpmath.mpf(t), m=k**2) for f in _RATIOS)
            theta = 2 * mpmath.asin(k * cd)
            rate = -2 * Omega * k * k1**2 * sd * nd / mpmath.sqrt(1 - (k * cd) ** 2)
            known = system.closed_form(float(t))
            assert known is not None
            margin = 1e-13 + 3e-15 / float(k1)
            assert abs(known[0][0] - (mpmath.mpf(phi0) + theta - theta0)) < margin
            assert abs(known[1][0] - rate) < Omega * margin


# The closed form of a damped spring by the roots of its characteristic equation.

G = 9.80665  # m/s²
M, C, L0, Y0 = 1.3, 40.0, 0.4, -0.2
CRITICAL = 2 * np.sqrt(C * M)
TIMES = (0.1, 0.6, 1.7)


def by_roots(d: float, t: float) -> tuple[float, float]:
    """m r² + d r + c = 0: z = A e^{r₁t} + B e^{r₂t} about the rest, from rest."""
    one, other = np.roots([M, d, C]).astype(complex)
    rest = -L0 - M * G / C
    a, b = np.linalg.solve(np.array([[1, 1], [one, other]]), np.array([Y0 - rest, 0.0]))
    z = a * np.exp(one * t) + b * np.exp(other * t)
    return rest + z.real, (a * one * np.exp(one * t) + b * other * np.exp(other * t)).real


def off(part: float, module: Any = spring_mass_damper) -> float:
    """How far the closed form is from that, where damped so many times as critically."""
    d = part * CRITICAL
    system = module.SpringMassDamper(m=M, c=C, d=d, l0=L0, y0=Y0)
    found: list[Array] = [np.concatenate(system.closed_form(t)) for t in TIMES]
    return float(np.max(np.abs(np.array(found) - [by_roots(d, t) for t in TIMES])))


@pytest.mark.mutant("the hyperbolic cosine of an overdamped spring squared")
@pytest.mark.parametrize("part", [0.05, 0.7, 1.3, 8.0])
def test_the_closed_form_is_the_roots(part: float) -> None:
    assert off(part) < 1e-12  # 3e-15
    was = "(1 + math.exp(-2 * kappa * t)) / 2"
    squared = otherwise(spring_mass_damper, was, was.replace("/ 2", "** 2"))
    assert (off(part, squared) > 1e-2) == (part > 1)


# A ball on a rope: its events by known functions, what an impact leaves, and planted mistakes.

STRUCK = {"x0": 0.0, "y0": -1.0}
THROWN: dict[str, tuple[dict[str, float], list[str]]] = {
    "dropped beside the point": ({}, ["tightens"]),
    "dropped from above it": ({"x0": -0.3, "y0": 0.8}, ["tightens"]),
    "struck": (STRUCK | {"vx0": 6.0}, ["slackens", "tightens"]),
    "struck backward": (STRUCK | {"vx0": -6.3}, ["slackens", "tightens"]),
    "swings": (STRUCK | {"vx0": 4.0}, []),
    "goes round": (STRUCK | {"vx0": -7.5}, []),
}


def moved(changed: dict[str, float]) -> tuple[System, Followed]:
    system = example("ball_on_rope", **changed)
    return system, follow(system, np.linspace(0.0, 1.4, 29))


@pytest.mark.parametrize("how", THROWN)
def test_events_are_where_they_are_known_to_be(how: str) -> None:
    changed, names = THROWN[how]
    system, found = moved(changed)
    assert [event.name for event in found.events] == names
    assert max(event_errors(system, system, 1.4), default=0.0) <= LOCATED
    for t, mode, y in zip(np.linspace(0.0, 1.4, 29).tolist(), found.modes, found.y, strict=True):
        assert system.possible(mode, t, *np.split(y, 2)) is None


@pytest.mark.parametrize("how", ["dropped beside the point", "struck"])
def test_an_impact_takes_what_parts_the_ends_and_nothing_else(how: str) -> None:
    _, found = moved(THROWN[how][0])
    event = found.events[-1]
    (x, y, vx, vy), (*_, ux, uy) = event.before.tolist(), event.after.tolist()
    assert ux * x + uy * y == pytest.approx(0.0, abs=1e-12)
    assert x * uy - y * ux == pytest.approx(x * vy - y * vx, abs=1e-12)  # (2.27) about the point
    assert vx * x + vy * y > 0.5  # it does part them


def test_what_it_cannot_say_of_its_events() -> None:
    assert example("ball_on_rope", vx0=1.0).closed_events(1.0) is None
    above = example("ball_on_rope", **STRUCK, vx0=5.0)  # it comes above the point once more
    assert [name for name, _ in above.closed_events(0.7) or []] == ["slackens"]
    assert above.closed_events(1.4) is None


def thrown_back(self: BallOnRope, t: float, q: Any, v: Any) -> Any:
    n = q / np.linalg.norm(q)
    return "swings", self.L * n, v - 1.01 * (v @ n) * n


def stopped(self: BallOnRope, t: float, q: Any, v: Any) -> Any:
    n = q / np.linalg.norm(q)
    return "swings", self.L * n, 0.99 * (v - (v @ n) * n)


@pytest.mark.slow
@pytest.mark.mutant("a ball {wrong} by 1 % too much where its rope tightens")
@pytest.mark.parametrize("wrong", [thrown_back, stopped])
def test_a_wrong_impact_is_seen(wrong: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(BallOnRope, "_caught", wrong)
    broken = [c.name for c in solve(scenes.SHIPPED["ball_on_rope.caught"]).checks if not c.holds]
    assert "generated motion" in broken


@pytest.mark.slow
@pytest.mark.mutant("a ball that flies only once its rope pushes")
def test_a_flight_that_begins_too_late_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """It lets go where it already pushes a little."""
    guards = BallOnRope.guards

    def late(self: BallOnRope, mode: str) -> Any:
        (guard,) = guards(self, mode)
        shift = 1e-6 if mode == "swings" else 0.0
        return (type(guard)(guard.event, lambda t, q, v: guard.g(t, q, v) + shift, guard.then),)

    monkeypatch.setattr(BallOnRope, "guards", late)
    case = scenes.SHIPPED["ball_on_rope.let_go"]
    assert {"generated events", "closed events"} <= {
        check.name for check in solve(case).checks if not check.holds
    }


# A bar against a stop: strikes by elliptic integrals, what is left after one, planted mistakes.

SWUNG: dict[str, tuple[dict[str, float], int]] = {
    "rests": ({}, 1),
    "thrown back": ({"e": 0.7}, 4),
    "thrown back whole": ({"e": 1.0}, 3),
    "stopped where it hangs": ({"e": 0.5, "low": -math.pi / 2}, 3),
}


@pytest.mark.parametrize("how", SWUNG)
def test_strikes_are_where_they_are_known_to_be(how: str) -> None:
    changed, strikes = SWUNG[how]
    system, times = example("stopped_pendulum", **changed), np.linspace(0.0, 2.0, 41)
    found = follow(system, times)
    assert [event.name for event in found.events] == ["strikes"] * strikes
    assert max(event_errors(system, system, 2.0)) <= LOCATED
    for event in found.events:
        assert event.after[1] == pytest.approx(-changed.get("e", 0.0) * event.before[1], abs=1e-15)


@pytest.mark.slow
def test_what_rests_on_a_stop_presses_with_the_moment_of_its_weight() -> None:
    case = scenes.SHIPPED["stopped_pendulum.rests"]
    torque = observe(case.scene, scenes.solved(case.name).trajectory, "stop.torque")
    assert torque[0] == 0.0
    assert torque[-1] == pytest.approx(1.2 * 9.80665 * 0.4 * math.cos(math.pi / 3), rel=1e-13)


def broken() -> set[str]:
    case = scenes.SHIPPED["stopped_pendulum.thrown_back"]
    return {check.name for check in solve(case).checks if not check.holds}


@pytest.mark.slow
@pytest.mark.mutant("restitution 0.71 for 0.7 in the generated stop")
def test_another_restitution_in_the_generated_mechanism_is_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made: Any = unilateral.Stopped.__init__

    def livelier(self: Any, **given: Any) -> None:
        made(self, **given | {"restitution": 0.71})

    monkeypatch.setattr(unilateral.Stopped, "__init__", livelier)
    assert {"generated motion", "generated events"} <= broken()


@pytest.mark.slow
@pytest.mark.mutant("a stop 1e-6 rad elsewhere in the hand-written system")
def test_a_stop_elsewhere_in_the_hand_written_system_is_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    guards = StoppedPendulum.guards

    def early(self: StoppedPendulum, mode: str) -> Any:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) - 1e-6) for g in guards(self, mode)]

    monkeypatch.setattr(StoppedPendulum, "guards", early)
    assert {"generated events", "closed events"} <= broken()


@pytest.mark.slow
@pytest.mark.mutant("Steiner term left out of the stopped bar")
def test_a_lost_steiner_term_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    def lonely(self: Any, t: float, q: Any, v: Any) -> Any:
        return np.array([0.0 if self.rests else -6.0 * 9.80665 / self.l * math.cos(q[0])])

    monkeypatch.setattr(stopped_pendulum._Bar, "accelerations", lonely)
    assert "generated motion" in broken()
