"""Laws in time, wherever one may stand, against their numbers; corners and moving points."""

import json
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.scenes.laws_in_time import ALL, LAWS, MOVING, PRESCRIBED, words

from textmech.cases.case import Case
from textmech.cases.fields.signal import Law, Signal
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.mechanism.kinematics import signal
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

KNOWN = 2e-13  # of quantities near 1 (forces near 10), after some hundred steps: rounding
M, J = 1.6, 0.4
FLAT = (
    "  gravity: none\n  points: {O: [0, 0]}\n"
    f"  bodies: {{b: {{rigid: {{mass: {M}, inertia: {J}}}}}}}\n"
)
FLAT_PAIR = FLAT.replace("}}}\n", "}}, anvil: {rigid: {mass: 2.0, inertia: 0.8}}}\n")
SOLID = (
    "  space: 3\n  gravity: none\n  points: {O: [0, 0, 0]}\n"
    f"  bodies: {{b: {{rigid: {{mass: {M}, inertia: [{J}, {J}, {J}, 0, 0, 0]}}}}}}\n"
)
U, W = (0.6, 0.8), (2 / 7, 3 / 7, 6 / 7)  # directions in the plane and in space
FREE = "b: {x: 0, y: 0, angle: 0}"
FREE_IN_SPACE = "b: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}}"


@dataclass(frozen=True)
class Place:
    """A scene in which LAW stands, and what it moves: how often integrated, and times what."""

    scene: str
    start: str
    moves: dict[str, tuple[int, float]]
    laws: tuple[str, ...] = ALL
    along: tuple[float, ...] = field(default=())  # which has as many entries


def rate(scene: str, freedom: str, rate: str, effort: str, inertia: float) -> Place:
    """A prescribed one of the joint j; its drive exerts m or J times what it changes by."""
    moves = {f"j.{freedom}": (1, 1.0), f"j.{rate}": (0, 1.0), f"j.{effort}": (-1, inertia)}
    start = "j: {s: 0, a: 0}" if freedom in "sa" else f"j: {{{freedom}: 0}}"
    return Place(f"{scene}  drive: {{j.{rate}: {{LAW}}}}\n", start, moves, PRESCRIBED)


def along(
    name: str, u: tuple[float, ...], order: int, times: float
) -> dict[str, tuple[int, float]]:
    """`b.v` → b.vx, b.vy, b.vz."""
    return {f"{name}{axis}": (order, times * x) for axis, x in zip("xyz", u, strict=False)}


