"""What nothing accelerates, at one instant or at all, is small against what moves and acts there.

A sum that cancels has no size of its own: a certificate that divides by it FAILS what is right.
Each scene stands beside a planted mistake, which is seen as before.
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.reference.certificate import certify, laws
from textmech.reference.formalisms import lagrange
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.solve import Solution, solve
from textmech.reference.system import Array
from textmech.reference.systems.linkages.four_bar import FourBar

SPINS = """\
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: [0.5, 0.4, 0.3, 0, 0, 0]}}}
  joints: {q: {hinge: [ground.O, b.center], axis: [0, 0, 1]}}
initial: {q: {angle: 0, omega: 3}}
allow: {q.angle: 1.0e-3}
"""
PUSHED = """\
scene:
  space: 3
  gravity: none
  bodies: {b: {sphere: {mass: 1.3, radius: 0.2}}}
  forces:
    f: {push: b.center, sine: {amplitude: [2.0, 0, 0], angular_frequency: 360 deg/s, phase: 90 deg}}
initial: {b: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}}}
allow: {b.x: 1.0e-3}
"""
SLIPS = """\
scene:
  bodies: {{b: {{disk: {{mass: 1.3, radius: {R!r}}}}}}}
  contacts: {{touch: {{between: [b, ground.floor], friction: 0.3}}}}
initial: {{b: {{x: 0, y: {R!r}, angle: 0, vx: 1}}}}
allow: {{b.x: 1.0e-3}}
"""
BLADE = """\
scene:
  gravity: none
  bodies: {sled: {rigid: {mass: 1.7, inertia: 1.0e+5}, points: {P: [-0.35, 0]}}}
  constraints:
    blade: {edge: sled.P, along: [1, 0.2], speed: {sine: {amplitude: 0.3, angular_frequency: 4.0}}}
initial: {sled: {x: 0, y: 0, angle: 0.1, omega: 0.8}}
allow: {sled.x: 1.0e-3}
"""
TAIL = scenes.tail(1.0, 21)  # two of them are where the cosine of a turn is zero
SOUND = {"spins": SPINS, "pushed": PUSHED, "blade": BLADE}
SOUND |= {f"slips, R = {R:g} m": SLIPS.format(R=R) for R in (1e-1, 1e-5, 1e-7, 1e-9)}


def broken(found: Solution) -> set[str]:
    return {check.name for check in found.checks if not check.holds}


@pytest.mark.slow
@pytest.mark.parametrize("name", SOUND)
def test_what_is_right_holds(tmp_path: Path, name: str) -> None:
    assert broken(solve(scenes.typed(tmp_path, SOUND[name], tail=TAIL))) == set()


def more(accelerations: Callable[..., Array], part: float) -> Callable[..., Array]:
    """Accelerations that are off by a part of ω v, or of themselves."""

    def wrong(self: Any, t: float, q: Array, v: Array) -> Array:
        a = accelerations(self, t, q, v)
        size = max(float(np.max(np.abs(a))), float(np.max(np.abs(v))) ** 2)
        return a + part * size

    return wrong


@pytest.mark.slow
@pytest.mark.mutant("accelerations off by 1e-10 of what moves ({name})")
@pytest.mark.parametrize("name", ["spins", "pushed", "slips, R = 0.1 m"])
def test_what_is_wrong_by_little_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    kind: Any = Multibody if name.startswith("slips") else SpatialMultibody
    monkeypatch.setattr(kind, "accelerations", more(kind.accelerations, 1e-10))
    found = broken(solve(scenes.typed(tmp_path, SOUND[name], tail=TAIL)))
    assert any(law.startswith("accelerations by") for law in found)


@pytest.mark.slow
@pytest.mark.mutant("kinetic energy of a turn off by 1e-9 (R = {R} m)")
@pytest.mark.parametrize("R", [1e-1, 1e-7])
def test_power_that_is_lost_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, R: float
) -> None:
    T = Multibody.T

    def wrong(self: Multibody, t: Any, q: Any, v: Any) -> Any:
        return T(self, t, q, v) + 0.5e-9 * self.masses["b"].J * v[2] * v[2]

    monkeypatch.setattr(Multibody, "T", wrong)
    assert "power balance (2.51)" in broken(
        solve(scenes.typed(tmp_path, SLIPS.format(R=R), tail=TAIL))
    )


# What never moves is drawn as fast as its body is in the whole motion, and no joint is turned over.
TINY = """\
scene:
  space: 3
  gravity: none
  bodies:
    b:
      rigid: {mass: 1.0e-15, inertia: [1.0e-28, 1.5e-28, 2.0e-28, 0, 0, 0]}
      points: {P: [1.0e-6, 0, 0]}
