"""What ends a motion before its time is told as a mistake of the case, at its place."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from given.machines.closed_motions import time_to_flat
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference import refusal
from textmech.reference import solve as solving
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.motion.stuck import Stuck
from textmech.reference.refusal import refusals
from textmech.reference.solve import solve
from textmech.reference.system import Array


@pytest.mark.slow
def test_a_flat_parallelogram_ends_the_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """There it can go on as a parallelogram or crossed: reported soon, and with the time."""
    asked, accelerations = Counter[str](), Multibody.accelerations

    def counted(mode: Multibody, t: float, q: Array, v: Array) -> Array:
        asked["accelerations"] += 1
        return accelerations(mode, t, q, v)

    monkeypatch.setattr(Multibody, "accelerations", counted)
    mistake = refused(scenes.scene("parallelogram"))
    # Measured 1.2e4, not twice a whole four-bar; the integrators alone would creep on for minutes.
    assert asked["accelerations"] < 2.5e4
    assert mistake.where == "duration"
    told = float(mistake.what.split("t = ")[1].split(" s")[0])
    assert told == pytest.approx(time_to_flat(), abs=6e-5)  # half of its fourth digit
    assert "what D holds is held by the others already" in mistake.what


def test_a_spring_without_length() -> None:
    mistake = refused(scenes.scene("mass_on_spring", c=3, y=0))
    assert mistake.where == "duration"
    assert "beyond t = 0 s: coil has no length there, and so no direction" in mistake.what


def test_a_spring_that_loses_its_length_on_the_way() -> None:
    """It would push backwards beyond its anchor: λ = λ₀ + 1.5 cos(√(c/m) t) m is zero there."""
    mistake = refused(scenes.scene("mass_on_spring", "scene: {gravity: none}", c=3, y=-2))
    assert mistake.where == "duration"
    t = np.arccos(-0.5 / 1.5) / np.sqrt(3 / 0.7)
    assert f"beyond t = {t:.4g} s: coil has no length there" in mistake.what


RUBS = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {c: {particle: {mass: 1}}}
  joints: {rail: {slide: [ground.O, c.center], along: [1, 0], dry_friction: {kinetic: 2}}}
  forces: {coil: {spring: [ground.O, c.center], stiffness: 3, rest_length: 0.2 ONLY}}
initial: {c: {x: 0, vx: 3}}
allow: {c.x: 1.0e-2}
"""


@pytest.mark.mutant("a slack spring without length makes every speed beside it rounding")
def test_a_spring_without_length_at_the_start_of_what_rubs(tmp_path: Path) -> None:
    """What sticks or slides is asked before any step; and what is slack needs no direction."""
    mistake = refused(scenes.typed(tmp_path, RUBS.replace("ONLY", "")))
    assert mistake.where == "scene.forces.coil"
    assert mistake.what.startswith("has no length at the start, and so no direction")
    slack = scenes.typed(
        tmp_path, RUBS.replace("ONLY", ", only: tension"), tail=scenes.tail(0.05, 6)
    )
    x = solve(slack).trajectory.states["c"][:, 0]
    assert x == pytest.approx(3 * slack.times - slack.times**2, abs=1e-13)  # 2 N on 1 kg


MUSCLE = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {c: {particle: {mass: 1}}}
  joints: {rail: {slide: [ground.O, c.center], along: [1, 0]}}
  forces:
    calf: {linear_muscle: [ground.O, c.center], isometric: 1, damping: 5, series_stiffness: 20,
           parallel_stiffness: 0, rest_length: 0.2, contractile_length: 0.2}
