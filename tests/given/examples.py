"""The systems as their cases set them, what their starts must be, and random admissible states."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from textmech.reference.system import Array, Mode
from textmech.reference.systems import SYSTEMS

PARAMETERS: dict[str, dict[str, float]] = {
    "rolling_wheel": {
        "m": 1.3, "R": 0.25, "mu": 0.5, "beta": math.radians(20), "F": 2.5, "v0": 0.4, "w0": 1.6,
    },
    "bar_pendulum": {"m": 1.2, "l": 0.8, "phi0": math.radians(24.6)},
    "double_pendulum": {
        "m1": 1.0, "l1": 0.6, "m2": 0.7, "l2": 0.9,
        "a0": math.radians(-61), "b0": math.radians(-33),
    },
    "four_bar": {
        "m": 1.0, "a": 0.3, "b": 0.8, "c": 0.6, "d": 0.9, "crank0": math.radians(70),
    },
    "rhombus": {
        "m": 0.5, "l": 0.4, "c": 60.0, "l0": 0.5,
        "left0": math.radians(-130), "right0": math.radians(-60),
    },
    "spring_mass_damper": {"m": 1.0, "c": 36.0, "d": 1.2, "l0": 0.5, "y0": -0.6},
}  # fmt: skip

# What the case files say of the start, typed again: body, column of its pose, value. Of the
# rocker they only say near which of the two ways to close the loop it is.
STARTS: dict[str, list[tuple[str, int, float, float]]] = {
    "rolling_wheel": [
        ("wheel", 0, 0.0, 0.0), ("wheel", 1, 0.25, 0.0), ("wheel", 2, 0.0, 0.0),
        ("wheel", 3, 0.4, 1e-15), ("wheel", 5, -1.6, 1e-15),
    ],
    "bar_pendulum": [("bar", 2, 24.6 * math.pi / 180, 1e-15), ("bar", 5, 0.0, 0.0)],
    "double_pendulum": [
        ("upper", 2, -61 * math.pi / 180, 1e-15), ("lower", 2, -33 * math.pi / 180, 1e-15),
    ],
    "four_bar": [
        ("crank", 2, 70 * math.pi / 180, 1e-15), ("rocker", 2, 96 * math.pi / 180, 0.01),
    ],
    "rhombus": [
        ("left", 2, -130 * math.pi / 180, 1e-15), ("lower_right", 2, -130 * math.pi / 180, 1e-15),
        ("right", 2, -60 * math.pi / 180, 1e-15), ("lower_left", 2, -60 * math.pi / 180, 1e-15),
    ],
    "spring_mass_damper": [("mass", 1, -0.6, 0.0), ("mass", 4, 0.0, 0.0)],
}  # fmt: skip

# The reactions that the multipliers λ of (2.60) are.
MULTIPLIERS = {
    "rolling_wheel": ("touch.tangent", "touch.normal"),
    "four_bar": ("C.fx", "C.fy"),
}


def example(name: str, **changed: float) -> Mode:
    """The system of the case, with some of its parameters changed."""
    found = SYSTEMS[name](**{**PARAMETERS[name], **changed})
    assert isinstance(found, Mode)
    return found


def states(name: str, count: int = 50, seed: int = 1) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v that meet the constraints."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        yield random.uniform(0.0, 5.0), *_STATE[name](random)


def _rolling_wheel(random: np.random.Generator) -> tuple[Array, Array]:
    phi, phi_dot = random.uniform(-9, 9), random.uniform(-9, 9)
    return np.array([0.25 * phi, 0.25, phi]), np.array([0.25 * phi_dot, 0.0, phi_dot])


def _bar_pendulum(random: np.random.Generator) -> tuple[Array, Array]:
    return random.uniform(-math.pi, math.pi, 1), random.uniform(-8, 8, 1)


def _double_pendulum(random: np.random.Generator) -> tuple[Array, Array]:
    return random.uniform(-math.pi, math.pi, 2), random.uniform(-8, 8, 2)


def _four_bar(random: np.random.Generator) -> tuple[Array, Array]:
    """Any crank angle, on both branches: with these lengths β − γ never comes near 0 or π."""
    a, b, c, d = (PARAMETERS["four_bar"][key] for key in "abcd")
    alpha, alpha_dot = random.uniform(-math.pi, math.pi), random.uniform(-8, 8)
    B = a * np.exp(1j * alpha)
    diagonal = d - B
    s = abs(diagonal)
    turn = random.choice([-1, 1]) * np.arccos((b * b + s * s - c * c) / (2 * b * s))
    beta = np.angle(diagonal) + turn
    gamma = np.angle(B + b * np.exp(1j * beta) - d)
    # i a e^{iα} α̇ + i b e^{iβ} β̇ − i c e^{iγ} γ̇ = 0, real and imaginary part
    e = 1j * np.exp(1j * np.array([alpha, beta, gamma])) * [a, b, -c]
    rates = np.linalg.solve([e[1:].real, e[1:].imag], [-e[0].real, -e[0].imag]) * alpha_dot
    return np.array([alpha, beta, gamma]), np.array([alpha_dot, *rates])


def _rhombus(random: np.random.Generator) -> tuple[Array, Array]:
    """Opened between 20° and 160°: flat, the free-cut equations have no unique reactions."""
    theta1 = random.uniform(-math.pi, math.pi)
    opening = random.choice([-1, 1]) * random.uniform(math.radians(20), math.radians(160))
    return np.array([theta1, theta1 + opening]), random.uniform(-8, 8, 2)


def _spring_mass_damper(random: np.random.Generator) -> tuple[Array, Array]:
    return random.uniform(-1.5, -0.1, 1), random.uniform(-5, 5, 1)


_STATE: dict[str, Callable[[np.random.Generator], tuple[Array, Array]]] = {
    "rolling_wheel": _rolling_wheel,
    "bar_pendulum": _bar_pendulum,
    "double_pendulum": _double_pendulum,
    "four_bar": _four_bar,
    "rhombus": _rhombus,
    "spring_mass_damper": _spring_mass_damper,
}
