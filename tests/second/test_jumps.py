"""Where a law jumps the second reading chooses anew what sticks, and reads the sample behind it."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes

from second import answer, read, switching
from textmech.reference.solve import solve

M, MU, PUSH, AT, G = 2.0, 0.5, 15.0, 0.5, 9.80665
SCENE = f"""\
scene:
  bodies: {{block: {{particle: {{mass: {M}}}}}}}
  contacts: {{touch: {{between: [block, ground.floor], friction: {MU}}}}}
  forces: {{shove: {{push: block.center, step: {{amplitude: [{PUSH}, 0.0], at: {AT}}}}}}}
initial: {{block: {{x: 0, y: 0}}}}
allow: {{block.x: 1.0e-3, block.vx: 1.0e-3, touch.tangent: 1.0e-2}}
"""
RATE = PUSH / M - MU * G  # m/s², from the corner on


def off(tmp_path: Path) -> float:
    """How far a block is, in m, m/s and N, from where it must be: it lies until it is pushed."""
    case = scenes.typed(tmp_path, SCENE, tail=scenes.tail(1.0, 11))
    (told,) = read.file(tmp_path / "typed.yaml").values()
    motion = answer.motion(told)
    since = np.maximum(0.0, case.times - AT)
    pushed = case.times >= AT  # on the corner too
    known = {
        "block.x": RATE * since**2 / 2,
        "block.vx": RATE * since,
        "touch.tangent": np.where(pushed, -MU * M * G, 0.0),
    }
    return max(
        float(np.max(np.abs(answer.observed(motion, name) - values)))
        for name, values in known.items()
    )


@pytest.mark.slow
def test_what_sticks_is_chosen_anew_where_a_law_jumps(tmp_path: Path) -> None:
    """The force is twice what friction holds from the corner on, which is a sample."""
    assert off(tmp_path) < 1e-9


@pytest.mark.slow
@pytest.mark.mutant("the second reading keeps its mode where a law jumps")
def test_a_mode_that_outlives_a_jump_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No guard falls there: from the jump on friction is above its bound, and no fall is met."""
    sound = switching.next_mode

    def kept(now, mode, site, what):  # type: ignore[no-untyped-def]
        return mode if what == "" and site is None else sound(now, mode, site, what)

    monkeypatch.setattr(switching, "next_mode", kept)
    assert off(tmp_path) > 1e-3


FALLS = """\
scene:
  bodies: {bob: {particle: {mass: 0.25}}}
  contacts: {c: {between: [bob, ground.floor], friction: {static: 0.59, kinetic: 0.34}}}
initial: {bob: {x: 0, y: 0.45, vx: -1.1}}
events: {lands: {c.gap: falls to zero}}
allow: {bob.x: 1.0e-3}
"""


@pytest.mark.slow
def test_a_blow_rubs_by_the_kinetic_coefficient_in_both_readings(tmp_path: Path) -> None:
    """It arrives with v = √(2 g 0.45 m) and keeps 1.1 − 0.34 v, which 0.59 v would stop."""
    case = scenes.typed(tmp_path, FALLS, tail=scenes.tail(0.6, 7))
    v = (2 * G * 0.45) ** 0.5
    left = 1.1 - 0.34 * v
    assert left > 0 > 1.1 - 0.59 * v
    known = -1.1 * v / G - left**2 / (2 * 0.34 * G)
    (told,) = read.file(tmp_path / "typed.yaml").values()
    motion = solve(case)
    assert motion.holds
    assert motion.trajectory.states["bob"][-1, 0] == pytest.approx(known, abs=1e-12)
    assert answer.observed(answer.motion(told), "bob.x")[-1] == pytest.approx(known, abs=1e-7)