initial: {c: {x: 0.2, vx: -3}}
allow: {c.x: 1.0e-2}
"""


@pytest.mark.parametrize("samples", [3, 11])
@pytest.mark.mutant("a muscle that goes through its own length 0")
def test_a_muscle_that_loses_its_length_on_the_way(samples: int, tmp_path: Path) -> None:
    """With u = 0.2 m + w, ẍ = −20 (x − u), u̇ = −(1 − 20 (x − u))/5: x is zero after 67.56 ms."""
    mistake = refused(scenes.typed(tmp_path, MUSCLE, tail=scenes.tail(0.2, samples)))
    assert mistake.where == "duration"
    w = solve_ivp(
        lambda t, y: (y[1], -20 * (y[0] - y[2]), -(1 - 20 * (y[0] - y[2])) / 5),
        (0.0, 0.2), (0.2, -3.0, 0.2), events=lambda t, y: y[0], rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    assert w.t_events is not None
    assert f"beyond t = {w.t_events[0][0]:.4g} s: calf has no length there" in mistake.what


@pytest.mark.slow
def test_a_rhombus_that_folds_flat_ends_the_motion() -> None:
    """Its own coordinates know no constraint; the generated answer stops where it lies flat."""
    rhombus = scenes.SHIPPED["rhombus"]
    soft = {name: replace(f, stiffness=1e-3) for name, f in rhombus.scene.forces.items()}  # type: ignore[call-overload]
    case = replace(
        rhombus,
        scene=replace(rhombus.scene, forces=soft),
        parameters={**rhombus.parameters, "c": 1e-3},
    )
    mistake = refused(case)
    assert mistake.where == "duration"
    assert "diagonal has no length there" in mistake.what


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (
            scenes.scene(
                "hanging_bar",
                "scene: {bodies: {dot: {particle: {mass: 1.2e+6}}}}\ninitial: {dot: {x: 1, y: 0}}",
            ),
            "dot is 1e+06 times as heavy as bar: give bar more mass, or leave it out",
        ),
        (
            scenes.scene("mass_on_spring", c=1e8),
            "a spring of 1e+08 N/m swings 2e+03 times in 1 s: make it softer, or a joint",
        ),
        (scenes.scene("hanging_bar"), "shorten the duration, or change what is about to jump"),
    ],
    ids=["masses", "spring", "unknown"],
)
def test_steps_that_shrink_are_told_with_what_can_be_done(case: Case, words: str) -> None:
    generated = scenes.mechanism(case)
    y = np.concatenate(generated.start()[1:])
    reason = "the steps shrink to nothing at t = 0.00034668686823560225"
    with pytest.raises(CaseError) as caught, refusals(case, generated):
        raise Stuck(reason, generated.base, 0.00034668686823560225, y)
    (mistake,) = caught.value.mistakes
    begin = "the motion cannot be followed beyond t = 0.0003467 s: the steps shrink to nothing; "
    assert mistake.what.startswith(begin + words)


HEAVY = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 1.0e6}}}
  joints:
    guide:
      slide: [ground.O, b.center]
      along: [1, 0]
      dry_friction: {static: 6.0e6, kinetic: 3.0e6, smooth: {band: BAND, sharpness: SHARP}}
  forces: {pull: {push: b.center, ramp: [-1.0e6, 0]}}
initial: {b: {x: 0, vx: 0}}
allow: {b.x: 1.0e-3}
duration: 8.0
samples: 11
"""
"""Example 2.3 with a million times its masses and forces."""


def heavy(tmp_path: Path, band: str, sharpness: str) -> Case:
    text = HEAVY.replace("BAND", band).replace("SHARP", sharpness)
    return scenes.typed(tmp_path, text, tail="")


@pytest.mark.slow
@pytest.mark.mutant("a smooth law too sharp for its forces is not told")
def test_a_smooth_law_too_sharp_for_its_forces_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = heavy(tmp_path, "5.0e-4", "1.0e+5")
    mistake = refused(case)
    assert mistake.where == "scene.joints.guide.dry_friction.smooth.sharpness"
    assert "within 2e-12 of the static friction of guide" in mistake.what
    monkeypatch.setattr(refusal, "SHARP", np.inf)
    assert refused(case).where == "duration"


@pytest.mark.slow
def test_what_is_advised_against_too_sharp_a_law_helps(tmp_path: Path) -> None:
    """From t = 6 s on 3e6 N brake: x = -(1e6 s³/6 + (6 - 3) 1e6 s²/2) / 1e6 kg, s = 2 s."""
    exact = -(2.0**3 / 6 + 3 * 2.0**2 / 2)
    smoother = solve(heavy(tmp_path, "0.5", "100"))
    assert smoother.holds
    assert smoother.trajectory.states["b"][-1, 0] == pytest.approx(exact, abs=1e-6)


@pytest.mark.mutant("a reference that finds no memory ends in a traceback")
def test_what_finds_no_memory_is_told_with_its_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    case = scenes.scene("mass_on_spring", c=3, y=-2)

    def moved(case: Case) -> None:
        np.ones(2**50)  # of no machine

    monkeypatch.setattr(solving, "_solve_islands", moved)
    mistake = refused(case)
    assert (mistake.where, mistake.line > 1) == ("scene", True)
    assert "needs more memory than its process may take (Unable to allocate 8.00 P" in mistake.what


SLEIGH = """\
scene:
  space: 3
  bodies:
    sled: {rigid: {mass: 1.7, inertia: [0.05, 0.09, 0.12, 0, 0, 0]}, points: {P: [-0.35, 0, -0.1]}}
  constraints: {blade: {edge: sled.P, along: [1, 0, 0]}}
initial:
  sled: {x: 0, y: 0, z: 1, vx: 0.4, attitude: {axis: [1, 2, 1], angle: 0.4}, omega: [0.3, 2, 0.5]}
allow: {sled.x: 1.0e-2}
duration: 3.0
samples: 11
"""


@pytest.mark.slow
@pytest.mark.mutant("a blade that stands upright is not told")
def test_a_sleigh_that_falls_on_its_nose(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Free in space its blade comes to point down, where it has no heading."""
    case = scenes.typed(tmp_path, SLEIGH, tail="")
    mistake = refused(case)
    assert "blade points straight down there and has no heading: sled falls on" in mistake.what
    monkeypatch.setattr(refusal, "STEEP", 0.0)
    assert "the steps shrink to nothing" in refused(case).what
