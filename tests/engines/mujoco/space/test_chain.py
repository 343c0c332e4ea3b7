"""MuJoCo's trees in space: five skew hinges, free and driven, against Newton and Euler by hand."""

import math

import numpy as np
import pytest
from given.engine_space import simulated
from given.skew_chain import Q_DOT, N, Q, accelerations, chain, start, wrenches
from scipy.integrate import solve_ivp

from textmech.cases.scene import Signal
from textmech.cases.scene.rotation import angle_between
from textmech.cases.trajectory import Array, Trajectory

TIMES = np.linspace(0.0, 0.3, 4)
LAWS = (
    Signal("sine", (0.8,), 3.0, 0.2),
    Signal("constant", (0.7,)),
    Signal("ramp", (1.1,)),
    Signal("sine", (1.2,), 5.0, -0.4),
    Signal("sine", (0.5,), 2.0, 1.0),
)


def apart(motion: Trajectory, q: Array, q_dot: Array) -> float:
    """How far all bodies are from where the joints put them [m, rad, m/s, rad/s]."""
    worst = 0.0
    for k in range(len(motion.times)):
        for name, row in start(q[k], q_dot[k]).items():
            given, found = np.array(row), motion.states[name][k]
            turned = float(angle_between(given[3:7], found[3:7]))
            others = np.delete(given - found, slice(3, 7))
            worst = max(worst, turned, float(np.max(np.abs(others))))
    return worst


@pytest.fixture(scope="module")
def fall() -> tuple[Array, Array]:
    """The chain's own fall: q and q̇ at the samples."""
    found = solve_ivp(
        lambda t, y: np.concatenate([y[N:], accelerations(y[:N], y[N:])]),
        (0.0, TIMES[-1]), np.concatenate([Q, Q_DOT]), "DOP853", TIMES, rtol=1e-12, atol=1e-13,
    )  # fmt: skip
    return found.y[:N].T, found.y[N:].T


@pytest.mark.slow
@pytest.mark.parametrize("back", [(), (1, 3), (0, 1, 2, 3, 4)])
def test_five_skew_hinges_fall(fall: tuple[Array, Array], back: tuple[int, ...]) -> None:
    """Whichever part a joint names first. Reached: 3e-11 and, of 50 N, 3e-10; at 1e-4 2e-12."""
    q, q_dot = fall
    names = [f"j{i}.{letter}{axis}" for i in range(N) for letter in "fm" for axis in "xyz"]
    motion = simulated(chain(back=back), start(Q, Q_DOT), TIMES, 1e-3, names)
    assert apart(motion, q, q_dot) < 1e-10
    for k in range(len(TIMES)):
        forces, moments, _ = wrenches(q[k], q_dot[k], accelerations(q[k], q_dot[k]))
        found = np.array([motion.reactions[name][k] for name in names]).reshape(N, 2, 3)
        found[list(back)] *= -1
        assert np.max(np.abs(found[:, 0] - forces)) < 3e-9
        assert np.max(np.abs(found[:, 1] - moments)) < 1e-9


def driven(t: Array) -> tuple[Array, Array, Array]:
    """What the laws prescribe: turns, rates and accelerations (N, 5)."""
    columns = []
    for law in LAWS:
        (A,), w, phase = law.amplitude, law.angular_frequency, law.phase
        if law.law == "sine":
            swing = np.sin(w * t + phase)
            angle = A * (math.cos(phase) - np.cos(w * t + phase)) / w
            columns.append((angle, A * swing, A * w * np.cos(w * t + phase)))
        elif law.law == "ramp":
            columns.append((A * t * t / 2, A * t, np.full_like(t, A)))
        else:
            columns.append((A * t, np.full_like(t, A), np.zeros_like(t)))
    turns, rates, gains = (np.column_stack(part) for part in zip(*columns, strict=True))
    return Q + turns, rates, gains


@pytest.mark.parametrize("back", [(), (1, 3, 4)])
def test_five_driven_hinges_go_where_they_are_told(back: tuple[int, ...]) -> None:
    """And their torques are those that it takes. Reached: 1e-12, and of 37 N m 2e-12."""
    times = np.linspace(0.0, 2.0, 5)
    q, q_dot, q_ddot = driven(times)
    rates = {f"j{i}.omega": law for i, law in enumerate(LAWS)}
    names = [f"j{i}.torque" for i in range(N)]
    scene = chain(back=back, drives=rates)
    motion = simulated(scene, start(q[0], q_dot[0]), times, 1e-3, names)
    assert apart(motion, q, q_dot) < 1e-11
    torques = [wrenches(*row)[2] for row in zip(q, q_dot, q_ddot, strict=True)]
    found = np.array([motion.reactions[name] for name in names]).T
    assert np.max(np.abs(found - torques)) < 1e-10


@pytest.mark.slow
def test_hinges_that_are_not_driven_follow() -> None:
    """Reached: 1e-11, and of the torques 5e-10."""
    q, q_dot, _ = driven(TIMES[:1])
    which = (0, 3)
    begun = np.where([i in which for i in range(N)], q_dot[0], Q_DOT)

    def rates(t: float, y: Array) -> Array:
        _, prescribed, gains = driven(np.array([t]))
        speed = y[N:].copy()
        speed[list(which)] = prescribed[0, list(which)]
        given = {i: float(gains[0, i]) for i in which}
        return np.concatenate([speed, accelerations(y[:N], speed, given)])

    found = solve_ivp(
        rates, (0.0, TIMES[-1]), np.concatenate([q[0], begun]), "DOP853", TIMES,
        rtol=1e-12, atol=1e-13,
    )  # fmt: skip
    scene = chain(drives={f"j{i}.omega": LAWS[i] for i in which})
    names = [f"j{i}.torque" for i in which]
    motion = simulated(scene, start(q[0], begun), TIMES, 1e-3, names)
    assert apart(motion, found.y[:N].T, found.y[N:].T) < 1e-10
    for k, y in enumerate(found.y.T):
        torques = wrenches(y[:N], y[N:], rates(TIMES[k], y)[N:])[2]
        for i, name in zip(which, names, strict=True):
            assert abs(motion.reactions[name][k] - torques[i]) < 3e-9
