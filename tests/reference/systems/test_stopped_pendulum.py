"""A bar against a stop: strikes by elliptic integrals, what is left after one, planted mistakes."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.events import LOCATED, event_errors
from given.examples import example

from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes import unilateral
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.systems.pendula import stopped_pendulum
from textmech.reference.systems.pendula.stopped_pendulum import StoppedPendulum

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
