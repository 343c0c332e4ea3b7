"""Load that hangs on a muscle, which is set going at t = 0 (figure 2.17).

q = (y, u): y below the hook, so that the muscle is λ = −y long, and u the length of what contracts
in it. u has a rate of its own, u̇ = −v of the shortening speed v, and no velocity; v = (ẏ,).
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


class Hanging(Mode):
    """m [kg] on c_s [N/m] in series with what contracts, and c_p [N/m], of length L [m], beside."""

    m: float
    F0: float
    cs: float
    cp: float
    L: float

    coordinates = ("y", "u")
    body = "load"

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {self.body: Mass(self.m, None)})

    def shortening(self, F: Any) -> Any:
        """v = −u̇ [m/s] under the force F [N]."""
        raise NotImplementedError

    def start(self) -> tuple[Array, Array]:
        """At rest with λ = u = L: nothing pulls."""
        return np.array([-self.L, self.L]), np.zeros(1)

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """q̇ = (ẏ, −v(F)), F = c_s (λ − u)."""
        return np.array([v[0], -self.shortening(self.cs * (-q[0] - q[1]))])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) m ÿ = −m g + c_s (λ − u) + c_p (λ − L) [m/s²], (1,)."""
        pull = self.cs * (-q[0] - q[1]) + self.cp * (-q[0] - self.L)
        return np.array([pull / self.m - G])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẏ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c_s (λ − u)² + ½ c_p (λ − L)² + m g y, λ = −y [J]."""
        series, beside = -q[0] - q[1], -q[0] - self.L
        return (self.cs * series**2 + self.cp * beside**2) / 2 + self.m * G * q[0]

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (0, y), and the inner state."""
        load = (0.0, q[0], 0.0, 0.0, v[0], 0.0)
        return {self.body: load, "muscle.contractile_length": (q[1],)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, (2.82) the two springs, towards the hook."""
        y, u = q.tolist()
        forces = (-self.m * G, -self.cs * (y + u), -self.cp * (y + self.L))
        return [Load(self.body, (0.0, y), (0.0, force)) for force in forces]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The guide holds the load sideways only."""
        return [Cut(("guide.fx",), None, "load", (0.0, float(q[0])), ((1.0, 0.0),))]


@dataclass(frozen=True)
class MuscleLoad(Hanging):
    """Hill's: (F + a)(v + b) = (F₀ + a) b, a [N], b [m/s]; above F₀ it lengthens."""

    m: float
    F0: float
    a: float
    b: float
    cs: float
    cp: float
    L: float

    def shortening(self, F: Any) -> Any:
        """v = (F₀ + a) b/(F + a) − b [m/s]."""
        return (self.F0 + self.a) * self.b / (F + self.a) - self.b


@dataclass(frozen=True)
class LinearMuscleLoad(Hanging):
    """F = F₀ − b v, b [N s/m]."""

    m: float
    F0: float
    b: float
    cs: float
    cp: float
    L: float

    def shortening(self, F: Any) -> Any:
        """v = (F₀ − F)/b [m/s]."""
        return (self.F0 - F) / self.b

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """z = z∞ + Σ w_k e^{s_k t}, z = (y, ẏ, u): all of it is linear.

        z∞: it bears m g with F₀ in what contracts and the rest beside it. s_k and w_k: eigenvalues
        and eigenvectors, as much of each as the start has.
        """
        rest = -self.L - (self.m * G - self.F0) / self.cp
        ends = np.array([rest, 0.0, -rest - self.F0 / self.cs])
        A = np.array([
            [0.0, 1.0, 0.0],
            [-(self.cs + self.cp) / self.m, 0.0, -self.cs / self.m],
            [-self.cs / self.b, 0.0, -self.cs / self.b],
        ])  # fmt: skip
        s, w = np.linalg.eig(A)
        share = np.linalg.solve(w, np.array([-self.L, 0.0, self.L]) - ends)
        y, y_dot, u = ends + np.real(w @ (share * np.exp(s * t)))
        return np.array([y, u]), np.array([y_dot])


# Muscle after Hill between two fixed points (figure 2.17): its force rises to the isometric one.
#
# q = (y, u): the lower end, which is held at y = −λ, and the length u of what contracts, which
# has a rate of its own; v = (ẏ,). A quick release by Δ is the start with c_s Δ less force in
# series.


@dataclass(frozen=True)
class MuscleIsometric(MuscleLoad):
    """The muscle and its load m, which is held: λ = l [m] long, with u = u0 [m] at first."""

    l: float
    u0: float

    body = "hook"

    def start(self) -> tuple[Array, Array]:
        """Held, with u₀."""
        return np.array([-self.l, self.u0]), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) ÿ = 0 [m/s²], (1,)."""
        return np.zeros(1)

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) The ground bears what the muscle leaves of the weight."""
        pull = self.cs * (-q[0] - q[1]) + self.cp * (-q[0] - self.L)
        return {"glue.fx": 0.0, "glue.fy": float(self.m * G - pull)}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """Ḟ = c_s b (F₀ − F)/(F + a): w − A ln w = w₀ − A ln w₀ + c_s b t, w = F₀ − F, A = F₀ + a.

        w = −A W(−(w₀/A) e^{−(w₀ + c_s b t)/A}) by Lambert's W, W e^W = x: its main branch.
        """
        A, w0 = self.F0 + self.a, self.F0 - self.cs * (self.l - self.u0)
        x = -w0 / A * math.exp(-(w0 + self.cs * self.b * t) / A)
        from scipy.special import lambertw

        w = -A * float(lambertw(x).real)
        return np.array([-self.l, self.l - (self.F0 - w) / self.cs]), np.zeros(1)

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) y + λ = 0."""
        return np.array([q[0] + self.l])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẏ = 0."""
        return np.ones((1, 1))

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The hook is held in both directions."""
        return [Cut(("glue.fx", "glue.fy"), None, self.body, (0.0, float(q[0])))]
