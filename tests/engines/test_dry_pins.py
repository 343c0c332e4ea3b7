"""Dry friction of pins in both engines: against the swing typed in the test, and the reference."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.adapters.outside import solved
from given.adapters.planning import TUNED, apart, moved, planned, refused, ways
from given.scenes import rubbing
from given.scenes.rubbing import HELD, HUNG

from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import ANGLE
from textmech.engines.engine import Diverged, Plan, Realised, Refusal, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.model import start as begins
from textmech.engines.mujoco.model import tree
from textmech.engines.mujoco.model.tree import Branch, Tree
from textmech.engines.mujoco.read import reaction
from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.callbacks import friction
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

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


# Where our law of dry friction is not known, pymunk's own friction stays beside other laws.


SLIDES = """\
title: A block that slides with dry friction on a body that slides, with a damper
source: {equations: ["2.89"]}
scene:
  points: {Q: [0, 0], W: [-1, 0]}
  bodies:
    a: {rigid: {mass: 1.0, inertia: 0.3}, points: {P: [0, 0.1]}}
    b: {bar: {mass: 1.4, length: 1.0}}
  joints:
    ja: {slide: [ground.Q, a.center], along: [1, 0]}
    jb: {slide: [a.P, b.center], along: [1, 0], dry_friction: {static: 3.0, kinetic: 2.0}}
  forces: {oil: {damper: [ground.W, a.center], damping: 0.3}}
initial: {ja: {shift: 0, speed: 0.1}, jb: {shift: 0, speed: 1.0}}
allow: {b.x: 1.0e-2}
duration: 0.4
samples: 11
step: {pymunk: 5.0e-4}
"""
PINS = """\
title: Two bodies in free flight on a pin that rubs, and a ball in the air
source: {equations: ["2.89"]}
scene:
  bodies:
    b: {bar: {mass: 2.5, length: 0.4}}
    c: {disk: {mass: 1.7, radius: 0.2}, points: {P: [0.4, 0]}}
    ball: {particle: {mass: 0.3}}
  joints: {pin: {pin: [b.center, c.P], dry_friction: {kinetic: 0.5}}}
  forces: {air: {drag: ball.center, coefficient: 0.1, exponent: 2}}
initial:
  b: {x: 0, y: 0, vx: 0, vy: 0, angle: 0, omega: 2.9}
  pin: {angle: 0.9, omega: -1.34}
  ball: {x: 3, y: 0, vx: 1, vy: 0}
allow: {b.omega: 1.0e-2, ball.x: 1.0e-2}
duration: 0.4
samples: 11
step: {pymunk: 5.0e-4}
"""


def off(folder: Path, text: str) -> float:
    """The largest difference of places, angles and rates by our law, of scenes of size 1."""
    case, reference = solved(folder, text)
    start = first(reference)
    found = moved(TUNED["pymunk"], case.scene, start, case.times, 5e-4, realised="law")
    return float(apart(reference, found).max())


@pytest.mark.slow
@pytest.mark.parametrize("text", [SLIDES, PINS], ids=["a slide on a slide", "a pin in flight"])
def test_friction_between_bodies_is_pymunks_own(text: str, tmp_path: Path) -> None:
    """While it slides one way it is the textbook's, and nothing is left but steps: 8e-7 at most."""
    assert off(tmp_path, text) < 3e-6


@pytest.mark.slow
@pytest.mark.mutant("our law of friction where it is not known, beside a law that is")
def test_a_law_that_is_not_known_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It asks for the rail's point of the ground, and the rail is on a body."""
    monkeypatch.setattr(friction, "ruled", lambda scene: True)
    with pytest.raises(KeyError):
        off(tmp_path, SLIDES)


MUSCLE = """\
title: A muscle that is stiff for a step
source: {equations: ["2.83"]}
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {load: {particle: {mass: 0.01}}}
  joints: {rail: {slide: [ground.O, load.center], along: [1, 0]}}
  forces:
    calf: {muscle: [ground.O, load.center], isometric: 10, hill_a: 5, hill_b: 0.1,
           series_stiffness: 4000, parallel_stiffness: 0, rest_length: 0.3,
           contractile_length: 0.3}
initial: {load: {x: 0.301, vx: -0.3}}
allow: {load.x: 1.0e-3}
duration: 0.05
samples: 6
step: {mujoco: STEP, pymunk: STEP}
"""


