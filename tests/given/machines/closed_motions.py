"""Motions known without the reference: in closed form, or by scipy from typed equations."""

import math
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipj, ellipk

from textmech.cases.scene import Bounds
from textmech.cases.trajectory import Array

from ..adapters.engine_scenes import RADIUS, G


def pendulum(times: Array) -> tuple[Array, Array]:
    """`bar_pendulum`: its angle [rad] and the size of the hinge's force [N], by Newton's law."""
    released = math.radians(24.6) + math.pi / 2
    k, frequency = math.sin(released / 2), math.sqrt(1.5 * G / 0.8)
    sn, cn, _, _ = ellipj(ellipk(k * k) - frequency * times, k * k)
    hanging = 2 * np.arcsin(k * sn)
    omega = 2 * k * frequency * cn  # up to its sign
    angular = -(frequency**2) * np.sin(hanging)
    along = 1.2 * (0.4 * omega**2 + G * np.cos(hanging))
    across = 1.2 * (0.4 * angular + G * np.sin(hanging))
    return hanging - math.pi / 2, np.hypot(along, across)


def sliding_then_rolling(times: Array, v: float, omega: float, mu: float) -> Array:
    """x [m] of a disk: its slip v + R ω falls by 3 μ g."""
    rolls = (v + RADIUS * omega) / (3 * mu * G)
    t = np.minimum(times, rolls)
    return v * t - mu * G * t**2 / 2 + (v - mu * G * rolls) * (times - t)


def growing(times: Array, b: float = 1.0) -> Array:
    """Example 2.3: x [m] of a block that slips from 6 N / b on."""
    slid = np.maximum(times - 6.0 / b, 0.0)
    return -b * slid**3 / 6 - 3 * slid**2 / 2


def drawn(times: Array) -> Array:
    """Example 2.4: x [m] through phases of rest, and of ẍ = −2 x + 4 t − 3."""
    x, start, w, found = 0.0, 0.0, math.sqrt(2.0), np.zeros_like(times)
    while start < times[-1]:
        slips = (6.0 + 2 * x) / 4
        a, b = x - (2 * slips - 1.5), -2.0 / w
        speed = partial(_speed, w=w, a=a, b=b)
        grid = np.linspace(0.1, 4.0, 40)
        low, high = next((p, q) for p, q in pairwise(grid) if speed(p) > 0 >= speed(q))
        lasts = float(brentq(speed, low, high, xtol=1e-14))
        s = np.clip(times - slips, 0.0, lasts)
        slid = 2 * (slips + s) - 1.5 + a * np.cos(w * s) + b * np.sin(w * s)
        found = np.where(times >= start, np.where(times > slips, slid, x), found)
        x = 2 * (slips + lasts) - 1.5 + a * math.cos(w * lasts) + b * math.sin(w * lasts)
        start = slips + lasts
    return found


def _speed(s: float, *, w: float, a: float, b: float) -> float:
    return 2.0 + w * (b * math.cos(w * s) - a * math.sin(w * s))


def to_and_fro(times: Array, amplitude: float, frequency: float, bounds: Bounds) -> Array:
    """x [m] of 1 kg from rest under a sine so strong that it turns back without a rest.

    v = c − (A/ω) cos ω t − s F t between two reversals.
    """
    a, w, n = amplitude, frequency, 200_000
    x, t0, found = 0.0, math.asin(bounds.forward / a) / w, np.zeros_like(times)
    sense = 1
    while t0 < times[-1]:
        brakes = bounds.forward if sense > 0 else -bounds.backward

        def speed(t: Any, t0: float = t0, brakes: float = brakes) -> Any:
            return -a / w * (np.cos(w * t) - math.cos(w * t0)) - brakes * (t - t0)

        grid = np.linspace(t0, t0 + 2 * math.pi / w, n)[1:]
        after = int(np.argmax(sense * speed(grid) < 0))
        t1 = float(brentq(speed, grid[after - 1], grid[after], xtol=1e-15))

        def place(t: Any, x: float = x, t0: float = t0, brakes: float = brakes) -> Any:
            sines = (np.sin(w * t) - math.sin(w * t0)) / w - math.cos(w * t0) * (t - t0)
            return x - a / w * sines - brakes * (t - t0) ** 2 / 2

        found = np.where((times >= t0) & (times <= t1), place(times), found)
        x, t0, sense = float(place(t1)), t1, -sense
    return found


def time_to_flat() -> float:
    """When [s] `parallelogram` lies flat: ½ J α̇² = 2 m g a (sin α₀ − sin α), so that t = ∫ dα/α̇."""
    J, weight = 2 * 0.3**2 / 3 + 0.3**2, 2 * 9.80665 * 0.3  # two cranks, one coupler of 1 kg
    # α = α₀ − s², by Gauss: the integrand is then smooth at the start
    s, weights = np.polynomial.legendre.leggauss(40)
    half = np.sqrt(np.radians(70)) / 2
    s, weights = half * (s + 1), half * weights
    fallen = np.sin(np.radians(70)) - np.sin(np.radians(70) - s**2)
    return float(np.sum(weights * 2 * s / np.sqrt(2 * weight * fallen / J)))
