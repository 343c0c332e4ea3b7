"""What a case asks, by the second reading: its motion, and its events."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq

from second.contacts import sites
from second.equations import redundant, solve
from second.model import Model
from second.motion import Motion, Piece, State, moved, smooth
from second.moving import Array
from second.quantities import asked
from second.start import start
from second.switching import followed

# The whole way: what a case asks, over its samples and at its events.


def works(model: Model, names: list[str]) -> tuple[str, ...]:
    """The parts whose work is asked."""
    return tuple(name.split(".")[0] for name in names if name.endswith(".work"))


def begun(case: dict[str, Any]) -> tuple[Model, State, Array]:
    """The model of a case, and the numbers with which its motion starts."""
    model = Model(case["scene"])
    x, u, turned = start(model, case.get("initial") or {}, case.get("near") or {})
    state = State(model, works(model, case["allow"]))
    inner = [model.forces[name]["contractile_length"] for name in model.inner]
    return model, state, np.concatenate([x, u, turned, inner, np.zeros(len(state.works))])


def switches(model: Model) -> bool:
    """Whether something may open, stick, or become slack."""
    return bool(sites(model)) or any("only" in told for told in model.forces.values())


def motion(case: dict[str, Any]) -> Motion:
    """The motion of a case."""
    model, state, y = begun(case)
    if switches(model):
        return followed(model, y, state, case["duration"], int(case["samples"]))
    return moved(model, y, state, case["duration"], int(case["samples"]))


def observed(motion: Motion, name: str) -> Array:
    """A quantity over the samples."""
    state, first = motion.state, motion.samples[0][0]
    values = []
    for now, solved in motion.samples:
        beside: dict[str, Any] = {"start": first}
        if name.endswith(".work"):
            piece = next(p for p in motion.pieces if now.t <= p.end)
            beside["works"] = dict(zip(state.works, np.split(piece.at(now.t), state.cuts)[4],
                                       strict=True))  # fmt: skip
        values.append(asked(now, solved, name, beside))
    return np.array(values)


# Events: when a quantity crosses a value, stays zero or leaves it, and what is there.

FINE = 12  # readings of a quantity between two samples
ZERO = 1e-9  # of its largest value: what is left of a zero


def read(motion: Motion, piece: Piece, name: str) -> Callable[[float], float]:
    """A quantity over one piece of a motion."""
    several = redundant(motion.samples[0][0], smooth(motion.samples[0][0]))

    def at(t: float) -> float:
        now = motion.state.now(t, piece.at(t))
        mode = piece.mode
        solved = mode.solved(now) if mode else solve(now, smooth(now), redundant=several)
        return float(asked(now, solved, name, {"start": motion.samples[0][0]}))

    return at


def readings(motion: Motion, name: str) -> list[tuple[Array, Array, Callable[[float], float]]]:
    """A quantity at some times of each piece, and at any."""
    found = []
    h = motion.times[1] / FINE
    for piece in motion.pieces:
        if piece.end > piece.start:
            at = read(motion, piece, name)
            times = np.linspace(piece.start, piece.end, 2 + int((piece.end - piece.start) / h))
            found.append((times, np.array([at(t) for t in times]), at))
    return found


def times(motion: Motion, told: dict[str, Any]) -> list[float]:
    """When an event happens."""
    (name, rule), *_ = told.items()
    pieces = readings(motion, name)
    small = ZERO * max(float(np.max(np.abs(u))) for _, u, _ in pieces)
    if rule in ("stays zero", "leaves zero"):
        rests = [bool(np.all(np.abs(u) <= small)) for _, u, _ in pieces]
        wanted = (False, True) if rule == "stays zero" else (True, False)
        return [
            float(t[0])
            for (t, *_), before, after in zip(pieces[1:], rests, rests[1:], strict=False)
            if (before, after) == wanted
        ]
    sign, value = 1.0, 0.0
    if isinstance(rule, dict):
        (rule, value), *_ = rule.items()
    if rule in ("rises to zero", "rises to"):
        sign = -1.0
    elif rule not in ("falls to zero", "falls to"):
        raise ValueError(rule)
    found = []
    for t, u, at in pieces:
        v = sign * (u - value)
        v[np.abs(v) <= small] = 0.0
        for i in range(len(t) - 1):
            if v[i] > 0 and v[i + 1] < 0:
                found.append(brentq(lambda s, at=at: at(s) - value, t[i], t[i + 1], xtol=1e-13))
            elif v[i] > 0 and v[i + 1] == 0:
                found.append(float(t[i + 1]))
    return found


def beside(motion: Motion, name: str, t: float, side: str) -> float:
    """A quantity at an event, before or after it where it jumps."""
    pieces = [p for p in motion.pieces if p.start <= t <= p.end and p.end > p.start]
    return read(motion, pieces[-1] if side == "after" else pieces[0], name)(t)
