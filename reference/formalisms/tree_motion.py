"""The motion of a kinematic tree by its own equations: the reference of a compiled model's limit.

It is integrated by two methods; what they differ by is the error that it states.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np

from ...cases.tree import SHIFTS, WIDTH, Tree
from ..coverage import equation
from ..integrators.implicit import Radau
from ..integrators.march import IntegrationError, march
from ..integrators.radau import radau_table
from ..system import Array
from . import tree_equations as equations

ROUGH, FINE = (5, 1e-12), (7, 1e-13)
"""Of each answer the stages of Radau IIA, which follows what is stiff and what is not, and its
tolerance: with as many stages both may take the same steps, and err alike."""
DOUBLE = 2.0  # an angle is twice what the numbers of its quaternion differ by


class Controls(Protocol):
    """Numbers (nu,) in time, and when [s] one of them jumps or has a kink."""

    @property
    def corners(self) -> tuple[float, ...]:
        """In their order [s]."""
        ...

    def at(self, time: float) -> Array:
        """(nu,) at a time [s]; on a jump those after it."""
        ...


class TooExpensive(Exception):
    """More accelerations than an answer may cost."""


@dataclass(frozen=True)
class TreeMotion:
    """Samples at times (N,) [s]: q (N, m), and by how much (N,) two answers differ up to each.

    Times that were asked for and are not there were out of reach.
    """

    times: Array
    q: Array
    errors: Array


@equation
def acceleration(tree: Tree, q: Array, v: Array, u: Array) -> Array:
    """(2.23), (2.33) v̇ (n,) of M v̇ + bias = passive forces + those of motors at controls u."""
    bodies = equations.moving(tree, q, v)
    forces = equations.passive(tree, q, v, bodies).forces - equations.bias(tree, bodies)
    forces += equations.driven(tree, q, v, u, bodies).forces
    v_dot: Array = np.linalg.solve(equations.mass_matrix(tree, bodies), forces).astype(np.float64)
    return v_dot


def rates(tree: Tree, q: Array, v: Array) -> Array:
    """Returns q̇ (m,) of joints that move with v (n,): v itself, and of turns in space theirs."""
    q_dot = np.empty_like(q)
    for joint in tree.joints:
        wide, freedoms = WIDTH[joint.kind]
        plain = SHIFTS[joint.kind] if wide > freedoms else freedoms
        k, i = joint.q + plain, joint.v + plain
        q_dot[joint.q : k] = v[joint.v : i]
        if wide > freedoms:
            q_dot[k : k + 4] = quaternion_rate(q[k : k + 4], v[i : i + 3])
    return q_dot


@equation
def quaternion_rate(q: Array, omega: Array) -> Array:
    """(2.5) Ė_i = ω × E_i of the axes of a quaternion: q̇ = ½ q ∘ (0, ω), ω in body axes: (4,)."""
    w, x, y, z = q.tolist()
    a, b, c = omega.tolist()
    vector = w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a
    return np.array([-(x * a + y * b + z * c), *vector]) / 2


def tree_motion(
    tree: Tree, q: Array, v: Array, times: Array, controls: Controls, most: int
) -> TreeMotion:
    """Returns the motion from a start on, of which each answer costs `most` accelerations at most.

    The equations have to be all of the tree's: nothing unread, and no constraint that acts.
    """
    y = np.concatenate([q, v])
    rough = np.array([*_Answer(tree, controls, ROUGH, most).samples(y, times)])
    within = times[: len(rough)]
    fine = np.array([*_Answer(tree, controls, FINE, most).samples(y, within)])
    m, count = len(q), len(fine)
    error = DOUBLE * np.abs(rough[:count, :m] - fine[:, :m]).max(axis=1)
    return TreeMotion(times[:count], fine[:, :m], np.maximum.accumulate(error))


class _Answer:
    """ẏ = f(t, y) of y = (q, v), with its controls in time."""

    def __init__(self, tree: Tree, controls: Controls, how: tuple[int, float], most: int) -> None:
        self.tree, self.controls, self.how, self.left = tree, controls, how, most
        self.before = math.inf

    def slope(self, t: float, y: Array) -> Array:
        """Returns ẏ; up to a corner the controls are those before it. Raises TooExpensive."""
        if not self.left:
            raise TooExpensive
        self.left -= 1
        q, v = np.split(y, [-self.tree.n])
        u = self.controls.at(min(t, self.before))
        return np.concatenate([rates(self.tree, q, v), acceleration(self.tree, q, v, u)])

    def samples(self, y: Array, times: Array) -> Iterator[Array]:
        """Yields y at the times, as far as it comes; no step leads over a corner."""
        corners = [t for t in self.controls.corners if times[0] < t < times[-1]]
        yield y
        for a, b in pairwise([times[0], *corners, times[-1]]):
            self.before = math.nextafter(b, a)
            grid = np.unique([a, *times[(times > a) & (times < b)], b])
            stages, tolerance = self.how
            method = Radau(self.slope, tolerance, radau_table(stages))
            try:
                for step in march(method, grid, y):
                    y = step.y_next
                    if step.t_next in times:
                        yield y
            except (TooExpensive, IntegrationError, np.linalg.LinAlgError):
                return