JOINED = "  joints: {{j: {{{}}}}}\n"
PIN = FLAT + JOINED.format("pin: [ground.O, b.center]")
HINGE = SOLID + JOINED.format("hinge: [ground.O, b.center], axis: [2, 3, 6]")
NAMED = SOLID + JOINED.format(
    "freedoms: {s: {slide: [0, 0.6, 0.8]}, a: {hinge: [1, 0, 0]}}, of: [ground.O, b.center]"
)
BLADE = "  constraints: {j: {edge: b.center, along: [0.6, 0.8], speed: {LAW}}}\n"
TURNS = {"b.angle": (2, 1 / J), "b.omega": (1, 1 / J)}
HINGED = {"j.angle": (2, 1 / J), "j.omega": (1, 1 / J)}
PLACES = {
    "slide": rate(
        FLAT + JOINED.format("slide: [ground.O, b.center], along: [0.6, 0.8]"),
        "shift", "speed", "drive", M,
    ),
    "pin": rate(PIN, "angle", "omega", "torque", J),
    "slide in space": rate(
        SOLID + JOINED.format("slide: [ground.O, b.center], along: [2, 3, 6]"),
        "shift", "shift_dot", "shift_force", M,
    ),
    "hinge": rate(HINGE, "angle", "omega", "torque", J),
    "named slide": rate(NAMED, "s", "s_dot", "s_force", M),
    "named hinge": rate(NAMED, "a", "a_dot", "a_torque", J),
    "blade": Place(
        FLAT + BLADE, FREE,
        {"j.speed": (0, 1.0), "j.drive": (-1, M), **along("b.", U, 1, 1.0)}, PRESCRIBED,
    ),
    "point": Place(
        FLAT.replace("[0, 0]", "{at: [0, 0], moves: {LAW}}")
        + JOINED.format("weld: [ground.O, b.center]"),
        "b: {angle: 0}",
        {**along("b.", U, 0, 1.0), **along("b.v", U, -1, 1.0), **along("j.f", U, -2, M)},
        MOVING, U,
    ),
    "push": Place(
        FLAT + "  forces: {f: {push: b.center, LAW}}\n", FREE,
        {**along("b.", U, 2, 1 / M), **along("b.v", U, 1, 1 / M)}, along=U,
    ),
    "torque": Place(FLAT + "  forces: {f: {torque: b, LAW}}\n", FREE, TURNS),
    "couple": Place(
        FLAT_PAIR + "  forces: {f: {couple: [anvil, b], LAW}}\n",
        f"{FREE}, anvil: {{x: 0, y: 0, angle: 0}}",
        {**TURNS, "anvil.angle": (2, -1 / 0.8), "anvil.omega": (1, -1 / 0.8)},
    ),
    "motor": Place(PIN + "  forces: {f: {motor: j, LAW}}\n", "j: {angle: 0}", HINGED),
    "push in space": Place(
        SOLID + "  forces: {f: {push: b.center, LAW}}\n", FREE_IN_SPACE,
        {**along("b.", W, 2, 1 / M), **along("b.v", W, 1, 1 / M)}, along=W,
    ),
    "torque in space": Place(
        SOLID + "  forces: {f: {torque: b, LAW}}\n", FREE_IN_SPACE,
        {f"b.omega_{i + 1}": (1, w / J) for i, w in enumerate(W)}, along=W,
    ),
    "motor in space": Place(HINGE + "  forces: {f: {motor: j, LAW}}\n", "j: {angle: 0}", HINGED),
    "motor of a named hinge": Place(
        NAMED + "  forces: {f: {motor: j.a, LAW}}\n", "j: {s: 0, a: 0}",
        {"j.a": (2, 1 / J), "j.a_dot": (1, 1 / J)},
    ),
}  # fmt: skip
EACH = [(where, law) for where, place in PLACES.items() for law in place.laws]


def law_off(where: str, law: str) -> float:
    """The largest difference of what the law moves from its number's integrals."""
    place = PLACES[where]
    scene = place.scene.replace("LAW", words(law, place.along))
    first = next(iter(place.moves))
    text = f"scene:\n{scene}initial: {{{place.start}}}\nallow: {{{first}: 1.0}}\nrests: true\n"
    case = scenes.parsed(text)
    mechanism = scenes.mechanism(case)
    motion = Answer(mechanism, follow(mechanism, case.times)).trajectory(case.times)
    own = LAWS[law]
    numbers = {order: [own.times(order, t) for t in case.times] for order in (-2, -1, 0, 1, 2)}
    return max(
        float(np.max(np.abs(observe(case.scene, motion, name) - times * np.array(numbers[order]))))
        for name, (order, times) in place.moves.items()
    )


@pytest.mark.parametrize(("where", "law"), EACH)
def test_a_law_moves_things_as_its_number_says(where: str, law: str) -> None:
    assert law_off(where, law) < KNOWN


