"""Laws in time with corners: typed values, closed forms of what they push, planted mistakes."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.fields.signal import Law, Signal
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array
from textmech.reference.mechanism.kinematics import signal as laws
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

TABLE = json.loads((Path(__file__).parents[2] / "engines" / "law_table.json").read_text())
M, C, F, T1, T2, X0 = 2.0, 50.0, 6.0, 0.2137, 0.6411, 0.02
W = math.sqrt(C / M)


def jump(t: Array, at: float, F: float) -> Array:
    """m ẍ + c x = F from that instant on: x = F/c (1 − cos ω τ)."""
    return np.where(t > at, F / C * (1 - np.cos(W * (t - at))), 0.0)


def bend(t: Array, at: float, b: float) -> Array:
    """m ẍ + c x = b τ from that instant on: x = b/c (τ − sin(ω τ)/ω)."""
    tau = t - at
    return np.where(t > at, b / C * (tau - np.sin(W * tau) / W), 0.0)


def along_table(t: Array) -> Array:
    up, down = F / (T2 - T1), (-3.0 - F) / (0.9 - T2)
    return bend(t, T1, up) + bend(t, T2, down - up) + bend(t, 0.9, -down)


def along_polynomial(t: Array) -> Array:
    """x = k₀ + k₁ t + k₂ t² with c k₂ = 15, c k₁ = −20, c k₀ = F − 2 m k₂, and its free swing."""
    k2, k1 = 15.0 / C, -20.0 / C
    k0 = (F - 2 * M * k2) / C
    return k0 + k1 * t + k2 * t**2 - k0 * np.cos(W * t) - k1 / W * np.sin(W * t)


PUSHED: dict[str, Callable[[Array], Array]] = {
    "step": lambda t: jump(t, T1, F),
    "pulse": lambda t: jump(t, T1, F) - jump(t, T2, F),
    "table": along_table,
    "polynomial": along_polynomial,
}


def off(variant: str) -> float:
    """How far [m] the reference's cart is from the closed form."""
    case = scenes.SHIPPED[f"pushed_cart.{variant}"]
    x = solve(case).trajectory.states["cart"][:, 0]
    free = X0 * np.cos(W * case.times)
    return float(np.max(np.abs(x - free - PUSHED[variant](case.times))))


@pytest.mark.slow
@pytest.mark.parametrize("variant", PUSHED)
def test_closed_form(variant: str) -> None:
    assert off(variant) < 1e-14  # of 0.2 m: its rounding


def test_typed_values() -> None:
    for row in TABLE["signals"]:
        numbers = {key: row[key] for key in ("angular_frequency", "phase") if key in row}
        lists = {key: tuple(row[key]) for key in ("amplitude", "times", "values") if key in row}
        law = Signal(row["law"], **lists, **numbers)
        size: Any = pytest.approx(row["value"], rel=1e-12, abs=1e-15)
        assert list(laws.signal(law, row["t"])) == size
        assert law.at(np.array([row["t"]]))[0].tolist() == size
        if "rate" in row:
            assert list(laws.slope(law, row["t"])) == pytest.approx(row["rate"], rel=1e-12)


WRONG: dict[str, dict[Law, Callable[[Signal, Any], Any]]] = {
    "a step that is late": {"step": lambda law, t: float(t.real >= law.times[0] + 1e-6)},
    "a pulse that does not end": {"pulse": lambda law, t: float(t.real >= law.times[0])},
    "a table without lines": {
        "table": lambda law, t: law.values[int(np.searchsorted(law.times, t.real)) - 1]
    },
    "a polynomial without its last term": {
        "polynomial": lambda law, t: law.values[0] + law.values[1] * t
    },
}


@pytest.mark.slow
@pytest.mark.mutant("a law in time: {mistake}")
@pytest.mark.parametrize("mistake", WRONG)
def test_a_wrong_law_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ((law, wrong),) = WRONG[mistake].items()
    monkeypatch.setitem(laws.SIZES, law, wrong)
    assert off(law) > 1e-8


@pytest.mark.slow
def test_a_step_ends_at_each_corner() -> None:
    case = scenes.SHIPPED["pushed_cart.pulse"]
    rows = follow(scenes.mechanism(case), case.times, every=True).rows
    assert {T1, T2} < {t for t, *_ in rows}


