"""Checks each answer of an engine before it is believed: the engine may be anybody's."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from numbers import Real
from typing import Any, get_args

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.states import MASS_MATRIX, coordinates
from ....cases.trajectory import Array, Trajectory
from ....engines.engine import (
    Diverged,
    Engine,
    Plain,
    Plan,
    Realised,
    Refusal,
    Shape,
    Start,
    Tunable,
)
from ....engines.knobs import Knob, Options
from .table_text import spelled

WAYS = get_args(Realised)
AROUND = 2.0  # steps: a record may begin between two, and end with one that is behind the samples
SAME = 1e-9  # of the duration: times that differ less are the same, rounded otherwise


class BadAnswer(Exception):
    """An engine answered with something else than the protocol says."""


def plans(engine: Engine, scene: Scene, start: Start) -> tuple[Plan | Refusal, ...]:
    """Asks an engine for its plans, each way once. Raises BadAnswer."""
    answer: Any = engine.plans(scene, start)
    if not isinstance(answer, Sequence) or isinstance(answer, str):
        raise BadAnswer(f"plans should be a list of plans and refusals, is {_kind(answer)}")
    ways = tuple(map(_way, answer))
    if not ways:
        raise BadAnswer("plans is empty: a scene that is not run is refused")
    names = [way.realised for way in ways]
    for name in names:
        if names.count(name) > 1:
            raise BadAnswer(f"plans has {names.count(name)} ways that are realised as {name!r}")
    return ways


def _way(way: Any) -> Plan | Refusal:
    if not isinstance(way, Plan | Refusal):
        raise BadAnswer(f"plans should hold plans and refusals, holds {_kind(way)}")
    if not isinstance(way.realised, str) or way.realised not in WAYS:
        wanted = f"one of {', '.join(WAYS)}, is {spelled(repr(way.realised), 50)}"
        raise BadAnswer(f"realised should be {wanted}")
    if isinstance(way, Refusal):
        return replace(way, because=spelled(way.because))
    for exponents in (way.held, way.following or ()):
        if not all(isinstance(exponent, int | float) and exponent > 0 for exponent in exponents):
            raise BadAnswer(f"exponents should be numbers, are {spelled(repr(exponents), 50)}")
    if not isinstance(way.withheld, Mapping):
        raise BadAnswer(f"withheld should say why by quantity, is {_kind(way.withheld)}")
    withheld = {name: spelled(because) for name, because in way.withheld.items()}
    return replace(way, withheld=withheld, simplified=spelled(way.simplified))


def moved(trajectory: Any, scene: Scene, times: Array) -> Trajectory:
    """Checks a run's trajectory. Raises BadAnswer where it is another than was asked for."""
    if not isinstance(trajectory, Trajectory):
        raise BadAnswer(f"run should give a trajectory, gives {_kind(trajectory)}")
    _check_rows("times", trajectory.times, times.shape)
    if not np.all(np.abs(trajectory.times - times) <= SAME * times[-1]):
        raise BadAnswer("run gives other times than were asked for")
    _check_states("states", trajectory, scene)
    if trajectory.record is not None:
        _recorded(trajectory.record, scene, times)
    return trajectory


def _recorded(record: Any, scene: Scene, times: Array) -> None:
    """Raises BadAnswer for another record than one from the first sample to the last."""
    if not isinstance(record, Trajectory):
        raise BadAnswer(f"record should be a trajectory, is {_kind(record)}")
    steps = record.times
    _check_rows("times of the record", steps, (steps.size if isinstance(steps, np.ndarray) else 0,))
    # Two rows may be of one time, before and after a stop. Of NaN this is not so.
    if not (len(steps) > 1 and steps[0] < steps[-1] and np.all(np.diff(steps) >= 0.0)):
        raise BadAnswer("times of the record should rise from step to step")
    ends = np.abs(np.array([steps[0] - times[0], steps[-1] - times[-1]]))
    if not np.all(ends <= AROUND * np.max(np.diff(steps))):  # as a protocol reads it
        raise BadAnswer("the record should last from the first sample to the last")
    _check_states("states of the record", record, scene)
    for body, rows in record.states.items():
        if not np.all(finite := np.all(np.isfinite(rows), axis=1)):
            at = float(steps[np.argmin(finite)])
            raise Diverged(f"{body} is not finite in the record from t = {at:.4g} s on")


def claimed(answer: Any, wanted: Sequence[str], scene: Scene, count: int) -> dict[str, Array]:
    """The wanted quantities of so many states. Raises BadAnswer where one is not told.

    Whatever else is told is nothing that was asked for.
    """
    values, entries = by_quantity(answer), len(coordinates(scene)) ** 2
    for name in wanted:
        if name not in values:
            raise BadAnswer(f"answer tells nothing of {name}, and not why")
        if isinstance(values[name], str):
            raise BadAnswer(f"answer withholds {name} of all states, and told it of one")
        shape: tuple[int, ...] = (count * entries,) if name == MASS_MATRIX else (count,)
        turned = name.rpartition(".")[2] == "attitude"
        _check_rows(f"{name} of {count} states", values[name], (count, 4) if turned else shape)
    return {name: values[name] for name in wanted}


