"""What the reference answers, for comparison: the only file here that imports textmech."""

from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from given import scenes

from second import geometry, read
from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import at_event
from textmech.reference.solve import Solution, solve
from textmech.reports.compare.events.states import reference_states
from textmech.reports.compare.events.times import reference_events

FILES = [Path(path) for path in shipped().values()]
EVERY = scenes.EVERY
"""Every shipped case, as the suite reads it: which of them a test asks for is no answer."""
_file = cache(read.file)


def reread(name: str) -> dict[str, Any]:
    """A shipped case, read a second time."""
    (path,) = (path for path in FILES if path.stem == name.partition(".")[0])
    return _file(path)[name]


class Answer(NamedTuple):
    """A case as the suite reads it, and what the reference says of it."""

    case: Case
    solution: Solution


def stored(name: str) -> Answer:
    """What the reference says of a shipped case."""
    return Answer(EVERY[name], scenes.solved(name))


def solved(path: Path) -> dict[str, Answer]:
    """What the reference says of the cases of a file."""
    return {case.name: Answer(case, solve(case)) for case in load(path)}


def stated(answer: Answer, name: str) -> float:
    """The reference's own error of a quantity, as it states it."""
    return next(c.certified or 0.0 for c in answer.solution.checks if c.name == f"error of {name}")


def answered(answer: Answer, name: str) -> np.ndarray:
    """A quantity of the reference's motion; attitudes as matrices."""
    values = np.asarray(observe(answer.case.scene, answer.solution.trajectory, name))
    if name.endswith(".attitude") and values.shape[-1] == 4:
        return np.array([geometry.of_quaternion(q) for q in values])
    return values


def happened(answer: Answer, event: str) -> list[float]:
    """The times of an event in the reference's motion."""
    trajectory = answer.solution.trajectory
    record = trajectory.record or trajectory
    return reference_events(answer.case.scene, record, answer.case.events[event]).tolist()


def beside(answer: Answer, name: str) -> list[float]:
    """What a quantity is in the reference's motion whenever an event happens."""
    at = at_event(name, answer.case.events)
    record = answer.solution.trajectory.record
    assert at is not None
    assert record is not None
    times = np.array(happened(answer, at.event))
    return reference_states(answer.case, record, at, times).tolist()
