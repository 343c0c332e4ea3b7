"""Turns of joints in space with their whole turns: attitudes tell an angle but for these.

They are counted from row to row, on rows as close as `ambiguous_turns` asks.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..trajectory import Array
from .chain import Turns

THREE = 3
LOCKED = 1e-6  # rad from gimbal lock: an arc cosine has lost half of its digits there
FAR = 1.0  # rad between two rows: a third of the half turn that can be told
OFF = 0.1  # rad from what both rates say


def nearest(ways: Sequence[Turns], expected: Array) -> Turns:
    """The turns (N, K), in each row of that solution which is nearest to `expected` (N, K)."""
    angles = [way.near(expected) for way in ways]
    if len(ways) == 1:
        return replace(ways[0], angles=angles[0])
    first, second = (np.sum((angle - expected) ** 2, axis=1) for angle in angles)
    first_nearer = (first <= second)[:, None]
    rates = np.where(first_nearer, *(way.rates for way in ways))
    return replace(ways[0], angles=np.where(first_nearer, *angles), rates=rates)


def counted(ways: Sequence[Turns], times: Array, begins: Sequence[float | None]) -> Turns:
    """The turns with whole turns counted from row to row, from the angles where they begin.

    Between two rows a turn goes on by the mean of both rates, to less than half a turn: the rows
    have to be as close as `ambiguous_turns` asks. Without a start it is within half a turn of 0.
    """
    way, start = _nearest_at_start(ways, begins)
    if len(ways) > 1:
        return _one_by_one([way, *(other for other in ways if other is not way)], times, start)
    expected = 0.5 * (way.rates[1:] + way.rates[:-1]) * np.diff(times)[:, None]
    missing = np.round((expected - np.diff(way.angles, axis=0)) / math.tau)
    whole = np.vstack([np.round((start - way.angles[:1]) / math.tau), missing])
    return replace(way, angles=way.angles + math.tau * np.cumsum(whole, axis=0))


def _nearest_at_start(ways: Sequence[Turns], begins: Sequence[float | None]) -> tuple[Turns, Array]:
    """The solution whose first row is nearest to the given start, and its angles (K,) there."""
    known = np.array([math.nan if begin is None else begin for begin in begins])
    candidates = []
    for way in ways:
        expected = np.where(np.isnan(known), way.angles[0], known)
        start = way.near(expected)[0]
        candidates.append((float(np.sum((start - expected) ** 2)), way, start))
    _, way, start = min(candidates, key=lambda each: each[0])
    return way, start


def _one_by_one(ways: Sequence[Turns], times: Array, start: Array) -> Turns:
    """For each row the way, of two, that goes on best from the row before it."""
    angles, rates = np.empty_like(ways[0].angles), np.empty_like(ways[0].rates)
    angles[0], rates[0] = start, ways[0].rates[0]
    for i, dt in enumerate(np.diff(times).tolist(), start=1):
        least = math.inf
        if ways[0].free[i] < LOCKED:  # their angles are rounding's
            angles[i], rates[i] = angles[i - 1] + rates[i - 1] * dt, rates[i - 1]
            continue
        for way in ways:
            expected = angles[i - 1] + 0.5 * (rates[i - 1] + way.rates[i]) * dt
            there = way.angles[i] + math.tau * np.round((expected - way.angles[i]) / math.tau)
            if (distance := float(np.max(np.abs(there - expected)))) < least:
                least, angles[i], rates[i] = distance, there, way.rates[i]
    return replace(ways[0], angles=angles, rates=rates)


def ambiguous_turns(turns: Turns, times: Array) -> Array:
    """(N − 1,) whether a turn moves too far between two rows to count whole turns.

    Or the middle one of three so far as gimbal lock is away, at which the others may go anywhere.
    """
    dt = np.diff(times)[:, None]
    fastest = np.maximum(np.abs(turns.rates[1:]), np.abs(turns.rates[:-1])) * dt
    expected = 0.5 * (turns.rates[1:] + turns.rates[:-1]) * dt
    deviation = np.abs(np.diff(turns.angles, axis=0) - expected)
    wide = np.any((fastest > FAR) | (deviation > OFF), axis=1)
    if turns.angles.shape[1] == THREE:
        least, most = (end(turns.free[1:], turns.free[:-1]) for end in (np.minimum, np.maximum))
        wide = (wide | (fastest[:, 1] > most)) & (least > LOCKED)
    return wide