@pytest.mark.slow
@pytest.mark.parametrize("engine", [MuJoCo("tuned"), Pymunk("tuned")], ids=["mujoco", "pymunk"])
def test_a_step_that_leaves_hills_law_is_told(engine: MuJoCo | Pymunk, tmp_path: Path) -> None:
    """It would leap onto the other branch of the hyperbola, and the model would be blamed.

    With 10 us both are right, pymunk to 7e-10 m.
    """
    case, reference = solved(tmp_path, MUSCLE.replace("STEP", "1.0e-5"))
    start = {name: tuple(rows[0].tolist()) for name, rows in reference.states.items()}
    plan, *_ = [p for p in engine.plans(case.scene, start) if isinstance(p, Plan)]  # type: ignore[arg-type]
    fine = engine.run(case.scene, start, case.times, 1e-5, plan, reactions=(), record=False)  # type: ignore[arg-type]
    assert fine.states["load"][:, 0] == pytest.approx(reference.states["load"][:, 0], abs=3e-9)
    with pytest.raises(Diverged, match=r"calf is pressed by .* N, and Hill's law holds above -5 N"):
        engine.run(case.scene, start, case.times, 5e-3, plan, reactions=(), record=False)  # type: ignore[arg-type]


# The force of a slide: with its dry friction, and without what an oil of its own exerts.


HELD_SLIDE = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {block: {mass: 2.0, width: 0.1, height: 0.1}}}
  joints: {rail: {slide: [ground.O, b.center], along: [0.8, 0.6]DRY}}
  forces: {push: {push: b.center, constant: [25.0, 0]}OIL}
initial: {b: {x: 0, y: 0, vx: 0.8, vy: 0.6}}
allow: {b.x: 1.0e-3, rail.force: 1.0e-2}
"""
CARRIED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies:
    arm: {bar: {mass: 1.0, length: 1.0}}
    bead: {block: {mass: 0.5, width: 0.1, height: 0.1}}
  joints:
    hinge: {pin: [ground.O, arm.start]}
    rail: {slide: [arm.center, bead.center], along: [1, 0]}
  forces: {oil: {viscous: rail, coefficient: 0.6, exponent: 1}}
initial: {arm: {angle: 0, omega: 2.0}, bead: {x: 0.6}}
allow: {arm.angle: 1.0e-3, rail.force: 1.0e-2}
"""
DRY = ", dry_friction: {kinetic: 3.0}"
OIL = ", oil: {viscous: rail, coefficient: 3.0, exponent: EXPONENT}"


def held(dry: str = "", oil: str = "") -> str:
    return HELD_SLIDE.replace("DRY", dry).replace("OIL", oil)


SCENES = {
    "dry": held(DRY),
    "viscous": held(oil=OIL.replace("EXPONENT", "1")),
    "by the square": held(oil=OIL.replace("EXPONENT", "2")),
    "by a power of our law": held(oil=OIL.replace("EXPONENT", "1.5")),
    "carried": CARRIED,
}
NEAR = {"mujoco": 1e-4, "pymunk": 2e-2}  # N, of some 20 N at 2e-4 s
ROUGH = 2e-4  # s


def rail_off(name: str, what: str, tmp_path: Path) -> dict[str, float]:
    """By the way in which the engine runs it [N], where its force is read."""
    case = scenes.typed(tmp_path, SCENES[what], tail=scenes.tail(0.4, 21))
    motion = solve(case).trajectory
    start, found = first(motion), {}
    for plan in TUNED[name].plans(case.scene, start):
        if isinstance(plan, Refusal) or "rail.force" in plan.withheld:
            continue
        run = TUNED[name].run(case.scene, start, case.times, ROUGH, plan, reactions=("rail.force",))
        wanted, got = (observe(case.scene, t, "rail.force") for t in (motion, run))
        found[plan.realised] = float(np.max(np.abs(got - wanted)))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", NEAR)
@pytest.mark.parametrize("what", SCENES)
def test_engines_read_the_force_of_the_book(name: str, what: str, tmp_path: Path) -> None:
    found = rail_off(name, what, tmp_path)
    assert found
    assert max(found.values()) < NEAR[name]


@pytest.mark.slow
@pytest.mark.mutant("a joint's damping read as its force")
@pytest.mark.parametrize("what", ["viscous", "carried"])
def test_damping_that_is_read_as_its_force_is_seen(
    what: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "damped", lambda scene, joint: [])
    assert rail_off("mujoco", what, tmp_path)["native"] > 0.05
