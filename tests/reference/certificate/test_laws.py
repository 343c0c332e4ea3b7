"""The laws along a motion and beside it: what is right holds, and what is wrong by little is seen.

What lies still, is small or is accelerated by nothing is small against what moves and acts there: a
sum that cancels has no size of its own, and a certificate that divides by it FAILS what is right.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.certified import broken, certified
from given.machines.examples import only
from given.machines.formal import FORMAL
from given.machines.formal import drawn as formal
from given.machines.states import states
from given.machines.turning_bodies import J
from given.mutants import mutant
from given.scenes.claims import claimed

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.reference.certificate import certify, laws
from textmech.reference.certificate.agreement import Check
from textmech.reference.formalisms import lagrange, voronets
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.solve import solve
from textmech.reference.states import answer
from textmech.reference.system import Array, Mode
from textmech.reference.systems import written
from textmech.reference.systems.linkages.four_bar import FourBar

Patch = pytest.MonkeyPatch
POWER, BALANCE = "power balance (2.51)", "Newton-Euler balance (2.23), (2.27)"
VORONETS, CHAPLYGIN, APPELL = (f"accelerations by {name}" for name in laws.ELIMINATED)
MULTIPLIERS = "accelerations by Lagrange with multipliers (2.60)"
SPACE = "scene:\n  space: 3\n  gravity: none\n"
SLIPS = """\
scene:
  bodies: {{b: {{disk: {{mass: 1.3, radius: {R!r}}}}}}}
  contacts: {{touch: {{between: [b, ground.floor], friction: 0.3}}}}
initial: {{b: {{x: 0, y: {R!r}, angle: 0, vx: 1}}}}
allow: {{b.x: 1.0e-3}}
"""
BARS = 60
ENDS = ["ground.O", *(f"b{i}.end" for i in range(BARS))]
CHAIN = f"""\
scene:
  points: {{O: [0, 0]}}
  bodies: {{{", ".join(f"b{i}: {{bar: {{mass: 1, length: 0.1}}}}" for i in range(BARS))}}}
  joints: {{{", ".join(f"j{i}: {{pin: [{ENDS[i]}, b{i}.start]}}" for i in range(BARS))}}}
initial: {{{", ".join(f"b{i}: {{angle: -30 deg}}" for i in range(BARS))}}}
allow: {{b3.angle: 1.0e-3}}
"""
STILL = (
    "a mass on a spring that friction stops", "a bar that has toppled", "an arch",
    "a symmetric hanging deck",
)  # fmt: skip
# Each with its duration and samples.
SCENES: dict[str, tuple[str, float, int]] = {
    # What lies still at the end or all the time: its power is rounding, divided by rounding.
    STILL[0]: ("""\
scene:
  gravity: none
  points: {O: [0, 0], Q: [-1, 0]}
  bodies: {m: {particle: {mass: 1}}}
  joints:
    rail: {slide: [ground.O, m.center], along: [1, 0], dry_friction: {static: 3, kinetic: 2}}
  forces: {coil: {spring: [ground.Q, m.center], stiffness: 30, rest_length: 1}}
initial: {m: {x: 0.2, vx: 0}}
allow: {m.x: 1.0e-3}
""", 2.0, 26),
    STILL[1]: ("""\
