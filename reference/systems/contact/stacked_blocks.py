"""Block on a block: the lower one is pulled ever harder, or the upper one is thrown on it.

q = (x₁, x₂), lower and upper. F₁ is the floor's friction on the lower block, F₂ the lower one's on
the upper; each stands on two corners, N_l and N_r, of which only the normal forces are determined.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²

Slips = tuple[int, int]
"""Which way the lower block slips on the floor, and the upper on the lower: 0, it sticks."""
NAMES: dict[Slips, str] = {
    (0, 0): "rests", (1, 0): "together", (1, -1): "left behind", (1, 1): "drags", (0, 1): "on top",
}  # fmt: skip


@dataclass(frozen=True)
class _Blocks(Mode):
    """Both on the floor; what sticks is held by a row, what slips is braked."""

    m1: float
    m2: float
    w1: float
    h1: float
    w2: float
    h2: float
    mu1: float
    mu2: float
    b: float
    s: Slips

    coordinates = ("x1", "x2")

    def __post_init__(self) -> None:
        sizes = {"lower": (self.m1, self.w1, self.h1), "upper": (self.m2, self.w2, self.h2)}
        masses = {name: Mass(m, m * (w**2 + h**2) / 12) for name, (m, w, h) in sizes.items()}
        object.__setattr__(self, "masses", masses)
        corners = ("floor_left", "floor_right"), ("left", "right")
        shared = [name for s, two in zip(self.s, corners, strict=True) if not s for name in two]
        object.__setattr__(self, "undetermined", tuple(f"{name}.tangent" for name in shared))

    def _sliding(self) -> tuple[float, float]:
        """(2.87) F₁ = −μ₁ (m₁ + m₂) g and F₂ = −μ₂ m₂ g against the slips, 0 where it sticks."""
        F1 = -self.s[0] * self.mu1 * (self.m1 + self.m2) * G
        return F1, -self.s[1] * self.mu2 * self.m2 * G

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23) m₁ ẍ₁ = b t + F₁ − F₂, m₂ ẍ₂ = F₂; both (m₁ + m₂) ẍ = b t + F₁ [m/s²], (2,)."""
        F1, F2 = self._sliding()
        if self.s[1] == 0:
            a = (self.b * t + F1) / (self.m1 + self.m2) if self.s[0] else 0.0
            return np.array([a, a])
        lower = (self.b * t + F1 - F2) / self.m1 if self.s[0] else 0.0
        return np.array([lower, F2 / self.m2])

    def friction(self, t: float, q: Array, v: Array) -> tuple[float, float]:
        """F₁ and F₂ [N]: where it sticks F₂ = m₂ ẍ₂ and F₁ = m₁ ẍ₁ − b t + F₂."""
        a1, a2 = self.accelerations(t, q, v).tolist()
        F1, F2 = self._sliding()
        F2 = F2 if self.s[1] else self.m2 * a2
        return F1 if self.s[0] else self.m1 * a1 - self.b * t + F2, F2

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.27) N_l − N_r = F₂ h₂/w₂ above; on the floor the moment of all that acts on top of the
        lower block too, ½ w₁ (N_l − N_r) = ½ h₁ (F₁ + F₂) + ½ h₂ F₂ − m₂ g (x₂ − x₁) [N].
        """
        F1, F2 = self.friction(t, q, v)
        above, below = self.m2 * G / 2, (self.m1 + self.m2) * G / 2
        tips = F2 * self.h2 / (2 * self.w2)
        moment = (self.h1 * (F1 + F2) + self.h2 * F2) / 2 - self.m2 * G * float(q[1] - q[0])
        normals = {
            "left.normal": above + tips, "right.normal": above - tips,
            "floor_left.normal": below + moment / self.w1,
            "floor_right.normal": below - moment / self.w1,
        }  # fmt: skip
        sticks = {"floor.tangent": F1} if self.s[0] == 0 else {}
        return normals | sticks | ({"upper.tangent": F2} if self.s[1] == 0 else {})

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m₁ ẋ₁² + ½ m₂ ẋ₂² [J]."""
        return (self.m1 * v[0] ** 2 + self.m2 * v[1] ** 2) / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = (b t + F₁ − F₂, F₂) of the friction that slides [N]."""
        F1, F2 = self._sliding()
        return np.array([self.b * t + F1 - F2, F2 + 0.0 * t])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẋ₁ = 0 and ẋ₂ − ẋ₁ = 0, each where it sticks: λ is the friction."""
        rows = [[1.0, 0.0]] if self.s[0] == 0 else []
        return np.array([*rows, *([[-1.0, 1.0]] if self.s[1] == 0 else [])]).reshape(-1, 2)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x₁, h₁/2), R₂ = (x₂, h₁ + h₂/2)."""
        return {
            "lower": (q[0], self.h1 / 2, 0.0, v[0], 0.0, 0.0),
            "upper": (q[1], self.h1 + self.h2 / 2, 0.0, v[1], 0.0, 0.0),
        }

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights and push at the middles, and the friction that slides where it does."""
        (x1, x2), (F1, F2) = map(float, q), self._sliding()
        return [
            Load("lower", (x1, self.h1 / 2), (self.b * t, -self.m1 * G)),
            Load("upper", (x2, self.h1 + self.h2 / 2), (0.0, -self.m2 * G)),
            Load("lower", (x1, 0.0), (F1, 0.0)),
            Load("lower", (x2, self.h1), (-F2, 0.0)),
            Load("upper", (x2, self.h1), (F2, 0.0)),
        ]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The corners, and where blocks stick the sum of what holds them along."""
        (x1, x2), up, along = map(float, q), ((0.0, 1.0),), ((1.0, 0.0),)
        corners = [
            Cut(("floor_left.normal",), None, "lower", (x1 - self.w1 / 2, 0.0), up),
            Cut(("floor_right.normal",), None, "lower", (x1 + self.w1 / 2, 0.0), up),
            Cut(("left.normal",), "lower", "upper", (x2 - self.w2 / 2, self.h1), up),
            Cut(("right.normal",), "lower", "upper", (x2 + self.w2 / 2, self.h1), up),
        ]
        floor = Cut(("floor.tangent",), None, "lower", (x1, 0.0), along)
        upper = Cut(("upper.tangent",), "lower", "upper", (x2, self.h1), along)
        return [*corners, *([] if self.s[0] else [floor]), *([] if self.s[1] else [upper])]


Then = Callable[[float, Array, Array], tuple[str, Array, Array]]


@dataclass(frozen=True)
class StackedBlocks(System):
    """Masses m [kg], sizes w, h [m] and friction mu [1] of the lower block (1) and the upper (2).

    Pulled from rest with b t, b in N/s, or thrown on it with v0 [m/s]; the upper begins at x0 [m].
    """

    m1: float
    m2: float
    w1: float
    h1: float
    w2: float
    h2: float
    mu1: float
    mu2: float
    b: float
    v0: float
    x0: float

    def __post_init__(self) -> None:
        if min(self.b, self.v0) != 0.0 or not max(self.b, self.v0) > 0.0:
            raise ValueError(
                f"it is pulled with b > 0 or thrown with v0 > 0, not b = {self.b}, v0 = {self.v0}"
            )
        sizes = (self.m1, self.m2, self.w1, self.h1, self.w2, self.h2, self.mu1, self.mu2, self.b)
        object.__setattr__(self, "modes", {n: _Blocks(*sizes, s) for s, n in NAMES.items()})

    def start(self) -> tuple[str, Array, Array]:
        """At rest, or thrown: the lower one is dragged if μ₂ m₂ > μ₁ (m₁ + m₂)."""
        thrown = "drags" if self.mu2 * self.m2 > self.mu1 * (self.m1 + self.m2) else "on top"
        mode = thrown if self.v0 else "rests"
        return mode, np.array([0.0, self.x0]), np.array([0.0, self.v0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """F₁ or F₂ at its bound where it sticks, or no slip any more."""
        if mode == "rests":
            slides = lambda t, q, v: self.mu1 * (self.m1 + self.m2) * G - self.b * t  # noqa: E731
            return (Guard("slides", slides, _next("together")),) if self.b else ()
        if mode == "together":
            slips = Guard("slips", self._margin, _next("left behind"))
            stops = Guard("stops", lambda t, q, v: float(v[0]), _next("rests", 0.0))
            return (slips if self.b else stops,)
        if mode in ("drags", "on top"):
            then = self._joined if mode == "drags" else _next("rests", 0.0)
            return (Guard("joins", lambda t, q, v: float(v[1] - v[0]), then),)
        return ()

    def _margin(self, t: float, q: Array, v: Array) -> float:
        """(2.89) μ₂ m₂ g − F₂ [N]."""
        together = self.modes["together"]
        assert isinstance(together, _Blocks)
        return self.mu2 * self.m2 * G - together.friction(t, q, v)[1]

    def _joined(self, t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
        """One velocity from now on, that of the common momentum."""
        u = (self.m1 * v[0] + self.m2 * v[1]) / (self.m1 + self.m2)
        return "together", q, np.array([u, u])

    def _phases(self) -> list[tuple[float, str, tuple[float, ...]]]:
        """(2.89) When each mode begins, by which event; ẍ₁, ẍ₂ and their slopes from then on.

        b t = μ₁ M g and b t = (μ₁ + μ₂) M g, M = m₁ + m₂; or where v₀ − μ₂ g t meets the velocity
        of the lower block, and that of both zero.
        """
        M, slow, fast, rests = self.m1 + self.m2, self.mu1 * G, self.mu2 * G, (0.0,) * 4
        if self.b:
            j, apart = self.b / M, (fast, fast, self.b / self.m1, 0.0)
            later = [(slow / j, "slides", (0.0, 0.0, j, j)), ((slow + fast) / j, "slips", apart)]
            return [(0.0, "", rests), *later]
        lower = max(0.0, (fast * self.m2 - slow * M) / self.m1)
        joins, both = self.v0 / (fast + lower), (-slow, -slow, 0.0, 0.0)
        first = (0.0, "", (lower, -fast, 0.0, 0.0))
        if not lower:
            return [first, (joins, "joins", rests)]
        return [first, (joins, "joins", both), (joins * (1 + lower / slow), "stops", rests)]

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """x and v of each phase, ẍ = a + j (t − t_k): a cubic from where the phase before ends."""
        q, v = np.array([0.0, self.x0]), np.array([0.0, self.v0])
        phases = self._phases()
        for k, (begins, _, (*a, j1, j2)) in enumerate(phases):
            ends = phases[k + 1][0] if k + 1 < len(phases) else t
            tau, a, j = min(t, ends) - begins, np.array(a), np.array([j1, j2])
            if tau <= 0.0 and k:
                break
            q, v = q + v * tau + a * tau**2 / 2 + j * tau**3 / 6, v + a * tau + j * tau**2 / 2
        return q, v

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """The beginnings of its phases."""
        return [(name, t) for t, name, _ in self._phases()[1:] if t <= until]

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) |F| ≤ μ N where it sticks, all corners pressed, one block on the other."""
        blocks = self.modes[mode]
        assert isinstance(blocks, _Blocks)
        if abs(float(q[1] - q[0])) > (self.w1 - self.w2) / 2:
            return "a corner of the upper block is past the end of the lower one"
        forces = blocks.reactions(t, q, v)
        if pulls := [name for name in forces if name.endswith("normal") and forces[name] < 0]:
            return f"{pulls[0]} would have to pull: a block tips"
        F1, F2 = blocks.friction(t, q, v)
        bounds = self.mu1 * (self.m1 + self.m2) * G, self.mu2 * self.m2 * G
        for force, bound in zip((abs(F1), abs(F2)), bounds, strict=True):
            if force > (1 + 1e-12) * bound:
                return f"sticking takes {force:.6g} N, there is {bound:.6g}"
        return None


def _next(mode: str, rate: float | None = None) -> Then:
    """The next mode, with all at the same rate where it is given."""
    return lambda t, q, v: (mode, q, v if rate is None else np.full(2, rate))
