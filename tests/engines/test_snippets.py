"""What is to be pasted is pasted here: the engine then holds the options' very numbers."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import re
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pymunk
import pytest
from given import scenes
from given.adapters.models import differing
from given.adapters.planning import begun, planned
from given.scenes import rods

from textmech.engines.engine import Choice
from textmech.engines.knobs import Options
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.adapter.compilation import compiled, timestep
from textmech.engines.mujoco.model.scene import mjcf
from textmech.engines.mujoco.settings import snippet as snippets
from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.adapter.plans import numbers_by_name
from textmech.engines.pymunk.adapter.script import building
from textmech.engines.pymunk.stepping.run import placed
from textmech.engines.pymunk.stepping.scene import build
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

STEP = 5e-4
RECIPE: Options = {}  # stands for the tuned one

MUJOCO: list[tuple[str, Options]] = [
    ("bar_pendulum", {"integrator": "implicit"}),
    ("four_bar", {"connect": {"solref": ["10h", 1.0]}, "iterations": 50}),
    ("four_bar", RECIPE),
    ("dynamometer", RECIPE),
    ("sliding_block.braking", {"contacts": "slide"}),
    ("tipping_block", RECIPE),
    ("rolling_wheel.downhill", {"solimp": [0.99, 0.99, 0.001], "impratio": 10.0}),
    ("spatial_four_bar", RECIPE),
    ("driven_wheel.circle", RECIPE),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "options"), MUJOCO, ids=str)
def test_elements_for_mujoco(name: str, options: Options) -> None:
    """Pasted into the scene's file without any setting."""
    scene, start = begun(name)
    options = options or MuJoCo("shipped").recipe(scene, start)
    engine = MuJoCo("own", {**options, "step": STEP})
    plan = planned(engine, scene, start)
    given = [c for c in planned(MuJoCo("shipped"), scene, start).choices(STEP) if _heavy(c)]
    # noslip needs a freedom more, which no option is
    given += [Choice(c.name, 1, "") for c in plan.choices(STEP) if "noslip" in c.name]
    bare = mjcf(scene, start, [timestep(1.0), *given])
    snippet = engine.snippet(scene, start, options, STEP)
    head, tag, rest = bare.partition("<worldbody>")
    both = mujoco.MjModel.from_xml_string(head + snippet + tag + rest)
    wanted, _ = compiled(scene, start, STEP, plan)
    for field in ("dof_solref", "dof_solimp"):  # a default is also for joints that do not rub
        idle = wanted.dof_frictionloss == 0
        getattr(both, field)[idle] = getattr(wanted, field)[idle]
    for field in ("geom_solref", "geom_solimp"):  # what touches in our files are pairs
        getattr(both, field)[:] = getattr(wanted, field)
    assert not differing(both, wanted)
    assert differing(mujoco.MjModel.from_xml_string(bare), wanted)


@pytest.mark.slow
@pytest.mark.parametrize(
    "options",
    [RECIPE, {"rod": {"solref": ["4h", 1.0]}}, {"connect": {"solref": ["4h", 1.0]}}],
    ids=["both", "rod", "connect"],
)
def test_what_one_default_cannot_say_of_two_groups_is_a_comment(
    options: Options, tmp_path: Path
) -> None:
    """Loops closed by a pin and by a rod are both equalities, with numbers of their own."""
    case = scenes.typed(tmp_path, rods.BOTH, tail=scenes.tail(0.2, 5))
    scene, start = case.scene, first(solve(case).trajectory)
    options = options or MuJoCo("shipped").recipe(scene, start)
    plan = planned(MuJoCo("own", {**options, "step": STEP}), scene, start)
    snippet = MuJoCo("shipped").snippet(scene, start, options, STEP)
    ((group, numbers),) = re.findall(
        "<!-- each equality of a (connect|rod) (?:has|keeps) (.*?)(?: instead)? -->", snippet
    )
    bare = mjcf(scene, start, [timestep(1.0)])
    head, tag, rest = bare.partition("<worldbody>")
    inside, word = rest.partition("<equality>"), {"connect": "<connect ", "rod": "<tendon "}[group]
    own = inside[2].replace(word, f"{word}{numbers.replace(',', '')} ")
    pasted = "".join([head, snippet, tag, *inside[:2], own])
    wanted, _ = compiled(scene, start, STEP, plan)
    assert not differing(mujoco.MjModel.from_xml_string(pasted), wanted)
    assert differing(mujoco.MjModel.from_xml_string(head + snippet + tag + rest), wanted)