scene:
  points: {O: [0, 0.2]}
  bodies: {bar: {bar: {mass: 1, length: 1}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
  contacts: {tip: {between: [bar.end, ground.floor], friction: 0}}
initial: {bar: {angle: 60 deg}}
events: {lands: {tip.gap: falls to zero}}
allow: {bar.angle: 1.0e-2}
""", 2.0, 26),
    STILL[2]: ("""\
rests: true
scene:
  points: {O: [0, 0], Q: [1, 0]}
  bodies:
    left: {bar: {mass: 1, length: 0.7}}
    right: {bar: {mass: 1, length: 0.7}}
    hung: {particle: {mass: 3}}
  joints:
    a: {pin: [ground.O, left.start]}
    b: {pin: [ground.Q, right.start]}
    c: {pin: [left.end, right.end]}
  forces: {coil: {spring: [left.end, hung.center], stiffness: 40, rest_length: 0.3}}
initial: {hung: {x: 0.5, y: -0.545457}}
near: {left: {angle: 44 deg}, right: {angle: 136 deg}}
allow: {left.angle: 1.0e-3}
""", 2.0, 26),
    STILL[3]: ("""\
rests: true
scene:
  points: {O: [0, 0], Q: [1.2, 0]}
  bodies:
    left: {bar: {mass: 1, length: 0.5}}
    deck: {bar: {mass: 1, length: 0.6}}
    right: {bar: {mass: 1, length: 0.5}}
  joints:
    a: {pin: [ground.O, left.start]}
    b: {pin: [ground.Q, right.start]}
    c: {pin: [left.end, deck.start]}
    d: {pin: [deck.end, right.end]}
initial: {left: {angle: -53.13010235415598 deg}}
near: {deck: {angle: 0}, right: {angle: -126.8 deg}}
allow: {left.angle: 1.0e-3}
""", 2.0, 26),
    # Two samples are where the cosine of a turn is zero.
    "spins": (f"""\
{SPACE}\
  points: {{O: [0, 0, 0]}}
  bodies: {{b: {{rigid: {{mass: 1, inertia: [0.5, 0.4, 0.3, 0, 0, 0]}}}}}}
  joints: {{q: {{hinge: [ground.O, b.center], axis: [0, 0, 1]}}}}
initial: {{q: {{angle: 0, omega: 3}}}}
allow: {{q.angle: 1.0e-3}}
""", 1.0, 21),
    "pushed": (f"""\
{SPACE}\
  bodies: {{b: {{sphere: {{mass: 1.3, radius: 0.2}}}}}}
  forces:
    f:
      push: b.center
      sine: {{amplitude: [2.0, 0, 0], angular_frequency: 360 deg/s, phase: 90 deg}}
initial: {{b: {{x: 0, y: 0, z: 0, attitude: {{axis: [0, 0, 1], angle: 0}}}}}}
allow: {{b.x: 1.0e-3}}
""", 1.0, 21),
    **{f"slips, R = {R:g} m": (SLIPS.format(R=R), 1.0, 21) for R in (1e-1, 1e-7, 1e-9)},
    # Never moving, a coordinate is drawn as fast as its body is in the whole motion.
    "tiny": (f"""\
{SPACE}\
  bodies:
    b:
      rigid: {{mass: 1.0e-15, inertia: [1.0e-28, 1.5e-28, 2.0e-28, 0, 0, 0]}}
      points: {{P: [1.0e-6, 0, 0]}}
initial: {{b: {{x: 0, y: 0, z: 0, attitude: {{axis: [0, 0, 1], angle: 0}}, omega: [1, 2, 3]}}}}
allow: {{b.omega_1: 1.0e-3}}
""", 1.0, 11),
    # No joint is turned over beside a motion.
    "fan": (f"""\
{SPACE}\
  bodies:
    hull: {{rigid: {{mass: 1.0, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}}}}
    fan: {{rigid: {{mass: 0.3, inertia: [2.0e-3, 3.0e-3, 4.0e-3, 0, 0, 0]}}}}
  joints: {{spin: {{hinge: [hull.center, fan.center], axis: [0, 0, 1]}}}}
  forces: {{m: {{motor: spin, constant: 0.1}}}}
initial:
  hull: {{x: 0, y: 0, z: 0, attitude: {{axis: [0, 0, 1], angle: 0}}, omega: [20, 5, 5]}}
  spin: {{angle: 0, omega: 30}}
allow: {{hull.omega_1: 1.0e-1}}
""", 1.0, 11),
    # Of 0.3 mm: what goes 10 mm/s turns by 100 rad/s, and where a pivot is driven most of T is
    # there without any rate that is free.
    "pair": ("""\
scene:
  bodies:
    a: {bar: {mass: 8.0e-10, length: 3.0e-4}}
    b: {bar: {mass: 7.0e-10, length: 4.0e-4}}
  joints: {h: {pin: [a.end, b.start]}}
initial: {a: {angle: -0.6, omega: 31.6, x: 1.0e-3, y: 2.0e-3, vx: 0.0316, vy: 0},
          b: {angle: 0.3, omega: 63.2}}
allow: {a.x: 1.0e-6}
""", 0.06, 5),
    "driven": ("""\
scene:
  points: {O: {at: [2.76e-4, 2.276e-3], velocity: [-0.0072, -0.047]}}
  bodies:
    a: {bar: {mass: 1.8e-4, length: 4.06e-4}, points: {P: [-8.2e-05, 9.46e-05]}}
    b: {block: {mass: 5.5e-5, width: 4.94e-4, height: 2.96e-4}, points: {P: [2.57e-05, 5.78e-05]}}
  joints:
    j: {pin: [ground.O, a.start]}
    k: {pin: [a.P, b.P], dry_friction: {static: 1.5e-07, kinetic: 9.9e-08}}
  forces: {t: {motor: j, ramp: 2.48e-05}}
initial: {a: {angle: -0.213, omega: -106.2}, b: {angle: -2.168, omega: 209.4}}
allow: {a.x: 1.0e-06}
""", 0.01, 5),
    # Friction by the root of the speed: beside its stop no integrator knows the speed to rounding.
    "root": ("""\
scene:
  points: {O: [3.113, 1.907]}
  bodies:
    a: {bar: {mass: 1.113, length: 0.555}, points: {P: [-0.204795, 0.102675]}}
    b: {bar: {mass: 0.567, length: 0.597}}
  joints:
    j: {slot: [ground.O, a.P], along: [1, 0]}
    k: {pin: [a.P, b.start]}
  forces:
    v: {viscous: j, coefficient: 1.655, exponent: 0.5}
    t: {torsion: k, stiffness: 28.555, rest_angle: -1.318}
initial:
  j: {shift: -0.07, speed: 0.332}
  a: {angle: 2.69, omega: 0.032}
  b: {angle: 0.681, omega: 2.699}
allow: {a.x: 1.0e-3}
""", 1.0, 41),
    "chain": (CHAIN, 0.5, 3),  # measured 1.05e-12, of a condition of 1e4
}  # fmt: skip
# Shipped systems with other numbers: they divide by next to nothing, or forces are rounding's.
ALTERED = {
    "four_bar": ("d: 0.9", "d: 0.44"),  # coupler and rocker pass in line within 0.005 rad
    "dynamometer_smooth": ("F_minus: 3.0", "F_minus: 1.5"),  # 6e-44 N at the first sample
}


def case(name: str, folder: Path) -> Case:
    if name in SCENES:
        text, duration, samples = SCENES[name]
        return scenes.parsed(text, tail=scenes.tail(duration, samples))
    text = shipped()[name].read_text(encoding="utf-8")
    assert ALTERED[name][0] in text
    head, _, _ = text.replace(*ALTERED[name]).partition("reach:")
    (folder / f"{name}.yaml").write_text(head, encoding="utf-8")
    return scenes.load(folder / f"{name}.yaml")[0]


@pytest.mark.slow
@pytest.mark.parametrize("name", [*SCENES, *ALTERED])
def test_what_is_right_holds(name: str, tmp_path: Path) -> None:
    assert broken(solve(case(name, tmp_path))) == set()


def more(accelerations: Callable[..., Array], part: float) -> Callable[..., Array]:
    """Accelerations that are off by a part of ω v, or of themselves."""

    def wrong(self: Any, t: float, q: Array, v: Array) -> Array:
        a = accelerations(self, t, q, v)
        return a + part * max(float(np.max(np.abs(a))), float(np.max(np.abs(v))) ** 2)

    return wrong


def unforgiving(answer: Any, built: Any, times: Any, marched: Any, drift: Any) -> Any:
    """Laws that know of no drift of a rate."""
    return ASKED(answer, built, times, marched, 0.0)


ASKED, ACCELERATIONS = certify.laws, Multibody.accelerations
T, U, REACTIONS = Multibody.T, Multibody.U, FourBar.reactions
LAGRANGE = {"accelerations by Lagrange (2.44)", MULTIPLIERS}
LIGHTER = (
    Multibody, "T",
    lambda self, t, q, v: T(self, t, q, v) + 0.5e-9 * self.masses["b"].J * v[2] * v[2],
)  # fmt: skip
LOOSER = (Multibody, "U", lambda self, t, q: U(self, t, q) + 1e-8 * np.sum(q))
ONE = (lagrange, "_equal_energy_rates", lambda M, energy, most: np.ones(len(M)))
# By what is planted: the scene, what is replaced, and the rows of which at least one breaks.
PLANTED: dict[str, tuple[str, tuple[Any, str, Any], set[str]]] = {
    # 1e-8 N and N m more along all coordinates: accelerations show it where nothing has power.
    **{f"potential of what rests off by 1e-8 N ({x})": (x, LOOSER, LAGRANGE) for x in STILL},
    **{
        f"accelerations off by 1e-10 of what moves ({name})": (
            name, (kind, "accelerations", more(kind.accelerations, 1e-10)),
            {VORONETS, APPELL, *LAGRANGE},
        )
        for name, kind in {
            "spins": SpatialMultibody, "pushed": SpatialMultibody, "slips, R = 0.1 m": Multibody,
        }.items()
    },
    "kinetic energy of a turn off by 1e-9 (R = 0.1 m)": ("slips, R = 0.1 m", LIGHTER, {POWER}),
    "kinetic energy of a turn off by 1e-9 (R = 1e-07 m)": ("slips, R = 1e-07 m", LIGHTER, {POWER}),
    "a rate in rad/s for one in m/s, of what never moves": (
        "tiny", (laws.Scale, "idle", lambda self, mode, t, q, n: np.ones(n)), {VORONETS},
    ),
    "a reaction off by 1e-9 beside a dead centre": (
        "four_bar",
        (FourBar, "reactions", lambda self, *at: {
            name: force * (1 + 1e-9) for name, force in REACTIONS(self, *at).items()
        }),
        {"reactions by Newton-Euler"},
    ),
    "forces that are rounding's alone, balanced to their own digits": (
        "dynamometer_smooth", (laws, "SMALL", 0.0), {BALANCE},
    ),
    "T of 1 rad/s beside T of 1 m/s, and of what is driven, to all its digits": (
        "pair", ONE, {VORONETS},
    ),
    "drift of a rate bounded by roundings where no integrator keeps it so well": (
        "root", (certify, "laws", unforgiving), {POWER},
    ),
    "rounding of a long chain's equations taken for a mistake": (
        "chain", (laws, "_held_together", lambda mode, t, q, v: 0.0), {MULTIPLIERS},
    ),
    # Its power loses nothing by the chain's length.
    "accelerations of a long chain off by 1e-9 of themselves": (
        "chain",
        (Multibody, "accelerations", lambda self, *at: (1 + 1e-9) * ACCELERATIONS(self, *at)),
        {POWER},
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", PLANTED)
def test_what_is_wrong_by_little_is_seen(mistake: str, tmp_path: Path, monkeypatch: Patch) -> None:
    name, plant, seen = PLANTED[mistake]
    monkeypatch.setattr(*plant)
    assert broken(solve(case(name, tmp_path))) & seen


@pytest.mark.slow
def test_of_what_is_driven_too_T_is_not_known_to_all_its_digits(
    tmp_path: Path, monkeypatch: Patch
) -> None:
    monkeypatch.setattr(*ONE)
    assert VORONETS in broken(solve(case("driven", tmp_path)))


@pytest.mark.slow
@pytest.mark.mutant("a hinge that is turned over, beside a motion")
def test_a_hinge_that_is_turned_over_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.setattr(laws.Scale, "turned", lambda self, mode, t, q, n: np.full(n, np.inf))
    assert not broken(solve(case("fan", tmp_path)))
    monkeypatch.setattr(laws.Scale, "axes_keep_sense", lambda *given: True)
    assert VORONETS in broken(solve(case("fan", tmp_path)))


@pytest.mark.slow
@pytest.mark.mutant("what moves slowly is drawn beside itself, by a fast rotor's turns")
def test_a_fast_rotor_keeps_nothing_else_near(monkeypatch: Patch) -> None:
    text = f"""\
{SPACE}\
  points: {{O: [0, 0, 0]}}
  bodies:
    sled: {{rigid: {{mass: 1.0, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}}}}
    fan: {{rigid: {{mass: 0.3, inertia: [2.0e-3, 3.0e-3, 4.0e-3, 0, 0, 0]}}}}
  joints:
    rail: {{slide: [ground.O, sled.center], along: [1, 0, 0]}}
    spin: {{hinge: [sled.center, fan.center], axis: [0, 0, 1]}}
initial: {{rail: {{shift: 0, shift_dot: 10}}, spin: {{angle: 0, omega: 1.0e+4}}}}
allow: {{sled.x: 1.0e-3}}
"""
    sound, slid = laws.states, list[float]()

    def kept(mode: Any, times: Array, y: Array, *given: Any) -> Iterator[Any]:
        for t, q, v in sound(mode, times, y, *given):
            here = mode.poses(t, *mode.parted(y[int(np.argmin(abs(times - t)))]))
            slid.append(abs(mode.poses(t, q, v)["sled"][0] - here["sled"][0]))
            yield t, q, v

    monkeypatch.setattr(laws, "states", kept)
    for planted in (False, True):
        if planted:
            patched = lambda self, mode, t, q, n: np.full(n, np.inf)  # noqa: E731
            monkeypatch.setattr(laws.Scale, "turned", patched)
        solve(scenes.parsed(text, tail=scenes.tail(0.1, 11)))
    near, beside = slid
    assert near > 0.02  # m, of a motion over 1 m
    assert beside < 1e-3


@pytest.mark.mutant("a torque of 1e-9 of J ω² where none is needed")
def test_a_torque_that_is_none_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    """What nothing loads needs no torque, but for the rounding of ω × J ω."""
    text = """\
title: States without any load
source: {equations: ["2.44"]}
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: [0.5, 0.5, 0.3, 0.01, 0, 0]}}}
  joints: {q: {hinge: [ground.O, b.center], axis: [0, 0, 1]}}