initial: {b: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}, omega: [1, 2, 3]}}
allow: {b.omega_1: 1.0e-3}
"""
FAN = """\
scene:
  space: 3
  gravity: none
  bodies:
    hull: {rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}}
    fan: {rigid: {mass: 0.3, inertia: [2.0e-3, 3.0e-3, 4.0e-3, 0, 0, 0]}}
  joints: {spin: {hinge: [hull.center, fan.center], axis: [0, 0, 1]}}
  forces: {m: {motor: spin, constant: 0.1}}
initial:
  hull: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}, omega: [20, 5, 5]}
  spin: {angle: 0, omega: 30}
allow: {hull.omega_1: 1.0e-1}
"""
BESIDE = {"tiny": TINY, "fan": FAN}


def drawn(folder: Path, name: str) -> set[str]:
    return broken(solve(scenes.typed(folder, BESIDE[name], tail=scenes.tail(1.0, 11))))


@pytest.mark.slow
@pytest.mark.parametrize("name", BESIDE)
def test_states_beside_a_motion_are_of_its_size_and_of_its_assembly(
    name: str, tmp_path: Path
) -> None:
    assert not drawn(tmp_path, name)


@pytest.mark.slow
@pytest.mark.mutant("a rate in rad/s for one in m/s, of what never moves")
def test_a_rate_of_another_unit_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(laws.Scale, "idle", lambda self, mode, t, q, n: np.ones(n))
    assert "accelerations by Voronets (2.66)" in drawn(tmp_path, "tiny")


@pytest.mark.slow
@pytest.mark.mutant("a hinge that is turned over, beside a motion")
def test_a_hinge_that_is_turned_over_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(laws.Scale, "turned", lambda self, mode, t, q, n: np.full(n, np.inf))
    assert not drawn(tmp_path, "fan")
    monkeypatch.setattr(laws.Scale, "assembled", lambda *given: True)
    assert "accelerations by Voronets (2.66)" in drawn(tmp_path, "fan")


ROTOR = """\
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies:
    sled: {rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}}
    fan: {rigid: {mass: 0.3, inertia: [2.0e-3, 3.0e-3, 4.0e-3, 0, 0, 0]}}
  joints:
    rail: {slide: [ground.O, sled.center], along: [1, 0, 0]}
    spin: {hinge: [sled.center, fan.center], axis: [0, 0, 1]}
initial: {rail: {shift: 0, shift_dot: 10}, spin: {angle: 0, omega: 1.0e+4}}
allow: {sled.x: 1.0e-3}
"""


def slid(folder: Path, monkeypatch: pytest.MonkeyPatch) -> float:
    """How far a sled of a motion over 1 m is drawn beside itself [m]."""
    sound, found = laws.drawn, []

    def kept(mode: Any, times: Array, y: Array, *given: Any) -> Iterator[Any]:
        for t, q, v in sound(mode, times, y, *given):
            here = mode.poses(t, *mode.parted(y[int(np.argmin(abs(times - t)))]))
            found.append(abs(mode.poses(t, q, v)["sled"][0] - here["sled"][0]))
            yield t, q, v

    monkeypatch.setattr(laws, "drawn", kept)
    solve(scenes.typed(folder, ROTOR, tail=scenes.tail(0.1, 11)))
    (way,) = found
    return float(way)


@pytest.mark.slow
@pytest.mark.mutant("what moves slowly is drawn beside itself, by a fast rotor's turns")
def test_a_fast_rotor_keeps_nothing_else_near(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        assert slid(tmp_path, patch) > 0.02
    monkeypatch.setattr(laws.Scale, "turned", lambda self, mode, t, q, n: np.full(n, np.inf))
    assert slid(tmp_path, monkeypatch) < 1e-3


# Systems whose own equations divide by next to nothing, or whose forces are rounding's.
ALTERED = {
    "four_bar": ("d: 0.9", "d: 0.44"),  # coupler and rocker pass in line within 0.005 rad
    "dynamometer_smooth": ("F_minus: 3.0", "F_minus: 1.5"),  # 6e-44 N at the first sample
}


def altered(folder: Path, name: str) -> Case:
    text = shipped()[name].read_text(encoding="utf-8")
    old, new = ALTERED[name]
    assert old in text
    head, _, _ = text.replace(old, new).partition("reach:")
    (folder / f"{name}.yaml").write_text(head, encoding="utf-8")
    return scenes.load(folder / f"{name}.yaml")[0]


@pytest.mark.slow
@pytest.mark.parametrize("name", ALTERED)
def test_systems_with_other_numbers_hold(name: str, tmp_path: Path) -> None:
    assert not broken(solve(altered(tmp_path, name)))


@pytest.mark.slow
@pytest.mark.mutant("a reaction off by 1e-9 beside a dead centre")
def test_a_reaction_beside_a_dead_centre_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = altered(tmp_path, "four_bar")
    sound = FourBar.reactions

    def wrong(self: Any, t: float, q: Array, v: Array) -> dict[str, float]:
        return {name: force * (1 + 1e-9) for name, force in sound(self, t, q, v).items()}

    monkeypatch.setattr(FourBar, "reactions", wrong)
    assert broken(solve(case)) >= {"generated reactions", "reactions by Newton-Euler"}


@pytest.mark.slow
@pytest.mark.mutant("forces that are rounding's alone, balanced to their own digits")
def test_forces_that_are_none_are_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(laws, "SMALL", 0.0)
    found = broken(solve(altered(tmp_path, "dynamometer_smooth")))
    assert found == {"Newton-Euler balance (2.23), (2.27)"}


STATES = """\
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