@pytest.mark.slow
@pytest.mark.mutant("a snippet does not say which equalities keep their numbers")
def test_equalities_that_change_unsaid_would_be_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(snippets, "_keep", lambda *_: ())
    with pytest.raises(ValueError, match="not enough values"):
        test_what_one_default_cannot_say_of_two_groups_is_a_comment(
            {"rod": {"solref": ["4h", 1.0]}}, tmp_path
        )


def _heavy(choice: Choice) -> bool:
    """What stands in every file of a scene with driven points, whatever the setting."""
    return choice.name == "option.tolerance"


def test_no_more_than_what_differs() -> None:
    scene, start = begun("four_bar")
    told = {"integrator": "RK4", "cone": "pyramidal", "connect": {"solref": ["4h", 1.0]}}
    said, *elements = MuJoCo("shipped").snippet(scene, start, told, STEP).splitlines()
    assert "numbers of its own keeps them" in said
    assert elements == [
        '<option timestep="0.0005" integrator="RK4" />',
        "<default>",
        '  <equality solref="0.002 1.0" />',
        "</default>",
    ]
    lines = Pymunk("shipped").snippet(scene, start, {"iterations": 30}, STEP).splitlines()
    assert lines == ["h = 0.0005  # s, for space.step(h)", "space.iterations = 30"]


@pytest.mark.parametrize(
    ("engine", "name", "told", "note"),
    [
        (MuJoCo("shipped"), "sliding_block.below", {"settled": True}, "deep in the floor"),
        (MuJoCo("shipped"), "sliding_block.below", {"noslip_iterations": 5}, "third axis"),
        (Pymunk("shipped"), "tipping_block", {"reflects": True}, "elasticity 1"),
    ],
    ids=str,
)
def test_what_no_line_says_is_a_comment(
    engine: MuJoCo | Pymunk, name: str, told: Options, note: str
) -> None:
    scene, start = begun(name)
    text = engine.snippet(scene, start, told, STEP)
    said = [line for line in text.splitlines() if line.startswith(("<!--", "# "))]
    assert len(said) == 1
    assert note in said[0]
    assert note not in engine.snippet(scene, start, {}, STEP)


CORNER = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {d: {disk: {mass: 2, radius: 0.2}}}
  contacts:
    f: {between: [d, ground.floor], friction: 0.2}
    w: {between: [d, ground.wall], friction: 0}
