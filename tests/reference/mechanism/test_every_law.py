"""Every law in time, in every place of a file where one may stand, against its number.

A body that nothing else moves goes as the law's integrals say, which another hand takes.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.laws_in_time import ALL, LAWS, MOVING, PRESCRIBED, words

from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.kinematics import signal
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow

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


def off(folder: Path, where: str, law: str) -> float:
    """The largest difference of what the law moves from its number's integrals."""
    place = PLACES[where]
    scene = place.scene.replace("LAW", words(law, place.along))
    first = next(iter(place.moves))
    text = f"scene:\n{scene}initial: {{{place.start}}}\nallow: {{{first}: 1.0}}\nrests: true\n"
    case = scenes.typed(folder, text)
    mechanism = scenes.mechanism(case)
    motion = Answer(mechanism, follow(mechanism, case.times)).trajectory(case.times)
    own = LAWS[law]
    numbers = {order: [own.times(order, t) for t in case.times] for order in (-2, -1, 0, 1, 2)}
    return max(
        float(np.max(np.abs(observe(case.scene, motion, name) - times * np.array(numbers[order]))))
        for name, (order, times) in place.moves.items()
    )


@pytest.mark.parametrize(("where", "law"), EACH)
def test_a_law_moves_things_as_its_number_says(where: str, law: str, tmp_path: Path) -> None:
    assert off(tmp_path, where, law) < KNOWN


@pytest.mark.mutant("a drive by polynomial or table is one by a sine")
@pytest.mark.parametrize("law", ["polynomial", "table"])
def test_a_law_taken_for_a_sine_is_seen(
    law: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As the first words for drives in space had it."""
    monkeypatch.setitem(signal.SIZES, law, signal.SIZES["sine"])  # type: ignore[arg-type]
    monkeypatch.setitem(signal.SLOPES, law, lambda known, t: 0.0)  # type: ignore[arg-type]
    assert off(tmp_path, "named slide", law) > 0.1
