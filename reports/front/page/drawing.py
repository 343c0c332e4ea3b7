"""A motion as the page draws it: its lines, its poses, and what differs from it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....cases.scene.frame import SPACE, Frame
from ....cases.trajectory import Array
from . import poses
from .sketch import Sketch

LIMIT = "limit"  # what the motion of a model is held against, which is no reference
POINTS = 128  # of a curve at most
SEEN = 1 / 400  # of what the motion reaches: nearer than that, two drawings are one

Motion = dict[str, Any]


@dataclass(frozen=True)
class Drawing:
    """The lines of a motion's bodies, and how far it reaches [m].

    reaches: by body how far [m] it is drawn from its place.
    """

    frame: Frame
    size: float
    sketch: Sketch
    reaches: Mapping[str, float]

    def poses(self, times: Array, moves: poses.Moves, close: float) -> poses.Poses:
        """Returns the poses that are needed to draw a motion to that part of its size."""
        return poses.drawn(self.frame, self.reaches, times, moves, close * self.size)

    def covers(self, own: Mapping[str, Array], right: Mapping[str, Array]) -> bool:
        """Whether no place is off by more than is seen, and no attitude by as much at that size."""
        place, attitude = self.frame.place, self.frame.attitude
        for body, rows in own.items():
            off, other = rows - right[body], rows + right[body]
            turns = np.abs(off[:, attitude])
            if self.frame is SPACE:  # a quaternion and its opposite are one attitude
                turns = np.minimum(turns.max(axis=1), np.abs(other[:, attitude]).max(axis=1))
            if np.max(np.abs(off[:, place])) > SEEN * self.size or np.max(turns) > SEEN:
                return False
        return True

    def motion(
        self,
        against: str,
        right: Mapping[str, Any],
        ghosts: Mapping[str, Mapping[str, Any] | None],
        curves: Mapping[str, Any],
        trail: list[list[float]] | None = None,
    ) -> Motion:
        """Returns all that the page draws of a motion.

        against: what the right one is called. ghosts: by way their poses, None of one that the
        right one covers, nothing of one that is lost.
        """
        return {
            "against": against,
            "axes": self.frame.dimension,
            "size": float(f"{self.size:.4g}"),
            "sketch": self.sketch,
            **right,
            "trail": trail,
            "ghosts": {name: ghost for name, ghost in ghosts.items() if ghost},
            "covered": sorted(name for name, ghost in ghosts.items() if ghost is None),
            "curves": curves,
        }


def thinned(count: int, most: int = POINTS) -> Any:
    """Which of so many samples are drawn: evenly, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
