"""Statics of one body by points, planes and cones: a linear programme for each force."""

import math
from typing import Any

import numpy as np
from scipy.optimize import linprog


def spans(points: Any, mus: Any, load: Any) -> list[tuple[float, float]] | None:
    """Of each contact (place, normal) its normal and its tangent force, least and largest.

    load: force and moment about the origin that they hold. None where nothing holds it.
    """
    columns, cones = [], []
    for k, ((x, y), (nx, ny)) in enumerate(points):
        for ux, uy in ((nx, ny), (ny, -nx)):  # the normal, and what has it to its left
            columns.append([ux, uy, x * uy - y * ux])
        for sign in (1.0, -1.0):
            cone = np.zeros(2 * len(points))
            cone[2 * k : 2 * k + 2] = -mus[k], sign
            cones.append(cone)
    n, found = 2 * len(points), []
    limits: Any = [(0, None), (None, None)] * len(points)
    for k in range(n):
        ends = []
        for sign in (1.0, -1.0):
            out: Any = linprog(
                sign * np.eye(n)[k], A_ub=cones, b_ub=np.zeros(len(cones)),
                A_eq=np.transpose(columns), b_eq=-np.asarray(load), bounds=limits,
            )  # fmt: skip
            if out.status == 2:
                return None
            ends.append(sign * out.fun if out.status == 0 else sign * -math.inf)
        found.append((ends[0], ends[1]))
    return found
