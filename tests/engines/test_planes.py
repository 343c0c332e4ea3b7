"""A scene on a plane is the scene on the floor, turned: the reference and the engines agree."""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from given.adapters.planning import NAMES, TUNED, ways
from given.adapters.planning import moved as run
from given.scenes import typed

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

TURNED = math.radians(35)
AT = (0.3, -0.2)  # the point of the plane that is the floor's origin [m]
G = 9.80665  # m/s²
DISK = "wheel: {disk: {mass: 1.3, radius: 0.25}}"
ROD = "wheel: {bar: {mass: 1.3, length: 0.8}}"
# The body, its contact, and its start: x, y, angle [rad], vx, vy, omega.
SCENES = {
    "slides, then rolls": (DISK, "wheel", "0.4", (0.0, 0.25, 0.0, 2.0, 0.0, 5.0)),
    "two coefficients": (DISK, "wheel", "{static: 0.5, kinetic: 0.4}", (0, 0.25, 0, 2, 0, 5)),
    "bounces": (DISK, "wheel", "0.3, restitution: 0.6", (0.0, 0.5, 0.0, 1.0, 0.0, 2.0)),
    "a bar's end": (
        ROD, "wheel.start", "0.2", (0.4 * math.cos(1.0), 0.4 * math.sin(1.0), 1.0, 0, 0, 0),
    ),
}  # fmt: skip
QUANTITIES = ("touch.slip", "touch.gap", "touch.drift", "touch.normal", "touch.tangent")
# What rounding makes of it until the end: the floor of MuJoCo is a stiff spring, and one step of
# either engine may fall on the other side of an impact.
STEP = 1e-3  # s
NEAR = 1e-7


def case(folder: Path, what: str, turn: float, at: tuple[float, float]) -> Case:
    """The scene on a plane through `at` that is turned by `turn` [rad]."""
    body, touching, friction, (x, y, angle, vx, vy, omega) = SCENES[what]
    cos, sin = math.cos(turn), math.sin(turn)
    start = {
        "x": at[0] + cos * x - sin * y, "y": at[1] + sin * x + cos * y, "angle": angle + turn,
        "vx": cos * vx - sin * vy, "vy": sin * vx + cos * vy, "omega": omega,
    }  # fmt: skip
    given = ", ".join(f"{key}: {value!r}" for key, value in start.items())
    folder.mkdir()
    return typed(folder, f"""\
scene:
  gravity: [{sin * G!r}, {-cos * G!r}]
  planes: {{slope: {{at: [{at[0]}, {at[1]}], normal: [{-sin!r}, {cos!r}]}}}}
  bodies: {{{body}}}
  contacts: {{touch: {{between: [{touching}, ground.slope], friction: {friction}}}}}
events: {{meets: {{touch.gap: falls to zero}}}}
initial: {{wheel: {{{given}}}}}
allow: {{wheel.x: 1.0e-2}}
""")  # fmt: skip


def pairs(folder: Path, what: str) -> Iterator[Case]:
    """On the floor, and turned."""
    yield case(folder / "level", what, 0.0, (0.0, 0.0))
    yield case(folder / "turned", what, TURNED, AT)


@pytest.mark.slow
@pytest.mark.parametrize("what", SCENES)
def test_reference(tmp_path: Path, what: str) -> None:
    level, turned = pairs(tmp_path, what)
    wanted, found = solve(level).trajectory, solve(turned).trajectory
    for name in QUANTITIES:
        a, b = observe(level.scene, wanted, name), observe(turned.scene, found, name)
        assert b == pytest.approx(a, abs=1e-10 * max(1.0, np.abs(a).max())), name
    # where impacts pile up, each time has the rounding of all that came before
    assert found.switches == pytest.approx(wanted.switches, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", SCENES)
def test_engine(tmp_path: Path, what: str, name: str) -> None:
    level, turned = pairs(tmp_path, what)
    starts = [first(solve(each).trajectory) for each in (level, turned)]
    engine, forces = TUNED[name], ("touch.normal", "touch.tangent")
    for way in ways(engine, level.scene, starts[0]):
        if way not in ways(engine, turned.scene, starts[1]):
            assert (name, way) == ("mujoco", "law")  # which pushes along a coordinate
            continue
        motions = [
            run(engine, each.scene, start, each.times, STEP, realised=way, reactions=forces)
            for each, start in zip((level, turned), starts, strict=True)
        ]
        for quantity in QUANTITIES:
            a = observe(level.scene, motions[0], quantity)
            b = observe(turned.scene, motions[1], quantity)
            assert b == pytest.approx(a, abs=NEAR * max(1.0, np.abs(a).max())), quantity
