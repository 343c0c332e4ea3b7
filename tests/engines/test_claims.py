"""Engines' answers about states: against formulas typed here, and with the physics spoilt."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.adapters.planning import SETTINGS, TUNED, moved, planned, words
from given.scenes.claims import CHAIN, PLANE, claimed

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.scene.states import claimable
from textmech.engines.engine import Claims, Engine
from textmech.engines.mujoco.read import readout as read
from textmech.reference.motion import bodies
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import assembled, first
from textmech.reports.compare.trial.states import ways
from textmech.reports.compare.trial.trial import Trial

MUJOCO, PYMUNK = (engines.make(name, "shipped") for name in ("mujoco", "pymunk"))


def told(engine: Engine, case: Case, *, wanted: tuple[str, ...] = ()) -> Mapping[str, Any]:
    """Answers to all that the case claims."""
    assert isinstance(engine, Claims)
    assert case.states is not None
    drawn = case.states.drawn(case.scene)
    return engine.answer(case.scene, assembled(case), drawn, wanted or tuple(case.allow))


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_disk_in_the_plane(engine: Engine, tmp_path: Path) -> None:
    """P at (0.1, 0.05): r = r_c + d, v = v_c + ω × d; J = m R²/2; p = Σ m v."""
    case = claimed(tmp_path, PLANE)
    assert case.states is not None
    drawn, found = case.states.drawn(case.scene), told(engine, case)
    (x, vx), (_, vy), (phi, w) = (drawn[f"wheel.{q}"][:, :2].T for q in ("x", "y", "angle"))
    dx = 0.1 * np.cos(phi) - 0.05 * np.sin(phi)
    assert found["wheel.P.x"] == pytest.approx(x + dx, rel=1e-14)
    assert found["wheel.P.vy"] == pytest.approx(vy + w * dx, rel=1e-13)
    assert found["wheel.inertia"] == pytest.approx(1.3 * 0.2**2 / 2, rel=1e-12)
    p = 1.3 * vx + 0.4 * drawn["bob.x"][:, 1]
    assert found["momentum.x"] == pytest.approx(p, rel=1e-12)
    twice = 2.0 if engine.name == "pymunk" else 1.0
    T = 1.3 * (vx**2 + vy**2) + 0.026 * w**2 + 0.4 * sum(drawn[f"bob.{q}"][:, 1] ** 2 for q in "xy")
    energy = told(engine, case, wanted=("energy.kinetic",))["energy.kinetic"]
    assert energy == pytest.approx(twice * T / 2, rel=1e-12)


def test_mujoco_on_one_hinge(tmp_path: Path) -> None:
    """A bar about its end on a level axis: 1/3 m l² q̈ + m g l/2 cos q, and a = r̈ of its end."""
    text = CHAIN.replace("axis: [0, 3, 4]", "axis: [0, -1, 0]")
    start, end = text.index("    box:"), text.index("  joints:")
    text = text[:start] + text[end:]
    start, end = text.index("    rail:"), text.index("states:")
    text = text[:start] + text[end:]
    start = text.index("allow:")
    text = text[:start] + "allow: {q1.torque: 1.0e-9, mass_matrix: 1.0e-9, rod.end.az: 1.0e-9}\n"
    case = claimed(tmp_path, text)
    assert case.states is not None
    (states,), found = case.states.drawn(case.scene).values(), told(MUJOCO, case)
    q, v, a = states.T
    J = 1.2 * 0.8**2 / 3
    assert found["mass_matrix"] == pytest.approx(J, rel=1e-12)
    weight = 1.2 * 9.80665 * 0.4 * np.cos(q)
    assert found["q1.torque"] == pytest.approx(J * a + weight, rel=1e-11)
    assert found["rod.end.az"] == pytest.approx(
        0.8 * (a * np.cos(q) - v * v * np.sin(q)), rel=1e-11
    )


def test_mujoco_answers_all_that_can_be_claimed(tmp_path: Path) -> None:
    for text in (CHAIN, PLANE):
        case = claimed(tmp_path, text)
        found = told(MUJOCO, case, wanted=tuple(claimable(case.scene)))
        assert not [name for name, rows in found.items() if isinstance(rows, str)]


def test_pymunk_says_what_it_does_not_know(tmp_path: Path) -> None:
    case = claimed(
        tmp_path, PLANE.replace("disk: {mass: 1.3, ", "rigid: {mass: 1.3, inertia: 0.1, ")
    )
    found = told(PYMUNK, case, wanted=tuple(claimable(case.scene)))
    whys = {name: why for name, why in found.items() if isinstance(why, str)}
    assert whys == {
        "wheel.inertia": "adapter: wheel has no shape from which pymunk could compute it",
        "wheel.P.ax": "engine: pymunk has velocities, and nothing that tells an acceleration",
        "wheel.P.ay": "engine: pymunk has velocities, and nothing that tells an acceleration",
        "momentum.angular": "engine: pymunk has no angular momentum",
        "energy.potential": "engine: pymunk knows no potential energy",
        "energy.total": "engine: pymunk knows no potential energy",
    }


@pytest.mark.slow
@pytest.mark.mutant("{name}: mass of a body 5 % off in the engine alone")
@pytest.mark.parametrize("name", scenes.CLAIMS)
@pytest.mark.parametrize("engine", [MUJOCO, PYMUNK], ids=words)
def test_an_engine_with_another_mass_is_seen(engine: Engine, name: str) -> None:
    """5 % of the last body's, in the engine's scene alone."""
    case = scenes.CLAIMS[name]
    (way,) = ways(engine, case, assembled(case))
    if engine.name == "pymunk" and case.scene.frame.dimension == 3:
        return
    *_, last = case.scene.bodies.values()
    bodies = {**case.scene.bodies, last.name: replace(last, mass=1.05 * last.mass)}
    other = replace(case, scene=replace(case.scene, bodies=bodies))
    trial = Trial(case, scenes.solved(name).trajectory, engine, way)
    good, bad = (told(engine, one) for one in (case, other))
    off = {q: float(np.max(np.abs(trial.read(q, bad[q]) - trial.wanted(q)))) for q in trial.motion}
    assert max(off.values()) > 1e-3
    beside = [q for q in trial.motion if f"{engine.name}.shipped" not in case.deviates
              or q not in case.deviates[f"{engine.name}.shipped"]]  # fmt: skip
    for q in beside:
        assert np.max(np.abs(trial.read(q, good[q]) - trial.wanted(q))) <= (case.allow[q] or 0.0), q


@pytest.mark.slow
@pytest.mark.mutant(
    "a place 1e-6 rad off in the engine alone",
    "a rate 1e-6 rad/s off in the engine alone",
    "an acceleration 1e-6 rad/s² off in the engine alone",
)
@pytest.mark.parametrize("number", [0, 1, 2], ids=["place", "rate", "acceleration"])
def test_an_engine_at_another_state_is_seen(number: int) -> None:
    case = scenes.CLAIMS["robot_states"]
    (way,) = ways(MUJOCO, case, assembled(case))
    trial = Trial(case, scenes.solved(case.name).trajectory, MUJOCO, way)
    assert isinstance(MUJOCO, Claims)
    assert case.states is not None
    drawn = {name: rows.copy() for name, rows in case.states.drawn(case.scene).items()}
    drawn["q3.angle"][:, number] += 1e-6
    found = MUJOCO.answer(case.scene, trial.start, drawn, trial.motion)
    off = [np.max(np.abs(trial.read(q, found[q]) - trial.wanted(q))) for q in trial.motion]  # type: ignore[arg-type]
    assert max(off) > 1e-8


@pytest.mark.parametrize("mass", [1e-3, 1e-6])
def test_light_bars_are_taken(mass: float, tmp_path: Path) -> None:
    """Though MuJoCo takes no moment below 1e-15 kg m²: they are thicker, and still slender."""
    case = claimed(tmp_path, CHAIN.replace("m: 1.2", f"m: {mass}"))
    found = told(MUJOCO, case, wanted=("rod.inertia_33", "rod.inertia_11"))
    assert found["rod.inertia_33"] == pytest.approx(mass * 0.8**2 / 12, rel=1e-7)
    assert np.all(found["rod.inertia_11"] < 1e-14)


def test_shapes_that_mujoco_does_not_take_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("textmech.engines.mujoco.adapter.inverse_dynamics.THIN", 1e-11)
    monkeypatch.setattr("textmech.engines.mujoco.adapter.inverse_dynamics.LEAST", 0.0)
    found = told(MUJOCO, claimed(tmp_path, CHAIN))
    assert len(set(found.values())) == 1
    assert found["q1.torque"].startswith("engine: MuJoCo does not take the shapes: ")


# Accelerations of bodies: the reference's, and what engines know of them.


FIELDS = ("arm.ax", "arm.ay", "arm.alpha", "rod.alpha", "bob.ax", "bob.ay")
SCENE = """\
scene:
  points: {O: [0, 0], hook: {at: [0, 0.5], velocity: [0.3, 0]}}
  bodies:
    rod: {bar: {mass: 1.2, length: 0.8}}
    arm: {bar: {mass: 0.7, length: 0.5}}
    bob: {particle: {mass: 0.3}}
  joints: {hinge: {pin: [ground.O, rod.start]}, elbow: {pin: [rod.end, arm.start]}}
  forces: {coil: {spring: [bob.center, ground.hook], stiffness: 20.0, rest_length: 0.2}}
