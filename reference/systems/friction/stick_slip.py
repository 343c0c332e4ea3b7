"""A block on a line with dry friction, (2.88) with (2.89) or (2.90): it slides, or it sticks."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ...coverage import Numbered, equation
from ...laws.friction import Dry
from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, Vector


class Pull(Protocol):
    """The forces on the block but friction, written three times over."""

    def F_a(self, t: float, x: float) -> float:
        """(2.88) F_a [N], the sum."""
        ...

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) Potential energy [J] of what has one."""
        ...

    def Q4(self, t: Any) -> Any:
        """(2.50) The rest [N]."""
        ...

    def forces(self, t: float, x: float) -> list[float]:
        """(2.23) One by one [N], along x."""
        ...


@dataclass(frozen=True)
class Drawn(Numbered):
    """By a spring c [N/m] whose end moves with u [m/s]."""

    c: float
    u: float

    def F_a(self, t: float, x: float) -> float:
        """(2.98) F_a = −c x + c u t [N]."""
        return -self.c * x + self.c * self.u * t

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c (x₀ − x₁)² [J]."""
        return self.c * (self.u * t - q[0]) ** 2 / 2

    def Q4(self, t: Any) -> Any:
        """(2.50) nothing else [N]."""
        return 0.0

    def forces(self, t: float, x: float) -> list[float]:
        """(2.82) the spring alone [N]."""
        return [self.c * (self.u * t - x)]


@dataclass(frozen=True)
class Line(Mode):
    """A block m [kg] that slides against the friction force F_fr [N], or sticks if that is None.

    falls: how much larger it is at v = 0 [N], with its sign, and the speed v_s [m/s] (2.90). N:
    weight [N] that it lies with on what holds it, by forces of these names, along x and y.
    """

    m: float
    pull: Pull
    F_fr: float | None
    falls: tuple[float, float] | None = None
    N: float = 0.0
    names: tuple[str, str] = ("guide.fx", "guide.fy")

    coordinates = ("x",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"block": Mass(self.m, None)})

    def _slides(self, v: Any) -> Any:
        """(2.90) F_fr = ∓(F + (F_s − F) e^{∓v/v_s}) [N]; 0 where it sticks."""
        if self.falls is None:
            return self.F_fr or 0.0
        more, v_s = self.falls
        return self.F_fr + more * np.exp(math.copysign(1.0, more) * v / v_s)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.88) m v̇ = F_a + F_fr; v̇ = 0 where it sticks [m/s²], (1,)."""
        if self.F_fr is None:
            return np.zeros(1)
        return np.array([(self.pull.F_a(t, float(q[0])) + self._slides(v[0])) / self.m])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.89) F_fr, −F_a where it sticks [N], and what carries the block."""
        stuck = self.F_fr is None
        F_fr = -self.pull.F_a(t, float(q[0])) if stuck else float(self._slides(v[0]))
        return dict(zip(self.names, (F_fr, self.N), strict=True))

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẋ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) of the pull [J]."""
        return self.pull.U(t, q)

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) of the pull and the friction of sliding [N], (1,)."""
        return np.array([self.pull.Q4(t) + self._slides(v[0])])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẋ = 0 where it sticks: λ is the friction force."""
        return np.ones((1, 1)) if self.F_fr is None else np.zeros((0, 1))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, 0)."""
        return {"block": (q[0], 0.0, 0.0, v[0], 0.0, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """The forces of the pull and the friction of sliding."""
        x = float(q[0])
        forces = [*self.pull.forces(t, x), float(self._slides(v[0]))]
        weight = Load("block", (x, 0.0), (0.0, -self.N))
        return [weight, *(Load("block", (x, 0.0), (force, 0.0)) for force in forces)]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The guide: across it always, along it where the block sticks."""
        at = (float(q[0]), 0.0)
        if self.F_fr is None:
            return [Cut(self.names, None, "block", at)]
        return [Cut(self.names[1:], None, "block", at, ((0.0, 1.0),))]


@equation
def modes(m: float, pull: Pull, dry: Dry, v_s: float | None = None) -> Mapping[str, Line]:
    """(2.89) The modes: `backward` with F₋, `forward` with −F₊, and `stuck`.

    (2.90) With v_s [m/s] the friction falls from F_s∓ to F∓.
    """
    forces = {"backward": dry.F_minus, "forward": -dry.F_plus, "stuck": None}
    more = {"backward": dry.Fs_minus - dry.F_minus, "forward": dry.F_plus - dry.Fs_plus}
    falls = {mode: (size, v_s) for mode, size in more.items()} if v_s else {}
    return {mode: Line(m, pull, F_fr, falls.get(mode)) for mode, F_fr in forces.items()}


@equation
def guards(
    pull: Pull, dry: Dry, mode: str, *, Delta: float = 0.0, keeps_v: bool = False
) -> tuple[Guard, ...]:
    """(2.89) `slips` where F_a leaves −F_s₋ ≤ F_a ≤ F_s₊, `stops` where v = 0 finds it inside.

    v = 0 with F_a outside is a mere turning point. With Δ > 0 it is (2.91): |v| ≤ Δ for v = 0, and
    a body that sticks keeps the v it came with, or is set to rest.
    """

    def F_a(t: float, q: Array) -> float:
        return pull.F_a(t, float(q[0]))

    def to(mode: str) -> Callable[[float, Array, Array], tuple[str, Array, Array]]:
        return lambda t, q, v: (mode, q, v if keeps_v else np.zeros(1))

    if mode == "stuck":
        return (
            Guard("slips", lambda t, q, v: F_a(t, q) + dry.Fs_minus, to("backward")),
            Guard("slips", lambda t, q, v: dry.Fs_plus - F_a(t, q), to("forward")),
        )
    sign, other = (1.0, "backward") if mode == "forward" else (-1.0, "forward")
    against = dry.Fs_minus if mode == "forward" else dry.Fs_plus

    def halts(t: float, q: Array, v: Array) -> float:
        force = F_a(t, q)
        return max(sign * float(v[0]) - Delta, -dry.Fs_minus - force, force - dry.Fs_plus)

    def turns(t: float, q: Array, v: Array) -> float:
        return max(sign * float(v[0]) - Delta, sign * F_a(t, q) + against)

    return Guard("stops", halts, to("stuck")), Guard(None, turns, to(other))


@equation
def possible(system: Mode, dry: Dry, t: float, q: Array, v: Array) -> str | None:
    """(2.89) Why `stuck` cannot be: −F_s₋ ≤ F_a ≤ F_s₊ is broken."""
    F_fr, _ = system.reactions(t, q, v).values()
    F_a = -F_fr
    if dry.sticks(F_a):
        return None
    return f"sticking against {F_a:.6g} N, allowed are {-dry.Fs_minus:.6g} to {dry.Fs_plus:.6g} N"
