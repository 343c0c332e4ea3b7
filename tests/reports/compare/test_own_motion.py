"""The limits of users' models against our own reference, and mistakes that they would not share."""

import math
from collections.abc import Callable
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest
from given.machines.random_models import public_models, random_model
from given.otherwise import otherwise

from textmech.cases.model_case import Steps, of_model
from textmech.cases.tree import Link, Tree
from textmech.engines.own_model import equations as ours
from textmech.engines.own_model import limit as limits
from textmech.engines.own_model.limit import limit
from textmech.engines.own_model.model import OwnModel, compiled, compiled_text
from textmech.reference.formalisms import tree_motion
from textmech.reports.compare import own_motion
from textmech.reports.compare.own_equations import Part, lines
from textmech.reports.compare.own_motion import motion
from textmech.reports.compare.own_rows import modelled

TIMES = np.linspace(0.0, 0.02, 3)
CORNER = 0.007
SURE = 3e-11  # rad, m: what both motions state as their errors, and rounding

ARM = """\
<mujoco><worldbody><body name="arm"><freejoint name="base"/><inertial pos=".2 0 .1" mass="2"
diaginertia=".02 .03 .04"/>
<body name="hand" pos=".5 0 0" gravcomp=".3"><inertial pos="0 .1 0" mass="1"
diaginertia=".01 .02 .02"/><joint name="wrist" axis="0 0 1" armature=".05"/>
<body pos="0 .3 0"><joint name="ball" type="ball" damping=".1"/>
<inertial pos="0 .1 .1" mass=".5" diaginertia=".01 .012 .015"/></body></body></body></worldbody>
<actuator><position name="servo" joint="wrist" kp="20"/></actuator>
<keyframe><key qpos="0 0 0 .8 0 .6 0 .1 1 0 0 0" qvel="1 0 0 1 2 -1 .5 3 1 2"/></keyframe></mujoco>
"""


def driven() -> OwnModel:
    law = Steps((0.0, CORNER), (0.5, -0.5))
    return replace(compiled_text(ARM), laws={0: law})


def part(tree: Callable[[Tree], Tree] = lambda tree: tree) -> Part:
    """The motion of the arm, of which our hands have another's numbers."""
    own = driven()
    exact = limit(own, TIMES)
    own.__dict__["tree"] = tree(own.tree)
    return motion(own, exact)


def test_a_limit_is_within_rounding_of_the_reference() -> None:
    moves = part()
    assert moves.holds
    assert moves.off is not None
    assert moves.off < 1e-12
    assert moves.bound < SURE
    assert moves.span == 0.02
    (line,) = lines([moves])
    assert "rad or m from the reference by our own equations, over 0.02 s" in line


def other_hand(change: Callable[[Link], Link]) -> Callable[[Tree], Tree]:
    return lambda tree: replace(tree, links=[tree.links[0], change(tree.links[1]), tree.links[2]])


TILTED = np.array([math.sin(1e-4), 0.0, math.cos(1e-4)])
MISTAKES: dict[str, Callable[[Tree], Tree]] = {
    "a hand's inertia 1e-4 off": other_hand(lambda x: replace(x, J=x.J * (1 + 1e-4))),
    "a hand of other weight": other_hand(lambda x: replace(x, lifted=0.3001)),
    "a wrist's axis 1e-4 off": other_hand(
        lambda x: replace(x, joints=[replace(x.joints[0], axis=TILTED)])
    ),
    "no armature in motion": lambda tree: replace(tree, armature=0 * tree.armature),
}


@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_another_number_moves_it(mistake: str) -> None:
    wrong = part(MISTAKES[mistake])
    assert not wrong.holds
    assert "FAILS: " in lines([wrong])[0]


LINES = {
    "a quaternion's rate in ground axes": ("w * a + y * c - z * b", "w * a - y * c + z * b"),
    "a quaternion's rate without its half": ("return np.array([-(x", "return 2 * np.array([-(x"),
    "rates of turns for those of shifts": (
        "v[joint.v : i]", "v[joint.v + i - joint.v : 2 * i - joint.v]"
    ),
    "a reference that loses the corner of a control": (
        "self.before = math.nextafter(b, a)", "self.before = 0.0"
    ),
    "no servo": ("forces += equations.driven", "0 * equations.driven"),
}  # fmt: skip


