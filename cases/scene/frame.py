"""The frame of a scene: a plane or space, and what the columns of a body's states mean there.

Plane: x right, y up, angles counter-clockwise. Space: z up; an attitude is a unit quaternion
(w, x, y, z) that turns body axes into ground axes, and ω stands in body axes.
"""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, eq=False)
class Frame:
    """The axes of the ground, and where place, attitude, velocity and ω stand in a state."""

    axes: tuple[str, ...]
    place: slice
    attitude: slice
    velocity: slice
    spin: slice

    @property
    def dimension(self) -> int:
        """Number of coordinates of a place: 2 or 3."""
        return len(self.axes)

    @property
    def width(self) -> int:
        """The number of columns of a body's states."""
        return self.spin.stop

    def alike(self, unit: str) -> Sequence[int]:
        """The columns of a unit; an attitude in space has none of its own."""
        columns = {"m": self.place, "m/s": self.velocity, "rad/s": self.spin}
        if self.dimension == 2:
            columns["rad"] = self.attitude
        return range(self.width)[columns[unit]] if unit in columns else ()


PLANE = Frame(("x", "y"), slice(0, 2), slice(2, 3), slice(3, 5), slice(5, 6))
SPACE = Frame(("x", "y", "z"), slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13))


def frame_of(width: int) -> Frame:
    """The frame in which a body's states have so many columns."""
    return {frame.width: frame for frame in (PLANE, SPACE)}[width]
