"""The option `shapes`: one body as a user has it, against models that this test writes itself."""

from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.adapters.plain_models import BOX, MODELS
from given.adapters.planning import begun
from given.otherwise import otherwise

from textmech import engines
from textmech.cases.trajectory import Array
from textmech.engines import plain_shapes
from textmech.engines.engine import Plain, Plan, Refusal
from textmech.engines.mujoco.adapter import plain_shapes as in_mjcf
from textmech.engines.pymunk.model import plain_shapes as in_space

CASES = [
    "creeping_block", "sinking_ball", "bouncing_ball", "landing", "rolling_down",
    "sliding_block.braking", "sliding_disk.uphill", "rolling_wheel.downhill",
]  # fmt: skip
HARD = {"pair": {"solref": ["2h", 1.0], "solimp": [0.9999, 0.9999, 0.001]}, "cone": "elliptic"}
SETTINGS: dict[str, list[dict[str, Any]]] = {
    "mujoco": [{}, HARD, {"contacts": "land", "integrator": "RK4"}],
    "pymunk": [{}, {"seed": 1e-9, "midpoint": True, "collision_slop": 1e-6}],
}
STEP, END = 1e-3, 0.6  # s
SAME = 1e-12  # m, rad: rounding; the two take the same steps


def both(name: str, engine: str, options: dict[str, Any]) -> tuple[Array, Array]:
    """(N, 3) each: x, y, angle of the adapter's run, and of a model as this test writes it."""
    (scene, start), case = begun(name), scenes.EVERY[name]
    made: Any = engines.make(engine, "mine", {**options, "shapes": "plain", "step": STEP})
    (plan,) = made.plans(scene, start)
    times = np.linspace(0.0, END, 7)
    (body,) = scene.bodies
    moved = made.run(scene, start, times, STEP, plan, reactions=(), record=True)
    pasted = made.snippet(scene, start, {**options, "shapes": "plain"}, STEP)
    return moved.states[body][:, :3], MODELS[engine](case, start, pasted, times)


def apart(name: str, engine: str, options: dict[str, Any]) -> float:
    """How far [m, rad] the two are apart at worst."""
    ours, users = both(name, engine, options)
    if not scenes.EVERY[name].scene.bodies[next(iter(begun(name)[0].bodies))].turns:
        ours, users = ours[:, :2], users[:, :2]
    return float(np.max(np.abs(ours - users)))


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize(
    ("engine", "place"), [(name, i) for name, of in SETTINGS.items() for i in range(len(of))]
)
def test_what_is_run_is_what_a_user_writes(name: str, engine: str, place: int) -> None:
    """With the lines pasted: no seed, no depth and no friction of ours, and the same shape."""
    assert apart(name, engine, SETTINGS[engine][place]) < SAME


PLANTED: list[tuple[ModuleType, str, str, str, str]] = [
    (in_mjcf, "size of a box geom", "written(width / 2, width / 2, height / 2)",
     "written(width / 2, width / 2, height / 4)", "landing"),
    (in_mjcf, "friction not passed on to geoms", "written(friction, 0.005, 0.0001)",
     "written(1.0, 0.005, 0.0001)", "sliding_disk.uphill"),
    (in_mjcf, "start a little in the floor", "raised((x, y)), *turned",
     "raised((x, y - 1e-6)), *turned", "rolling_down"),
    (in_mjcf, "sphere with its own inertia in place of the disk's",
     "(shape != CYLINDER or body.shape", "(shape == CYLINDER or body.shape", "rolling_down"),
    (in_mjcf, "pair that nobody pasted", 'any("solreffriction" in pair.attrib for',
     'any("solref" in pair.attrib for', ""),
]  # fmt: skip


