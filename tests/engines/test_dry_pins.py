"""Dry friction of pins in both engines: against the swing typed in the test, and the reference."""

from pathlib import Path

import numpy as np
import pytest
from given import rubbing, scenes
from given.planning import TUNED, moved, planned, refused, ways
from given.rubbing import HELD, HUNG

from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.cases.trajectory import ANGLE
from textmech.engines.engine import Realised, Start
from textmech.engines.mujoco.model import start as begins
from textmech.engines.mujoco.model import tree
from textmech.engines.mujoco.model.tree import Branch, Tree
from textmech.reference.solve import solve

END = scenes.tail(3.0, 31)
STEP = 5e-4  # s
# rad at this step. Our law has the mean over a step in which it turns back, of second order, as
# Verlet is. pymunk's law is known on a part that the ground holds, as the
# joint's second.
SWUNG: dict[tuple[str, Realised, str], float] = {
    ("mujoco", "law", HUNG): 1e-6,  # 2.8e-7
    ("mujoco", "law", HELD): 1e-6,
    ("pymunk", "law", HUNG): 8e-6,  # 2.6e-6
}


def typed(tmp_path: Path, text: str) -> tuple[Case, Start]:
    case = scenes.typed(tmp_path, text, tail=END)
    states = solve(case).trajectory.states
    return case, {body: tuple(rows[0].tolist()) for body, rows in states.items()}  # type: ignore[misc]


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "way", "ends"), SWUNG)
def test_a_bar_swings_to_rest(engine: str, way: Realised, ends: str, tmp_path: Path) -> None:
    """By friction that differs to and fro, whichever part is named first."""
    case, start = typed(tmp_path, rubbing.swinging(ends, 1.0, 1.4))
    run = moved(TUNED[engine], case.scene, start, case.times, STEP, realised=way)
    error = np.max(np.abs(run.states["rod"][:, ANGLE] - rubbing.swung(case.times, 1.0, 1.4)))
    assert error < SWUNG[engine, way, ends]


@pytest.mark.slow
@pytest.mark.parametrize("ends", [HUNG, HELD])
@pytest.mark.parametrize("engine", TUNED)
def test_these_are_the_ways(engine: str, ends: str, tmp_path: Path) -> None:
    case, start = typed(tmp_path, rubbing.swinging(ends, 1.0, 1.4))
    ours = [way for name, way, named in SWUNG if (name, named) == (engine, ends)]
    assert ways(TUNED[engine], case.scene, start) == ("native", *ours)


@pytest.mark.slow
@pytest.mark.mutant("dry friction of a pin that forgets which part is counted")
def test_mutant_that_forgets_which_part_is_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Axis and start as if MuJoCo's hinge were always named from the parent to the body."""
    sound = begins._turn

    def as_named(scene: Scene, kept: Tree, branch: Branch, start: Start) -> tuple[float, float]:
        angle, omega = sound(scene, kept, branch, start)
        return (angle, omega) if branch.forward else (-angle, -omega)

    monkeypatch.setattr(tree, "_axis", lambda scene, branch, freedom: freedom.axis)
    monkeypatch.setattr(begins, "_turn", as_named)
    case, start = typed(tmp_path, rubbing.swinging(HELD, 1.0, 1.4))
    run = moved(TUNED["mujoco"], case.scene, start, case.times, STEP, realised="law")
    error = np.max(np.abs(run.states["rod"][:, ANGLE] - rubbing.swung(case.times, 1.0, 1.4)))
    assert error > 1e-2


# rad, natively. MuJoCo's friction is regularised: it brakes a step too long; pymunk's takes just
# what stops the slip.
COUPLED = {"mujoco": 5e-6, "pymunk": 1e-12}  # 1.7e-6, 4e-13


