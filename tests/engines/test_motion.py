"""Each engine's tuned motion and forces meet closed forms, or the reference, as near as is written.

A bound is two to three times what was measured, beside which it stands with its reason.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from given.closed_motions import pendulum
from given.engine_scenes import (
    BOX,
    ROD,
    ROLLS,
    WHEEL,
    G,
    launched,
    machine,
    on_a_swing,
    pin,
)
from given.planning import NAMES, TUNED, begun, moved, planned
from given.scenes import SHIPPED, solved
from given.swings import energy_drift, swing_error

from textmech.cases.scene import Anchor, Push, Signal
from textmech.cases.scene.observe import observe
from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import ANGLE, Array, X
from textmech.engines.engine import Start


@dataclass(frozen=True)
class Near:
    """How near an engine's tuned setting comes; its order in h is that of its plan."""

    pendulum: tuple[float, float]  # rad over 10 s and N, at 1e-4 s
    rolling: tuple[float, float]  # m and N: of places and forces, at 1e-3 s
    towed: tuple[float, float, float]  # rad, m and N, at 1e-3 s
    slide: tuple[float, float]  # rad and N, at 1e-3 s
    weld: tuple[float, float]
    energy: float  # J, of hanging chains at 2e-4 s
    carried: float  # N, at 1e-4 s
    alike: float  # rounding, of masses a billion times larger and smaller


NEAR = {
    # Fourth order; what is left is rounding over 1e5 steps, the floor's depth (1 - d of it is
    # missing while a disk settles: 7e-7 N at the start), and the reference's own 1e-11.
    "mujoco": Near(
        pendulum=(2e-12, 4e-11),  # measured 5.7e-13, 1.1e-11
        rolling=(3e-8, 2e-6),  # 1.2e-8, 7.3e-7
        towed=(8e-11, 8e-12, 4e-10),  # 3.0e-11, 2.4e-12, 1.4e-10
        slide=(1e-10, 5e-9),  # 3.5e-11, 1.7e-9
        weld=(1e-11, 4e-10),  # 4.6e-12, 1.3e-10
        energy=6e-10,  # 2.3e-10
        carried=6e-9,  # 2.4e-9
        alike=3e-15,  # 8.9e-16
    ),
    # Second order.
    "pymunk": Near(
        pendulum=(1.5e-5, 2e-4),  # measured 5.7e-6, 1.1e-4
        rolling=(3e-14, 5e-10),  # a disk that rolls has no error: 9e-15 (slip 0), 1.8e-10
        towed=(5e-6, 1.2e-6, 5e-4),  # 2.2e-6, 4.5e-7, 2.0e-4
        slide=(1.2e-5, 5e-3),  # 4.1e-6, 1.9e-3
        weld=(4e-5, 9e-3),  # 1.4e-5, 3.1e-3
        energy=1e-4,  # 3.9e-5
        carried=1e-4,  # 3.3e-5 at the start, which is extrapolated
        alike=5e-13,  # 1.4e-13
    ),
}


def worst(a: Array, b: Array) -> float:
    """The largest difference."""
    return float(np.abs(a - b).max())


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_pendulum(name: str) -> None:
    scene, start = begun("bar_pendulum")
    times, wanted = SHIPPED["bar_pendulum"].times, ("hinge.force", "hinge.fx")
    run = moved(TUNED[name], scene, start, times, 1e-4, reactions=wanted)
    angle, force = pendulum(times)
    assert worst(run.states["bar"][:, ANGLE], angle) < NEAR[name].pendulum[0]
    assert worst(run.reactions["hinge.force"], force) < NEAR[name].pendulum[1]
    withheld = planned(TUNED[name], scene, start).withheld
    assert set(run.reactions) == set(wanted) - set(withheld)


