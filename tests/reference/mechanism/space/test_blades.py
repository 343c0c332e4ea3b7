"""The rows of a blade in space: differentiated once more, and with mistakes planted."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.reference.formalisms.derivative import along
from textmech.reference.mechanism.constraints.constraint_terms import Heading
from textmech.reference.mechanism.kinematics.kinematics import Direction
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.start.assembly import assemble
from textmech.reference.systems import written

KNIFE = scenes.SHIPPED["robot_knife"]
OWN = [-2, -1]  # the rows of the blade come last: to the side, and upward


def generated() -> SpatialMultibody:
    """The only mode of the scene's mechanism."""
    scene = KNIFE.scene
    return SpatialMultibody(scene, assemble(KNIFE))


def worst() -> float:
    """(2.15) f_a v̇ = γ is d/dt of f_a v = g, at the start and rates that do not obey f_a v = g."""
    mode = generated()
    q, v = mode.start()
    v = v + np.random.default_rng(1).normal(size=len(v))
    _, _, gamma = mode.rows(0.0, q, v)
    rates = mode.rates(0.0, q, v)
    slopes = along(lambda q: mode.rows(0.0, q, v)[0][OWN] @ v, (q,), (rates,))
    return float(abs(gamma[OWN] + slopes).max() / abs(gamma[OWN]).max())


def reactions() -> float:
    """The blade's forces, against those of the system that is written by hand [N]."""
    system = written("robot_knife", KNIFE.parameters)
    mode = generated()
    own, q, v = system.start()
    held = system.modes[own].reactions(0.0, q, v)
    place = mode.place(system.modes[own].poses(0.0, q, v))
    found = mode.reactions(0.0, *place)
    return max(abs(found[name] - held[name]) for name in ("blade.force", "blade.normal"))


def test_rows_are_differentiated_rightly() -> None:
    assert worst() < 1e-12  # of the largest: algebra, only rounding differs


def test_forces_are_those_of_the_system_written_by_hand() -> None:
    assert reactions() < 1e-11  # N, of 200 N in the joints


left = Heading._left


def backward(self: Any, k: Any, ends: Any) -> Direction:
    """Its rate with the wrong sign."""
    c = left(self, k, ends)
    return Direction(c.u, -c.u_dot)


def carried_along(self: Any, k: Any, ends: Any) -> Direction:
    """u as if it were fixed in the body, so that it tilts with it."""
    c = left(self, k, ends)
    return Direction(c.u, k.frame.cross(ends[self.p].part.spin, c.u))


def to_the_right(self: Any, k: Any, ends: Any) -> Direction:
    """To the right, for to the left."""
    c = left(self, k, ends)
    return Direction(-c.u, -c.u_dot)


@pytest.mark.mutant("direction of a blade in space: {wrong}")
@pytest.mark.parametrize(
    ("wrong", "law"), [(backward, worst), (carried_along, worst), (to_the_right, reactions)]
)
def test_a_planted_mistake_is_seen(
    wrong: Callable[..., Any], law: Callable[[], float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Heading, "_left", wrong)
    assert law() > 1e-3
