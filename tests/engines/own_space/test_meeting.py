"""How far convex outlines are apart: corner to side, and how deep where they overlap."""

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.engines.own_space import meeting

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
POINT, LINE = [(0.0, 0.0)], [(-1.0, 0.0), (1.0, 0.0)]
APART = [
    (POINT, POINT, (3.0, 4.0), 5.0),
    (POINT, LINE, (0.0, 2.0), 2.0),
    (POINT, LINE, (4.0, 4.0), 5.0),  # beyond its end
    (LINE, LINE, (5.0, 0.0), 3.0),  # one behind the other
    (LINE, LINE, (0.0, 0.5), 0.5),
    (SQUARE, SQUARE, (3.0, 0.5), 2.0),
    (SQUARE, SQUARE, (4.0, 5.0), 5.0),  # corner to corner
    (SQUARE, SQUARE, (0.7, 0.1), -0.3),
    (SQUARE, POINT, (0.5, 0.2), -0.2),
    (SQUARE, LINE, (0.5, 1.5), 0.5),
    (SQUARE, LINE, (0.5, 0.9), -0.1),
]


@pytest.mark.parametrize(("one", "other", "shift", "gap"), APART)
def test_outlines_are_as_far_apart_as_drawn(
    one: list[tuple[float, float]],
    other: list[tuple[float, float]],
    shift: tuple[float, float],
    gap: float,
) -> None:
    """However both are turned, and whichever comes first."""
    these, those = np.array(one), np.array(other) + shift
    turns = np.linspace(0.0, 6.0, 7)
    cos, sin = np.cos(turns), np.sin(turns)
    turn = np.array([[cos, sin], [-sin, cos]])

    def turned(corners: np.ndarray) -> np.ndarray:
        return np.einsum("kd,den->nke", corners, turn)

    assert meeting.gaps(turned(these), turned(those)) == pytest.approx(gap)
    assert meeting.gaps(turned(those), turned(these)) == pytest.approx(gap)


def test_lines_that_cross_overlap() -> None:
    across = np.array([[(0.2, -1.0), (0.2, 1.0)]])
    assert meeting.gaps(np.array([LINE]), across)[0] < -0.5


@pytest.mark.mutant("outlines that are apart only by their sides, and not by their corners")
def test_a_corner_that_is_forgotten_is_seen() -> None:
    changed = otherwise(meeting, "np.where(before >= 0.0, distance, before)", "before")
    corner = changed.gaps(np.array([SQUARE]), np.array([SQUARE]) + np.array([4.0, 5.0]))
    assert corner[0] != pytest.approx(5.0)