initial: {hinge: {angle: -20 deg, omega: 1}, elbow: {angle: 30 deg, omega: 2}, bob: {x: 0.4, y: 0}}
allow: {arm.ax: 1.0, arm.ay: 1.0, arm.alpha: 1.0, rod.alpha: 1.0, bob.ax: 1.0, bob.ay: 1.0}
"""


def case(folder: Path) -> Case:
    return scenes.typed(folder, SCENE, tail=scenes.tail(0.5, 501))


def off(folder: Path) -> float:
    """How far the reference's are from differences of its velocities, of their size."""
    motion = solve(case(folder)).trajectory
    worst = 0.0
    for name in FIELDS:
        body, _, field = name.partition(".")
        v = motion.states[body][:, {"ax": 3, "ay": 4, "alpha": 5}[field]]
        rate = (8 * (v[3:-1] - v[1:-3]) - (v[4:] - v[:-4])) / 12e-3
        a = motion.reactions[name]
        worst = max(worst, float(np.max(np.abs(rate - a[2:-2])) / np.max(np.abs(a))))
    return worst


@pytest.mark.slow
def test_the_reference_s_are_the_rates_of_its_velocities(tmp_path: Path) -> None:
    assert off(tmp_path) < 1e-7  # measured 2.4e-8: the h⁴ of the differences


