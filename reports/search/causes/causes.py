"""The causes of a run's rows, searched where they have to be: all pairs at once.

A cause is a fact about a scene, a setting, an engine's version and our adapter: where none of these
is another than that of a committed row, nor the error that it explains, it is that row's. An engine
that was built anew under its version may still be another one: then some verdict on the case is.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from .... import engines
from ....engines.engine import Tunable
from ....engines.knobs import Options
from ....reference.solve import Solution
from ...compare.trial.ladder import judged_step
from ...compare.trial.start import first
from ...runs.task_results import Results
from ...runs.tasks import Pair, solved
from ...tables.row import UNSEARCHED, Cause, Comparison, Known, Rungs, StepError, as_written
from .candidate import Candidate
from .cause_rows import NONE, NOTHING, Unexplained, by_ladder, by_ours, climbed, searched, without
from .change import STEP, Field, halved, levers, remainder, wholes
from .cures import Cured, cures
from .parallel_search import Search, lost, together
from .why import Key, Rows, key_of

LETTERS = 12  # of a word: two searches never share them


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
    rows = Rows(comparisons, ladders)
    off, found = list(rows.off()), dict[tuple[str, ...], list[Cause]]()
    for row in off:
        if ours := rows.ours(row):
            found[key_of(row)] = by_ours(row, ours)
    left, pairs = [row for row in off if key_of(row) not in found], list(pairs)
    states = {pair.case.name for pair in pairs if pair.case.states is not None}
    found |= {key_of(row): [without(row, NOTHING)] for row in left if row.case in states}
    if search:
        of = {_where_of(pair): pair for pair in pairs}
        own = lambda row: _own(of[_where(row)]) if _where(row) in of else {}  # noqa: E731
        found |= {key_of(cause): [cause] for cause in by_ladder(left, steps, ladders, own)}
        words = _words(left, pairs, results)
        moved = _moved(comparisons, known) if known else set[tuple[str, str]]()
        same = [row for row in left if (row.case, row.engine) not in moved]
        carried = _carried(same, words, known.causes) if known else {}
        found |= carried
        left = [row for row in left if key_of(row) not in carried]
        for asked, cured in _searched(left, steps, pairs, results):
            for row in asked.rows:
                causes = searched(asked, row, cured[row.quantity])
                found[key_of(row)] = [replace(c, searched_with=words[_where(row)]) for c in causes]
    last = NONE if search else UNSEARCHED
    told = (cause for row in off for cause in found.get(key_of(row), [without(row, last)]))
    return list(dict.fromkeys(told))  # two ways to the same set are one cause


def _where(row: Comparison) -> tuple[str, str, str]:
    return row.case, row.engine, row.setting


def _where_of(pair: Pair) -> tuple[str, str, str]:
    return pair.case.name, pair.engine.name, pair.engine.setting


def _own(pair: Pair) -> Options:
    """The options of a pair's own setting, as a file of settings has them, without the step."""
    engine = pair.engine
    if engine.setting == "tuned" and isinstance(engine, Tunable):
        return engine.recipe(pair.case.scene, first(pair.reference()))
    return {k: v for k, v in getattr(engine, "options", {}).items() if k != "step"}


def _words(
    rows: Sequence[Comparison], pairs: Iterable[Pair], results: Results
) -> dict[tuple[str, str, str], str]:
    """For each of the rows' pairs: engine version and key of a search; empty where it has none."""
    asked = {_where(row) for row in rows}
    words: dict[tuple[str, str, str], str] = {}
    for pair in pairs:
        where = _where_of(pair)
        if where in asked:
            word = results.keys.search(pair.case, pair.engine)
            words[where] = f"{pair.engine.version} {word[:LETTERS]}" if word else ""
    return words


def _moved(comparisons: Sequence[Comparison], known: Known) -> set[tuple[str, str]]:
    """Cases and engines of which some verdict is another one than it was."""
    return {
        (row.case, row.engine)
        for row in comparisons
        for key in [(*_where(row), row.realised, row.quantity)]
        if known.verdicts.get(key) != row.verdict
    }


def _carried(
    rows: Sequence[Comparison],
    words: Mapping[tuple[str, str, str], str],
    known: Mapping[Key, Sequence[Cause]],
) -> dict[Key, list[Cause]]:
    """For each row that is as the known causes found it: all of its causes."""
    found: dict[Key, list[Cause]] = {}
    for row in rows:
        word, before = words[_where(row)], known.get(key_of(row), ())
        asked = (word, as_written(row.error), as_written(row.allowed))
        if word and before and all(_asked(cause) == asked for cause in before):
            found[key_of(row)] = list(before)
    return found


def _asked(cause: Cause) -> tuple[str, float | None, float | None]:
    return cause.searched_with, as_written(cause.error), as_written(cause.allowed)


def _searched(
    rows: Sequence[Comparison], steps: Sequence[StepError], pairs: Iterable[Pair], results: Results
) -> Iterator[tuple[Unexplained, Mapping[str, Cured]]]:
    of: dict[tuple[str, str, str], list[Comparison]] = {}
    for row in rows:
        of.setdefault(_where(row), []).append(row)
    tunable = {
        key: pair
        for pair in pairs
        for key in [_where_of(pair)]
        if key in of and pair.case.states is None and isinstance(pair.engine, Tunable)
    }
    asked: dict[str, Unexplained] = {}
    searches: dict[str, Search[dict[str, Cured]]] = {}
    referenced = {" ".join(key): (key, p) for key, p in _referenced(tunable, results).items()}
    broken = lost({name: pair for name, (_, pair) in referenced.items()}, results)
    for name, (key, pair) in referenced.items():
        if name in broken:
            continue
        levers = between(pair)
        mine = [one for one in steps if (one.case, one.engine, one.setting) == key]
        strikes = pair.reference().blows.size > 0  # a ladder tells of one start alone
        runs = {} if strikes else climbed(levers.base, of[key], mine)
        asked[name] = Unexplained(pair, levers, of[key])
        looking = cures(levers, runs, [row.quantity for row in of[key]])
        searches[name] = Search(pair, runs, looking)
    found = together("causes", searches, results)
    for name, one in asked.items():
        yield one, found[name]


def _referenced(
    pairs: Mapping[tuple[str, str, str], Pair], results: Results
) -> dict[tuple[str, str, str], Pair]:
    """With the samples that the engine's own step meets; their references are in the store."""
    sampled = {key: pair.sampled for key, pair in pairs.items()}
    keys = {key: results.keys.solution(case) for key, case in sampled.items()}
    others = {
        keys[key]: sampled[key] for key, pair in pairs.items() if sampled[key] is not pair.case
    }
    answers = results.of("references", solved, others) if others else {}
    lost = {key for key, answer in answers.items() if not isinstance(answer, Solution)}
    return {
        key: replace(pair, case=sampled[key], key=keys[key])
        for key, pair in pairs.items()
        if keys[key] not in lost
    }


# The levers and the steps that lie between a row's own setting and the tuned one.


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
        return Field(base, [STEP], steps, steps, wholes=wholes(knobs))
    own = _own(pair)
    best = [engines.make(engine.name, "tuned")] if "tuned" in engines.settings(engine.name) else []
    least = min((judged_step(case, tuned) for tuned in best), default=step)
    found = levers(knobs, own)
    beside, alone = (halved(step, min(step / finer, least)) for finer in (BESIDE, ALONE))
    rest = remainder(knobs, engine.recipe(case.scene, start)) if best else None
    return Field(Candidate.of(own, step), [*found, STEP], beside, alone, rest, wholes(knobs))
