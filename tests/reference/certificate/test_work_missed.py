"""Work that samples cannot tell: of what is short, in step with them, or of a blow."""

import math
from pathlib import Path

import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference import assumptions
from textmech.reference.certificate import certify, work_error
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


# A zigzag of a drive, or of a heavy cart, hides what a buffer takes between two samples.
ZIGZAG = driven(BUFFER).replace(
    "{rail.speed: 1.0}",
    "{rail.speed: {table: {times: [0, 0.2, 0.4, 0.6, 0.8, 1], values: [1, 1.2, 1, 1.2, 1, 1.2]}}}",
)
HEAVY = driven(BUFFER).replace("mass: 1.0", "mass: 1000").replace(
    "{rail.speed: 1.0}", "{rail.speed: {sine: {amplitude: 1, angular_frequency: 6.28, phase: 0.5}}}"
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("text", "at"), [(ZIGZAG, 0.685), (HEAVY, 0.43)])
def test_a_short_contact_beside_a_power_that_moves_is_seen(
    tmp_path: Path, text: str, at: float
) -> None:
    """The only source of energy is the drive: its work is what the whole has more at the end."""
    stiff = text.replace("50000", "2000000").replace("x: 0.71", f"x: {at}")
    with pytest.raises(CaseError, match=ASKS) as wrong:
        solve(typed(tmp_path, stiff, tail=""))
    assert [mistake.where for mistake in wrong.value.mistakes] == ["allow.rail.work"]


PASSES = """\
scene:
  gravity: none
  points: {O: [0, 0], A: [0, HIGH]}
  bodies: {cart: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.A, cart.center], along: [1, 0]}}
  forces: {oil: {damper: [ground.O, cart.center], damping: 2.0}}
  drive: {rail.speed: 1.0}
initial: {rail: {shift: BEGIN}}
duration: 2.0
samples: 21
allow: {cart.x: 1.0e-3, oil.work: ALLOWED, rail.work: ALLOWED}
"""


def passes(high: float, begin: float, allowed: float) -> str:
    """A cart that passes the foot of a damper, so high above it."""
    numbers = {"HIGH": high, "BEGIN": begin, "ALLOWED": allowed}
    text = PASSES
    for word, number in numbers.items():
        text = text.replace(word, repr(number))
    return text


@pytest.mark.slow
@pytest.mark.parametrize("high", [1e-2, 1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize("begin", [-1.03, -1.0111, -0.95])
def test_what_a_driven_motion_does_not_feel_is_counted(
    tmp_path: Path, high: float, begin: float
) -> None:
    """W = −d v (x − h atan(x/h)): the error that is stated is the true one."""
    case = typed(tmp_path, passes(high, begin, 100.0), tail="")
    (one,) = (check for check in solve(case).checks if check.name == "error of oil.work")
    motion, ends = solve(case).trajectory, (begin, begin + 2.0)
    low, top = (x - high * math.atan(x / high) for x in ends)
    off = abs(float(observe(case.scene, motion, "oil.work")[-1]) + 2.0 * (top - low))
    assert off <= (one.certified or 0.0) <= 1.5 * off + 1e-9


@pytest.mark.slow
@pytest.mark.mutant("a sum over samples that is held against no integral")
def test_a_sum_needs_the_integral(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(certify, "work_errors", lambda *_: {})
    assert solve(typed(tmp_path, TURNED, tail="")).holds


@pytest.mark.parametrize("k", range(0, 24, 2))
def test_the_nodes_integrate_powers(k: int) -> None:
    """∫ tᵏ over (−1, 1) = 2/(k + 1), by seven nodes up to t¹³."""
    powers = work_error.NODES**k
    assert powers @ work_error.FIFTEEN == pytest.approx(2 / (k + 1), rel=1e-15 * (k + 4))
    fewer = powers[1::2] @ work_error.SEVEN
    assert (abs(fewer * (k + 1) / 2 - 1) < 1e-14) == (k < 14)


@pytest.mark.slow
@pytest.mark.mutant("an integral over whole steps, which feel no force that does not move them")
def test_steps_are_halved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else much more would be stated than is off."""
    case = typed(tmp_path, passes(1e-4, -1.03, 100.0), tail="")
    monkeypatch.setattr(work_error, "FINE", math.inf)
    (one,) = (check for check in solve(case).checks if check.name == "error of oil.work")
    assert (one.certified or 0.0) > 5 * 6.3e-4  # what is off: -4 + 1e-4 π, nearly


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
