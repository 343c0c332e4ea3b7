"""Poses of a motion, as few as cubics through them and their rates need to draw it.

Straight lines between poses would take a mechanism apart: a bar that turns by 1 rad from one to the
next is drawn an eighth too short in between. Cubics in the place and the attitude, through the
poses and their rates, are off by 1/384 of the fourth power of the turn, in parts of the bar.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....cases.case import Case
from ....cases.scene.frame import PLANE, SPACE, Frame, frame_of
from ....cases.scene.observe import motion_of
from ....cases.scene.point import GROUND
from ....cases.scene.rotation import product
from ....cases.trajectory import Array, Trajectory
from .digits import POSE, few_digits

CLOSE = 1 / 4000  # of what the motion reaches, which is drawn 400 pixels wide: a tenth of one
GHOST = 1 / 1000  # what an engine's motion is drawn to: by what it is off is seen, and not measured
BARE = 0.01  # rad: the turn of a body of which no size is known, as it is drawn small
FAR = 1.0  # rad from sample to sample in space: at 3 nobody knows which way it turned

Moves = Mapping[str, tuple[Array, Array]]
"""By part (N, k) its pose, and (N, k) the rates of that."""


@dataclass(frozen=True)
class Poses:
    """The poses that are drawn of one motion; `at` says where its parts are at any time."""

    times: Array
    moves: Moves

    def rounded(self) -> dict[str, Any]:
        """Returns it for the page: times, and of each part its poses and their rates by column."""
        return {
            "times": few_digits(self.times, POSE),
            "poses": {
                part: [_columns(pose, POSE), _columns(rates)]
                for part, (pose, rates) in self.moves.items()
            },
        }

    def at(self, times: Array) -> dict[str, Array]:
        """Returns the pose (N, k) of each part at the times."""
        return {part: cubic(self.times, *moved, times) for part, moved in self.moves.items()}


def read(drawn: Mapping[str, Any]) -> Poses:
    """Returns the poses of a page's motion, to their digits."""
    moves = {
        part: (np.transpose(pose), np.transpose(rates))
        for part, (pose, rates) in drawn["poses"].items()
    }
    return Poses(np.array(drawn["times"]), moves)


def _columns(rows: Array, *digits: int) -> list[list[float]]:
    return [few_digits(column, *digits) for column in rows.T]


def cubic(times: Array, places: Array, rates: Array, at: Array) -> Array:
    """(M, n): at the times (M,), by cubics through places and rates (N, n) at the times (N,)."""
    k = np.clip(np.searchsorted(times, at), 1, len(times) - 1) - 1
    h = (times[k + 1] - times[k])[:, None]
    s = (at - times[k])[:, None] / h
    ends = places[k] * (1 + 2 * s) * (1 - s) ** 2 + places[k + 1] * s**2 * (3 - 2 * s)
    return ends + h * (rates[k] * s * (1 - s) ** 2 - rates[k + 1] * s**2 * (1 - s))


def moves(states: Mapping[str, Array]) -> Moves:
    """The poses of bodies, and the rates of these, of their states (N, 6) or (N, 13)."""
    return {body: _moves(rows) for body, rows in states.items()}


def _moves(rows: Array) -> tuple[Array, Array]:
    frame = frame_of(rows.shape[1])
    place, velocity = rows[:, frame.place], rows[:, frame.velocity]
    if frame is PLANE:
        return rows[:, : frame.attitude.stop], rows[:, frame.velocity.start :]
    q = rows[:, frame.attitude]
    turns = np.where(np.sum(q[1:] * q[:-1], axis=1) < 0.0, -1.0, 1.0)
    q = q * np.cumprod(np.append(1.0, turns))[:, None]  # it and its opposite are one attitude
    spin = np.hstack([np.zeros((len(q), 1)), rows[:, frame.spin]])
    return np.hstack([place, q]), np.hstack([velocity, product(q, spin) / 2])


def driven(case: Case, times: Array) -> Moves:
    """The places of the ground's driven points, which are drawn as bodies without a turn."""
    n = case.scene.frame.dimension
    return {
        f"{GROUND}.{name}": (point.states(times)[:, :n], point.states(times)[:, n:])
        for name, point in case.scene.points.items()
        if point.driven
    }


def drawn(
    frame: Frame, reaches: Mapping[str, float], times: Array, moves: Moves, close: float
) -> Poses:
    """Returns as few of the poses as are needed.

    No pose that is left out is off the cubics by more than so much [m], wherever its body is drawn.
    reaches: by body how far [m] it is drawn from its place.
    """
    kept = _needed(times, moves, _within(frame, reaches, moves, close))
    return Poses(times[kept], {part: (p[kept], v[kept]) for part, (p, v) in moves.items()})


def _within(frame: Frame, reaches: Mapping[str, float], moves: Moves, close: float) -> Array:
    """Returns the bound of each column of poses; of a turn by what it moves the farthest point."""
    n, margins = frame.dimension, list[float]()
    for part, (pose, _) in moves.items():
        turns = pose.shape[1] - n
        arm = reaches[part] if turns else 0.0
        turn = close / arm if arm else BARE
        margins += [close] * n + [turn if n == len(PLANE.axes) else turn / 2] * turns
    return np.array(margins)


def _needed(times: Array, moves: Moves, within: Array) -> NDArray[np.int64]:
    """Returns the samples kept: the worst that cubics miss are added until they miss none."""
    places = np.hstack([pose for pose, _ in moves.values()])
    rates = np.hstack([rate for _, rate in moves.values()])
    kept, open_ends = {0, len(times) - 1}, [(0, len(times) - 1)]
    while open_ends:
        i, j = open_ends.pop()
        inner = np.arange(i + 1, j)
        ends = [i, j]
        between = cubic(times[ends], places[ends], rates[ends], times[inner])
        off = np.max(np.abs(between - places[inner]) / within, axis=1, initial=0.0)
        if len(inner) and np.max(off) > 1.0:
            worst = i + 1 + int(np.argmax(off))
            kept.add(worst)
            open_ends += [(i, worst), (worst, j)]
    return np.array(sorted(kept), dtype=np.int64)


def closer(case: Case, times: Array, states: Mapping[str, Array], size: float) -> int:
    """In how many parts the time between samples has to be cut for cubics to be the way; 1: uncut.

    Else they would open joints, or lose a turn. Gaps fall with the fourth power of the parts.
    """
    frame, middle = case.scene.frame, (times[1:] + times[:-1]) / 2
    paths, needed = moves(states), [0.0]
    for pose, _ in paths.values() if frame is SPACE else ():
        chords = np.linalg.norm(np.diff(pose[:, frame.attitude], axis=0), axis=1)
        needed.append(float(np.max(2 * chords)) / FAR)  # a quaternion goes half as far as its body
    rest = np.zeros((len(middle), frame.width - frame.attitude.stop))  # no gap asks for rates
    between = {body: np.hstack([cubic(times, *paths[body], middle), rest]) for body in paths}
    looked = Trajectory(
        np.append(times, middle),  # the samples first: of some rods the first has the length
        {body: np.vstack([states[body], between[body]]) for body in states},
        {},
    )
    for joint in case.scene.joints.values():
        gap = np.abs(joint.observe(motion_of(case.scene, looked), "gap"))
        opened = float(np.max(gap[len(times) :]) - np.max(gap[: len(times)]))
        needed.append((max(opened, 0.0) / (CLOSE * size)) ** 0.25)
    return max(1, math.ceil(max(needed)))
