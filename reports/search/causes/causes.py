"""The causes of a run's rows, searched where they have to be: all pairs at once.

A cause is a fact about a scene, a setting, an engine's version and our adapter: where none of these
is another than that of a committed row, nor the error that it explains, it is that row's. An engine
that was built anew under its version may still be another one: then some verdict on the case is.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

from .... import engines
from ....engines.engine import Tunable
from ....engines.knobs import Options, as_text
from ....reference.solve import Solution
from ...compare.trial.ladder import judged_step
from ...compare.trial.start import first
from ...runs.task_results import Results
from ...runs.tasks import Pair, solved
from ...tables.row import UNSEARCHED, Cause, Comparison, Known, Rungs, StepError, as_written
from .candidate import Candidate
from .cause_rows import NONE, NOTHING, Cost, by_ladder, by_ours, by_search, climbed, without
from .change import STEP, Field, halved, knob_changes, presets, rest
from .cures import cured
from .search import Runs, at_own_samples, lost, together
from .why import Key, Rows, key_of

LETTERS = 12  # of a word: two searches never share them
Where = tuple[str, str, str]
"""A pair's case, engine and setting."""


def causes(
    comparisons: Sequence[Comparison],
    steps: Sequence[StepError],
    ladders: Sequence[Rungs],
    pairs: Iterable[Pair],
    results: Results,
    *,
    search: bool,
    known: Known | None = None,
) -> list[Cause]:
    """For every row above its tolerance: what brings it within; search: whether runs are made.

    known: what is carried over where it stands on the same.
    """
    rows, by_where = Rows(comparisons, ladders), {_where(pair): pair for pair in pairs}
    off = {key_of(row): row for row in rows.off()}
    by_row = {key: by_ours(row, ours) for key, row in off.items() if (ours := rows.ours(row))}
    unexplained = {key: row for key, row in off.items() if key not in by_row}
    states = {case for (case, _, _), pair in by_where.items() if pair.case.states is not None}
    by_row |= {key: [without(off[key], NOTHING)] for key in unexplained if key[0] in states}
    if search:
        asked = {key[:3]: by_where[key[:3]] for key in unexplained if key[:3] in by_where}
        words = {where: _word(pair, results) for where, pair in asked.items()}
        for cause in by_ladder([*unexplained.values()], steps, ladders):
            options = _own(asked[key_of(cause)[:3]]) if key_of(cause)[:3] in asked else {}
            by_row[key_of(cause)] = [replace(cause, options=as_text(options))]
        carried = _carried(unexplained, comparisons, words, known) if known else {}
        by_row |= carried
        rest = [row for key, row in unexplained.items() if key not in carried]
        for key, cures in _searched(rest, steps, asked, results).items():
            by_row[key] = [replace(cause, searched_with=words[key[:3]]) for cause in cures]
    last = NONE if search else UNSEARCHED
    every = (cause for key, row in off.items() for cause in by_row.get(key, [without(row, last)]))
    return list(dict.fromkeys(every))  # two ways to the same set are one cause


def _where(pair: Pair) -> Where:
    return pair.case.name, pair.engine.name, pair.engine.setting


def _own(pair: Pair) -> Options:
    """The options of a pair's own setting, as a file of settings has them, without the step."""
    engine = pair.engine
    if engine.setting == "tuned" and isinstance(engine, Tunable):
        return engine.recipe(pair.case.scene, first(pair.reference()))
    return {k: v for k, v in getattr(engine, "options", {}).items() if k != "step"}


def _word(pair: Pair, results: Results) -> str:
    """Engine version and key of a search; empty where it has none."""
    word = results.keys.search(pair.case, pair.engine)
    return f"{pair.engine.version} {word[:LETTERS]}" if word else ""


def _carried(
    rows: Mapping[Key, Comparison],
    comparisons: Sequence[Comparison],
    words: Mapping[Where, str],
    known: Known,
) -> dict[Key, list[Cause]]:
    """For each row that is as the known causes found it: all of its causes.

    None of a case in an engine of which some verdict is another one than it was.
    """
    moved = {
        (row.case, row.engine)
        for row in comparisons
        if known.verdicts.get((*key_of(row)[:3], row.realised, row.quantity)) != row.verdict
    }
    return {
        key: list(before)
        for key, row in rows.items()
        if key[:2] not in moved
        and (before := known.causes.get(key))
        and (word := words.get(key[:3]))
        and all(_asked(cause, cause.searched_with) == _asked(row, word) for cause in before)
    }


