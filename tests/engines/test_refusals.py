"""A scene that an engine cannot build is refused, with who cannot and why; odd names are not."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from given.adapters import engine_scenes as given
from given.adapters.engine_scenes import (
    BOB,
    BOX,
    ODD_NAMES,
    ROD,
    ROLLS,
    WHEEL,
    incline,
    machine,
    on_a_swing,
    pin,
)
from given.adapters.engine_space import (  # fmt: skip
    STILL,
    attitude,
    hinge,
    joint,
    point,
    simulated,
    spatial,
    state,
    vector,
)
from given.adapters.engine_space import particle as lump
from given.adapters.engine_space import rigid as solid
from given.adapters.planning import NAMES, SETTINGS, TUNED, moved, planned, refused, words
from given.machines.skew_chain import Q_DOT, Q, chain, start

from textmech.cases.scene import (
    Anchor,
    Damper,
    Joint,
    Push,
    Scene,
    Signal,
    Spring,
    Torque,
    planar_joint,
)
from textmech.cases.scene.joint import Freedom
from textmech.cases.scene.shape import disk, particle, rigid
from textmech.cases.trajectory import Array
from textmech.engines.engine import Engine, Plan, Refusal, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.pymunk import Pymunk

BEAD = particle(name="bead", mass=0.1)


def beside(*joints: Joint) -> Scene:
    """A bead beside a rod and a block, joined to the rod alone."""
    scene, _ = on_a_swing("slide")
    bodies = {**scene.bodies, "bead": BEAD}
    return replace(scene, bodies=bodies, joints={joint.name: joint for joint in joints})


# Engine and why → scene.
REFUSED = {
    (
        "mujoco",
        "engine: MuJoCo .* closes a loop by the slide B: a loop needs a pin",
    ): machine(
        [BOX],
        [pin("A", "ground.O", "box.center", "slide"), pin("B", "ground.Q", "box.center", "slide")],
    ),
    ("mujoco", "adapter: B closes a loop by a weld"): machine(
        [BOX],
        [pin("A", "ground.O", "box.center", "weld"), pin("B", "ground.Q", "box.center", "weld")],
    ),
    ("mujoco", "adapter: B would have to let rod both shift and turn"): machine(
        [BOB, ROD],
        [pin("A", "ground.O", "bob.center", "slide"), pin("B", "bob.center", "rod.start", "slide")],
    ),
    ("mujoco", "adapter: B starts at a particle"): machine(
        [ROD, BOB],
        [pin("A", "ground.O", "rod.start"), pin("B", "bob.center", "rod.end", "slide")],
    ),
    ("mujoco", "engine: MuJoCo does not take the scene: .*mjMINVAL"): machine(
        [rigid(name="dust", mass=1e-9, inertia=1e-18, points={})]
    ),
    ("mujoco", "adapter: first is not the only contact of wheel"): machine(
        [WHEEL], contacts=[replace(ROLLS, name=name) for name in ("first", "second")]
    ),
    ("mujoco", "engine: MuJoCo's floor is a spring and damper"): incline(
        WHEEL, given.touching("wheel", 0.3, restitution=0.01)
    ),
    ("pymunk", "engine: loop joins rod to itself, on which pymunk aborts$"): beside(
        pin("loop", "rod.start", "rod.end")
    ),
    ("pymunk", "adapter: rail starts at a particle, which has no axes"): beside(
        planar_joint("rail", "slide", Anchor("bead", "center"), Anchor("rod", "P"))
    ),
    ("pymunk", "engine: pymunk takes only positive finite masses"): machine(
        [replace(ROD, mass=math.inf)]
    ),
}


@pytest.mark.parametrize(("name", "why"), REFUSED)
def test_refused(name: str, why: str) -> None:
    for engine in [engine for engine in SETTINGS if engine.name == name]:
        found = refused(engine, REFUSED[name, why])
        assert found is not None
        assert found.startswith(("engine: ", "adapter: "))
        assert re.match(why, found), found


@pytest.mark.parametrize("name", NAMES)
def test_a_bead_slides_on_a_rod(name: str) -> None:
    """A slide that starts at the rod is built; pymunk's groove is told its ends beforehand."""
    rail = planar_joint(
        "rail", "slide", Anchor("rod", "P"), Anchor("bead", "center"), along=given.ALONG
    )
    scene = beside(rail)
    begin = dict.fromkeys(scene.bodies, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert refused(TUNED[name], scene) is None
    exponents = {"mujoco": (4, 5), "pymunk": (2, 3)}[name]
    assert planned(TUNED[name], scene, begin).exponents == exponents


TENTH = np.linspace(0.0, 0.1, 3)


def wheel_and_rod(name: str) -> tuple[Scene, Start]:
    """A rolling disk of that name, and a rod pinned to its centre."""
    wheel = disk(name=name, mass=1.0, radius=0.3, points={})
    contact = replace(ROLLS, at=Anchor(name, "center"))
    pins = [pin("start_", f"{name}.center", "rod.start")]
    begin = {name: (0.0, 0.3, 0.0, 0, 0, 0), "rod": (0.5, 0.3, 0.0, 0, 0, 0)}
    return machine([wheel, ROD], pins, contacts=[contact]), begin  # type: ignore[return-value]


def named(engine: Engine, name: str) -> tuple[Array, Array]:
    """How the disk of that name moves, and the force by which it holds the rod."""
    wanted = ("start_.force",)
    found = moved(engine, *wheel_and_rod(name), TENTH, 1e-3, reactions=wanted)
    return found.states[name], found.reactions["start_.force"]


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
@pytest.mark.parametrize("name", ODD_NAMES)
def test_odd_names(name: str, engine: Engine) -> None:
    """A body, and a joint or contact beside it, may be called what an engine's file also uses."""
    scene, begin = wheel_and_rod(name)
    assert refused(engine, scene) is None
    for odd, plain in zip(named(engine, name), named(engine, "wheel"), strict=True):
        assert np.array_equal(odd, plain)
    assert engine.script(scene, begin, 1e-3, planned(engine, scene, begin))
    wanted = engine.measure(*wheel_and_rod("wheel"))
    renamed = {key.replace("wheel.", f"{name}."): number for key, number in wanted.items()}
    assert engine.measure(scene, begin) == renamed
    hung = machine([replace(ROD, name=name)], [pin("A", "ground.O", f"{name}.start")])
    assert refused(engine, hung) is None


# What an engine answers to scenes in space: MuJoCo runs them, pymunk says why not.


PYMUNK = "engine: pymunk moves bodies in a plane, and this scene is in space"


@pytest.mark.parametrize("setting", ["shipped", "tuned"])
def test_pymunk_says_that_it_is_planar(setting: str) -> None:
    assert list(Pymunk(setting).plans(chain(), start(Q, Q_DOT))) == [Refusal("native", PYMUNK)]


def acted_on() -> tuple[Scene, Start]:
    """A body with every kind of force."""
    ends = Anchor("top", "tip"), Anchor("ground", "O")
    body = solid("top", 1.3, (0.02, 0.03, 0.04), {"tip": (0.1, 0.2, 0.3)})
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
BODY = solid("b", 1.0, (0.02, 0.03, 0.04), {"l": (-0.3, 0, 0)})


@pytest.mark.parametrize(
    ("scene", "because"),
    [
        (
            spatial(
                [lump("bob", 1.0), BODY],
                [joint("rail", "slide", "bob.center", "b.center", SHIFT)],
            ),
            "adapter: rail starts at a particle, which has no axes",
        ),
        (
            spatial(
                [BODY, lump("bob", 1.0)], [hinge("tip", "b.l", "bob.center", (0, 0, 1))],
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


# MuJoCo's loops in space: what closes them, and what they hold.


TIMES = np.linspace(0.0, 0.5, 6)


ENDS = {"l": (-0.3, 0.0, 0.0), "r": (0.3, 0.0, 0.0)}
AT = {"L": point(ENDS["l"]), "R": point(ENDS["r"])}
BAR = solid("b", 1.0, (0.02, 0.03, 0.04), ENDS)
ALONG = (1.0, 0.0, 0.0)


def test_a_weld_closes_a_loop_and_its_moment_is_read() -> None:
    """With what the other joint holds it keeps the balance; the bar does not move."""
    turns = [Freedom.turn(axis) for axis in (ALONG, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    joints = [
        joint("guide", "freedoms", "ground.L", "b.l", Freedom.shift(ALONG), *turns),
        joint("held", "weld", "b.r", "ground.R"),
    ]
    start = {"b": state(STILL, (1, 0, 0, 0), STILL, STILL)}
    names = [f"{name}.{letter}{a}" for name in ("guide", "held") for letter in "fm" for a in "xyz"]
    gravity = np.array([1.0, 2.0, -9.0])
    scene = spatial([BAR], joints, points=AT, gravity=vector(gravity))
    motion = simulated(scene, start, TIMES, 1e-3, names)
    assert np.max(np.abs(motion.states["b"] - motion.states["b"][0])) < 1e-7
    row = np.array([motion.reactions[name][-1] for name in names]).reshape(2, 2, 3)
    (force, moment), (back, back_moment) = row
    assert np.max(np.abs(force - back + gravity)) < 1e-6
    arms = np.cross(ENDS["l"], force) - np.cross(ENDS["r"], back)
    assert np.max(np.abs(moment - back_moment + arms)) < 1e-6
    assert np.linalg.norm(back_moment) > 0.1


def test_what_cannot_move_is_refused() -> None:
    """MuJoCo drops such a constraint, and with it the force that would be read."""
    joints = [joint("one", "weld", "ground.L", "b.l"), joint("two", "weld", "b.r", "ground.R")]
    start = {"b": state(STILL, (1, 0, 0, 0), STILL, STILL)}
    (refusal,) = MuJoCo("tuned").plans(spatial([BAR], joints, points=AT), start)
    assert isinstance(refusal, Refusal)
    assert "leaves out two" in refusal.because


@pytest.mark.parametrize(
    ("kind", "freedoms"),
    [
        ("slide", (Freedom.shift((1.0, 0.0, 0.0), "shift"),)),
        ("universal", (Freedom.turn((1.0, 0.0, 0.0)), Freedom.turn((0.0, 1.0, 0.0)))),
    ],
)
def test_what_connect_cannot_close_is_refused(kind: str, freedoms: tuple[Freedom, ...]) -> None:
    body = solid("b", 1.0, (0.02, 0.03, 0.04), {"l": (-0.3, 0, 0), "r": (0.3, 0, 0)})
    joints = [joint(name, kind, "ground.O", f"b.{end}", *freedoms) for name, end in ("sl", "tr")]
    start = {"b": state((0.3, 0, 0), (1, 0, 0, 0), STILL, STILL)}
    (refusal,) = MuJoCo("tuned").plans(spatial([body], joints), start)
    assert isinstance(refusal, Refusal)
    why = f"engine: MuJoCo has no constraint that closes a loop by the {kind} t"
    assert refusal.because == f"{why}: a loop needs a ball, a hinge or a weld that is not driven"