def by_quantity(answer: Any) -> Mapping[str, Any]:
    """Checks that an answer about states is a mapping. Raises BadAnswer."""
    if not isinstance(answer, Mapping):
        raise BadAnswer(f"answer should tell each quantity by its name, tells {_kind(answer)}")
    return answer


def _check_states(what: str, motion: Trajectory, scene: Scene) -> None:
    if not isinstance(motion.states, Mapping) or set(motion.states) != set(scene.bodies):
        wanted = ", ".join(scene.bodies)
        has = spelled(", ".join(map(str, motion.states)), 50) if motion.states else "nothing"
        raise BadAnswer(f"{what} should be those of {wanted}, are of {has}")
    for body, rows in motion.states.items():
        _check_rows(f"{what} of {body}", rows, (len(motion.times), scene.frame.width))
    for name, rows in motion.reactions.items():
        _check_rows(f"{spelled(name, 50)}", rows, (len(motion.times),))


def _check_rows(what: str, rows: Any, shape: tuple[int, ...]) -> None:
    hides = isinstance(rows, np.ma.MaskedArray)  # numbers that it does not vouch for
    if not isinstance(rows, np.ndarray) or rows.dtype.kind not in "fiu" or hides:
        raise BadAnswer(f"{what} should be an array of numbers, is {_kind(rows)}")
    if rows.shape != shape:
        raise BadAnswer(f"{what} should have the shape {shape}, has {rows.shape}")


def read_back(numbers: Any, known: Mapping[str, float]) -> dict[str, float]:
    """The audit's numbers. Raises BadAnswer for what is none, and where there are none."""
    if not isinstance(numbers, Mapping):
        raise BadAnswer(f"measure should give numbers by name, gives {_kind(numbers)}")
    for name, number in numbers.items():
        if name not in known:
            raise BadAnswer(
                f"measure tells {spelled(repr(name), 50)}, which the case does not have"
            )
        if not isinstance(number, Real):
            raise BadAnswer(f"measure tells {name}, and it is no number: {_kind(number)}")
    if not numbers:
        raise BadAnswer("measure reads no number back: nothing shows that the physics is equal")
    return {name: float(number) for name, number in numbers.items()}


def tunable(engine: Tunable, scene: Scene, start: Start) -> Options:
    """The engine's recipe. Raises BadAnswer where one of its words on tuning is not what it is."""
    options: Any = engine.recipe(scene, start)
    knobs: Any = engine.knobs(scene, start)
    if not isinstance(options, Mapping) or not _plain(options):
        raise BadAnswer(f"recipe should be options as a file has them, is {_kind(options)}")
    if not isinstance(knobs, Sequence) or not all(isinstance(knob, Knob) for knob in knobs):
        raise BadAnswer(f"knobs should be a list of knobs, is {_kind(knobs)}")
    dear: Any = engine.cost(scene, start)
    if not callable(dear):
        raise BadAnswer(f"cost should be a function of options and a step, is {_kind(dear)}")
    for step in engine.steps:
        cost: Any = dear(options, step)
        if not isinstance(cost, Real) or not 0.0 < float(cost) < math.inf:
            raise BadAnswer(f"cost should be a number above 0, is {spelled(repr(cost), 50)}")
        text: Any = engine.snippet(scene, start, options, step)
        if not isinstance(text, str):
            raise BadAnswer(f"snippet should be text, is {_kind(text)}")
    if isinstance(engine, Plain):
        _shaped(engine, scene, start)
    return options


def _shaped(engine: Plain, scene: Scene, start: Start) -> None:
    """Raises BadAnswer where the shapes that a user has are not told as the protocol says."""
    shapes: Any = engine.shapes(scene, start)
    if not isinstance(shapes, Sequence) or not all(isinstance(shape, Shape) for shape in shapes):
        raise BadAnswer(f"shapes should be a list of shapes, is {_kind(shapes)}")
    for value in shapes:
        if not isinstance(value.options, Mapping) or not _plain(value.options):
            raise BadAnswer(f"shapes should have options as a file has them, {_kind(value)}")
    words: Any = engine.own_contacts(scene)
    if not isinstance(words, str):
        raise BadAnswer(f"own_contacts should be text, is {_kind(words)}")


def _plain(options: Any) -> bool:
    try:
        json.dumps(options)
    except (TypeError, ValueError):
        return False
    return True


def _kind(value: Any) -> str:
    if isinstance(value, np.ndarray) and not isinstance(value, np.ma.MaskedArray):
        return f"an array of {value.dtype}"
    return f"{spelled(repr(value), 50)}" if value is None else f"a {type(value).__name__}"