@pytest.mark.mutant("a drive by polynomial or table is one by a sine")
@pytest.mark.parametrize("law", ["polynomial", "table"])
def test_a_law_taken_for_a_sine_is_seen(law: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the first words for drives in space had it."""
    monkeypatch.setitem(signal.SIZES, law, signal.SIZES["sine"])  # type: ignore[arg-type]
    monkeypatch.setitem(signal.SLOPES, law, lambda known, t: 0.0)  # type: ignore[arg-type]
    assert law_off("named slide", law) > 0.1


TABLE = json.loads((Path(__file__).parents[2] / "engines" / "law_table.json").read_text())
CART, C, F, T1, T2, X0 = 2.0, 50.0, 6.0, 0.2137, 0.6411, 0.02
W0 = math.sqrt(C / CART)


def jump(t: Array, at: float, F: float) -> Array:
    """m ẍ + c x = F from that instant on: x = F/c (1 − cos ω τ)."""
    return np.where(t > at, F / C * (1 - np.cos(W0 * (t - at))), 0.0)


def bend(t: Array, at: float, b: float) -> Array:
    """m ẍ + c x = b τ from that instant on: x = b/c (τ − sin(ω τ)/ω)."""
    tau = t - at
    return np.where(t > at, b / C * (tau - np.sin(W0 * tau) / W0), 0.0)


def along_table(t: Array) -> Array:
    up, down = F / (T2 - T1), (-3.0 - F) / (0.9 - T2)
    return bend(t, T1, up) + bend(t, T2, down - up) + bend(t, 0.9, -down)


def along_polynomial(t: Array) -> Array:
    """x = k₀ + k₁ t + k₂ t² with c k₂ = 15, c k₁ = −20, c k₀ = F − 2 m k₂, and its free swing."""
    k2, k1 = 15.0 / C, -20.0 / C
    k0 = (F - 2 * CART * k2) / C
    return k0 + k1 * t + k2 * t**2 - k0 * np.cos(W0 * t) - k1 / W0 * np.sin(W0 * t)


PUSHED: dict[str, Callable[[Array], Array]] = {
    "step": lambda t: jump(t, T1, F),
    "pulse": lambda t: jump(t, T1, F) - jump(t, T2, F),
    "table": along_table,
    "polynomial": along_polynomial,
}


def cart_off(variant: str) -> float:
    """How far [m] the reference's cart is from the closed form."""
    case = scenes.SHIPPED[f"pushed_cart.{variant}"]
    x = solve(case).trajectory.states["cart"][:, 0]
    free = X0 * np.cos(W0 * case.times)
    return float(np.max(np.abs(x - free - PUSHED[variant](case.times))))


@pytest.mark.slow
@pytest.mark.parametrize("variant", PUSHED)
def test_closed_form(variant: str) -> None:
    assert cart_off(variant) < 1e-14  # of 0.2 m: its rounding


def test_typed_values() -> None:
    for row in TABLE["signals"]:
        numbers = {key: row[key] for key in ("angular_frequency", "phase") if key in row}
        lists = {key: tuple(row[key]) for key in ("amplitude", "times", "values") if key in row}
        law = Signal(row["law"], **lists, **numbers)
        size: Any = pytest.approx(row["value"], rel=1e-12, abs=1e-15)
        assert list(signal.signal(law, row["t"])) == size
        assert law.at(np.array([row["t"]]))[0].tolist() == size
        if "rate" in row:
            assert list(signal.slope(law, row["t"])) == pytest.approx(row["rate"], rel=1e-12)


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
    monkeypatch.setitem(signal.SIZES, law, wrong)
    assert cart_off(law) > 1e-8


@pytest.mark.slow
def test_a_step_ends_at_each_corner() -> None:
    case = scenes.SHIPPED["pushed_cart.pulse"]
    rows = follow(scenes.mechanism(case), case.times, every=True).rows
    assert {T1, T2} < {t for t, *_ in rows}


def pushed(forces: str, dry: str, more: str = "", **parameters: float) -> Case:
    """A block on a rail with dry friction, and what pushes it."""
    rail = f"joints: {{rail: {{dry_friction: {{{dry}}}}}}}"
    changes = f"scene: {{{rail}, forces: {{{forces}}}}}\nallow: {{rail.friction: 1.0e-2}}\n{more}"
    return scenes.scene("block_on_rail", changes, **parameters)


def block(law: str) -> tuple[Array, Trajectory]:
    """Times, and the motion of 1.5 kg that friction of 4 N holds at rest and of 3 N brakes."""
    hand = f"hand: {{push: block.center, {law}}}"
    case = pushed(hand, "static: 4.0, kinetic: 3.0", m=1.5)
    return case.times, solve(case).trajectory


@pytest.mark.slow
def test_a_force_that_jumps_beyond_stiction_breaks_loose_at_once() -> None:
    """(2.89) At rest until the corner, then ẍ = (F − F_k)/m; after the pulse it brakes to rest."""
    t, moved = block("pulse: {amplitude: [6.0, 0], from: 0.3, until: 0.5}")
    fast, a, b = 0.2 * 2.0, 2.0, 2.0
    v = np.clip(a * (t - 0.3), 0.0, fast) - np.clip(b * (t - 0.5), 0.0, fast)
    assert np.max(np.abs(moved.states["block"][:, 3] - v)) < 1e-13
    assert moved.switches.tolist() == pytest.approx([0.3, 0.7, 0.3, 0.5], abs=1e-12)
    held = moved.reactions["rail.friction"]
    assert held[t < 0.3].tolist() == [0.0] * 8
    assert held[(t > 0.3) & (t < 0.7)] == pytest.approx(-3.0, abs=1e-12)


@pytest.mark.slow
def test_a_corner_on_a_sample_belongs_to_what_follows() -> None:
    """Sample 7 is 0.28000000000000003 s, and the corner 0.28 s."""
    t, moved = block("step: {amplitude: [6.0, 0], at: 0.28}")
    v = np.maximum(0.0, 2.0 * (t - 0.28))
    assert np.max(np.abs(moved.states["block"][:, 3] - v)) < 1e-13
    assert moved.reactions["rail.friction"][7] == pytest.approx(-3.0, rel=1e-12)


# k/(n − 1) of the duration is, as a double, more than what is typed, less, or the same.
@pytest.mark.parametrize(
    ("duration", "samples", "k", "at"),
    [(0.9, 10, 3, "0.3"), (1.2, 13, 1, "0.1"), (1.2, 4, 1, "0.4"), (0.6, 7, 3, "0.3"),
     (0.6, 7, 3, "0.30000000000000004"), (3.0, 26, 11, "1.32")],
)  # fmt: skip
def test_a_sample_on_a_jump_holds_what_is_after_it(
    duration: float, samples: int, k: int, at: str
) -> None:
    step = f"hand: {{push: ball.center, step: {{amplitude: [6, 0], at: {at}}}}}"
    changes = f"scene: {{forces: {{{step}}}}}\nallow: {{ball.ax: 1.0e-3}}\n"
    changes += scenes.tail(duration, samples)
    case = scenes.scene("free_particle", changes, m=2, vx=1)
    assert np.diff(case.times) == pytest.approx(np.full(samples - 1, case.interval), rel=1e-12)
    ax = observe(case.scene, solve(case).trajectory, "ball.ax")
    assert ax.tolist() == [0.0] * k + [3.0] * (samples - k)


@pytest.mark.mutant("a sample on a jump where rounding put it")
def test_a_sample_before_its_jump_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("textmech.cases.case.ROUNDED", -1.0)
    with pytest.raises(AssertionError):
        test_a_sample_on_a_jump_holds_what_is_after_it(1.2, 13, 1, "0.1")


# N at the start, from 0.2 s on and from 0.5 s on, where it slips still at 8 N
TOLD = {3.0: (-1.0, -4.0, -1.0), 8.0: (-1.0, -4.0, -4.0)}


@pytest.mark.slow
@pytest.mark.parametrize(("push", "samples"), [(3.0, 77), (8.0, 31), (8.0, 77)])
def test_friction_at_a_corner_is_that_after_it(push: float, samples: int) -> None:
    """It holds against the new push, or slips under it; of 77 samples none is 0.2 s."""
    pulse = f"pulse: {{amplitude: [{push}, 0], from: 0.2, until: 0.5}}"
    forces = f"hand: {{push: block.center, {pulse}}}, tow: {{push: block.center, constant: [1, 0]}}"
    more = scenes.tail(1.0, samples) + ("stays: [rail.shift]\n" if push < 5 else "")
    case = pushed(forces, "static: 6.0 N, kinetic: 4.0 N", more)
    motion = solve(case)
    friction = observe(case.scene, motion.trajectory, "rail.friction")
    moves = push > 5
    at = np.searchsorted([0.2, 0.5], case.times, side="right")
    # 8 N: 5 m/s² for 0.3 s, and −3 m/s² for as long as there is a speed, 0.5 s
    known = np.where(moves & (case.times >= 1.0), -1.0, np.array(TOLD[push])[at])
    told = slice(-1 if moves else None)  # at the last it comes to rest, by rounding before or after
    np.testing.assert_allclose(friction[told], known[told], rtol=0, atol=1e-12)
    known_way = 5 * 0.3**2 / 2 + 1.5 * 0.5 - 3 * 0.5**2 / 2 if moves else 0.0
    shift = observe(case.scene, motion.trajectory, "rail.shift")[-1]
    assert shift == pytest.approx(known_way, abs=1e-12)
    assert [check.name for check in motion.checks if not check.holds] == []


HUNG = """\
scene:
  GRAVITY
  points: {O: PIVOT}
  bodies: {bar: {bar: {mass: 1.2, length: 0.8}}, bob: {particle: {mass: 0.4}}}
  joints: {JOINT}
  forces: {coil: {spring: [bob.center, bar.end], stiffness: 30.0, rest_length: 0.1}}
initial: START
allow: {bar.angle: 1.0e-2}
"""
A = 3.0
RESTS = "bob: {x: 0.9, y: -0.5, vx: 0, vy: 0}"
HANGS = {
    "pin": ("hinge: {pin: [ground.O, bar.start]}", "bar: {angle: -40 deg, omega: 0}"),
    "distance": (
        "rod: {distance: [ground.O, bar.start]}",
        "bar: {x: 0.5, y: -0.4, angle: -40 deg, vx: 0, vy: 0, omega: 0}",
    ),
    "slot": (
        "guide: {slot: [bar.start, ground.O], along: [1, 0]}",
        "bar: {angle: -40 deg, x: 0.25, vx: 0, omega: 0}",
    ),
}


def apart(kind: str) -> float:
    """How far [rad] the two turn differently."""
    joint, begins = HANGS[kind]
    law = f"polynomial: {{along: [1, 0], coefficients: [0, 0, {A / 2}]}}"
    angles = []
    for gravity, pivot in (
        ("", f"{{at: [0, 0], moves: {{{law}}}}}"),
        (f"gravity: [{-A}, -9.80665]", "[0, 0]"),
    ):
        text = HUNG.replace("JOINT", joint).replace("START", f"{{{begins}, {RESTS}}}")
        text = text.replace("  GRAVITY\n", f"  {gravity}\n" if gravity else "")
        motion = solve(scenes.parsed(text.replace("PIVOT", pivot))).trajectory
        angles.append(motion.states["bar"][:, 2])
    return float(np.max(np.abs(angles[0] - angles[1])))


@pytest.mark.slow
@pytest.mark.parametrize("kind", HANGS)
def test_an_accelerated_pivot_is_another_gravity(kind: str) -> None:
    assert apart(kind) < 1e-12


@pytest.mark.slow
@pytest.mark.mutant("acceleration of a moving point left out of a {kind}")
@pytest.mark.parametrize("kind", HANGS)
def test_a_lost_acceleration_is_seen(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(signal, "BENDS", dict.fromkeys(signal.BENDS, lambda law, t: 0.0))
    assert apart(kind) > 1e-3
