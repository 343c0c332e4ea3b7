"""What the reference costs: its integrators beside scipy's, and scenes of many bodies."""

import json
import math
import time
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

import numpy as np
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.trajectory import Array
from textmech.reference.integrators.march import integrate
from textmech.reference.motion.follow import either
from textmech.reference.motion.stuck import slope
from textmech.reference.solve import solve
from textmech.reference.system import Mode
from textmech.reference.systems import SYSTEMS
from textmech.reports.runs.selection import choose_cases

from .row import Row, Work, in_turn, ratio

ERRORS = {  # of the case, in its units: what all methods but the slowest reach
    "double_pendulum": 1e-9,
    "four_bar": 1e-9,
    "rhombus": 1e-9,
    "dynamometer_smooth": 1e-8,  # the stiff one
}
AIM = 0.5  # of our integrator's CPU time over that of the best of scipy's methods
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(12, 27))  # scipy takes none below 1e-13
HOPELESS = 4  # times as long as ours at a looser tolerance: it is not the best
MOST = 1_000_000  # steps
Name = Literal["DOP853", "LSODA", "Radau"]
SCIPYS: tuple[Name, ...] = ("DOP853", "LSODA", "Radau")
Method = Callable[[float], Array]


def integrators(rounds: int) -> Iterator[Row]:
    """Yields a row for each of ERRORS: ours over the fastest of scipy's that reaches the error.

    Each takes the loosest of TOLERANCES, half a power of ten apart, at which it reaches the error.
    """
    for name, error in ERRORS.items():
        yield _compared(choose_cases([name])[0], error, rounds)


def _compared(case: Case, error: float, rounds: int) -> Row:
    assert case.system
    mode = SYSTEMS[case.system](**case.parameters)
    assert isinstance(mode, Mode)
    f, y0 = slope(mode), np.concatenate(mode.start())

    def ours(tolerance: float) -> Array:
        method = either(mode, f, len(y0), tolerance=tolerance)
        return integrate(method, case.times, y0, most=MOST).y

    def scipys(name: Name, tolerance: float) -> Array:
        span = (0.0, case.duration)
        return solve_ivp(f, span, y0, name, case.times, rtol=tolerance, atol=tolerance).y.T

    truth, patience = ours(TOLERANCES[-1] / 100), math.inf
    methods: dict[str, Method] = {"ours": ours, **{n: partial(scipys, n) for n in SCIPYS}}
    works: dict[str, Callable[[int], Work]] = {}
    for name, method in methods.items():
        tolerance, seconds = loosest(method, truth, error, patience)
        if tolerance:
            works[name] = partial(_at, method, tolerance)
        if name == "ours":
            patience = HOPELESS * seconds
    part, title = "integrator", f"{case.name} to {error:.0e}"
    if "ours" not in works or len(works) == 1:
        return Row(part, title, note=f"reached only by {', '.join(works) or 'none'}")
    seconds = dict(zip(works, in_turn(list(works.values()), rounds), strict=True))
    own = seconds.pop("ours")
    best = min(seconds, key=lambda name: float(np.median(seconds[name])))
    return Row(part, title, best, float(np.median(own)), *ratio(own, seconds[best]), AIM)


def _at(method: Method, tolerance: float, _: int) -> Work:
    return lambda: method(tolerance)


def loosest(
    method: Method, truth: Array, error: float, patience: float = math.inf
) -> tuple[float | None, float]:
    """Returns the loosest tolerance at which a method reaches the error, and its CPU seconds.

    None: it does not, or takes longer than the patience [s].
    """
    seconds = math.nan
    for tolerance in TOLERANCES:
        before = time.process_time()
        reached = float(np.max(np.abs(method(tolerance) - truth)))
        seconds = time.process_time() - before
        if reached <= error:
            return tolerance, seconds
        if seconds > patience:
            break
    return None, seconds


SOLVED = 60.0  # CPU s: of a machine half as fast as that on which the slowest takes 20
LINKS: dict[bool, dict[str, Any]] = {  # by whether in space, where a slender bar turns about itself
    False: {"bar": {"mass": 1.0, "length": 0.1}},
    True: {
        "rigid": {"mass": 1.0, "inertia": [1e-3, 1e-3, 1e-4, 0, 0, 0]},
        "points": {"start": [-0.05, 0, 0], "end": [0.05, 0, 0]},
    },
}


def scenes(counts: Mapping[bool, int] | None = None) -> Iterator[Row]:
    """Yields a row for a chain of many bodies in the plane and in space, read and certified."""
    for space, count in (counts or {False: 40, True: 10}).items():
        with TemporaryDirectory() as folder:
            file = Path(folder) / "chain.yaml"
            file.write_text(json.dumps(chain(count, space=space)), encoding="utf-8")
            before = time.process_time()
            (case,) = load(file)
            holds = solve(case).holds
            seconds = time.process_time() - before
        name = f"chain of {count} bodies in {'space' if space else 'the plane'}"
        note = "" if holds else "the certificate does not hold"
        yield Row("scene", name, seconds=seconds, aim=SOLVED, note=note, wrong=not holds)


def chain(count: int, *, space: bool) -> dict[str, Any]:
    """Returns the case file of bodies in a row that hangs on the ground."""
    ends = ["ground.O", *(f"b{i}.end" for i in range(count))]
    pairs = [[ends[i], f"b{i}.start"] for i in range(count)]
    joints = {
        f"j{i}": {"hinge": pair, "axis": [0, 1, 0]} if space else {"pin": pair}
        for i, pair in enumerate(pairs)
    }
    start = {"angle": 0.1, "omega": 0} if space else {"angle": 0.1}
    return {
        "title": "A chain falls",
        "scene": {
            **({"space": 3} if space else {}),
            "points": {"O": [0, 0, 0] if space else [0, 0]},
            "bodies": {f"b{i}": LINKS[space] for i in range(count)},
            "joints": joints,
        },
        "initial": dict.fromkeys(joints if space else [f"b{i}" for i in range(count)], start),
        "duration": 1.0,
        "samples": 26,
        "allow": {"j0.angle" if space else "b0.angle": 1e-2},
    }
