"""Where our law of dry friction is not known, pymunk's own friction stays beside other laws."""

from pathlib import Path

import numpy as np
import pytest
from given.outside import solved

from textmech.engines.engine import Diverged, Plan
from textmech.engines.mujoco import MuJoCo
from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.callbacks import friction

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
    start = {name: tuple(rows[0].tolist()) for name, rows in reference.states.items()}
    engine = Pymunk("tuned")
    (plan,) = (
        plan
        for plan in engine.plans(case.scene, start)  # type: ignore[arg-type]
        if isinstance(plan, Plan) and plan.realised == "law"
    )
    found = engine.run(case.scene, start, case.times, 5e-4, plan, reactions=(), record=False)  # type: ignore[arg-type]
    return max(
        float(np.max(np.abs(found.states[name] - rows))) for name, rows in reference.states.items()
    )


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
