"""The whole way: what a case asks, over its samples and at its events."""

from typing import Any

import numpy as np

from second.model import Model
from second.motion import Motion, State, moved
from second.moving import Array
from second.quantities import asked
from second.sites import sites
from second.start import start
from second.switching import followed


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