initial: {d: {x: 0.2, y: 0.2, omega: -1}}
allow: {d.omega: 1.0e-2}
"""


@pytest.mark.slow
def test_contacts_that_differ_have_a_pair_each(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, CORNER)
    start = first(solve(case).trajectory)
    soft = {"pair": {"solref": ["-10/h2", "-1/h"], "solimp": [0.0001, 0.0001, 0.001]}}
    text = MuJoCo("shipped").snippet(case.scene, start, soft, STEP)
    assert 'condim="3" friction="0.2 0.2" /> for f,' in text
    assert 'condim="1" friction="0.0 0.0" /> for w' in text
    assert "is for 2 of a body, where a ball has one" in text


@pytest.mark.parametrize(
    ("name", "note"),
    [
        ("driven_wheel.circle", "has a heavy armature that goes on at the given rate"),
        ("four_bar", ""),
        ("particle_pendulum", "of hardly any mass with a hinge at either end"),
    ],
)
def test_how_the_model_is_built_is_said_where_another_is_near(name: str, note: str) -> None:
    """With a velocity actuator, or a tendon for a rod, what is claimed is not reached by far."""
    scene, start = begun(name)
    text = MuJoCo("shipped").snippet(scene, start, {"integrator": "RK4"}, STEP)
    said = "".join(line for line in text.splitlines() if "of a model in which" in line)
    assert note in said
    assert bool(said) == bool(note)


def test_what_needs_a_solreffriction_is_for_pairs_alone() -> None:
    """With the rest of it a thrown disk of geoms hops by 10 cm, and by 1 cm as shipped."""
    scene, start = begun("sliding_disk.uphill")
    numbers = {"solref": ["-0.25/h2", "-1/h"], "solimp": [0.000101, 0.000101, 0.001]}
    for pair, geoms in ((numbers, True), ({**numbers, "solreffriction": [-1.0, "-1/h"]}, False)):
        text = MuJoCo("shipped").snippet(scene, start, {"pair": pair}, STEP)
        assert "<pair solref" in text
        assert ("<geom solref" in text) == geoms
        assert ("without which the rest makes it hop" in text) != geoms


@pytest.mark.parametrize(
    ("told", "noted"),
    [
        ({"impratio": 100.0}, True),
        ({"pair": {"margin": 1e-9}}, True),
        ({"cone": "elliptic", "impratio": 100.0}, False),
        ({"integrator": "RK4"}, False),
    ],
    ids=str,
)
def test_for_which_friction_a_soft_contact_is_told(told: Options, noted: bool) -> None:
    """A ball of geoms sinks 0.07 mm with 0.5 and 0.37 mm with MuJoCo's own 1."""
    scene, start = begun("sinking_ball")
    text = MuJoCo("shipped").snippet(scene, start, told, STEP)
    assert ("makes a contact softer: this is for friction 0.5" in text) == noted


PYMUNK: list[tuple[str, Options]] = [
    ("bar_pendulum", {"iterations": 30, "error_bias": 0.0, "max_bias": 10.0}),
    ("four_bar", RECIPE),
    ("rolling_wheel.downhill", RECIPE),
    ("bouncing_disk.plastic", RECIPE),
    ("sliding_ladder", RECIPE),
    ("ball_on_rope.caught", RECIPE),
    ("stopped_pendulum.rests", {"limit_bias": 0.5, "max_bias": 10.0}),
    ("bearing.dry", {"max_bias": 10.0}),
    ("sliding_block.below", {"collision_persistence": 1}),
    ("spring_mass_damper.critical", RECIPE),
]


@pytest.mark.parametrize(("name", "options"), PYMUNK, ids=str)
def test_lines_for_pymunk(name: str, options: Options) -> None:
    """Pasted after the lines that build the scene as it is shipped."""
    scene, start = begun(name)
    options = {**(options or Pymunk("shipped").recipe(scene, start))}
    options.pop("seed", None)  # see `test_a_seed_is_in_what_touches`
    engine = Pymunk("own", {**options, "step": STEP})
    lines = building(build(scene, start, {}, "native"), start, {})
    names: dict[str, Any] = {}
    exec("\n".join(["import math", "import pymunk", *lines]), names)
    space = names["space"]
    before = held(space)
    pasted = engine.snippet(scene, start, options, STEP)
    exec(re.sub(r"space.iterations = \d+  # of the first .*", "", pasted), names)
    numbers = numbers_by_name(planned(engine, scene, start).choices(STEP))
    wanted = placed(scene, start, STEP, numbers, "native").space
    assert names["h"] == STEP
    assert held(space) == held(wanted)
    assert held(space) != before


