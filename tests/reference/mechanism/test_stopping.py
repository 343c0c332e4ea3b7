"""(2.86) with an exponent below 1 stops a slide, however many samples there are."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.forces import drag
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes.stopping import Stopping
from textmech.reference.motion import event_location as crossing
from textmech.reference.motion.follow import follow
from textmech.reference.solve import mechanism, solve
from textmech.reference.start import rates as start_rates

M, D, V = 1.3, 0.8, 3.0  # kg, N at 1 m/s, m/s
SCENE = """\
title: A slide that oil stops
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies: {{b: {{particle: {{mass: 1.3}}}}}}
  joints: {{rail: {{slide: [ground.O, b.center], along: {along}}}}}
  forces: {{oil: {{viscous: rail, coefficient: 0.8, exponent: {alpha}}}}}
initial: {{b: {{x: 0, y: 0, vx: {vx}, vy: {vy}}}}}
duration: 20
samples: {samples}
allow: {{b.x: 0.01, b.vx: 0.01}}
"""


def slide(tmp_path: Path, alpha: float, samples: int, turned: float = 0.0) -> Case:
    x, y = math.cos(turned), math.sin(turned)
    along = f"[{x!r}, {y!r}]"
    text = SCENE.format(alpha=alpha, samples=samples, along=along, vx=V * x, vy=V * y)
    path = tmp_path / "slide.yaml"
    path.write_text(text)
    (case,) = scenes.load(path)
    return case


@pytest.mark.slow
@pytest.mark.parametrize("alpha", [0.3, 0.5, 0.77, 0.9])
@pytest.mark.parametrize("samples", [41, 51, 81, 101, 126])
def test_it_stops_where_it_must(alpha: float, samples: int, tmp_path: Path) -> None:
    """(2.88) v^{1−α} = v₀^{1−α} − (1 − α) d t/m; x = v₀^{2−α} m/((2 − α) d) at rest."""
    case = slide(tmp_path, alpha, samples, 0.4)
    found = solve(case)
    assert [check for check in found.checks if not check.holds] == []
    left = V ** (1 - alpha) - (1 - alpha) * D / M * case.times
    v = np.maximum(0.0, left) ** (1 / (1 - alpha))
    x = (V ** (2 - alpha) - v ** (2 - alpha)) * M / ((2 - alpha) * D)
    states = found.trajectory.states["b"]
    np.testing.assert_allclose(np.hypot(states[:, 0], states[:, 1]), x, atol=3e-12)
    np.testing.assert_allclose(np.hypot(states[:, 3], states[:, 4]), v, atol=3e-12)


def test_its_time_is_known_as_far_as_it_says(tmp_path: Path) -> None:
    """With α = 0.9 rounding of the speed is a second of the time: nobody knows it better."""
    case = slide(tmp_path, 0.9, 41)
    system = mechanism(case)
    (stop,) = follow(system, case.times).changes
    known = V**0.1 * M / (0.1 * D)
    assert 0.01 < abs(stop.time - known) < system.blurred


def holds(case: Case) -> bool:
    try:
        return solve(case).holds
    except CaseError:  # the motion cannot be followed
        return False


@pytest.mark.slow
@pytest.mark.mutant("a stop without slope: {name}")
@pytest.mark.parametrize("name", ["by its speed alone", "with the friction of rounding"])
def test_a_stop_that_rounding_decides_is_seen(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if name == "by its speed alone":
        monkeypatch.setattr(Stopping, "slowing", lambda self, speed: speed)
    else:
        monkeypatch.setattr(Stopping, "idle", lambda self, state: ())
    # Rounding, another one on another processor, decides which of them.
    each = itertools.product((0.5, 0.9, 0.7, 0.3, 0.2), (51, 41, 101))
    assert not all(holds(slide(tmp_path, alpha, n)) for alpha, n in each)


def test_a_root_is_bracketed_by_what_was_asked_for() -> None:
    """An implicit step repeated differs by rounding: of both ends one answer each."""
    asked: list[float] = []

    def g(at: float) -> float:
        asked.append(at)
        return 1e-17 if asked.count(at) == 1 and at == 0.0 else -1e-17

    assert crossing._root(g, 0.0, 1.0) <= 1.0
    assert crossing._root(lambda at: -1.0, 0.25, 1.0) == 0.25


CARRIED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies:
    c0: {block: {mass: 1, width: 0.3, height: 0.2}}
    c1: {block: {mass: 1, width: 0.3, height: 0.2}}
  joints:
    r0: {slide: [ground.O, c0.center], along: [2, 1]}
    r1: {slide: [c0.center, c1.center], along: [-1, 2]}
  forces: {v0: {viscous: r0, coefficient: 3, exponent: ALPHA}}
initial: {r0: {shift: 0, speed: 0}, r1: {shift: 0.1, speed: 0.7}}
allow: {c1.y: 0.01}
"""


@pytest.mark.mutant("rounding of what another part does sets off a slide that nothing pushes")
@pytest.mark.parametrize("alpha", [0.1, 0.5])
def test_what_coasts_across_sets_nothing_off(alpha: float, tmp_path: Path) -> None:
    """No force acts along the lower slide, which rests: 1e-31 N are left of what turns nothing."""
    text = CARRIED.replace("ALPHA", repr(alpha))
    motion = solve(scenes.typed(tmp_path, text, tail=scenes.tail(0.2, 11)))
    assert motion.holds
    way = (0.1 + 0.7 * motion.trajectory.times) / math.sqrt(5)
    states = motion.trajectory.states
    assert states["c0"] == pytest.approx(0.0, abs=1e-15)
    np.testing.assert_allclose(states["c1"][:, :2], np.outer(way, [-1, 2]), atol=1e-14)


SKEW = """\
scene:
  points: {O: [0, 1.0], A: [0.7, 0.9]}
  bodies:
    c0: {block: {mass: 1.087, width: 0.3, height: 0.2}}
    c1: {block: {mass: 0.721, width: 0.3, height: 0.2}}
  joints:
    r0: {slide: [ground.O, c0.center], along: [-0.044, 0.761]}
    r1: {slide: [c0.center, c1.center], along: [-0.421, 0.586]}
  forces:
    v0: {viscous: r0, coefficient: 3.655, exponent: 0.1}
    s0: {spring: [ground.A, c0.center], stiffness: 22.352, rest_length: 0.236}
  drive: {r1.speed: {polynomial: {coefficients: [0.565, 0.9, -0.224]}}}
initial: {r0: {shift: -0.169, speed: 0}, r1: {shift: 0.143}}
allow: {v0.force: 1.0e-2}
"""


@pytest.mark.slow
@pytest.mark.mutant("rounding of a speed that is none has a viscous force by its root")
@pytest.mark.parametrize("slows", ["viscous: r0", "drag: c0.center"])
def test_what_starts_at_no_speed_has_no_viscous_force(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, slows: str
) -> None:
    """The slides are skew, and of the start's rates 1e-18 m/s are left: 0.05 N by |v|^0.1."""
    case = scenes.typed(tmp_path, SKEW.replace("viscous: r0", slows), tail=scenes.tail(0.2, 11))
    motion = solve(case)
    assert motion.holds
    assert observe(case.scene, motion.trajectory, "v0.force")[0] == 0.0
    assert abs(observe(case.scene, motion.trajectory, "v0.force")[1]) > 1.0
    monkeypatch.setattr(drag, "ROUNDING", 0.0)
    monkeypatch.setattr(start_rates, "ROUNDING", 0.0)
    rounded = solve(case).trajectory
    assert abs(observe(case.scene, rounded, "v0.force")[0]) > 1e-3
