"""Rimless wheel that walks down a slope on its spokes (section 2.4.1, figure 2.12).

q = (φ,) counts the rolling to +x, down the slope, as the book does: clockwise.  Each spoke in turn
is a pendulum turned over about its tip; the next one strikes the floor without slip or bounce.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered
from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector
from ..quadrature import integral

# The steps of a rimless wheel by known functions: energy from strike to strike, and the impact.
#
# Lengths are counted in spokes and inertia in m l²: J = ρ m l².


TURNS = 8  # of Newton's method: it squares a share below 1, five do
PANELS = 8  # of 16 nodes: 1e-14 s, but where a step takes many times the shortest


@dataclass(frozen=True)
class SpokeSteps(Numbered):
    """n spokes of l [m], ρ = J/(m l²), slope gamma [rad]; ω [rad/s] is a rate after a strike."""

    n: float
    l: float
    rho: float
    gamma: float

    @property
    def between(self) -> float:
        """2α = 2π/n [rad]: the angle of a step."""
        return 2 * math.pi / self.n

    @property
    def kept(self) -> float:
        """(2.27) η = 1 − 2 sin² α/(1 + ρ): of l φ̇ the part 1 − cos 2α cannot go on."""
        return 1 - 2 * math.sin(self.between / 2) ** 2 / (1 + self.rho)

    def gained(self, s: Any) -> Any:
        """(2.51) φ̇² − ω² [rad²/s²] at the angle s after a strike: ½ (1 + ρ) l φ̇² = g · fall.

        The hub falls by cos(s/2 − α + γ) − … = 2 sin(γ − α + s/2) sin(s/2) spokes.
        """
        fall = 2 * np.sin(self.gamma - self.between / 2 + s / 2) * np.sin(s / 2)
        return 2 * G / self.l / (1 + self.rho) * fall

    def next_rate(self, omega: float) -> float:
        """(2.27) ω⁺ = η √(ω² + gained in a step) [rad/s]."""
        return self.kept * math.sqrt(omega**2 + float(self.gained(self.between)))

    def limit_cycle(self) -> float:
        """(2.27) ω* = η √(D/(1 − η²)) [rad/s], D gained in a step; its multiplier is η².

        Down a slope each rate that goes on walking comes to it: ω⁺² − ω*² = η² (ω² − ω*²).
        """
        return self.kept * math.sqrt(float(self.gained(self.between)) / (1 - self.kept**2))

    def walks_over(self, omega: float) -> bool:
        """Whether it passes the place where it is slowest, upright against gravity."""
        slowest = max(0.0, self.between / 2 - self.gamma)
        return omega**2 + float(self.gained(slowest)) > 0.0

    def rate(self, omega: float, s: Any) -> Any:
        """(2.51) φ̇ = √(ω² + gained) [rad/s] at the angle s after a strike."""
        return np.sqrt(omega**2 + self.gained(s))

    def lasts(self, omega: float, s: float | None = None) -> float:
        """(2.51) T = ∫ ds/φ̇ [s] over a step, or up to the angle s in it."""
        end = self.between if s is None else s
        return float(integral(lambda s: 1 / self.rate(omega, s), end, PANELS))

    def angle(self, omega: float, tau: float) -> float:
        """(2.51) The angle s at which T = τ: Newton's method, T' = 1/φ̇ > 0."""
        s = self.between * tau / self.lasts(omega)
        for _ in range(TURNS):
            s += (tau - self.lasts(omega, s)) * float(self.rate(omega, s))
            s = min(max(s, 0.0), self.between)
        return s

    def after(self, omega: float, t: float) -> tuple[float, float] | None:
        """φ [rad] and φ̇ [rad/s] at t [s] after a strike; None where it has come to fall back."""
        phi = 0.0
        while self.walks_over(omega):
            if t < (lasts := self.lasts(omega)):
                s = self.angle(omega, t)
                return phi + s, float(self.rate(omega, s))
            t, phi, omega = t - lasts, phi + self.between, self.next_rate(omega)
        return None

    def strikes(self, omega: float, until: float) -> list[float] | None:
        """The times [s] of all strikes up to `until`, from a strike; None where it falls back."""
        t, times = 0.0, list[float]()
        while self.walks_over(omega):
            t += self.lasts(omega)
            if t > until:
                return times
            times.append(t)
            omega = self.next_rate(omega)
        return None


G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Spoke(Mode):
    """The wheel on spoke k, which leans by θ = φ − (2k − 1) α; at rest also on spoke k + 1."""

    wheel: "RimlessWheel"
    k: int
    rests: bool = False

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"wheel": Mass(self.wheel.m, self.wheel.J)})

    def _lean(self, phi: Any) -> Any:
        """θ [rad] against the normal of the slope."""
        return phi - (2 * self.k - 1) * self.wheel.alpha

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34) (J + m l²) φ̈ = m g l sin(θ + γ), 0 at rest [rad/s²], (1,): Steiner about the tip.

        The tip is the axis that is fixed, the wheel its pendulum turned over.
        """
        if self.rests:
            return np.zeros(1)
        w = self.wheel
        return np.array([w.m * G * w.l * math.sin(self._lean(float(q[0])) + w.gamma) / w.about_tip])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) F = m r̈_c − m g [N], r̈_c = l φ̈ (cos θ, −sin θ) − l φ̇² (sin θ, cos θ)."""
        w, theta, phi_dot = self.wheel, self._lean(float(q[0])), float(v[0])
        phi_ddot = float(self.accelerations(t, q, v)[0])
        sin, cos = math.sin(theta), math.cos(theta)
        x_ddot = w.l * (phi_ddot * cos - phi_dot**2 * sin)
        y_ddot = -w.l * (phi_ddot * sin + phi_dot**2 * cos)
        along, across = G * math.sin(w.gamma), -G * math.cos(w.gamma)
        return {"feet.tangent": w.m * (x_ddot - along), "feet.normal": w.m * (y_ddot - across)}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ (J + m l²) φ̇² [J]."""
        return self.wheel.about_tip * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g (y_c cos γ − x_c sin γ) [J]."""
        w, (x, y) = self.wheel, self._hub(q)
        return w.m * G * (y * math.cos(w.gamma) - x * math.sin(w.gamma))

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) φ = 2k α at rest on spokes k and k + 1 [rad]."""
        return np.array([q[0] - 2 * self.k * self.wheel.alpha] if self.rests else [])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) φ̇ = 0 at rest."""
        return np.ones((1, 1)) if self.rests else np.zeros((0, 1))

    def _tip(self) -> float:
        """x [m] of the tip of spoke k: each step is 2 l sin α long."""
        return (2 * self.k - 1) * self.wheel.l * math.sin(self.wheel.alpha)

    def _hub(self, q: Vector) -> tuple[Any, Any]:
        """x_c = X_k + l sin θ, y_c = l cos θ [m]."""
        theta = self._lean(q[0])
        return self._tip() + self.wheel.l * np.sin(theta), self.wheel.l * np.cos(theta)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x_c, y_c), angle = −φ."""
        theta, l = self._lean(q[0]), self.wheel.l
        x_dot, y_dot = l * v[0] * np.cos(theta), -l * v[0] * np.sin(theta)
        return {"wheel": (*self._hub(q), -q[0], x_dot, y_dot, -v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight at the hub, in the axes of the slope."""
        w, (x, y) = self.wheel, self._hub(q)
        down = (w.m * G * math.sin(w.gamma), -w.m * G * math.cos(w.gamma))
        return [Load("wheel", (float(x), float(y)), down)]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The tip on which it stands; at rest, where the two forces and the moment have a sum."""
        names = ("feet.tangent", "feet.normal", *(["moment"] if self.rests else []))
        return [Cut(names, None, "wheel", (self._tip(), 0.0), moment=self.rests)]


class _Spokes(dict[str, Mode]):
    """The modes `spoke k` and `rests k`, k any whole number, built when they are first met."""

    def __init__(self, wheel: "RimlessWheel") -> None:
        super().__init__()
        self.wheel = wheel

    def __missing__(self, name: str) -> Mode:
        what, k = name.split()
        self[name] = _Spoke(self.wheel, int(k), what == "rests")
        return self[name]


@dataclass(frozen=True)
class RimlessWheel(System):
    """n spokes, each l [m] long; m [kg], J [kg m²] about the hub; slope gamma [rad], friction mu.

    It starts on spoke 1, with spoke 0 just leaving the floor, at w0 [rad/s] down the slope.
    """

    n: float
    l: float
    m: float
    J: float
    gamma: float
    mu: float
    w0: float

    def __post_init__(self) -> None:
        if self.n != round(self.n) or self.n < 3:
            raise ValueError(f"a wheel has at least three whole spokes, not {self.n:g}")
        if not self.w0 > 0.0:
            raise ValueError(f"it must start down the slope: w0 > 0, not {self.w0:g}")
        if not self.eta > 0.0:
            raise ValueError("it would stop at once: the impact leaves η ≤ 0 of its speed")
        object.__setattr__(self, "modes", _Spokes(self))
        for name in ("spoke 0", "spoke 1", "spoke 2"):
            assert self.modes[name]

    @property
    def alpha(self) -> float:
        """α = π/n [rad]: half the angle between two spokes."""
        return math.pi / self.n

    @property
    def about_tip(self) -> float:
        """(2.35) J + m l² [kg m²]."""
        return self.J + self.m * self.l**2

    @property
    def eta(self) -> float:
        """(2.27) η = (J + m l² cos 2α)/(J + m l²): about the new tip nothing turns the wheel."""
        return (self.J + self.m * self.l**2 * math.cos(2 * self.alpha)) / self.about_tip

    def start(self) -> tuple[str, Array, Array]:
        """φ = 0 on spokes 0 and 1, φ̇ = w0."""
        return "spoke 1", np.zeros(1), np.array([self.w0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.27) `spoke 2 strikes` where the next spoke meets the floor, θ = ±α: φ̇ := η φ̇.

        What rocks ever less is at rest in the end.
        """
        what, number = mode.split()
        if what == "rests":
            return ()
        k = int(number)
        return tuple(self._strikes(k, way) for way in (1, -1))

    def _strikes(self, k: int, way: int) -> Guard:
        """From spoke k to k ± 1, at φ = 2k α or 2 (k − 1) α."""
        between = k if way == 1 else k - 1
        phi = 2 * between * self.alpha

        def then(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return f"spoke {k + way}", np.array([phi]), self.eta * v

        def rests(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return f"rests {between}", np.array([phi]), np.zeros(1)

        gap = lambda t, q, v: way * (phi - float(q[0]))  # noqa: E731
        return Guard(f"spoke {k + way} strikes", gap, then, rests)

    def _steps(self) -> SpokeSteps:
        return SpokeSteps(self.n, self.l, self.J / (self.m * self.l**2), self.gamma)

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """φ and φ̇ by energy and impact; None where it has come to fall back."""
        state = self._steps().after(self.w0, t)
        return state and (np.array(state[:1]), np.array(state[1:]))

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """The strikes up to `until` by energy and impact; None where it comes to fall back."""
        times = self._steps().strikes(self.w0, until)
        if times is None:
            return None
        return [(f"spoke {k} strikes", t) for k, t in enumerate(times, start=2)]

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) |F_fr| ≤ μ F_N and F_N > 0 where it stands, and no other tip in the floor."""
        forces = self.modes[mode].reactions(t, q, v)
        normal, tangent = forces["feet.normal"], forces["feet.tangent"]
        if not normal > 0.0:
            return f"the floor would have to pull: feet.normal = {normal:.3g} N"
        if abs(tangent) > self.mu * normal:
            return f"to pivot it needs friction {abs(tangent) / normal:.4g}, not {self.mu:.4g}"
        lean = abs(float(q[0]) / self.alpha - (2 * int(mode.split()[1]) - 1))
        if lean > 1 + 1e-9 and mode.startswith("spoke"):
            return f"{mode} leans by {lean:.4g} α, and the next tip is in the floor"
        return None
