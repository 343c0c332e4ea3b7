"""The plane and space: all in which their mechanics differ. The rest of the algebra is one.

A vector has d = 2 or 3 components, a turn s = 1 or 3: in the plane ω and a moment are numbers. The
velocities of a body hold ω in its own axes, which in the plane is the same number.
"""

from collections.abc import Sequence
from typing import Any, Protocol

from ...coverage import Numbered


class Vec(tuple[Any, ...]):
    """A vector of numbers, or of what a tape writes down."""

    __slots__ = ()

    def __add__(self, other: Any) -> "Vec":
        return Vec([a + b for a, b in zip(self, other, strict=True)])

    def __sub__(self, other: Any) -> "Vec":
        return Vec([a - b for a, b in zip(self, other, strict=True)])

    def __neg__(self) -> "Vec":
        return Vec([-a for a in self])

    def __mul__(self, factor: Any) -> "Vec":
        return Vec([a * factor for a in self])

    __rmul__ = __mul__  # type: ignore[assignment]

    def __truediv__(self, divisor: Any) -> "Vec":
        return Vec([a / divisor for a in self])

    def __matmul__(self, other: Sequence[Any]) -> Any:
        """The scalar product."""
        total: Any = 0.0
        for a, b in zip(self, other, strict=True):
            total = total + a * b
        return total


Columns = tuple[Vec, ...]
"""R of (2.1), whose columns are the body axes in ground axes."""


class Frame(Protocol):
    """The plane or space, as formulas ask it."""

    axes: Columns  # of the ground
    turns: int  # s, the components of ω
    attitude: int  # how many coordinates an attitude has

    def rotation(self, maths: Any, e: Sequence[Any]) -> Columns:
        """(2.3) R of the attitude's coordinates."""
        ...

    def cross(self, w: Vec, x: Vec) -> Vec:
        """ω × x, all in ground axes."""
        ...

    def wedge(self, x: Vec, F: Vec) -> Vec:
        """x × F (s,), the moment of a force."""
        ...

    def out(self, R: Columns, w: Vec) -> Vec:
        """ω or a moment (s,) of body axes in ground axes."""
        ...

    def into(self, R: Columns, w: Vec) -> Vec:
        """ω or a moment (s,) of ground axes in body axes."""
        ...


class _Plane:
    axes: Columns = (Vec((1.0, 0.0)), Vec((0.0, 1.0)))
    turns, attitude = 1, 1

    def rotation(self, maths: Any, e: Sequence[Any]) -> Columns:
        cos, sin = maths.cos(e[0]), maths.sin(e[0])
        return Vec((cos, sin)), Vec((-sin, cos))

    def cross(self, w: Vec, x: Vec) -> Vec:
        return Vec((-(w[0] * x[1]), w[0] * x[0]))

    def wedge(self, x: Vec, F: Vec) -> Vec:
        return Vec((x[0] * F[1] - x[1] * F[0],))

    def out(self, R: Columns, w: Vec) -> Vec:
        return w

    def into(self, R: Columns, w: Vec) -> Vec:
        return w


class _Space(Numbered):
    axes: Columns = (Vec((1.0, 0.0, 0.0)), Vec((0.0, 1.0, 0.0)), Vec((0.0, 0.0, 1.0)))
    turns, attitude = 3, 4

    def rotation(self, maths: Any, e: Sequence[Any]) -> Columns:
        """(2.3) R of the quaternion e = (w, x, y, z), whose length plays no part: that of e/|e|."""
        w, x, y, z = e
        each = 2.0 / (w * w + x * x + y * y + z * z)
        wx, wy, wz = (each * (w * a) for a in (x, y, z))
        xx, xy, xz = (each * (x * a) for a in (x, y, z))
        yy, yz, zz = each * (y * y), each * (y * z), each * (z * z)
        return (
            Vec((1.0 - (yy + zz), xy + wz, xz - wy)),
            Vec((xy - wz, 1.0 - (xx + zz), yz + wx)),
            Vec((xz + wy, yz - wx, 1.0 - (xx + yy))),
        )

    def cross(self, w: Vec, x: Vec) -> Vec:
        return Vec(
            (w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0])
        )

    def wedge(self, x: Vec, F: Vec) -> Vec:
        return self.cross(x, F)

    def out(self, R: Columns, w: Vec) -> Vec:
        return carried(R, w)

    def into(self, R: Columns, w: Vec) -> Vec:
        return back(R, w)


PLANE, SPACE = _Plane(), _Space()


def carried(R: Columns, x: Sequence[Any]) -> Vec:
    """R x: a vector of body axes in ground axes."""
    return sum((column * a for column, a in zip(R, x, strict=True)), Vec([0.0] * len(R)))


def back(R: Columns, x: Vec) -> Vec:
    """Rᵀ x: a vector of ground axes in body axes."""
    return Vec([column @ x for column in R])
