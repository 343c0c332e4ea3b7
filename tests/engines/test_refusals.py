"""A scene that an engine cannot build is refused, with who cannot and why; odd names are not."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from given import engine_scenes as given
from given.engine_scenes import (
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
from given.planning import NAMES, SETTINGS, TUNED, moved, planned, refused, words

from textmech.cases.scene import Anchor, Joint, Scene, planar_joint
from textmech.cases.scene.shape import disk, particle, rigid
from textmech.cases.trajectory import Array
from textmech.engines.engine import Engine, Start

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
