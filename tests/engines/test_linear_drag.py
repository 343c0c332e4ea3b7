"""Drag in proportion to the speed, by what the engines have: dampings of slides, of the space."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.planning import TUNED, moved, ways
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.engines.engine import Refusal
from textmech.engines.mujoco.model import force
from textmech.engines.mujoco.read import reaction
from textmech.engines.pymunk.callbacks import force as of_pymunk
from textmech.engines.pymunk.model import damping
from textmech.reports.compare.trial.start import assembled

D, M = 0.7, 0.5
DISK = f"disk: {{mass: {M}, radius: 0.1}}"
THROWN = f"""\
scene:
  gravity: none
  points: {{O: [0, 0], Q: [2, 0]}}
  bodies: {{ball: {{{DISK}, points: {{P: [0.05, 0]}}}}MORE}}
  forces: {{air: {{drag: ball.center, coefficient: {D}, exponent: 1}}FORCES}}
BELOWinitial: {{ball: {{x: 0, y: 0, vx: 3, vy: 4SPIN}}START}}
allow: {{ball.x: 1.0e-3}}
"""
STEP = 1e-3  # s


def thrown(folder: Path, **changed: str) -> Case:
    words = {"MORE": "", "FORCES": "", "BELOW": "", "SPIN": "", "START": ""} | changed
    text = THROWN
    for word, more in words.items():
        text = text.replace(word, more)
    return scenes.typed(folder, text)


def ran(engine: str, case: Case, **asked: Any) -> Any:
    return moved(TUNED[engine], case.scene, assembled(case), case.times, STEP, **asked)


def why(engine: str, case: Case) -> str:
    """Why it is not native."""
    first, *_ = TUNED[engine].plans(case.scene, assembled(case))
    assert isinstance(first, Refusal)
    return first.because


@pytest.mark.parametrize("engine", TUNED)
def test_a_thrown_disk_is_slowed_by_the_engine_itself(engine: str, tmp_path: Path) -> None:
    """v₀ exp(−d t/m), and the places that it makes: MuJoCo's of fourth order, pymunk's second."""
    case = thrown(tmp_path)
    states = ran(engine, case).states["ball"]
    slowed = np.exp(-D / M * case.times)
    assert states[:, 3:5] == pytest.approx(np.outer(slowed, [3.0, 4.0]), abs=1e-12)
    far = np.outer((1 - slowed) * M / D, [3.0, 4.0])
    near = {"mujoco": 1e-11, "pymunk": 5.0 * (D / M) * STEP**2 / 12 * 1.1}  # of the trapezoid
    assert np.max(np.abs(states[:, :2] - far)) < near[engine]


@pytest.mark.parametrize("engine", TUNED)
def test_what_falls_comes_to_its_terminal_speed(engine: str, tmp_path: Path) -> None:
    """m g/d; pymunk's is larger by the half of d h/m, as gravity comes after the damping."""
    case = thrown(tmp_path)
    case = replace(case, scene=replace(case.scene, gravity=(0.0, -9.81)), duration=20.0)
    speed = -ran(engine, case).states["ball"][-1, 4] / (9.81 * M / D)
    assert speed == pytest.approx(1.0 + (D / M * STEP / 2 if engine == "pymunk" else 0.0), abs=1e-6)


def test_a_slide_holds_what_its_drag_leaves(tmp_path: Path) -> None:
    """On a slope of 0.6 to 0.8 the guide's force is 0.6 m g, whatever slows along it."""
    slide = "  joints: {guide: {slide: [ground.O, ball.center], along: [0.6, 0.8]}}\n"
    case = thrown(tmp_path, BELOW=slide)
    case = replace(case, scene=replace(case.scene, gravity=(0.0, -9.81)))
    motion = ran("mujoco", case, reactions=("guide.fx", "guide.fy"))
    held = np.array([-0.8, 0.6]) * 0.6 * 9.81 * M
    found = np.array([motion.reactions[f"guide.{axis}"] for axis in ("fx", "fy")]).T
    assert found == pytest.approx(np.tile(held, (len(found), 1)), abs=1e-9)


@pytest.mark.mutant("MuJoCo's damping of a slide is counted among what its guide holds")
def test_a_drag_that_the_guide_holds_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "damped", lambda scene, joint: [])
    with pytest.raises(AssertionError):
        test_a_slide_holds_what_its_drag_leaves(tmp_path)