PULLS = {"pushed": (2.5, 0.0), "downhill": (0.0, math.radians(20))}  # N and rad


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("variant", PULLS)
def test_a_wheel_rolls(variant: str, name: str) -> None:
    scene, start = begun(f"rolling_wheel.{variant}")
    times, (push, beta) = SHIPPED[f"rolling_wheel.{variant}"].times, PULLS[variant]
    run = moved(TUNED[name], scene, start, times, 1e-3, reactions=("touch.normal", "touch.tangent"))
    pull, (place, force) = 1.3 * G * math.sin(beta) + push, NEAR[name].rolling
    x = 0.4 * times + pull / (1.5 * 1.3) / 2 * times**2
    assert worst(run.states["wheel"][:, X], x) < place
    assert np.abs(observe(scene, run, "touch.slip")).max() < place
    # the floor's force on the wheel: upwards, and against a pull to the right
    assert run.reactions["touch.normal"] == pytest.approx(1.3 * G * math.cos(beta), abs=force)
    assert run.reactions["touch.tangent"] == pytest.approx(-pull / 3, abs=force)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_a_driven_point_pushes_and_forces_in_time(name: str) -> None:
    exact, (scene, start) = solved("towed_pendulum").trajectory, begun("towed_pendulum")
    run = moved(TUNED[name], scene, start, exact.times, 1e-3, reactions=("pivot.force",))
    angle, place, force = NEAR[name].towed
    assert worst(run.states["bob"][:, ANGLE], exact.states["bob"][:, ANGLE]) < angle
    assert worst(run.states["cart"][:, X], exact.states["cart"][:, X]) < place
    assert worst(run.reactions["pivot.force"], observe(scene, exact, "pivot.force")) < force


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kind", ["slide", "weld"])
def test_slide_and_weld_on_a_turning_body(kind: str, name: str) -> None:
    angle, force = swing_error(TUNED[name], kind)
    near = NEAR[name].slide if kind == "slide" else NEAR[name].weld
    assert angle < near[0]
    assert force < near[1]


@pytest.mark.parametrize("name", NAMES)
def test_angle_of_a_weld_may_stand_on_another_turn(name: str) -> None:
    scene, start = on_a_swing("weld")
    x, y, angle, vx, vy, omega = start["box"]
    turned: Start = {**start, "box": (x, y, angle + math.tau, vx, vy, omega)}
    times = np.array([0.0, 0.4])
    a, b = (moved(TUNED[name], scene, s, times, 1e-3).states["rod"][-1] for s in (start, turned))
    assert b == pytest.approx(a, abs=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_angles_stay_on_their_turn(name: str) -> None:
    """A slide that holds 10° holds 370° too, and what hangs on it counts from there."""
    turn = math.tau + 0.2
    joints = [
        pin("A", "ground.O", "box.center", "slide", angle=0.2),
        pin("B", "box.center", "rod.start"),
    ]
    end = (0.5 * math.cos(8.0), 0.5 * math.sin(8.0))
    start = {"box": (0, 0, turn, 0, 0, 0), "rod": (*end, 8.0, 0, 0, 0)}
    found = moved(TUNED[name], machine([BOX, ROD], joints), start, np.linspace(0, 0.01, 3), 1e-3)
    assert found.states["box"][:, ANGLE] == pytest.approx(turn, abs=1e-14)
    assert found.states["rod"][0, ANGLE] == pytest.approx(8.0, abs=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("n", [5, 12])
def test_a_chain_keeps_its_energy(n: int, name: str) -> None:
    assert energy_drift(TUNED[name], n) < NEAR[name].energy


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("mass", [1e-9, 1e9])
def test_masses_far_from_one_fall_alike(mass: float, name: str) -> None:
    def fall(m: float) -> Array:
        rod = bar(name="rod", mass=m, length=1.0, points={})
        scene, start = machine([rod], [pin("A", "ground.O", "rod.start")]), (0.5, 0, 0, 0, 0, 0)
        return moved(TUNED[name], scene, {"rod": start}, np.linspace(0, 0.8, 11), 2e-3).states[
            "rod"
        ]

    assert worst(fall(mass), fall(1.0)) < NEAR[name].alike


@pytest.mark.parametrize("name", NAMES)
def test_the_floor_carries_a_disk_from_the_start(name: str) -> None:
    """Also under a sine's first push."""
    push = Push("push", Anchor("wheel", "center"), Signal("sine", (0.0, -30.0), 5.0, math.pi / 2))
    scene = machine([WHEEL], contacts=[ROLLS], forces=[push])
    times = np.linspace(0, 0.01, 3)
    found = moved(TUNED[name], scene, launched(0.0), times, 1e-4, reactions=("touch.normal",))
    wanted = 1.3 * G + 30 * np.cos(5.0 * times)
    assert worst(found.reactions["touch.normal"], wanted) < NEAR[name].carried


@pytest.mark.parametrize("name", NAMES)
def test_a_size_is_that_of_the_components(name: str) -> None:
    """Where they are told: else the components are withheld, and the size is not."""
    scene, start = begun("double_pendulum")
    wanted = tuple(f"elbow.{field}" for field in ("fx", "fy", "force"))
    times = SHIPPED["double_pendulum"].times[:3]
    found = moved(TUNED[name], scene, start, times, 1e-3, reactions=wanted).reactions
    if set(found) == set(wanted):
        assert found["elbow.force"] == pytest.approx(np.hypot(found["elbow.fx"], found["elbow.fy"]))
    else:
        assert set(found) == {"elbow.force"}
        assert set(planned(TUNED[name], scene, start).withheld) >= {"elbow.fx", "elbow.fy"}
