"""What hardly a scene does when it comes down, in pymunk: fast tips, two at once, beside what."""

from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.planning import TUNED, every, moved, ways

from textmech.cases.case import Case
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Realised
from textmech.engines.pymunk.callbacks import cut
from textmech.engines.pymunk.callbacks.foot import Foot
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

PYMUNK = TUNED["pymunk"]
Patch = pytest.MonkeyPatch

# It turns so fast that its tip is (ω h)² l/2 = 7e-6 m off its floor at the end of a step of 2 ms.
FAST_TIP = """\
scene:
  bodies: {rod: {bar: {mass: 1, length: 0.8}}}
  contacts:
    tip: {between: [rod.start, ground.floor], friction: 0.1, restitution: 0.8}
    far: {between: [rod.end, ground.floor], friction: 0.1}
events: {lands: {far.gap: falls to zero}}
initial: {rod: {start: [0, 0], angle: 60 deg, on: start, omega: -3}}
allow: {rod.angle: 1.0e-2, tip.normal: 1}
"""
# Two disks that come down in one step of 1 ms, the second 0.5 ms before the first.
TWO_LANDINGS = """\
scene:
  bodies: {one: {disk: {mass: 1, radius: 0.1}}, two: {disk: {mass: 2, radius: 0.1}}}
  contacts:
    a: {between: [one, ground.floor], friction: 0.3, restitution: 0.6}
    b: {between: [two, ground.floor], friction: 0.3, restitution: 0.6}
events: {lands: {a.gap: falls to zero}, too: {b.gap: falls to zero}}
initial: {one: {x: 0, y: 0.14972, angle: 0, vx: 1}, two: {x: 1, y: 0.14923, angle: 0, vx: 1}}
allow: {one.x: 1.0e-2, two.x: 1.0e-2}
"""
# A ball that bounces without end on a ramp, until 0.65 s, and slides down it.
PILE = """\
scene:
  planes: {ramp: {at: [0, 0], normal: [-0.6, 0.8]}}
  bodies: {ball: {disk: {mass: 1, radius: 0.1}}}
  contacts: {a: {between: [ball, ground.ramp], friction: 0.3, restitution: 0.5}}
events: {lands: {a.gap: falls to zero}}
initial: {ball: {x: -0.18, y: 0.24, angle: 0, vx: -1, vy: -0.75}}
allow: {ball.x: 1.0e-3, a.normal: 0.1}
"""
PUSHED = """\
scene:
  bodies: {one: {disk: {mass: 1, radius: 0.1}}}
  contacts: {a: {between: [one, ground.floor], friction: 0.3, restitution: 0.6}}
  forces: {hand: {push: one.center, sine: {amplitude: [0, 3], angular_frequency: 30}}}
events: {lands: {a.gap: falls to zero}}
initial: {one: {x: 0, y: 0.14972, angle: 0, vx: 1}}
allow: {one.x: 1.0e-2, one.y: 0.1}
"""


def known(folder: Path, text: str, duration: float) -> tuple[Case, Trajectory]:
    case = scenes.typed(folder, text, tail=scenes.tail(duration, 26))
    solution = solve(case)
    assert solution.holds
    return case, solution.trajectory


def off(case: Case, motion: Trajectory, step: float, way: Realised, body: str) -> Array:
    """(6,) how far the states of a body are from the reference's."""
    found = moved(PYMUNK, case.scene, first(motion), case.times, step, realised=way)
    largest: Array = np.abs(found.states[body] - motion.states[body]).max(axis=0)
    return largest


def pressed(folder: Path) -> float:
    """N: how far the force of the fast tip is off, but at first and where the far one lands."""
    case, motion = known(folder, FAST_TIP, 0.1)
    found = moved(
        PYMUNK, case.scene, first(motion), case.times, 2e-3, realised="driver",
        reactions=("tip.normal",),
    )  # fmt: skip
    return float(np.abs(found.reactions["tip.normal"] - motion.reactions["tip.normal"])[5:20].max())


@pytest.mark.slow
def test_a_tip_that_turns_fast_stays_on_its_floor(tmp_path: Path) -> None:
    assert pressed(tmp_path) < 1e-4  # measured 1.3e-5, of 2 to 4 N