@pytest.mark.mutant("{line}")
@pytest.mark.parametrize("line", LINES)
def test_a_wrong_line_moves_it(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong: ModuleType = otherwise(tree_motion, *LINES[line])
    monkeypatch.setattr(own_motion, "tree_motion", wrong.tree_motion)
    assert not part().holds


@pytest.mark.mutant("a limit that loses the corner of a control")
def test_a_lost_corner_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = otherwise(ours, "self.before = math.nextafter(b, a)", "self.before = 0.0")
    monkeypatch.setattr(limits, "Equations", wrong.Equations)
    assert not part().holds


OVER = "corners = [t for t in self.controls.corners if times[0] < t < times[-1]]", "corners = []"


@pytest.mark.mutant("{who} that steps over a corner")
@pytest.mark.parametrize("who", ["a limit", pytest.param("a reference", marks=pytest.mark.slow)])
def test_who_steps_over_a_corner_knows_its_motion_less(
    who: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Both choose their steps by their errors, and say them."""
    if who == "a limit":
        monkeypatch.setattr(limits, "Equations", otherwise(ours, *OVER).Equations)
    else:
        wrong = otherwise(tree_motion, *OVER)
        monkeypatch.setattr(own_motion, "tree_motion", wrong.tree_motion)
    assert part().bound > 3 * SURE


def compared(text: str, times: np.ndarray = TIMES) -> Part:
    own = compiled_text(text)
    return motion(own, limit(own, times))


FALLS = """\
<mujoco><worldbody><geom name="floor" type="plane" size="1 1 1"/>
<body name="drop" pos="0 0 .105"><freejoint/><geom size=".1"/></body></worldbody>
<keyframe><key qpos="0 0 .105 1 0 0 0"/></keyframe></mujoco>"""
LOSSY = """\
<mujoco><worldbody><body><joint name="hinge&#10;; rm" axis="0 1 0" frictionloss=".1"/>
<geom size=".1" pos=".3 0 0"/></body></worldbody></mujoco>"""


def test_it_is_compared_until_something_acts() -> None:
    """A ball falls 5 mm in 32 ms."""
    moves = compared(FALLS, np.linspace(0.0, 0.04, 5))
    assert moves.holds
    assert moves.span == 0.03
    assert moves.because.startswith("not compared from 0.03")
    assert "contact of geom floor and body drop acts" in moves.because


def test_what_acts_from_the_start_is_said_in_one_line() -> None:
    moves = compared(LOSSY)
    assert moves.off is None
    (line,) = lines([moves])
    assert "not compared: friction loss of joint hinge\\n; rm acts from the start on" in line


def test_what_is_not_read_and_what_takes_too_long_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    wet = compared(ARM.replace("<worldbody>", '<option density="1.2"/><worldbody>'))
    assert wet.because == "not compared: passive forces are not read as a whole"
    monkeypatch.setattr(own_motion, "MOST", 0)
    assert compared(ARM).because.endswith("takes too long")
    monkeypatch.setattr(own_motion, "MOST", 30 * 110)
    moves = compared(ARM)
    assert moves.span == 0.01
    assert moves.because == "not compared from 0.01 s on: it takes too long"


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 3, 4, 9, 11, 14])
def test_any_model_moves_as_its_reference(seed: int) -> None:
    """Servos of half of them are clamped: what has kinks states larger errors."""
    moves = compared(random_model(seed), np.linspace(0.0, 0.2, 5))
    assert moves.holds
    assert moves.span
    assert moves.bound < 1e-6


@pytest.mark.slow
def test_rows_of_a_run_have_it() -> None:
    case = replace(of_model("", "MJCF", "arm", ARM), duration=0.1)
    rows = {row.check: row for row in modelled(case).certificates}
    assert rows["motion"].verdict == "holds"
    assert rows["motion"].difference < rows["motion"].bound < 1e-7


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_public_models_move_as_their_reference_until_something_acts() -> None:
    """Of gymnasium's; each has a reference, or the constraint that acts from the start is named."""
    models = {file.stem: compiled(str(file)) for file in public_models()}
    times = np.linspace(0.0, 0.05, 6)
    moves = {name: motion(own, limit(own, times)) for name, own in models.items()}
    assert all(part.holds and (part.off is not None or part.because) for part in moves.values())
    assert {name for name, part in moves.items() if part.off is not None} == {
        "half_cheetah", "inverted_double_pendulum", "inverted_pendulum", "reacher",
    }  # fmt: skip