def claim(tmp_path: Path) -> Case:
    path = tmp_path / "states.yaml"
    path.write_text(STATES, encoding="utf-8")
    return scenes.load(path)[0]


def test_states_without_a_load_hold(tmp_path: Path) -> None:
    """What nothing loads needs no torque, but for the rounding of ω × J ω."""
    assert broken(solve(claim(tmp_path))) == set()


@pytest.mark.mutant("a torque of 1e-9 of J ω² where none is needed")
def test_a_torque_that_is_none_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from textmech.reference.states import answer

    sound = answer.by_virtual_work

    def wrong(*given: Any) -> Any:
        return {name: (work + 1e-9 * size, size) for name, (work, size) in sound(*given).items()}

    monkeypatch.setattr(answer, "by_virtual_work", wrong)
    assert "Lagrange (2.44) against d'Alembert (2.39)" in broken(solve(claim(tmp_path)))


# Scenes of 0.3 mm: what goes 10 mm/s turns by 100 rad/s, and where a pivot is driven most of T is
# there without any rate that is free.
PAIR = """\
scene:
  bodies:
    a: {bar: {mass: 8.0e-10, length: 3.0e-4}}
    b: {bar: {mass: 7.0e-10, length: 4.0e-4}}
  joints: {h: {pin: [a.end, b.start]}}
initial: {a: {angle: -0.6, omega: 31.6, x: 1.0e-3, y: 2.0e-3, vx: 0.0316, vy: 0},
          b: {angle: 0.3, omega: 63.2}}
allow: {a.x: 1.0e-6}
"""
DRIVEN = """\
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
"""
SMALL = {"pair": (PAIR, 0.06), "driven": (DRIVEN, 0.01)}


def small(folder: Path, name: str) -> Solution:
    text, duration = SMALL[name]
    return solve(scenes.typed(folder, text, tail=scenes.tail(duration, 5)))


@pytest.mark.parametrize("name", SMALL)
def test_what_is_small_holds(tmp_path: Path, name: str) -> None:
    assert not broken(small(tmp_path, name))


@pytest.mark.slow
@pytest.mark.mutant("T of 1 rad/s beside T of 1 m/s, and of what is driven, to all its digits")
@pytest.mark.parametrize("name", SMALL)
def test_rates_of_one_are_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setattr(lagrange, "_even", lambda M, energy, most: np.ones(len(M)))
    assert "accelerations by Voronets (2.66)" in broken(small(tmp_path, name))


# Friction by the root of the speed: beside its stop no integrator knows the speed to rounding.
ROOT = """\
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
"""


def rooted(folder: Path) -> set[str]:
    return broken(solve(scenes.typed(folder, ROOT, tail=scenes.tail(1.0, 41))))


@pytest.mark.slow
def test_what_the_motion_is_not_known_to_is_no_power(tmp_path: Path) -> None:
    assert not rooted(tmp_path)


@pytest.mark.slow
@pytest.mark.mutant("drift of a rate bounded by roundings where no integrator keeps it so well")
def test_drift_beyond_rounding_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = certify.laws

    def forgives(*given: Any) -> Any:
        answer, built, times, marched, _ = given
        return asked(answer, built, times, marched, 0.0)

    monkeypatch.setattr(certify, "laws", forgives)
    assert rooted(tmp_path) == {"power balance (2.51)"}