states: {random: 20, seed: 1, q: [-2.5, 2.5], q_dot: [-3, 3]}
allow: {q.torque: 1.0e-10, energy.kinetic: 1.0e-10}
"""
    assert broken(solve(claimed(tmp_path, text))) == set()
    sound = answer.by_virtual_work

    def wrong(*given: Any) -> Any:
        return {name: (work + 1e-9 * size, size) for name, (work, size) in sound(*given).items()}

    monkeypatch.setattr(answer, "by_virtual_work", wrong)
    assert "Lagrange (2.44) against d'Alembert (2.39)" in broken(solve(claimed(tmp_path, text)))


@pytest.mark.slow
@pytest.mark.mutant("NaN in the power balance of one mode")
@pytest.mark.parametrize("part", [(0.0, 0.5), (0.7, 0.76), (1.2, 1.6)])
def test_nan_is_not_lost_in_whichever_mode(part: tuple[float, float], monkeypatch: Patch) -> None:
    """It slides until 0.765 s and sticks after that."""
    terms = laws.energy.power_terms

    def sometimes(system: Mode, t: float, q: Array, v: Array) -> Array:
        return np.array([np.nan]) if part[0] <= t <= part[1] else terms(system, t, q, v)

    monkeypatch.setattr(laws.energy, "power_terms", sometimes)
    braking = scenes.SHIPPED["sliding_block.braking"]
    checks = certified(braking, written(braking.system or "", braking.parameters))
    assert broken(checks) == {POWER}


@pytest.mark.parametrize(
    ("rows", "lost"),
    [
        ([[1.0, 0.0], [0.0, 5.0]], 1e-13),
        ([[1.0, 0.0], [1.0, 0.0]], 0.0),
        ([[1.0, 0.0], [0.0, 0.0]], 0.0),
    ],
    ids=["apart", "dependent", "one of none"],
)
def test_rows_that_depend_on_each_other_widen_nothing(
    rows: list[list[float]], lost: float, monkeypatch: Patch
) -> None:
    monkeypatch.setattr(laws, "constraint_rows", lambda *_: rows)
    none = np.zeros(2)
    assert laws._held_together(None, 0.0, none, none) == pytest.approx(lost)  # type: ignore[arg-type]


# What needs no multipliers, at states beside those of a motion.

TIMES = np.linspace(0.0, 2.0, 5)


class Unit(laws.Scale):
    """1 m/s² or rad/s² is what all is small against."""

    def __init__(self) -> None:
        pass

    def largest_alone(self, mode: Mode, t: float, q: Array, v: Array) -> float:
        return 1.0

    def idle(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        return np.ones(n)

    def turned(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        return np.full(n, np.inf)

    def axes_keep_sense(self, mode: Mode, t: float, q: Array, v: Array, there: Array) -> bool:
        return True


def eliminated(mode: Mode, y: Array) -> dict[str, Check]:
    return {check.name: check for check in laws.eliminated(mode, Unit(), TIMES, y)}


def motion(name: str) -> tuple[Mode, Array]:
    """A mode, and five of its states as if they were a motion."""
    if name in FORMAL:
        return FORMAL[name], np.array([np.concatenate(at[1:]) for at in formal(name, 5)])
    return only(name), np.array([np.concatenate(at[1:]) for at in states(name, "moving", 5)])


@pytest.mark.parametrize(
    ("name", "names"),
    [
        ("sleigh", [VORONETS, CHAPLYGIN, APPELL]),
        ("upright wheel", [VORONETS, CHAPLYGIN, APPELL]),
        ("top", [VORONETS, APPELL]),
    ],
)
def test_the_ingredients_tell_which_apply(name: str, names: list[str]) -> None:
    found = eliminated(*motion(name))
    assert list(found) == names
    assert all(check.holds for check in found.values())


@pytest.mark.mutant("sign of β in (2.65)", "a potential 1e-6 too large")
def test_a_mistake_is_seen(monkeypatch: Patch) -> None:
    def seen(owner: Any, name: str, planted: Any) -> set[str]:
        with monkeypatch.context() as patch:
            patch.setattr(owner, name, planted)
            return broken(eliminated(*motion("sleigh")).values())

    beta, sleigh = voronets.beta, type(FORMAL["sleigh"])
    U = sleigh.U
    assert seen(voronets, "beta", lambda *at: -beta(*at)) == {VORONETS}
    more = seen(sleigh, "U", lambda self, t, q: 1.000001 * U(self, t, q))
    assert more == {VORONETS, CHAPLYGIN, APPELL}


@pytest.mark.mutant("gyroscopic moment left out where the motion has none")
def test_what_the_motion_never_shows_is_seen_beside_it() -> None:
    """A body that turns about a principal axis has no gyroscopic moment to lose."""
    sound: Any = FORMAL["free body"]
    axis = np.linalg.eigh(J)[1][:, 2]
    row = np.concatenate([np.zeros(3), [1.0, 0.0, 0.0, 0.0], np.zeros(3), 2.0 * axis])

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        return sound.accelerations(t, q, np.concatenate([v[:3], 0.0 * v[3:]]))

    lost = mutant(sound, accelerations=accelerations)
    at = 0.0, row[:7], row[7:]
    np.testing.assert_allclose(lost.accelerations(*at), sound.accelerations(*at), atol=1e-14)
    found = eliminated(lost, np.array([row] * 5))
    assert not any(check.holds for check in found.values())
    assert found.keys() == {VORONETS, APPELL}


@pytest.mark.parametrize(("light", "bound"), [(0.7, 1e-12), (1e-9, 1e-5)])
def test_the_bound_tells_what_uneven_masses_lose(light: float, bound: float) -> None:
    """Ten times ε and the ratio of the masses, in whole powers of ten."""
    y = motion("double_pendulum")[1]
    (check,) = eliminated(only("double_pendulum", m1=light, m2=1.0), y).values()
    assert check.holds
    assert check.bound == pytest.approx(bound)


@pytest.mark.parametrize(("light", "asked"), [(1e-7, True), (1e-10, False)])
def test_equations_that_lost_half_of_their_digits_are_not_asked(light: float, asked: bool) -> None:
    """The lower body of a crossed pendulum as light as that: their condition is about 1 over it."""
    crossed = scenes.SHIPPED["crossed_pendulum"]
    sound = scenes.mechanism(crossed).base
    last: Any = list(crossed.scene.bodies.values())[-1]
    inertia = tuple(light * x for x in last.inertia)
    lighter = replace(last, mass=light * last.mass, inertia=inertia)
    bodies = {**crossed.scene.bodies, last.name: lighter}
    mode = SpatialMultibody(replace(sound.scene, bodies=bodies), sound.start())
    found = eliminated(mode, np.array([np.concatenate(mode.start())] * 5))
    assert list(found) == ([VORONETS, APPELL] if asked else [])
    assert all(check.holds for check in found.values())


@pytest.mark.parametrize("name", ["top", "four_bar", "rolling_wheel"])
def test_states_beside_a_motion_are_such_as_the_mode_allows(name: str) -> None:
    """And elsewhere than the motion was."""
    mode, y = motion(name)
    found = list(laws.states(mode, TIMES, y, 20))
    assert len(found) == 20
    assert min(np.max(np.abs(q - row[: len(q)])) for _, q, _ in found for row in y) > 1e-3
    for t, q, v in found:
        assert t in TIMES
        assert np.max(np.abs(mode.f(t, q)), initial=0.0) < 1e-12
        rows = np.reshape(mode.f_a(t, q), (-1, len(v)))
        assert np.max(np.abs(rows @ v - mode.g(t, q)), initial=0.0) < 1e-12
        if "q3" in mode.coordinates:
            assert abs(q[-4:] @ q[-4:] - 1.0) < 1e-14


def test_a_long_way_keeps_the_length_of_a_quaternion_or_is_not_gone() -> None:
    mode, q = FORMAL["top"], np.array([0.5, 0.5, 0.5, 0.5])
    there = laws.midpoint_step(mode, 0.0, q, np.array([0.9, -0.8, 0.7]))
    assert there is not None
    assert abs(there @ there - 1.0) < 1e-15
    assert laws.midpoint_step(mode, 0.0, q, np.array([90.0, -80.0, 70.0])) is None


def test_where_the_mode_has_no_answer_another_state_is_drawn() -> None:
    sound, y = motion("four_bar")

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        if not np.min(np.abs(y[:, 0] - q[0])) < 1e-2:
            raise ArithmeticError("too far")
        return sound.accelerations(t, q, v)

    found = [q for _, q, _ in laws.states(mutant(sound, accelerations=accelerations), TIMES, y, 20)]
    assert len(found) == 20
    assert all(np.min(np.abs(y[:, 0] - q[0])) < 1e-2 for q in found)
