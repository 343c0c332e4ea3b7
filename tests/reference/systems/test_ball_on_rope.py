"""A ball on a rope: its events by known functions, what an impact leaves, and planted mistakes."""

from typing import Any

import numpy as np
import pytest
from given import scenes
from given.events import LOCATED, event_errors
from given.examples import example

from textmech.reference.motion.follow import Followed, follow
from textmech.reference.solve import solve
from textmech.reference.system import System
from textmech.reference.systems.pendula.ball_on_rope import BallOnRope

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
