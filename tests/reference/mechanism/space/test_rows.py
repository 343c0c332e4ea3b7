"""Rows in space of every kind: they are the rates of their places, and γ is what is left of them.

Both by the complex step, at rates that do not obey the rows.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.reference.formalisms.derivative import along
from textmech.reference.mechanism.constraints.constraint_terms import Lowest
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.start.assembly import assemble

CASES = ["universal_shaft", "spatial_four_bar", "cat_turn", "tilting_disk.circle", "rolling_sphere"]
CASES += ["top_on_floor"]
T = 0.13  # s: laws in time are neither at zero nor at rest


def state(name: str) -> tuple[SpatialMultibody, Any, Any]:
    """The mode at its start, with rates anyhow."""
    case = scenes.SHIPPED[name]
    mode = SpatialMultibody(case.scene, assemble(case))
    q, v = mode.start()
    return mode, q, v + np.random.default_rng(1).normal(size=len(v))


def left_of_gamma(name: str) -> float:
    """(2.15) f_a v̇ = γ is d/dt of f_a v = g: what is left, over the largest."""
    mode, q, v = state(name)

    def excess(t: Any, q: Any) -> Any:
        f_a, g, _ = mode.rows(t, q, v)
        return f_a @ v - g

    gamma = mode.rows(T, q, v)[2]
    slopes = along(excess, (T, q), (1.0, mode.rates(T, q, v)))
    return float(np.max(np.abs(gamma + slopes)) / max(np.max(np.abs(gamma)), 1.0))


def left_of_rates(name: str) -> float:
    """(2.14), (2.15) f_a v − g is the rate of f."""
    mode, q, v = state(name)
    f_a, g, _ = mode.rows(T, q, v)
    held = [part.held or (None,) * part.size for part in mode.permanent]
    rates = (f_a @ v - g)[[at is not None for each in held for at in each]]
    slopes = along(mode.f, (T, q), (1.0, mode.rates(T, q, v)))
    return float(np.max(np.abs(rates - slopes), initial=0.0) / max(np.max(np.abs(rates)), 1.0))


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_rows_are_the_rates_of_places_and_gamma_of_rows(name: str) -> None:
    assert left_of_gamma(name) < 1e-12  # of the largest: algebra, only rounding differs
    assert left_of_rates(name) < 1e-12


@pytest.mark.mutant("slip of a disk's centre for that of its rim")
def test_the_slip_of_a_centre_is_not_that_of_the_rim(monkeypatch: pytest.MonkeyPatch) -> None:
    """The height of the lowest point does not change as the rows of the centre would have it."""
    sound = Lowest.row

    def at_the_centre(*given: Any) -> Row:
        row = sound(*given)
        return Row([(part, F, None) for part, F, _ in row.loads], row.g, row.gamma)

    monkeypatch.setattr(Lowest, "row", at_the_centre)
    assert left_of_rates("tilting_disk.circle") > 1e-3


@pytest.mark.mutant("a row that goes upward is divided by the shadow of its stand-in")
def test_a_height_is_kept_while_the_x_axis_of_its_body_stands_upright() -> None:
    """The blade's long axis is another one, and lies level then."""
    case = scenes.SHIPPED["robot_knife"]
    own = case.scene
    (name, edge), *_ = own.constraints.items()
    scene = replace(own, constraints={name: replace(edge, along=(0.0, 1.0, 0.0))})
    mode = SpatialMultibody(scene, assemble(replace(case, scene=own)))
    q, v = mode.start()
    first = 7 * [*scene.bodies].index(edge.at.body)
    q[first + 3 : first + 7] = np.sqrt([0.5, 0.0, 0.5, 0.0])  # about y, by a right angle
    with np.errstate(all="raise"):
        f_a, _, gamma = mode.rows(T, q, v)
    assert np.isfinite(f_a).all()
    assert np.isfinite(gamma).all()