@pytest.mark.mutant("{what} in a user's model of MuJoCo's")
@pytest.mark.parametrize(
    ("module", "what", "was", "now", "name"), PLANTED, ids=[planted[1] for planted in PLANTED]
)
def test_another_model_than_a_user_writes_is_seen(
    module: ModuleType, what: str, was: str, now: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = otherwise(module, was, now)
    monkeypatch.setattr(in_mjcf, "plain_mjcf", wrong.plain_mjcf)
    if name:
        assert apart(name, "mujoco", {}) > 10 * SAME
    else:
        assert "<pair geom1" in model(HARD)


def model(options: dict[str, Any], name: str = "sinking_ball") -> str:
    """The model that `show` prints."""
    scene, start = begun(name)
    made: Any = engines.make("mujoco", "mine", {**options, "shapes": "plain", "step": STEP})
    return made.script(scene, start, STEP, made.plans(scene, start)[0])


def test_a_pair_stands_where_pasted_lines_ask_for_it_alone() -> None:
    assert "<pair geom1" not in model(HARD)
    assert "<pair geom1" in model({"contacts": "slide"})


@pytest.mark.mutant("a seed in a user's model of pymunk's that no pasted line has")
def test_a_seed_of_ours_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = otherwise(in_space, "shape.radius + seed", "shape.radius + seed + 1e-6")
    from textmech.engines.pymunk.stepping import run

    monkeypatch.setattr(run, "swell", wrong.swell)
    assert apart("rolling_down", "pymunk", {}) > 10 * SAME


def test_a_box_stands_for_a_particle_and_is_read_as_one() -> None:
    scene, start = begun("creeping_block")
    boxed, placed = plain_shapes.with_box(scene, start, "plain")
    assert boxed.bodies["block"].size == BOX
    assert placed["block"] == (0.0, BOX[1] / 2, 0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", ["stacked_blocks.rests", "four_bar", "sliding_ladder"])
@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_what_is_more_than_one_body_on_planes_has_no_such_shapes(engine: str, name: str) -> None:
    known = [case for case in scenes.EVERY if case.startswith(name.partition(".")[0])]
    scene, start = begun(known[0])
    made = engines.make(engine, "mine", {"shapes": "plain", "step": STEP})
    (refusal,) = made.plans(scene, start)
    assert isinstance(refusal, Refusal)
    assert refusal.because.startswith("adapter: shapes:")
    shipped = engines.make(engine, "shipped")
    assert isinstance(shipped, Plain)
    assert not shipped.shapes(scene, start)


@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_forces_of_the_floor_are_read(engine: str) -> None:
    """A block that friction holds: its weight, and the push upon it."""
    scene, start = begun("friction_at_rest")
    options = {"mujoco": HARD, "pymunk": {"seed": 1e-9}}[engine]
    made: Any = engines.make(engine, "mine", {**options, "shapes": "plain", "step": STEP})
    (plan,) = made.plans(scene, start)
    assert isinstance(plan, Plan)
    wanted = ("touch.normal", "touch.tangent")
    found = made.run(scene, start, np.linspace(0.0, 1.0, 11), STEP, plan, reactions=wanted)
    normal, tangent = (found.reactions[name][2:] for name in wanted)
    assert normal == pytest.approx([9.80665] * 9, rel=1e-3)
    assert tangent == pytest.approx(-4.0 * found.times[2:], abs=2e-2)  # the push of 4 N a second


def test_a_cylinder_touches_at_two_points() -> None:
    """The same motion of a disk that rolls, and half of the depth: no other body."""
    scene, start = begun("rolling_down")
    places = []
    for shape in ("plain", "cylinder"):
        made: Any = engines.make("mujoco", "mine", {**HARD, "shapes": shape, "step": STEP})
        (plan,) = made.plans(scene, start)
        moved = made.run(scene, start, np.array([0.0, 0.5]), STEP, plan, reactions=())
        places.append(moved.states["wheel"][-1, 0])
    assert places[0] == pytest.approx(places[1], abs=1e-6)


@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_the_audit_reads_a_users_model(engine: str) -> None:
    scene, start = begun("sliding_disk.uphill")
    made: Any = engines.make(engine, "mine", {"shapes": "plain", "step": STEP})
    found = made.measure(scene, start)
    wanted = {f"{part.name}.{n}": x for part in scene.elements() for n, x in part.numbers().items()}
    for name in ("wheel.mass", "wheel.inertia", "touch.friction"):
        assert found[name] == pytest.approx(wanted[name], rel=1e-12)
