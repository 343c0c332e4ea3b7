"""The steps that a run asks of the engines, counted before any is taken."""

import multiprocessing
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from ....cases.case import Case
from ....cases.language.check.work import GO_ON, LIMIT
from ....cases.mistake import Mistake
from ....cases.scene import Scene
from ....engines import foreign
from ....engines.engine import Engine, Paced
from ....engines.probe import apart, guarded
from .ladder import RUNGS_DOWN, judged_step

STEPS = 20_000_000  # of an engine for a file, all of its variants
PATIENCE = 5.0  # s: an answer that takes longer is none
STEP, BODY = 25e-6, 1.5e-6  # s: what a step takes, and for each body, if an engine does not say
KEPT = 5_000_000  # rows of bodies that a run with events holds: 250 MB

UPWARD = 4  # steps of a case: two ladders h, 2h, 4h, … of which none is twice its finest rung
DOWNWARD = 2**RUNGS_DOWN - 1  # an engine's own step h: h, h/2, …


def too_long(cases: Sequence[Case], engines: Sequence[Engine]) -> list[Mistake]:
    """A mistake for each file and engine with too many steps; none where the case allows it."""
    files: dict[str, list[Case]] = {}
    for case in cases:
        if not case.long:
            files.setdefault(case.source.file, []).append(case)
    return [m for group in files.values() for engine in engines for m in _too_long(group, engine)]


def _too_long(cases: Sequence[Case], engine: Engine) -> Iterator[Mistake]:
    """Yields a mistake at the variant that asks for most, if it is too much."""
    counts = [_steps(case, engine) for case in cases]
    steps, most = sum(counts), cases[counts.index(max(counts))]
    if steps > STEPS:
        yield _mistake(most, engine, f"{steps:.3g} steps", f"{STEPS:g}")
        return
    seconds = [count * pace(case, engine) for count, case in zip(counts, cases, strict=True)]
    if max(seconds) > LIMIT:
        most, count = max(zip(cases, counts, strict=True), key=lambda pair: pair[1])
        what = f"{count:.3g} steps, which take {about(max(seconds))}"
        yield _mistake(most, engine, what, f"{LIMIT / 60:g} minutes")
    kept = [_kept_rows(case, engine) for case in cases]
    most = cases[kept.index(max(kept))]
    if max(kept) > KEPT:
        yield _mistake(most, engine, f"{max(kept):.3g} rows kept for the events", f"{KEPT:g}")


def about(seconds: float) -> str:
    """Returns a time in words of the right size."""
    minutes = seconds / 60
    for size, unit in ((60 * 24 * 365, "years"), (60 * 24, "days"), (60, "hours")):
        if minutes > 2 * size:
            return f"about {minutes / size:.2g} {unit}"
    return f"about {minutes:.0f} minutes"


def _mistake(case: Case, engine: Engine, what: str, limit: str) -> Mistake:
    h, who = judged_step(case, engine), f"{engine.name}.{engine.setting}"
    said = engine.own_step is None and ("step",) in case.source.places
    return case.mistake(
        ("step",) if said else ("duration",),
        f"{case.duration:g} s at {who}'s step {h:.3g} s, with all steps of its ladder, are {what}, "
        f"and the limit is {limit}: {GO_ON}",
    )


def pace(case: Case, engine: Engine) -> float:
    """Estimates how long a step takes [s]."""
    usual = STEP + BODY * len(case.scene.bodies)
    if not isinstance(engine, Paced):
        return usual
    name = engine.name, engine.setting, engine.version
    measured = _own_pace(_Asked((*name, case.name, case.source.file), engine, case.scene))
    return measured if measured is not None and 0.0 < measured < LIMIT else usual


@dataclass(frozen=True)
class _Asked:
    """Names whom and which case: an engine is anybody's, and cannot tell if it is another."""

    of: tuple[str, ...]
    engine: Paced = field(compare=False)
    scene: Scene = field(compare=False)


@lru_cache(10_000)  # of somebody else's engine a process is asked, and each run asks again
def _own_pace(asked: _Asked) -> float | None:
    if not foreign(asked.of[0]) or multiprocessing.current_process().daemon:
        return guarded(lambda: _number(asked))[0]
    if threading.current_thread() is not threading.main_thread():
        return None  # two threads that look at children lose one's end
    return apart(_number, asked, most=PATIENCE)[0]


def _number(asked: _Asked) -> float:
    return float(asked.engine.pace(asked.scene))


def _steps(case: Case, engine: Engine) -> float:
    """Number of engine steps over all ladders of one realisation; 0 for a claim about states."""
    if case.states is not None:
        return 0.0
    rungs = UPWARD if engine.own_step is None else DOWNWARD
    return rungs * case.duration / judged_step(case, engine)


def _kept_rows(case: Case, engine: Engine) -> float:
    """Rows of bodies at every step of the finest rung, from which events are read."""
    finest = 1 if engine.own_step is None else 2 ** (RUNGS_DOWN - 1)
    bodies = len(case.scene.bodies) if case.events else 0
    return bodies * finest * case.duration / judged_step(case, engine)