STUCK = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {block: {particle: {mass: 1.5}}}
  joints:
    rail:
      slide: [ground.O, block.center]
      along: [1, 0]
      dry_friction: {static: 4.0, kinetic: 3.0}
  forces: {hand: {push: block.center, LAW}}
initial: {block: {x: 0, vx: 0}}
RESTS
allow: {rail.friction: 1.0e-2, block.vx: 1.0e-2}
"""


def block(folder: Path, law: str, rests: str = "") -> Any:
    return solve(scenes.typed(folder, STUCK.replace("LAW", law).replace("RESTS", rests)))


@pytest.mark.slow
def test_a_force_that_jumps_beyond_stiction_breaks_loose_at_once(tmp_path: Path) -> None:
    """(2.89) At rest until the corner, then ẍ = (F − F_k)/m; after the pulse it brakes to rest."""
    moved = block(tmp_path, "pulse: {amplitude: [6.0, 0], from: 0.3, until: 0.5}").trajectory
    t = scenes.typed(tmp_path, STUCK.replace("LAW", "constant: [0, 0]").replace("RESTS", "")).times
    fast, a, b = 0.2 * 2.0, 2.0, 2.0
    v = np.clip(a * (t - 0.3), 0.0, fast) - np.clip(b * (t - 0.5), 0.0, fast)
    assert np.max(np.abs(moved.states["block"][:, 3] - v)) < 1e-13
    assert moved.switches.tolist() == pytest.approx([0.3, 0.7, 0.3, 0.5], abs=1e-12)
    held = moved.reactions["rail.friction"]
    assert held[t < 0.3].tolist() == [0.0] * 8
    assert held[(t > 0.3) & (t < 0.7)] == pytest.approx(-3.0, abs=1e-12)


@pytest.mark.slow
def test_a_force_that_jumps_within_stiction_moves_nothing(tmp_path: Path) -> None:
    moved = block(tmp_path, "step: {amplitude: [3.9, 0], at: 0.3}", "rests: true").trajectory
    assert not moved.states["block"][:, 3].any()
    assert moved.reactions["rail.friction"][-1] == pytest.approx(-3.9, rel=1e-14)


@pytest.mark.slow
def test_a_corner_on_a_sample_belongs_to_what_follows(tmp_path: Path) -> None:
    """Sample 7 is 0.28000000000000003 s, and the corner 0.28 s."""
    moved = block(tmp_path, "step: {amplitude: [6.0, 0], at: 0.28}").trajectory
    t = np.arange(26) / 25
    v = np.maximum(0.0, 2.0 * (t - 0.28))
    assert np.max(np.abs(moved.states["block"][:, 3] - v)) < 1e-13
    assert moved.reactions["rail.friction"][7] == pytest.approx(-3.0, rel=1e-12)


JUMPS = """\
scene:
  gravity: none
  bodies: {ball: {particle: {mass: 2}}}
  forces: {hand: {push: ball.center, step: {amplitude: [6, 0], at: AT}}}
initial: {ball: {x: 0, y: 0, vx: 1, vy: 0}}
allow: {ball.x: 1.0e-3, ball.ax: 1.0e-3}
"""


# k/(n − 1) of the duration is, as a double, more than what is typed, less, or the same.
@pytest.mark.parametrize(
    ("duration", "samples", "k", "at"),
    [(0.9, 10, 3, "0.3"), (1.2, 13, 1, "0.1"), (1.2, 4, 1, "0.4"), (0.6, 7, 3, "0.3"),
     (0.6, 7, 3, "0.30000000000000004"), (3.0, 26, 11, "1.32")],
)  # fmt: skip
def test_a_sample_on_a_jump_holds_what_is_after_it(
    duration: float, samples: int, k: int, at: str, tmp_path: Path
) -> None:
    text = JUMPS.replace("AT", at)
    case = scenes.typed(tmp_path, text, tail=scenes.tail(duration, samples))
    assert np.diff(case.times) == pytest.approx(np.full(samples - 1, case.interval), rel=1e-12)
    ax = observe(case.scene, solve(case).trajectory, "ball.ax")
    assert ax.tolist() == [0.0] * k + [3.0] * (samples - k)


@pytest.mark.mutant("a sample on a jump where rounding put it")
def test_a_sample_before_its_jump_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("textmech.cases.case.ROUNDED", -1.0)
    with pytest.raises(AssertionError):
        test_a_sample_on_a_jump_holds_what_is_after_it(1.2, 13, 1, "0.1", tmp_path)
