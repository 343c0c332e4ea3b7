"""Lines of `textmech advise`: plain numbers, two recipes, their price, and what to paste."""

import time
from collections.abc import Iterator, Sequence

import numpy as np

from ....engines.engine import Diverged, Plain, Tunable
from ....engines.knobs import as_text
from ...compare.judge.figures import plain
from ...compare.trial.start import first
from ...compare.trial.trial import Trial
from ...runs.tasks import Pair
from ...search.advice.advice_rows import BOTH, Advised, rows, settings, words
from ...search.advice.recipe import Recipe, front
from ...search.causes.candidate import Candidate
from ...search.causes.errors import trial_of
from ...tables.short_numbers import factor, milliseconds

HEADS = {BOTH: "fewest changes, and cheapest"}


def shipped_lines(one: Advised) -> Iterator[str]:
    """Yields what a person sees of one case in one engine as shipped, before any search."""
    yield ""
    if one.search is None:
        yield f"{_name(one)}: refused: {rows(one)[0].remains}"
        return
    yield f"{_name(one)}, as shipped, {milliseconds(one.shipped.step)}"
    yield from _measured_on(one)
    yield from _found(one, one.shipped)


def stopped_lines(one: Advised) -> Iterator[str]:
    """Yields the nearest of all that was tried before the search was interrupted."""
    for candidate in one.pasted:
        runs = 0 if one.search is None else len(one.search.runs.known)
        yield ""
        yield f"{_name(one)}: interrupted after {runs} run{'s' * (runs > 1)}; the nearest so far"
        yield from _found(one, candidate)
        yield from _paste(one, candidate)


def _name(one: Advised) -> str:
    return f"{one.pair.case.name} in {one.pair.engine.name} {one.pair.engine.version}"


def advice_lines(one: Advised) -> Iterator[str]:
    """Yields the advice on one case in one engine, line by line."""
    if one.search is None:
        return
    tolerance, margin = one.asked.tolerance, one.asked.margin
    within = "its tolerances" if tolerance is None else f"{tolerance:g} of its size"
    yield ""
    yield f"{_name(one)}: all within {within} / {margin:g}"
    if one.recipes is None:
        yield f"  no recipe: {rows(one)[0].remains}"
        if ours := " and ".join(one.search.candidates.ours):
            yield f"    not tried, for it takes our adapter, as `run --causes` does: {ours}"
        for candidate in one.pasted:
            yield "  the nearest"
            yield from _found(one, candidate)
            yield from _paste(one, candidate)
    for want, recipe in one.wanted:
        step = milliseconds(recipe.candidate.step)
        yield f"  {HEADS.get(want, want)}: {words(recipe.choice)}, {step}"
        yield from _recipe(one, recipe)
    if one.asked.front:
        yield "  cost against error, each point a fifth better at least than what costs less"
        yield from (f"    {line}" for line in _front(one))


def _measured_on(one: Advised) -> Iterator[str]:
    """Yields whose shapes the numbers belong to, where something touches."""
    engine = one.pair.engine
    if one.shapes:
        yield f"  measured as a user has it: {one.shapes[0].words}"
        trial = trial_of(one.pair, one.shipped)
        if trial and trial.withheld:
            yield f"    {', '.join(trial.withheld)} not read there"
    elif isinstance(engine, Plain) and (ours := engine.own_contacts(one.pair.case.scene)):
        yield f"  measured in our model alone, where {ours}"


def _recipe(one: Advised, recipe: Recipe) -> Iterator[str]:
    assert one.search is not None
    candidate = recipe.candidate
    yield from _found(one, candidate)
    if candidate in (cut := one.search.elsewhere) and not one.shapes:
        yield f"    with the loop cut at other joints at most {factor(cut[candidate])}"
    cost = one.search.cost(candidate) / one.search.cost(one.shipped)
    measured = ratio(one.pair, candidate, one.shipped)
    beside = "" if measured is None else f", measured here ×{measured:.2g}"
    yield f"    costs ×{cost:.2g} of shipped{beside}"
    yield from _paste(one, candidate)


def _paste(one: Advised, candidate: Candidate) -> Iterator[str]:
    """Yields what it gives on the other shapes that a user may have, and what to paste."""
    engine, scene = one.pair.engine, one.pair.case.scene
    assert isinstance(engine, Tunable)
    for shape, worst, quantity in one.beside.get(candidate, ()):
        lost = f"{quantity} {factor(worst)}" if quantity else "every quantity is lost"
        yield f"    where {shape}: {lost}"
    yield "    to paste"
    start = first(one.pair.reference())
    options = candidate.on(one.pair.shapes).options
    lines = engine.snippet(scene, start, options, candidate.step).rstrip().splitlines()
    yield from (f"      {line}" for line in lines)
    yield "    as a file of --settings"
    yield f"      {settings(one.pair, candidate)}"


def _found(one: Advised, candidate: Candidate) -> Iterator[str]:
    """Yields the numbers that a person asks for, in words, and the worst judged quantity."""
    assert one.search is not None
    trial = trial_of(one.pair, candidate)
    try:
        numbers = plain(trial) if trial else []
    except Diverged as gone:
        yield f"    {gone}"
        return
    if numbers:
        yield f"    {'; '.join(map(str, numbers))}"
    worst, quantity = one.search.worst(candidate)
    yield (
        f"    worst: {quantity} {factor(worst)} of what is allowed"
        if quantity
        else ("    every quantity is lost")
    )


def _front(one: Advised) -> Sequence[str]:
    assert one.search is not None
    return [
        f"{one.search.cost(candidate):9.4g} /s  ×{worst:<8.2g} {quantity:20} "
        f"h = {candidate.step:.3g} s  {as_text(candidate.options)}"
        for candidate, worst, quantity in front(one.search)
    ]


# Measures what a simulated second of a candidate costs over another's, in CPU time.


ROUNDS = 3  # in turn; the least of each counts
LONG = 0.05  # s: what is shorter is run as often as fills it, for its least time to be found


def ratio(pair: Pair, candidate: Candidate, over: Candidate) -> float | None:
    """CPU time of all steps of the candidate's run over the other's; None where one is refused."""
    one, other = (trial_of(pair, each) for each in (candidate, over))
    if one is None or other is None:
        return None
    measured = [(_whole(one), _begun(one), _whole(other), _begun(other)) for _ in range(ROUNDS)]
    mine, built, others, too = (min(column) for column in zip(*measured, strict=True))
    return (mine - built) / (others - too)


def _whole(trial: Trial) -> float:
    return _seconds(trial, trial.case.duration)


def _begun(trial: Trial) -> float:
    """CPU time [s] of building alone, and one step: to be taken off."""
    return _seconds(trial, trial.step)


def _seconds(trial: Trial, end: float) -> float:
    times, spent = np.array([0.0, end]), list[float]()
    while sum(spent) < LONG:
        begun = time.process_time()
        trial.engine.run(trial.case.scene, trial.start, times, trial.step, trial.plan, reactions=())
        spent.append(time.process_time() - begun)
    return min(spent)
