"""The forces of users' models' constraints against the optimum of their law, and mistakes."""

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.engines.own_model import constraints as read
from textmech.engines.own_model.constraints import Constraints
from textmech.engines.own_model.model import OwnModel, State, compiled_text
from textmech.reference.laws import constraints as law
from textmech.reports.compare import own_equations
from textmech.reports.compare.own_equations import Part, constraints, lines

PILE = """\
<mujoco><option cone="{cone}" impratio="{impratio}" {more}/><worldbody>
<geom name="floor" type="plane" size="2 2 1" friction=".4 .02 .01"/>
<body name="box" pos="0 0 .098"><freejoint name="loose"/>
<geom name="crate" type="box" size=".2 .1 .1" mass="2" condim="{condim}"/></body>
<body name="arm" pos="1 0 1"><joint name="shoulder" axis="0 1 0" range="0 40" frictionloss=".3"/>
<geom size=".05" fromto="0 0 0 .5 0 0" type="capsule" mass="1" contype="0" conaffinity="0"/>
<body pos=".5 0 0"><joint name="elbow" axis="0 1 0"/><joint name="rolls" axis="1 0 0"/>
<geom size=".05" fromto="0 0 0 .5 0 0" type="capsule" mass="1" contype="0" conaffinity="0"/>
</body></body></worldbody>
<tendon><fixed name="rope" range="-.1 .1" limited="true" frictionloss=".2">
<joint joint="elbow" coef="1"/></fixed></tendon>
<equality><joint name="geared" joint1="rolls" joint2="elbow" polycoef="0 .5 0 0 0"/></equality>
<keyframe><key qpos="0 0 .098 1 0 0 0 .8 .3 .1" qvel="1.5 -.4 -.3 .2 .3 2 1 2 .5"/></keyframe>
</mujoco>"""
KINDS = [("pyramidal", 3), ("pyramidal", 6), ("elliptic", 1), ("elliptic", 3), ("elliptic", 4),
         ("elliptic", 6)]  # fmt: skip


def pile(
    cone: str = "elliptic", condim: int = 4, impratio: float = 5.0, more: str = ""
) -> OwnModel:
    return compiled_text(PILE.format(cone=cone, condim=condim, impratio=impratio, more=more))


def states(own: OwnModel) -> list[State]:
    """Slow and fast, to and fro: what sticks, slips, and lifts off."""
    start, speeds = own.start(), (0.0, 0.3, 1.0, -30.0)
    return [State(start.qpos, speed * start.qvel, start.ctrl) for speed in speeds]


def part(own: OwnModel) -> Part:
    return constraints(own, states(own))


@pytest.mark.parametrize(("cone", "condim"), KINDS)
@pytest.mark.parametrize("impratio", [1.0, 30.0])
def test_forces_are_the_optimum_of_their_law(cone: str, condim: int, impratio: float) -> None:
    own = pile(cone, condim, impratio)
    compared = part(own)
    assert compared.holds
    assert compared.states == len(states(own))
    assert compared.off is not None
    assert compared.off < 1e-12


def test_all_constraints_are_named() -> None:
    acting = Constraints(pile()).at(states(pile())[0])
    assert acting is not None
    names = dict.fromkeys(constraint.name for constraint in acting.constraints)
    assert [*names] == [
        "equality geared",
        "friction loss of joint shoulder",
        "friction loss of tendon rope",
        "limit of joint shoulder",
        "limit of tendon rope",
        "contact of geom floor and geom crate",
    ]
    assert {c.bound for c in acting.constraints} == {"none", "loss", "one way", "cone"}
    assert acting.constraints[-1].rows.stop == len(acting.f) == len(acting.J)


def test_where_none_acts_nothing_is_compared() -> None:
    own = compiled_text(
        "<mujoco><worldbody><body><joint/><geom size='1'/></body></worldbody></mujoco>"
    )
    compared = part(own)
    assert compared.off is None
    assert lines([compared]) == []


def test_a_second_pass_is_not_compared() -> None:
    (line,) = lines([part(pile(more='noslip_iterations="3"'))])
    assert "not compared: option noslip_iterations" in line