@pytest.mark.slow
@pytest.mark.mutant("a tip's path along its curve, (ω h)² l/2, taken for a leap")
def test_a_tip_that_leaves_by_its_curve_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    look = Foot.look

    def level(self: Foot, step: float) -> None:
        self._far, far = 0.0, self._far
        look(self, step)
        self._far = far

    monkeypatch.setattr(Foot, "look", level)
    assert pressed(tmp_path) > 1e-3  # measured 0.011: it comes down anew in each step


@pytest.mark.slow
def test_two_that_land_in_one_step_each_do_so_in_time(tmp_path: Path) -> None:
    case, motion = known(tmp_path, TWO_LANDINGS, 0.2)
    assert len({int(t / 1e-3) for t in motion.switches}) == 1
    for body in ("one", "two"):
        assert off(case, motion, 1e-3, "driver", body).max() < 1e-10


@pytest.mark.slow
@pytest.mark.mutant("of two that land in one step the later one first")
def test_the_later_of_two_landings_first_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.setattr(cut, "min", max, raising=False)
    case, motion = known(tmp_path, TWO_LANDINGS, 0.2)
    assert max(off(case, motion, 1e-3, "driver", body).max() for body in ("one", "two")) > 1e-4


def slid(folder: Path) -> float:
    """N: how far the ramp's force is off once the ball slides."""
    case, motion = known(folder, PILE, 1.0)
    found = moved(
        PYMUNK, case.scene, first(motion), case.times, 5e-4, realised="driver",
        reactions=("a.normal",),
    )  # fmt: skip
    return float(np.abs(found.reactions["a.normal"] - motion.reactions["a.normal"])[20:].max())


@pytest.mark.slow
def test_what_bounces_without_end_stands_after_it(tmp_path: Path) -> None:
    assert slid(tmp_path) < 1e-8  # measured 7e-10, rounding of 8 N: twice that by half the step


@pytest.mark.slow
@pytest.mark.mutant("a bounce of less than a step thrown back, in each step anew")
def test_bounces_in_each_step_are_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    touch = Foot.touch

    def thrown(self: Foot, step: float) -> None:
        touch(self, step)
        self._back = self.contact.restitution
        self._throw(self._back)

    monkeypatch.setattr(Foot, "touch", thrown)
    assert slid(tmp_path) > 1.0


@pytest.mark.slow
def test_no_step_is_cut_beside_a_force_given_in_time(tmp_path: Path) -> None:
    """It is told before each step, for all of it."""
    case, motion = known(tmp_path, PUSHED, 0.2)
    assert ways(PYMUNK, case.scene, first(motion)) == ("native",)
    # The landing at the end of its step: 8e-3 m/s at 1 ms, of first order.
    assert off(case, motion, 1e-3, "native", "one")[:3].max() < 5e-3


# What stands beside a disk that may come down, and forbids to cut its step.
BESIDE = {
    "hand: {push: one.center, sine: {amplitude: [0, 3], angular_frequency: 30}}": ("", ""),
    "hand: {push: one.center, constant: [0, 3]}": ("", ""),
    "air: {drag: one.center, coefficient: 0.1, exponent: 2}": ("", ""),
    "coil: {spring: [ground.O, one.center], stiffness: 30, rest_length: 0.1}": (
        "points: {O: {at: [0, 1], moves: {sine: {amplitude: [0.1, 0], angular_frequency: 9}}}}",
        "",
    ),
    "cord: {rope: [ground.O, one.center], length: 3}": ("points: {O: [0, 1]}", ""),
    "turn: {torsion_damper: guide, damping: 0.1}": (
        "points: {O: [0, 1]}\n  joints: {guide: {slot: [ground.O, one.center], along: [0, 1]}}",
        "",
    ),
    "none": ("", "friction: {static: 0.4, kinetic: 0.3}"),
}


def beside(force: str, folder: Path) -> bool:
    """Whether steps of the disk are cut beside it."""
    more, contact = BESIDE[force]
    text = PUSHED.replace("scene:\n", f"scene:\n  {more}\n" if more else "scene:\n")
    text = text.replace("friction: 0.3", contact) if contact else text
    sine = "hand: {push: one.center, sine: {amplitude: [0, 3], angular_frequency: 30}}"
    text = text.replace(f"{{{sine}}}", f"{{{force}}}" if force != "none" else "{}")
    return cut.cuts(scenes.typed(folder, text, tail=scenes.tail(0.2, 26)).scene)


