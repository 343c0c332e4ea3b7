"""What an engine answers to scenes in space: MuJoCo runs them, pymunk says why not."""

import numpy as np
import pytest
from given.engine_space import STILL, attitude, hinge, joint, particle, rigid, spatial, state
from given.skew_chain import Q_DOT, Q, chain, start

from textmech.cases.scene import Anchor, Damper, Push, Scene, Signal, Spring, Torque
from textmech.cases.scene.joint import Freedom
from textmech.engines.engine import Engine, Plan, Refusal, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.pymunk import Pymunk

PYMUNK = "engine: pymunk moves bodies in a plane, and this scene is in space"


@pytest.mark.parametrize("setting", ["shipped", "tuned"])
def test_pymunk_says_that_it_is_planar(setting: str) -> None:
    assert list(Pymunk(setting).plans(chain(), start(Q, Q_DOT))) == [Refusal("native", PYMUNK)]


def acted_on() -> tuple[Scene, Start]:
    """A body with every kind of force."""
    ends = Anchor("top", "tip"), Anchor("ground", "O")
    body = rigid("top", 1.3, (0.02, 0.03, 0.04), {"tip": (0.1, 0.2, 0.3)})
    forces = [
        Spring("spring", *ends, 40.0, 0.5), Damper("damper", *ends, 2.0),
        Push("push", ends[0], Signal("constant", (1.0, 2.0, 3.0))),
        Torque("twist", "top", Signal("constant", (1.0, 2.0, 3.0))),
    ]  # fmt: skip
    begun = state((1.0, 2.0, 3.0), attitude((1, 2, 3, 4)), STILL, STILL)
    return spatial([body], forces=forces, gravity=(0.1, -0.2, -0.3)), {"top": begun}


@pytest.mark.parametrize("engine", [MuJoCo("shipped"), MuJoCo("tuned")], ids=lambda e: e.setting)
def test_the_audit_of_a_scene_in_space(engine: Engine) -> None:
    """All that elements say of themselves is read back, and gravity along three axes."""
    scene, begun = acted_on()
    found = engine.measure(scene, begun)
    for element in scene.elements():
        for name, number in element.numbers().items():
            assert abs(found[f"{element.name}.{name}"] - number) < 1e-14
    assert [found[f"gravity.{axis}"] for axis in "xyz"] == [0.1, -0.2, -0.3]


def test_a_users_options_reach_scenes_in_space() -> None:
    engine = MuJoCo("mine", {"integrator": "implicitfast", "step": 1e-4})
    scene, begun = acted_on()
    (plan,) = engine.plans(scene, begun)
    assert isinstance(plan, Plan)
    assert {c.name: c.value for c in plan.choices(1e-4)}["option.integrator"] == "implicitfast"
    assert plan.held == (1, 2)
    motion = engine.run(scene, begun, np.array([0.0, 1e-3]), 1e-4, plan, reactions=())
    assert np.all(np.isfinite(motion.states["top"]))


SHIFT = Freedom.shift((1.0, 0.0, 0.0), "x")
BODY = rigid("b", 1.0, (0.02, 0.03, 0.04), {"l": (-0.3, 0, 0)})


@pytest.mark.parametrize(
    ("scene", "because"),
    [
        (
            spatial(
                [particle("bob", 1.0), BODY],
                [joint("rail", "slide", "bob.center", "b.center", SHIFT)],
            ),
            "adapter: rail starts at a particle, which has no axes",
        ),
        (
            spatial(
                [BODY, particle("bob", 1.0)], [hinge("tip", "b.l", "bob.center", (0, 0, 1))],
                drives={"tip.omega": Signal("constant", (1.0,))},
            ),
            "adapter: tip would have to turn a particle, which has no axes",
        ),
        (
            spatial(
                [BODY],
                [hinge("one", "ground.O", "b.center", (0, 0, 1)),
                 hinge("two", "ground.O", "b.center", (0, 0, 1))],
                drives={
                    "one.omega": Signal("constant", (1.0,)),
                    "two.omega": Signal("constant", (1.0,)),
                },
            ),
            "adapter: two is driven, and closes a loop of driven joints: drive fewer",
        ),
    ],
    ids=["slide of a particle", "turn of a particle", "driven loop"],
)  # fmt: skip
def test_what_the_adapter_does_not_build(scene: Scene, because: str) -> None:
    begun = {name: state(STILL, (1, 0, 0, 0), STILL, STILL) for name in scene.bodies}
    (refusal,) = MuJoCo("tuned").plans(scene, begun)
    assert refusal == Refusal("native", because)
