"""Random states of every mode of every hand-written system, such as its constraints allow."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from textmech.reference.system import Array

from .examples import PARAMETERS, example

Drawn = tuple[Array, Array]


def states(name: str, mode: str, count: int = 50) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v that meet the constraints of the mode."""
    random = np.random.default_rng(1)
    for _ in range(count):
        t = random.uniform(0.0, 5.0)
        yield t, *(_SMOOTH[name](random) if name in _SMOOTH else _switching(random, name, mode, t))


def _switching(random: np.random.Generator, name: str, mode: str, t: float) -> Drawn:
    """Anywhere on the floor or above it, with rates that the mode allows."""
    system = example(name).modes[mode]
    n = len(system.coordinates)
    q, v = random.uniform(-2.0, 2.0, n), random.uniform(-5.0, 5.0, n)
    if name == "sliding_disk":
        q[1] = 0.25
    if name == "ball_on_rope" and mode == "swings":
        q = q / np.linalg.norm(q)
    if name == "stopped_pendulum" and mode == "rests":
        q = np.array([math.radians(-60)])
    if name == "sliding_ladder" and mode == "leans":
        q[0] = 0.75 * math.cos(q[1])
    if name == "tipping_block" and mode == "stands":
        q = np.array([math.atan2(0.6, 0.3)])
    if name == "stacked_blocks" and mode == "rests":
        v = np.zeros(2)
    if name == "disk_on_disk":
        q[0] = 0.7 + abs(q[0]) if mode == "flies" else 0.6
    if name == "bouncing_disk":
        q = np.zeros(1) if mode == "rest" else q + 2.0
    rows = system.f_a(t, q)
    for _ in range(2 if len(rows) else 0):  # once more for the rounding of what was far larger
        v = v - np.linalg.pinv(rows) @ (rows @ v - system.g(t, q))
    return q, v


def _rolling_wheel(random: np.random.Generator) -> Drawn:
    phi, phi_dot = random.uniform(-9, 9), random.uniform(-9, 9)
    return np.array([0.25 * phi, 0.25, phi]), np.array([0.25 * phi_dot, 0.0, phi_dot])


def _bar_pendulum(random: np.random.Generator) -> Drawn:
    return random.uniform(-math.pi, math.pi, 1), random.uniform(-8, 8, 1)


def _double_pendulum(random: np.random.Generator) -> Drawn:
    return random.uniform(-math.pi, math.pi, 2), random.uniform(-8, 8, 2)


def _four_bar(random: np.random.Generator) -> Drawn:
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


def _rhombus(random: np.random.Generator) -> Drawn:
    """Opened between 20° and 160°: flat, the free-cut equations have no unique reactions."""
    theta1 = random.uniform(-math.pi, math.pi)
    opening = random.choice([-1, 1]) * random.uniform(math.radians(20), math.radians(160))
    return np.array([theta1, theta1 + opening]), random.uniform(-8, 8, 2)


def _spring_mass_damper(random: np.random.Generator) -> Drawn:
    return random.uniform(-1.5, -0.1, 1), random.uniform(-5, 5, 1)


def _on_spring(random: np.random.Generator) -> Drawn:
    """A length that is far from 0, in any direction."""
    q = np.array([random.uniform(0.4, 1.5), random.uniform(-math.pi, math.pi)])
    return q, random.uniform(-5, 5, 2)


def _trunk(random: np.random.Generator) -> Drawn:
    """Pitched between 20° and 60°: level, what the legs push sideways cancels to rounding."""
    pitch = random.choice([-1, 1]) * random.uniform(math.radians(20), math.radians(60))
    return np.array([random.uniform(0.5, 1.2), pitch]), random.uniform(-5, 5, 2)


def _sleigh(random: np.random.Generator) -> Drawn:
    """Any place and heading, gliding either way."""
    x, y, theta = random.uniform(-3, 3, 3)
    u, omega = random.uniform(-5, 5, 2)
    return np.array([x, y, theta]), np.array([u * math.cos(theta), u * math.sin(theta), omega])


_SMOOTH: dict[str, Callable[[np.random.Generator], Drawn]] = {
    "rolling_wheel": _rolling_wheel,
    "bar_pendulum": _bar_pendulum,
    "elastic_pendulum": _on_spring,
    "running_gait": _on_spring,
    "spring_mass_jump": _on_spring,
    "trunk_on_legs": _trunk,
    "double_pendulum": _double_pendulum,
    "four_bar": _four_bar,
    "rhombus": _rhombus,
    "knife_edge": _sleigh,
    "sleigh": _sleigh,
    "spring_mass_damper": _spring_mass_damper,
}