@pytest.mark.slow
@pytest.mark.parametrize("parts", ["a.center, b.center", "b.center, a.center"])
@pytest.mark.parametrize("engine", COUPLED)
def test_a_clutch_couples(engine: str, parts: str, tmp_path: Path) -> None:
    """Natively; its friction drives the one and brakes the other."""
    case, start = typed(tmp_path, rubbing.CLUTCH.replace("PARTS", parts))
    wanted = ("clutch.friction",) if engine == "mujoco" else ()
    run = moved(TUNED[engine], case.scene, start, case.times, STEP, reactions=wanted)
    for body, angle in zip("ab", rubbing.coupled(case.times), strict=True):
        assert np.max(np.abs(run.states[body][:, ANGLE] - angle)) < COUPLED[engine]
    for name in wanted:
        drives = 0.4 if parts.endswith("b.center") else -0.4
        assert run.reactions[name][[0, -1]] == pytest.approx([drives, 0.0], abs=1e-6)


def test_a_loop_that_rubs_is_refused(tmp_path: Path) -> None:
    """MuJoCo closes loops by pins without friction where it can, and has none that rubs."""
    text = rubbing.CLUTCH.replace("PARTS", "a.center, b.center")
    rubs = "dry_friction: {kinetic: 0.1}"
    loop = text.replace("a.center]}", f"a.center], {rubs}}}")
    far = f"    far: {{pin: [ground.O, b.center], {rubs}}}\n"
    loop = loop.replace("joints:\n", f"joints:\n{far}")
    said = refused(TUNED["mujoco"], scenes.typed(tmp_path, loop).scene)
    assert said is not None
    assert said.endswith("closes a loop, and MuJoCo rubs in the tree's joints only")


@pytest.mark.slow
@pytest.mark.parametrize("engine", TUNED)
def test_what_an_engine_holds_is_the_scene_s(engine: str, tmp_path: Path) -> None:
    case, start = typed(tmp_path, rubbing.CLUTCH.replace("PARTS", "a.center, b.center"))
    held = TUNED[engine].measure(case.scene, start)
    assert held["clutch.friction_forward"] == held["clutch.friction_backward"] == 0.4
    plan = planned(TUNED[engine], case.scene, start)
    script = TUNED[engine].script(case.scene, start, 1e-3, plan)
    assert 'frictionloss="0.4"' in script or "SimpleMotor" in script


# rad, in 1 s; of the moment [N m] four times that. The elbow sticks, is broken loose and sticks
# again: each costs a step's mean. Measured 2.4e-6.
BENT = 7e-6


@pytest.mark.slow
@pytest.mark.parametrize("parts", ["rod.end, arm.start", "arm.start, rod.end"])
def test_an_elbow_rubs_as_the_reference(parts: str, tmp_path: Path) -> None:
    """Between two parts that both move, by friction that falls."""
    text = rubbing.ARM.replace("PARTS", parts)
    case = scenes.typed(tmp_path, text, tail=scenes.tail(1.0, 11))
    solution = solve(case)
    states = solution.trajectory.states
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in states.items()}  # type: ignore[misc]
    wanted = ("elbow.friction",)
    run = moved(
        TUNED["mujoco"], case.scene, start, case.times, STEP, realised="law", reactions=wanted
    )
    for body, rows in states.items():
        assert np.max(np.abs(run.states[body] - rows)[:, ANGLE]) < BENT
    known = solution.trajectory.reactions["elbow.friction"]
    assert np.max(np.abs(run.reactions["elbow.friction"] - known)) < 4 * BENT


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "ends"), [("mujoco", HUNG), ("mujoco", HELD), ("pymunk", HUNG)])
def test_the_smooth_law_of_a_pin(engine: str, ends: str, tmp_path: Path) -> None:
    """(2.95) with Δ = 0.01 rad/s: measured 2.8e-5 and 6.3e-5 rad at this step."""
    text = rubbing.swinging(ends, 1.0, 1.4, rubbing.SMOOTH)
    case = scenes.typed(tmp_path, text, tail=scenes.tail(2.0, 21))
    rows = solve(case).trajectory.states["rod"]
    start: Start = {"rod": tuple(rows[0].tolist())}  # type: ignore[dict-item]
    run = moved(TUNED[engine], case.scene, start, case.times, STEP, realised="law")
    assert np.max(np.abs(run.states["rod"] - rows)[:, ANGLE]) < 2e-4
