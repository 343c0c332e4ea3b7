"""A claim about states before an engine: asked once, without a step and so without a ladder."""

from dataclasses import replace

from ....cases.case import Case
from ....cases.mistake import CaseError
from ....cases.trajectory import Array
from ....engines.engine import Claims, Engine, Plan, Refusal, Start
from .answers import by_quantity
from .run import Rung
from .table_text import spelled, why
from .trial import Trial, planned

SILENT = "adapter: it offers no answers about states"
AT = ("states", 0.0)  # where the only run of such a trial belongs


def moving(case: Case) -> Case:
    """The case, of which something can be run. Raises CaseError for a claim about states."""
    if case.states is None:
        return case
    raise CaseError([case.mistake(("states",), "is a claim about states: nothing is run")])


def ways_of(engine: Engine, case: Case, start: Start) -> tuple[Plan | Refusal, ...]:
    """Returns the ways in which a case is tried; what an engine raises is a way that fails."""
    if case.states is None:
        return planned(engine, case.scene, start)
    try:
        return ways(engine, case, start)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        return (Refusal("native", why(error)),)


def ways(engine: Engine, case: Case, start: Start) -> tuple[Plan | Refusal, ...]:
    """The engine's own answer, or why there is none; it is asked of one state what it withholds."""
    if not isinstance(engine, Claims):
        return (Refusal("native", SILENT),)
    alone = replace(case.scene, forces={})  # nothing moves: what acts is asked for by itself
    way = next(way for way in planned(engine, alone, start) if way.realised == "native")
    if isinstance(way, Refusal):
        return (way,)
    answer = engine.answer(case.scene, start, _drawn_states(case, 1), tuple(case.allow))
    because = {name: what for name, what in by_quantity(answer).items() if isinstance(what, str)}
    whys = {name: spelled(what) for name, what in because.items()}
    return (Plan("native", held=(), withheld=whys),)


def rung(trial: Trial) -> Rung:
    """Returns the one run of a claim about states: all of them at once."""
    most = dict.fromkeys(trial.motion, float("inf"))
    return Rung(trial.case, trial.engine, trial.start, trial.plan, trial.case.duration, most)


def _drawn_states(case: Case, count: int) -> dict[str, Array]:
    assert case.states is not None
    return {name: rows[:count] for name, rows in case.states.drawn(case.scene).items()}