STACK = """\
<mujoco><option cone="{0}" impratio="{1}" timestep=".001"/><default>
<geom friction="{2} {3} {3}" condim="{4}" solimp=".9 {5} .001" solref="{6} 1"/></default><worldbody>
<geom type="plane" size="1 1 1"/>
<body pos="0 0 .05"><freejoint/><geom type="box" size=".1 .1 .05" mass="1"/></body>
<body pos=".01 0 .151"><freejoint/><geom type="box" size=".1 .1 .05" mass="{7}"/></body>
<body pos=".4 0 .0499"><freejoint/><geom size=".05" mass="{7}"/></body></worldbody>
<keyframe><key qvel="{8} 0 0 0 0 0 -{8} 0 0 0 0 0 1 0 0 0 0 0"/></keyframe></mujoco>"""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_forces_of_any_stack_are_the_optimum(seed: int) -> None:
    """Light on heavy, hard and soft: what cancels in them is large, and no alarm is false."""
    random = np.random.default_rng(seed)
    sizes = [10 ** random.uniform(*range_) for range_ in ((-1, 3), (-2, 0.7), (-5, -1))]
    dimension, impedance = random.choice([1, 3, 4, 6]), 1 - 10 ** random.uniform(-6, -1)
    rest = 10 ** random.uniform(-2.5, -1), 10 ** random.uniform(-3, 2), random.uniform(0, 2)
    cone = "elliptic" if seed % 4 else "pyramidal"
    own = compiled_text(STACK.format(cone, *sizes, dimension, impedance, *rest))
    compared = constraints(own, [*own.moving(0.2)][::10])
    assert compared.states
    assert compared.off is not None
    assert compared.off < 1e-13


MISTAKES = {
    "a softness 1e-6 off": ("(d.efc_aref, d.efc_R,", "(d.efc_aref, d.efc_R * (1 + 1e-6),"),
    "a reference 1e-6 off": ("(d.efc_aref,", "(d.efc_aref * (1 + 1e-6),"),
    "a loss of friction 1e-6 off": ("np.array(d.efc_frictionloss[row : row + 1])",
                                    "np.array(d.efc_frictionloss[row : row + 1]) * (1 + 1e-6)"),
    "a cone 1e-6 wider": ("np.array(contact.friction[", "(1 + 1e-6) * np.array(contact.friction["),
    "a limit that is read as an equality": ('("limit of joint", OBJECT.mjOBJ_JOINT, "one way")',
                                '("limit of joint", OBJECT.mjOBJ_JOINT, "none")'),
    "forces without those of constraints": ("np.array(d.qfrc_smooth)", "np.array(d.qfrc_passive)"),
}  # fmt: skip


@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_other_numbers_are_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = otherwise(read, *MISTAKES[mistake])
    monkeypatch.setattr(own_equations, "Constraints", wrong.Constraints)
    assert not part(pile()).holds


@pytest.mark.mutant("forces of a solver that stops where it is told to")
def test_forces_are_solved_for_to_the_last_digit(monkeypatch: pytest.MonkeyPatch) -> None:
    """By few more steps of Newton's: a tolerance of the cost leaves its root of the forces."""
    wrong = otherwise(read, "mujoco.mj_forward(self.exact, d)", "pass")
    wrong.EXACT_SOLVER = {**read.EXACT_SOLVER, "tolerance": 1e-8}
    monkeypatch.setattr(own_equations, "Constraints", wrong.Constraints)
    assert not part(pile()).holds


LINES = {
    "a cone's force that is too small": ("/ (R[0] + rho)", "/ (R[0] + 2 * rho)"),
    "a cone without its tip": ("R[0] * normal + rho * aside <= 0.0", "normal <= 0.0"),
    "a pyramid for a cone": ("np.linalg.norm(y)", "np.abs(y).sum()"),
    "a limit that pulls": ("np.maximum(free, 0.0)", "free"),
    "no Jᵀ f": ("- J.T @ state.f", ""),
}  # fmt: skip


@pytest.mark.mutant("{line}")
@pytest.mark.parametrize("line", LINES)
def test_another_law_is_seen(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(own_equations, "law", otherwise(law, *LINES[line]))
    assert not part(pile()).holds


def test_what_fails_names_its_constraint(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = otherwise(read, *MISTAKES["a loss of friction 1e-6 off"])
    monkeypatch.setattr(own_equations, "Constraints", wrong.Constraints)
    (line,) = lines([part(pile())])
    assert "FAILS: " in line
    assert "in friction loss of" in line
    assert line.endswith("at 4 states")
