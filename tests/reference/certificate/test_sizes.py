"""What nothing accelerates, at one instant or at all, is small against what moves and acts there.

A sum that cancels has no size of its own: a certificate that divides by it FAILS what is right.
Each scene stands beside a planted mistake, which is seen as before.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.solve import Solution, solve
from textmech.reference.system import Array

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
