"""Two ways to one number: what `show` prints as MJCF, read as a user's model, and the reference."""

from functools import cache

import numpy as np
import pytest
from given.scenes import SHIPPED, solved

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.trajectory import Array
from textmech.engines.own_model.drawing import states
from textmech.engines.own_model.equations import Equations, Fineness
from textmech.engines.own_model.model import OwnModel, compiled_text
from textmech.reports.front.show.script import script
from textmech.reports.runs.selection import choose_engines

FINE = Fineness(1e-12, 1e-12, 32)  # a leg that lifts off has a kink, which 1e-10 leaves 5e-9 off
WITHIN = 1e-9  # rad, m
PARTS = 4


def beyond(text: str, own: OwnModel) -> str:
    """Returns why the file alone is not the textbook's scene, by what it has; or nothing."""
    m = own.model
    reasons = {
        "a callback": "set_mjcb" in text,
        "a loop": m.neq > 0,
        "contacts": m.npair > 0 or bool(np.any(m.geom_contype)),
        "limits": bool(np.any(m.jnt_limited) or np.any(m.tendon_limited)),
        "dry friction": bool(np.any(m.dof_frictionloss) or np.any(m.tendon_frictionloss)),
    }
    return next((reason for reason, holds in reasons.items() if holds), "")


@cache
def shown() -> dict[str, tuple[OwnModel, str]]:
    """Each case's file as MuJoCo compiles it, and why it is not to be compared."""
    engine = next(e for e in choose_engines([], []) if (e.name, e.setting) == ("mujoco", "shipped"))
    models: dict[str, tuple[OwnModel, str]] = {}
    for name, case in SHIPPED.items():
        try:
            text = script(case, engine)
        except CaseError:
            continue  # what MuJoCo has not
        own = compiled_text(text, name)
        models[name] = own, beyond(text, own)
    return models


def apart(case: Case, own: OwnModel, y: Array) -> float:
    """How far bodies are from the certified reference [m, rad]; a particle has no attitude."""
    ours, gaps = states(own, y), list[float]()
    for name, rows in solved(case.name).trajectory.states.items():
        body, mine = case.scene.bodies[name], ours[name]
        plane = rows.shape[1] == 6
        wide = 2 if plane else 3
        gaps.append(float(np.abs(rows[:, :wide] - mine[:, :wide]).max()))
        if not np.any(body.inertia):
            continue
        half = rows[:, 2] / 2 if plane else np.zeros(len(rows))
        turned = np.array([np.cos(half), 0 * half, 0 * half, np.sin(half)]).T
        attitude = turned if plane else rows[:, 3:7]
        sign = np.sign((attitude * mine[:, 3:7]).sum(axis=1))[:, None]
        gaps.append(2 * float(np.abs(attitude * sign - mine[:, 3:7]).max()))
    return max(gaps)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(PARTS))
def test_the_limit_of_a_shown_file_is_the_certified_reference(part: int) -> None:
    """Of all without loops, contacts, limits, dry friction and callbacks."""
    gaps: dict[str, float] = {}
    for name, (own, why) in [*shown().items()][part::PARTS]:
        if not why:
            y = Equations(own, own.start()).followed(SHIPPED[name].times, FINE)
            gaps[name] = apart(SHIPPED[name], own, y)
    assert len(gaps) > 5
    assert {name: gap for name, gap in gaps.items() if not gap <= WITHIN} == {}


@pytest.mark.slow
def test_what_is_not_compared_has_what_the_rule_names() -> None:
    reasons = {name: why for name, (_, why) in shown().items()}
    assert {*reasons.values()} == {
        "", "a callback", "a loop", "contacts", "limits", "dry friction",
    }  # fmt: skip
    assert reasons["double_pendulum"] == reasons["torque_free.thrown"] == ""
    assert reasons["four_bar"] == "a loop"
    assert reasons["rolling_sphere"] == "contacts"
    assert reasons["pushed_cart.step"] == "a callback"


@pytest.mark.slow
@pytest.mark.mutant("a shown file with an inertia 1e-6 off")
def test_another_file_is_seen() -> None:
    own, _ = shown()["double_pendulum"]
    case, model = SHIPPED["double_pendulum"], own.model
    model.body_inertia[2] *= 1 + 1e-6
    y = Equations(own, own.start()).followed(case.times, FINE)
    model.body_inertia[2] /= 1 + 1e-6
    assert apart(case, own, y) > 10 * WITHIN