@pytest.mark.slow
@pytest.mark.mutant("accelerations 1 % too small")
def test_a_lost_term_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = bodies.accelerations

    def lost(*given: object) -> dict[str, float]:
        return {k: 0.99 * a for k, a in sound(*given).items()}  # type: ignore[arg-type]

    monkeypatch.setattr(bodies, "accelerations", lost)
    assert off(tmp_path) > 1e-3


def apart(folder: Path) -> float:
    """MuJoCo's from the reference's [m/s², rad/s²]."""
    one = scenes.typed(folder, SCENE, tail=scenes.tail(0.5, 26))
    known = solve(one).trajectory
    found = moved(TUNED["mujoco"], one.scene, first(known), one.times, 1e-3, reactions=FIELDS)
    return max(
        float(np.max(np.abs(found.reactions[name] - known.reactions[name]))) for name in FIELDS
    )


@pytest.mark.slow
def test_mujoco_s_are_the_reference_s(tmp_path: Path) -> None:
    assert apart(tmp_path) < 1e-5  # measured 2e-7, of 40 m/s²


@pytest.mark.slow
@pytest.mark.mutant("ax read for ay")
def test_mujoco_s_weight_is_no_acceleration(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its world falls upward: with the other field for `ay`, or without gravity, it is seen."""
    monkeypatch.setattr(read, "FIELDS", ("ay", "ax", "alpha"))
    assert apart(tmp_path) > 1.0


@pytest.mark.slow
def test_pymunk_knows_none(tmp_path: Path) -> None:
    one = case(tmp_path)
    start = first(solve(one).trajectory)
    said = planned(TUNED["pymunk"], one.scene, start).withheld
    assert {said[name] for name in FIELDS} == {
        "engine: pymunk knows velocities and impulses, and no accelerations"
    }