def test_the_first_sweeps_are_taken_first() -> None:
    """As the run of the same options takes them: to the last bit."""
    scene, start = begun("four_bar")
    options: Options = {"error_bias": 0.0, "start_iterations": 90}
    engine = Pymunk("own", {**options, "step": STEP})
    built = building(build(scene, start, {}, "native"), start, {})
    names: dict[str, Any] = {}
    exec("\n".join(["import math", "import pymunk", *built]), names)
    pasted = engine.snippet(scene, start, options, STEP)
    exec(pasted, names)
    names["space"].step(STEP)
    assert names["space"].iterations == 90
    for _ in range(4):
        names["space"].step(STEP)
    (after,) = re.findall(r"after them: (space.iterations = \d+)$", pasted, re.MULTILINE)
    exec(after, names)
    for _ in range(95):
        names["space"].step(STEP)
    times = np.array([0.0, 100 * STEP])
    plan = planned(engine, scene, start)
    motion = engine.run(scene, start, times, STEP, plan, reactions=())
    for name, body in names["bodies"].items():
        assert (*body.position, body.angle) == tuple(motion.states[name][-1][:3])


def test_a_seed_is_in_what_touches() -> None:
    """Whatever its shape, and the ground's stays."""
    space = pymunk.Space()
    floor = pymunk.Segment(space.static_body, (-1, 0), (1, 0), 0.0)
    box, ball = pymunk.Body(1.0, 1.0), pymunk.Body(1.0, 1.0)
    shapes = pymunk.Poly.create_box(box, (0.1, 0.1)), pymunk.Circle(ball, 0.1)
    space.add(floor, box, ball, *shapes)
    scene, start = begun("sliding_block.below")
    told = Pymunk("shipped").snippet(scene, start, {"seed": 1e-3}, STEP)
    exec(told, {"space": space})
    assert [shape.radius for shape in (floor, *shapes)] == [0.0, 1e-3, 0.1 + 1e-3]


def held(space: pymunk.Space) -> list[Any]:
    """All that an option can change."""
    bodies = [(*body.position, body.angle, *body.velocity) for body in space.bodies]
    circles = [s.radius for s in space.shapes if isinstance(s, pymunk.Circle)]
    springs = (pymunk.DampedSpring, pymunk.DampedRotarySpring)  # which correct no position
    joints = [(j.error_bias, j.max_bias) for j in space.constraints if not isinstance(j, springs)]
    names = ("iterations", "damping", "collision_slop", "collision_bias", "collision_persistence")
    return [[getattr(space, name) for name in names], bodies, circles, joints]


PUSHED = """\
scene:
  points: {O: [0, 0], W: [-1, 0]}
  bodies: {b: {block: {mass: 1.0, width: 0.3, height: 0.1}}}
  joints: {rail: {slide: [ground.O, b.center], along: [1, 0]}}
  forces:
    coil: {spring: [ground.W, b.center], stiffness: 30.0, rest_length: 1.0}
    hand: {push: b.center, LAW}
initial: {rail: {shift: 0.1, speed: 0}}
allow: {b.x: 1.0e-3}
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "noted"),
    [("sine: {amplitude: [5, 0], angular_frequency: 8.0}", True), ("constant: [5, 0]", False)],
)
def test_when_a_law_in_time_is_asked_is_said(law: str, noted: bool, tmp_path: Path) -> None:
    """Both recipes take forces in the middle of a step, or at every stage of it."""
    case = scenes.typed(tmp_path, PUSHED.replace("LAW", law), tail=scenes.tail(1.0, 26))
    scene, start = case.scene, first(solve(case).trajectory)
    lines = Pymunk("shipped").snippet(scene, start, {"midpoint": True}, STEP)
    assert ("the law's value at t = n * h + h / 2" in lines) == noted
    told = MuJoCo("shipped").snippet(scene, start, {"integrator": "RK4"}, STEP)
    assert ("is to be set in mjcb_control" in told) == noted
    assert "mjcb_control" not in MuJoCo("shipped").snippet(scene, start, {}, STEP)
