"""Compass walker down a slope: two equal legs pinned at a hip with a mass, on points for feet.

q = (x, a, b): the place of the standing foot, and the angles of the left and the right leg, from
foot to hip, against the normal of the slope, clockwise: a leg that leans forward, down the slope,
has a > 0. Midway a swinging leg passes through the floor; it strikes in front, where a + b = 0, and
the foot behind leaves without impulse. In the figure's place (2.12) the legs are slender bars.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²
LEGS = ("left", "right")
PASSES = 1e-3  # rad: nearer to each other, the legs are passing, and the floor is not met
LIFTED = math.pi / PASSES  # enough for any angles: behind the other, no foot strikes
APART = 1e-6  # rad: two feet on the floor lean alike, but for rounding


@dataclass(frozen=True)
class _Stance(Mode):
    """On the left leg (k = 0) or the right one (k = 1); s and w are the standing and swinging."""

    walker: "CompassWalker"
    k: int

    coordinates = ("x", "a", "b")

    def __post_init__(self) -> None:
        leg = Mass(self.walker.m, self.walker.J)
        masses = {"left": leg, "right": leg, "hip": Mass(self.walker.M, None)}
        object.__setattr__(self, "masses", masses)

    def _legs(self, q: Any) -> tuple[Any, Any]:
        """The standing and the swinging leg's entry of q or v."""
        return q[1 + self.k], q[2 - self.k]

    def _entries(self, x: Any, s: Any, w: Any) -> list[Any]:
        """The entries of q or v in their order, from those of the standing and swinging leg."""
        return [x, s, w] if self.k == 0 else [x, w, s]

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) A s̈ − C ẅ = N sin(s − w) ẇ² + g (M l + m (l − c) + m l) sin(s + γ),
        B ẅ − C s̈ = −N sin(s − w) ṡ² − m g c sin(w + γ), N = m c l, C = N cos(s − w); (3,).

        A = (M + m) l² + m (l − c)² + J, B = m c² + J: moments about the foot and about the hip.
        """
        p, (s, w), (s_dot, w_dot) = self.walker, self._legs(q.tolist()), self._legs(v.tolist())
        N, across = p.m * p.c * p.l, math.sin(s - w)
        A, B, C = p.about_foot, p.about_hip, N * math.cos(s - w)
        lever = p.M * p.l + p.m * (p.l - p.c) + p.m * p.l
        f_s = N * across * w_dot**2 + G * lever * math.sin(s + p.gamma)
        f_w = -N * across * s_dot**2 - p.m * G * p.c * math.sin(w + p.gamma)
        D = A * B - C * C
        return np.array(self._entries(0.0, (B * f_s + C * f_w) / D, (A * f_w + C * f_s) / D))

    def _places(self, q: Vector, v: Vector) -> tuple[tuple[Any, ...], ...]:
        """x, y, ẋ, ẏ of the standing leg's centre, the swinging one's, and the hip."""
        p, (s, w), (s_dot, w_dot) = self.walker, self._legs(q), self._legs(v)
        hip = self._along(p.l, s, s_dot, (q[0], 0.0, v[0], 0.0))
        stands = self._along(p.l - p.c, s, s_dot, (q[0], 0.0, v[0], 0.0))
        return stands, self._along(-p.c, w, w_dot, hip), hip

    @staticmethod
    def _along(r: float, a: Any, a_dot: Any, start: tuple[Any, ...]) -> tuple[Any, ...]:
        """(2.6) r up a leg from a point that moves."""
        x, y, x_dot, y_dot = start
        sin, cos = np.sin(a), np.cos(a)
        return x + r * sin, y + r * cos, x_dot + r * a_dot * cos, y_dot - r * a_dot * sin

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ J (ȧ² + ḃ²) [J]."""
        p, places = self.walker, self._places(q, v)
        masses = (p.m, p.m, p.M)
        moving = sum(m * (u * u + w * w) for m, (_, _, u, w) in zip(masses, places, strict=True))
        return moving / 2 + p.J * (v[1] ** 2 + v[2] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = Σ m g (y cos γ − x sin γ) [J]."""
        p, places = self.walker, self._places(q, q)  # of which the rates are not used
        sin, cos = math.sin(p.gamma), math.cos(p.gamma)
        masses = (p.m, p.m, p.M)
        high = (m * (y * cos - x * sin) for m, (x, y, *_) in zip(masses, places, strict=True))
        return G * sum(high)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẋ = 0: the foot stands; λ is its friction."""
        return np.array([[1.0, 0.0, 0.0]])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) m r̈_c = m g + F [N]: of the floor on the foot that stands, of each leg on the hip.

        A metre further up a leg a point has in addition (ä cos a − ȧ² sin a, −ä sin a − ȧ² cos a).
        """
        p, legs = self.walker, (self._legs(q.tolist()), self._legs(v.tolist()))
        rates = self._legs(self.accelerations(t, q, v).tolist())
        up = [
            np.array([cos * a_ddot - sin * a_dot**2, -sin * a_ddot - cos * a_dot**2])
            for a, a_dot, a_ddot in zip(*legs, rates, strict=True)
            for sin, cos in [(math.sin(a), math.cos(a))]
        ]
        g = G * np.array([math.sin(p.gamma), -math.cos(p.gamma)])
        stands, hip = (p.l - p.c) * up[0], p.l * up[0]
        swinging = -p.m * (hip - p.c * up[1] - g)  # the force of the swinging leg on the hip
        standing = p.M * (hip - g) - swinging
        floor = p.m * (stands - g) + standing
        forces = {f"{LEGS[self.k]}_foot": floor}
        names = ("tangent", "normal"), ("fx", "fy")
        forces |= {f"{LEGS[self.k]}_hip": standing, f"{LEGS[1 - self.k]}_hip": swinging}
        return {
            f"{part}.{name}": float(x)
            for part, force in forces.items()
            for name, x in zip(names["hip" in part], force, strict=True)
        }

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k; a leg's angle is that of a bar from foot to hip: 90° − a."""
        stands, swings, hip = self._places(q, v)
        both = (stands, swings) if self.k == 0 else (swings, stands)
        poses: dict[str, Pose] = {}
        for name, (x, y, x_dot, y_dot), a, a_dot in zip(LEGS, both, q[1:], v[1:], strict=True):
            poses[name] = (x, y, math.pi / 2 - a, x_dot, y_dot, -a_dot)
        x, y, x_dot, y_dot = hip
        return {**poses, "hip": (x, y, 0.0, x_dot, y_dot, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights, in the axes of the slope."""
        loads = []
        for name, (x, y, *_) in self.poses(t, q, v).items():
            m = self.masses[name].m
            down = (m * G * math.sin(self.walker.gamma), -m * G * math.cos(self.walker.gamma))
            loads.append(Load(name, (float(x), float(y)), down))
        return loads

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The foot that stands, and the hip on either leg."""
        *_, (x, y, *_) = self._places(q, q)
        hip = (float(x), float(y))
        pins = [Cut((f"{leg}_hip.fx", f"{leg}_hip.fy"), leg, "hip", hip) for leg in LEGS]
        leg = LEGS[self.k]
        names = (f"{leg}_foot.tangent", f"{leg}_foot.normal")
        foot = Cut(names, None, leg, (float(q[0]), 0.0))
        return [foot, *pins]


@dataclass(frozen=True)
class CompassWalker(System):
    """M [kg] at the hip; legs that are slender bars of m [kg], l [m]; slope gamma [rad]; friction.

    It starts on the left leg. left0 and right0 [rad] are the angles of the legs from foot to hip,
    counter-clockwise from down the slope; w0 and u0 [rad/s] turn them forward.
    """

    M: float
    m: float
    l: float
    gamma: float
    mu: float
    left0: float
    right0: float
    w0: float
    u0: float

    def __post_init__(self) -> None:
        modes = {f"{leg} stands": _Stance(self, k) for k, leg in enumerate(LEGS)}
        object.__setattr__(self, "modes", modes)

    @property
    def c(self) -> float:
        """l/2 [m]: how far below the hip a leg has its centre."""
        return self.l / 2

    @property
    def J(self) -> float:
        """(2.32) m l²/12 [kg m²] about the leg's centre (Exercise 2.3)."""
        return self.m * self.l**2 / 12

    @property
    def about_foot(self) -> float:
        """(2.35) A = (M + m) l² + m (l − c)² + J [kg m²]: the swinging leg counts at the hip."""
        return (self.M + self.m) * self.l**2 + self.m * (self.l - self.c) ** 2 + self.J

    @property
    def about_hip(self) -> float:
        """(2.35) B = m c² + J [kg m²]."""
        return self.m * self.c**2 + self.J

    def start(self) -> tuple[str, Array, Array]:
        """x = 0, a = 90° − left0, b = 90° − right0."""
        q = np.array([0.0, math.pi / 2 - self.left0, math.pi / 2 - self.right0])
        return "left stands", q, np.array([0.0, self.w0, self.u0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """`strikes` in front, where a + b rises through 0; behind and midway nothing does."""
        k = LEGS.index(mode.split()[0])

        def above(t: float, q: Array, v: Array) -> float:
            s, w = q[1 + k], q[2 - k]
            return float(LIFTED * max(0.0, PASSES - (s - w)) - (s + w))

        return (Guard("strikes", above, lambda t, q, v: self.struck(k, q, v)),)

    def struck(self, k: int, q: Array, v: Array) -> tuple[str, Array, Array]:
        """(2.27) The other leg stands: moments of momentum about its foot, and of the old one about
        the hip, are conserved. With the rates ṡ, ẇ of the legs that stand and swing, before, after:
        (A − C) ṡ⁺ + (B − C) ẇ⁺ = H ṡ⁻ + K ẇ⁻ and B ẇ⁺ − C ṡ⁺ = K ṡ⁻, where K = J − m c (l − c),
        H = M l² cos δ + m (l − c) (2 l cos δ − c) + J, C = m c l cos δ, δ the angle between them.
        """
        s, s_dot, w_dot = float(q[1 + k]), float(v[1 + k]), float(v[2 - k])
        if abs(s + float(q[2 - k])) > APART:
            raise ArithmeticError("the leg that stands leans forward where the other passes it")
        cos, r, A, B = math.cos(2 * s), self.l - self.c, self.about_foot, self.about_hip
        C, K = self.m * self.c * self.l * cos, self.J - self.m * self.c * r
        H = self.M * self.l**2 * cos + self.m * r * (2 * self.l * cos - self.c) + self.J
        whole, leg = H * s_dot + K * w_dot, K * s_dot
        stands = (whole - leg + C / B * leg) / (A - C * C / B)
        swings = (leg + C * stands) / B
        x = float(q[0]) + 2 * self.l * math.sin(s)
        legs = [(-s, stands), (s, swings)]
        (a, a_dot), (b, b_dot) = legs if k == 1 else reversed(legs)
        return f"{LEGS[1 - k]} stands", np.array([x, a, b]), np.array([0.0, a_dot, b_dot])

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) F_N > 0 and |F_fr| ≤ μ F_N."""
        forces = self.modes[mode].reactions(t, q, v)
        foot = f"{mode.split()[0]}_foot"
        normal, tangent = forces[f"{foot}.normal"], abs(forces[f"{foot}.tangent"])
        if not normal > 0.0:
            return f"the floor would have to pull: {normal:.3g} N"
        if tangent > self.mu * normal:
            return f"to pivot it needs friction {tangent / normal:.4g}, not {self.mu:.4g}"
        return None


# The simplest walker before its limit: massless legs, a hip M, and feet of a small mass m.
#
# For m/M → 0 it becomes `simplest_walker`, which no engine can run.


@dataclass(frozen=True)
class LightFeet(CompassWalker):
    """A walker with all of a leg's mass m [kg] at its foot, where its moment of inertia is J_f."""

    J_f: float

    @property
    def c(self) -> float:
        """l [m]: how far below the hip a leg has its centre."""
        return self.l

    @property
    def J(self) -> float:
        """J_f [kg m²]."""
        return self.J_f