@pytest.mark.parametrize(
    ("engine", "planted"),
    [
        pytest.param("pymunk", "rate", marks=pytest.mark.mutant("pymunk slows by d, not by d/m")),
        pytest.param("mujoco", "write", marks=pytest.mark.mutant("MuJoCo damps by the double")),
    ],
)
def test_the_audit_reads_the_coefficient_back(
    engine: str, planted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = thrown(tmp_path)
    start = assembled(case)
    sound = TUNED[engine].measure(case.scene, start)
    assert sound["air.coefficient"] == pytest.approx(D, rel=1e-14)
    if planted == "rate":
        monkeypatch.setattr(of_pymunk, "rate", lambda scene: D)
    else:
        double = lambda sections, force, *slides: [s.give("damping", 2 * D) for s in slides]  # noqa: E731
        known = force.ELEMENTS[type(case.scene.forces["air"])]
        changed = {**force.ELEMENTS, type(case.scene.forces["air"]): replace(known, write=double)}
        monkeypatch.setattr(force, "ELEMENTS", changed)
    assert TUNED[engine].measure(case.scene, start)["air.coefficient"] != pytest.approx(D, rel=0.1)


BOTH = ("native", "law")
SECOND = ", other: {particle: {mass: 1}}"
AT_REST = ", other: {x: 1, y: 1}"


@pytest.mark.parametrize(
    ("changed", "mujoco", "pymunk"),
    [
        ({}, "", ""),
        ({"SPIN": ", omega: 2"}, "", "slows turning too, as that of ball"),
        ({"FORCES": ", w: {torque: ball, constant: 1}"}, "", "slows turning too"),
        (
            {"SPIN": ", angle: 0", "FORCES": ", w: {push: ball.P, constant: [1, 0]}"},
            "",
            "slows turning too",
        ),
        (
            {"MORE": SECOND, "START": AT_REST},
            "",
            "slows all bodies alike: ball loses 1.4 1/s and other 0",
        ),
        (
            {
                "MORE": SECOND,
                "START": AT_REST,
                "FORCES": ", oil: {drag: other.center, coefficient: 1.4, exponent: 1}",
            },
            "",
            "",
        ),
        (
            {"FORCES": ", oil: {drag: ball.center, coefficient: 0.1, exponent: 1}"},
            "damps a slide once, and oil is beside air",
            "",
        ),
        (
            {"FORCES": ", oil: {drag: ball.center, coefficient: 0.1, exponent: 2}"},
            "has no drag at a point",
            "no friction by a power of the speed",
        ),
        (
            {
                "SPIN": ", angle: 0",
                "FORCES": ", oil: {drag: ball.P, coefficient: 0.1, exponent: 1}",
            },
            "has no drag at a point",
            "and oil a point beside its centre",
        ),
        (
            {
                "SPIN": ", angle: 0",
                "FORCES": ", o: {drag: ball.center, coefficient: 1, exponent: 1, along: [1, 0], "
                "across: 1}",
            },
            "has no drag at a point",
            "slows alike in all directions, and o does not",
        ),
    ],
)  # fmt: skip
def test_where_it_is_the_engines_own(
    changed: dict[str, str], mujoco: str, pymunk: str, tmp_path: Path
) -> None:
    """And where not, for which reason: beside one that is told, pymunk's space damps nothing."""
    case = thrown(tmp_path, **changed)
    start = assembled(case)
    for engine, reason in (("mujoco", mujoco), ("pymunk", pymunk)):
        if reason:
            assert reason in why(engine, case)
            assert ways(TUNED[engine], case.scene, start)[-1] == "law"
        else:
            own = ("native",) if engine == "mujoco" else BOTH
            assert ways(TUNED[engine], case.scene, start) == own


@pytest.mark.parametrize(
    ("joint", "mujoco", "pymunk"),
    [
        ("slide: [ground.O, ball.center], along: [0.6, 0.8]", "", ""),
        ("slot: [ground.O, ball.center], along: [0.6, 0.8]", "", "slows turning too"),
        ("slot: [ground.O, ball.P], along: [0.6, 0.8]", "by no slides alone", "slows turning too"),
        ("pin: [ground.O, ball.P]", "by no slides alone", "slows turning too"),
    ],
)
def test_what_a_joint_leaves_decides(joint: str, mujoco: str, pymunk: str, tmp_path: Path) -> None:
    start = "" if "slide" in joint else ", angle: 0"
    text = THROWN.replace(", vx: 3, vy: 4SPIN", start).replace("x: 0, y: 0", "x: 0")
    for word in ("MORE", "FORCES", "START"):
        text = text.replace(word, "")
    text = text.replace("BELOW", f"  joints: {{j: {{{joint}}}}}\n")
    if "ball.P" in joint:
        text = text.replace("x: 0, angle", "angle" if "pin" in joint else "x: 0, angle")
    case = scenes.typed(tmp_path, text)
    for engine, reason in (("mujoco", mujoco), ("pymunk", pymunk)):
        first, *_ = TUNED[engine].plans(case.scene, assembled(case))
        told = first.because if isinstance(first, Refusal) else ""
        assert bool(told) == bool(reason), told
        assert reason in told


def test_a_pendulum_in_oil(tmp_path: Path) -> None:
    """A particle on a rod, which pymunk slows as a whole: l φ̈ = −g sin φ − d l φ̇/m.

    As near as the damping, which comes before gravity, lets it be: h d/m of 0.5 m.
    """
    text = f"""\
scene:
  points: {{O: [0, 0]}}
  bodies: {{bob: {{particle: {{mass: {M}}}}}}}
  joints: {{rod: {{distance: [ground.O, bob.center], length: 0.5}}}}
  forces: {{air: {{drag: bob.center, coefficient: {D}, exponent: 1}}}}
initial: {{bob: {{x: 0.3, y: -0.4}}}}
allow: {{bob.x: 1.0e-3}}
"""
    case = scenes.typed(tmp_path, text)
    assert "by no slides alone" in why("mujoco", case)
    states = ran("pymunk", case).states["bob"]
    swung = solve_ivp(
        lambda t, y: [y[1], -9.80665 / 0.5 * math.sin(y[0]) - D / M * y[1]],
        (0.0, float(case.times[-1])),
        [math.asin(0.6), 0.0],
        rtol=1e-10,
        atol=1e-12,
        t_eval=case.times,
    ).y[0]
    assert states[:, 0] == pytest.approx(0.5 * np.sin(swung), abs=STEP * D / M * 0.5)


@pytest.mark.mutant("pymunk's space damps what turns")
def test_a_spin_that_is_damped_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = thrown(tmp_path, SPIN=", omega: 2")
    assert ran("pymunk", case, realised="law").states["ball"][-1, 5] == pytest.approx(2.0)
    monkeypatch.setattr(damping, "_stays_unturned", lambda scene, body, start: True)
    spun = ran("pymunk", case).states["ball"][-1, 5]
    assert spun == pytest.approx(2.0 * math.exp(-D / M), rel=1e-9)
