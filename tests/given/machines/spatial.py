"""The hand-written systems in space as their cases set them, and random states of each."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from textmech.reference.system import MOVING, Array, Mode, System
from textmech.reference.systems import written

SPATIAL: dict[str, dict[str, float]] = {
    "heavy_top": {
        "m": 0.5, "l": 0.05, "A": 3.5e-4, "C": 6e-4,
        "theta0": math.radians(40), "w1": 0.6, "w2": -0.9, "w3": 150.0,
    },
    "tilting_disk": {
        "m": 1.3, "R": 0.25, "mu": 1.0, "beta0": math.radians(12), "w1": 0.3, "w2": 5.0, "w3": -0.8,
    },
    "tilting_ring": {
        "m": 1.3, "R": 0.25, "A": 0.03, "C": 0.07, "mu": 1.0,
        "beta0": math.radians(12), "w1": 0.3, "w2": 5.0, "w3": -0.8,
    },
    "torque_free": {
        "m": 1.3, "A": 0.09, "B": 0.06, "C": 0.04, "gravity": 9.80665,
        "vx": 0.3, "vy": -0.2, "vz": 4.0,
        "psi0": 0.4, "theta0": 0.7, "phi0": -1.1, "w1": 1.0, "w2": 2.0, "w3": 3.0,
    },
}  # fmt: skip


def steady(degrees: float, w3: float, R: float = 0.25) -> float:
    """ω₂ [rad/s] of a homogeneous disk on a steady circle.

    3/2 R² ω₂ ω₃ = ¼ R² ω₃² tan β − g R sin β.
    """
    beta = math.radians(degrees)
    return (R * w3**2 * math.tan(beta) / 4 - 9.80665 * math.sin(beta)) / (1.5 * R * w3)


# What two principal axes of the body take turns about, and in which weight; a top that begins with
# a cusp, a loop or none, and one that spins slowly; the disk's steady circle is below.
VARIANTS: dict[str, tuple[str, dict[str, float]]] = {
    "about axis 1": ("torque_free", {"w1": -3.0, "w2": 2.0, "w3": 1.0}),
    "about axis 3": ("torque_free", {"w1": 1.0, "w2": -2.0, "w3": -3.0, "gravity": 0.0}),
    "near axis 1": ("torque_free", {"w1": 5.0, "w2": 0.05, "w3": 0.02}),
    "near axis 3": ("torque_free", {"w1": 0.02, "w2": 0.05, "w3": 5.0}),
    "near axis 2": ("torque_free", {"w1": 0.01, "w2": 5.0, "w3": 0.02}),
    "on axis 1": ("torque_free", {"w1": 5.0, "w2": 0.0, "w3": 0.0}),
    "cusp": ("heavy_top", {"w1": 0.0, "w2": 0.0, "w3": 200.0}),
    "loops": ("heavy_top", {"w1": 0.0, "w2": -1.5, "w3": 200.0}),
    "waves": ("heavy_top", {"w1": -0.7, "w2": -3.0, "w3": -150.0}),
    "falls deep": ("heavy_top", {"w1": 0.3, "w2": 3.0, "w3": 50.0}),
    "steady circle": (
        "tilting_disk",
        {"w1": 0.0, "w2": steady(20.0, -1.2), "w3": -1.2, "beta0": math.radians(20)},
    ),
    "straight": ("tilting_disk", {"w1": 0.0, "w2": 5.0, "w3": 0.0, "beta0": 0.0}),
    "spins in place": ("tilting_disk", {"w1": 0.0, "w2": 0.0, "w3": 20.0, "beta0": 0.0}),
}


def example(name: str, **changed: float) -> System:
    """The system of the case, with some of its parameters changed."""
    return written(name, {**SPATIAL[name], **changed})


def variant(name: str) -> System:
    """The system of a variant."""
    system, changed = VARIANTS[name]
    return example(system, **changed)


def closed(system: System, t: float) -> tuple[Array, Array]:
    """q and v of its closed form, which it must have."""
    known = system.closed_form(t)
    assert known is not None
    return known


def only(name: str, **changed: float) -> Mode:
    """Its only mode."""
    return example(name, **changed).modes[MOVING]


def states(name: str, count: int = 100) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v that meet the constraints."""
    random = np.random.default_rng(8)
    for _ in range(count):
        yield random.uniform(0.0, 5.0), *_DRAWN[name](random)


def _heavy_top(random: np.random.Generator) -> tuple[Array, Array]:
    """Neither upright nor hanging, where ψ and φ are not told apart."""
    theta = random.uniform(math.radians(10), math.radians(170))
    q = np.array([random.uniform(-9, 9), theta, random.uniform(-9, 9)])
    return q, random.uniform(-20, 20, 3)


def _tilting(random: np.random.Generator) -> tuple[Array, Array]:
    """Up to 80°, rolling (2.19)."""
    x, y, theta, phi = random.uniform(-9, 9, 4)
    beta = random.uniform(math.radians(-80), math.radians(80))
    w1, w2, w3 = random.uniform(-8, 8, 3)
    roll = 0.25 * (w2 - w3 * math.tan(beta))
    v = np.array([roll * math.cos(theta), roll * math.sin(theta), w1, w2, w3])
    return np.array([x, y, theta, beta, phi]), v


def _torque_free(random: np.random.Generator) -> tuple[Array, Array]:
    e = random.normal(size=4)
    q = np.concatenate([random.uniform(-5, 5, 3), e / np.linalg.norm(e)])
    return q, random.uniform(-8, 8, 6)


_DRAWN: dict[str, Callable[[np.random.Generator], tuple[Array, Array]]] = {
    "heavy_top": _heavy_top,
    "tilting_disk": _tilting,
    "tilting_ring": _tilting,
    "torque_free": _torque_free,
}