@pytest.mark.mutant("a step that is cut beside {force}")
@pytest.mark.parametrize("force", BESIDE)
def test_what_a_step_of_any_length_does_not_bear_is_not_cut(force: str, tmp_path: Path) -> None:
    """Planted by hand: each of the conditions of `cuts` left out."""
    assert not beside(force, tmp_path)


def test_springs_that_stand_still_are_no_hindrance(tmp_path: Path) -> None:
    scene = scenes.typed(tmp_path, PUSHED, tail=scenes.tail(0.2, 26)).scene
    assert cut.cuts(replace(scene, forces={}))


def slips(monkeypatch: Patch) -> float:
    """m/s: how far a tip that never slips is from slipping as fast the other way after a step."""
    lay, seen, before = Foot.lay, [], {}

    def watched(self: Foot, length: float, *, strikes: bool) -> None:
        if self in before and self.stands and not strikes:
            seen.append(abs(self._slip(*before[self][0]) + before[self][1]))
        before.pop(self, None)
        if self.stands and not strikes and self._turns:
            *_, cos, sin = self.carrier.pose(length, 0.0)
            before[self] = (cos, sin), self._slip(cos, sin)
        lay(self, length, strikes=strikes)

    monkeypatch.setattr(Foot, "lay", watched)
    case, exact = scenes.SHIPPED["rimless_wheel"], scenes.solved("rimless_wheel").trajectory
    moved(PYMUNK, case.scene, first(exact), case.times[:4], 1e-3, realised="driver")
    assert len(seen) > 100
    return float(np.median(seen))


@pytest.mark.slow
def test_a_tip_that_stands_slips_as_fast_the_other_way(monkeypatch: Patch) -> None:
    """Reflected: to first order its path is then that of a pin."""
    assert slips(monkeypatch) < 1e-9


@pytest.mark.slow
@pytest.mark.mutant("a circle under a pivot that is held at its own lowest point")
def test_a_circle_held_at_its_own_lowest_point_is_seen(monkeypatch: Patch) -> None:
    def carry(self: Foot, slip: float) -> None:
        ux, uy = self.contact.plane.along
        self.shape.surface_velocity = slip * ux, slip * uy

    monkeypatch.setattr(Foot, "_carry", carry)
    assert slips(monkeypatch) > 1e-7


LADDER = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {rod: {bar: {mass: 5.0, length: 3.0}}}
  contacts:
    foot: {between: [rod.end, ground.floor], friction: 0}
    top: {between: [rod.start, ground.wall], friction: 0}
events: {leaves: {top.normal: falls to zero}}
initial: {rod: {angle: -0.9, on: [end, start]}}
allow: {rod.angle: 1.0e-2}
"""


def let_go(folder: Path, step: float) -> tuple[float, float]:
    """s: when the wall first pushes no longer, in the reference and in pymunk."""
    case, motion = known(folder, LADDER, 0.5)
    found = moved(
        PYMUNK, case.scene, first(motion), case.times, step, reactions=("top.normal",), record=True
    )
    record = every(found)
    (leaves,) = motion.switches.tolist()
    return leaves, float(record.times[np.argmax(record.reactions["top.normal"] <= 0.0)])


@pytest.mark.slow
@pytest.mark.parametrize("step", [1e-3, 5e-4, 1.25e-4])
def test_a_smooth_ladder_leaves_its_wall_once(step: float, tmp_path: Path) -> None:
    leaves, found = let_go(tmp_path, step)
    assert found == pytest.approx(leaves, abs=2 * step)


@pytest.mark.slow
@pytest.mark.mutant("a seed that the curve of a tip's path uses up")
def test_a_seed_that_is_used_up_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    recipe = import_module("textmech.engines.pymunk.settings.recipe")
    monkeypatch.setattr(recipe, "_TIP_SEED", replace(recipe._TIP_SEED, value=1e-8))
    leaves, found = let_go(tmp_path, 5e-4)
    assert found < leaves - 0.1