def _asked(row: Cause | Comparison, word: str) -> tuple[str, float | None, float | None]:
    return word, as_written(row.error), as_written(row.allowed)


def _searched(
    rows: Sequence[Comparison],
    steps: Sequence[StepError],
    pairs: Mapping[Where, Pair],
    results: Results,
) -> dict[Key, list[Cause]]:
    """The causes of each row of a pair that can be searched."""
    of: dict[Where, list[Comparison]] = {}
    for row in rows:
        of.setdefault(key_of(row)[:3], []).append(row)
    tunable = {
        where: pair
        for where, pair in pairs.items()
        if where in of and pair.case.states is None and isinstance(pair.engine, Tunable)
    }
    referenced = _referenced(tunable, results)
    broken = lost(referenced, results)
    searches: dict[Key, Callable[[], list[Cause]]] = {}
    for where, pair in referenced.items():
        if where not in broken:
            field, runs = between(pair), Runs(pair)
            mine = [one for one in steps if (one.case, one.engine, one.setting) == where]
            if not pair.reference().blows.size:  # a ladder tells of one start alone
                for candidate, errors in climbed(field.base, of[where], mine).items():
                    runs.add(candidate, errors)
            asked = partial(_cures, field=field, runs=runs, cost=_cost(pair, field.base))
            searches |= {key_of(row): partial(asked, row) for row in of[where]}
    return together("causes", searches, results)


def _cures(row: Comparison, field: Field, runs: Runs, cost: Cost) -> list[Cause]:
    return by_search(row, cured(field, runs, row.quantity), cost)


def _cost(pair: Pair, base: Candidate) -> Cost:
    """The cost of a candidate over the base's."""
    engine = pair.engine
    assert isinstance(engine, Tunable)
    cost = engine.cost(pair.case.scene, first(pair.reference()))
    return lambda one: cost(one.options, one.step) / cost(base.options, base.step)


def _referenced(pairs: Mapping[Where, Pair], results: Results) -> dict[Where, Pair]:
    """With the samples that the engine's own step meets; their references are in the store."""
    sampled = {where: at_own_samples(pair, results) for where, pair in pairs.items()}
    others = {p.key: p.case for where, p in sampled.items() if p.case is not pairs[where].case}
    answers = results.of("references", solved, others) if others else {}
    lacking = {key for key, answer in answers.items() if not isinstance(answer, Solution)}
    return {where: pair for where, pair in sampled.items() if pair.key not in lacking}


# The changes and the steps that lie between a row's own setting and the tuned one.


ALONE = 16  # times finer: as far as an engine's own ladder goes, or to the tuned setting's step
BESIDE = 4  # times, beside other changes, or to the tuned setting's step
FINEST = 8  # times, of the tuned setting, which has nothing else to be changed


def between(pair: Pair) -> Field:
    """From the row's own setting to the tuned one; from the tuned one to smaller steps."""
    case, engine = pair.case, pair.engine
    assert isinstance(engine, Tunable)
    step, start = judged_step(case, engine), first(pair.reference())
    knobs = engine.knobs(case.scene, start)
    if engine.setting == "tuned":
        base = Candidate.of(_own(pair), step)
        steps = halved(step, step / FINEST)
        return Field(base, [STEP], steps, steps, presets=presets(knobs))
    own = _own(pair)
    best = [engines.make(engine.name, "tuned")] if "tuned" in engines.settings(engine.name) else []
    least = min((judged_step(case, tuned) for tuned in best), default=step)
    beside, alone = (halved(step, min(step / finer, least)) for finer in (BESIDE, ALONE))
    return Field(
        Candidate.of(own, step),
        [*knob_changes(knobs, own), STEP],
        beside,
        alone,
        rest(knobs, engine.recipe(case.scene, start)) if best else (),
        presets(knobs),
    )
