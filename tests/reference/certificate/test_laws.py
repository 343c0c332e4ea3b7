"""The laws along a motion: what lies still is no mistake, and nothing is lost between modes."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes, written_scenes
from given.certified import certified

from textmech.reference.certificate import laws
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve
from textmech.reference.system import Array, Mode
from textmech.reference.systems import written

POWER = "power balance (2.51)"
# What lies still at the end or all the time. Its power is rounding, and was divided by rounding.
STILL = {
    "a mass on a spring that friction stops": """\
scene:
  gravity: none
  points: {O: [0, 0], Q: [-1, 0]}
  bodies: {m: {particle: {mass: 1}}}
  joints:
    rail:
      {slide: [ground.O, m.center], along: [1, 0], dry_friction: {static: 3, kinetic: 2}}
  forces: {coil: {spring: [ground.Q, m.center], stiffness: 30, rest_length: 1}}
initial: {m: {x: 0.2, vx: 0}}
allow: {m.x: 1.0e-3}
""",
    "a bar that has toppled": """\
scene:
  points: {O: [0, 0.2]}
  bodies: {bar: {bar: {mass: 1, length: 1}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
  contacts: {tip: {between: [bar.end, ground.floor], friction: 0}}
initial: {bar: {angle: 60 deg}}
events: {lands: {tip.gap: falls to zero}}
allow: {bar.angle: 1.0e-2}
""",
    "an arch": """\
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
""",
    "a symmetric hanging deck": """\
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
""",
}


@pytest.mark.slow
@pytest.mark.parametrize("name", STILL)
def test_what_lies_still_keeps_its_power_balance(tmp_path: Path, name: str) -> None:
    solution = solve(scenes.typed(tmp_path, STILL[name], tail=scenes.tail(2.0, 26)))
    assert [check for check in solution.checks if not check.holds] == []


@pytest.mark.mutant("potential of what rests off by 1e-8 N ({name})")
@pytest.mark.slow
@pytest.mark.parametrize("name", STILL)
def test_a_potential_that_is_wrong_is_seen_at_rest_too(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1e-8 N and N m more along all coordinates: accelerations show it where nothing has power."""
    U = Multibody.U
    monkeypatch.setattr(Multibody, "U", lambda self, t, q: U(self, t, q) + 1e-8 * np.sum(q))
    solution = solve(scenes.typed(tmp_path, STILL[name], tail=scenes.tail(2.0, 26)))
    broken = {check.name for check in solution.checks if not check.holds}
    assert any(law.startswith("accelerations by Lagrange") for law in broken)


@pytest.mark.slow
@pytest.mark.mutant("NaN in the power balance of one mode")
@pytest.mark.parametrize("part", [(0.0, 0.5), (0.9, 1.02), (1.5, 2.0)])
def test_nan_is_not_lost_in_whichever_mode(
    tmp_path: Path, part: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It slides until 1.02 s and sticks after that."""
    terms = laws.energy.power_terms

    def sometimes(system: Mode, t: float, q: Array, v: Array) -> Array:
        return np.array([np.nan]) if part[0] <= t <= part[1] else terms(system, t, q, v)

    monkeypatch.setattr(laws.energy, "power_terms", sometimes)
    case = written_scenes.case(tmp_path, "braking")
    checks = certified(case, written(case.system or "", case.parameters))
    assert [check.name for check in checks if not check.holds] == [POWER]


BARS = 60
MULTIPLIERS = "accelerations by Lagrange with multipliers (2.60)"


def chain() -> str:
    """A chain of bars, drawn up to a straight line: it falls."""
    ends = ["ground.O", *(f"b{i}.end" for i in range(BARS))]
    bodies = ", ".join(f"b{i}: {{bar: {{mass: 1, length: 0.1}}}}" for i in range(BARS))
    joints = ", ".join(f"j{i}: {{pin: [{ends[i]}, b{i}.start]}}" for i in range(BARS))
    start = ", ".join(f"b{i}: {{angle: -30 deg}}" for i in range(BARS))
    points = "points: {O: [0, 0]}"
    return (
        f"scene:\n  {points}\n  bodies: {{{bodies}}}\n  joints: {{{joints}}}\n"
        f"initial: {{{start}}}\nallow: {{b3.angle: 1.0e-3}}\n"
    )


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
    rows: list[list[float]], lost: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(laws, "constraint_rows", lambda *_: rows)
    none = np.zeros(2)
    assert laws._held_together(None, 0.0, none, none) == pytest.approx(lost)  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.mutant(
    "rounding of a long chain's equations taken for a mistake",
    "accelerations of a long chain off by 1e-9 of themselves",
)
def test_a_long_chain_is_certified_as_far_as_its_equations_tell(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Measured 1.05e-12, of a condition of 1e4; with 11 samples 1.3e-12."""
    case = scenes.typed(tmp_path, chain(), tail=scenes.tail(0.5, 3))

    def broken() -> list[str]:
        return [check.name for check in solve(case).checks if not check.holds]

    assert broken() == []
    with monkeypatch.context() as told:
        told.setattr(laws, "_held_together", lambda mode, t, q, v: 0.0)
        assert broken() == [MULTIPLIERS]
    sound = Multibody.accelerations
    off = 1 + 1e-9
    monkeypatch.setattr(
        Multibody, "accelerations", lambda self, t, q, v: off * sound(self, t, q, v)
    )
    assert POWER in broken()  # which loses nothing by a chain's length
