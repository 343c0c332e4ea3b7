"""Work that samples cannot tell: of what is short, in step with them, or of a blow."""

import math
from pathlib import Path

import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.reference import assumptions
from textmech.reference.certificate import certify, errors
from textmech.reference.solve import solve

DRIVEN = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {cart: {disk: {mass: 1.0, radius: 0.1}}, ball: {disk: {mass: 0.5, radius: 0.1}}}
  joints: {rail: {slide: [ground.O, cart.center], along: [1, 0]}}
  drive: {rail.speed: 1.0}
  MEETS
initial: {cart: {x: 0, y: 0}, ball: {x: 0.71, y: 0, vx: -0.5, vy: 0}}
EVENTS
duration: 1.0
samples: 26
allow: {ball.x: 1.0e-2, rail.work: 1.0e-2}
"""
STRIKES = "contacts: {knock: {between: [cart, ball], friction: 0, restitution: 0.5}}"
BUFFER = "forces: {buffer: {spring: [cart.center, ball.center], stiffness: 50000, "
BUFFER += "rest_length: 0.2, only: compression}}"
PUSHED = """\
scene:
  gravity: none
  bodies: {b: {particle: {mass: 1.0}}}
  forces: {p: {push: b.center, sine: {amplitude: [100, 0], angular_frequency: OMEGA, phase: 0.7}}}
initial: {b: {x: 0, y: 0, vx: 1, vy: 0}}
duration: 0.4
samples: 11
allow: {b.x: 1.0e-2, p.work: 1.0e-2}
"""
TURNED = f"""\
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies: {{b: {{bar: {{mass: 1, length: 0.2}}}}}}
  joints: {{h: {{pin: [ground.O, b.center]}}}}
  forces: {{p: {{push: b.end, constant: [3, 0]}}}}
  drive: {{h.omega: {80 * math.pi!r}}}
initial: {{b: {{angle: 0.7}}}}
duration: 1.0
samples: 11
allow: {{b.end.y: 1.0e-2, p.work: 1.0e-2}}
"""


def driven(meets: str, events: str = "") -> str:
    return DRIVEN.replace("MEETS", meets).replace("EVENTS\n", events)


def pushed(periods: float) -> str:
    """A push of so many periods between two samples, which does no work in whole ones."""
    return PUSHED.replace("OMEGA", repr(math.tau * periods / 0.04))


ASKS = "asks more than can be certified"


@pytest.mark.slow
@pytest.mark.parametrize("text", [driven(BUFFER), *map(pushed, (1, 4, 8)), TURNED])
def test_work_that_samples_miss_is_not_certified(tmp_path: Path, text: str) -> None:
    """A buffer that acts for 10 ms between samples 40 ms apart; a period in step with them."""
    with pytest.raises(CaseError, match=ASKS):
        solve(typed(tmp_path, text, tail=""))


@pytest.mark.slow
def test_work_that_they_tell_is(tmp_path: Path) -> None:
    assert solve(typed(tmp_path, pushed(0.005), tail="")).holds


@pytest.mark.slow
@pytest.mark.mutant("a sum over samples that is not held against the steps")
def test_a_short_contact_needs_the_steps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(errors, "_missed", lambda *_: 0.0)
    monkeypatch.setattr(certify, "UNEVEN", certify.QUARTERS)  # of which two lie beside the contact
    assert solve(typed(tmp_path, driven(BUFFER), tail="")).holds


@pytest.mark.slow
@pytest.mark.mutant("a sum over samples that is held against even parts of them")
def test_a_period_in_step_needs_uneven_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(certify, "UNEVEN", certify.QUARTERS)
    assert solve(typed(tmp_path, TURNED, tail="")).holds


EVENT = "events: {strikes: {knock.gap: falls to zero}}\n"


@pytest.mark.slow
@pytest.mark.mutant("a drive that works through a blow")
def test_work_of_a_drive_through_a_blow_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """J v = 0.5 (1 + 0.5) 1.5 · 1 = 1.125 J, in no time: as a sum over power it is 0."""
    case = typed(tmp_path, driven(STRIKES, EVENT), tail="")
    with pytest.raises(CaseError, match=r"something strikes at 0\.34 s") as wrong:
        solve(case)
    assert [mistake.where for mistake in wrong.value.mistakes] == ["allow.rail.work"]
    monkeypatch.setattr(assumptions, "_struck", lambda *_: [])
    assert solve(case).trajectory.times[-1] == 1.0
