"""The causes of a run's rows: searched where they have to be, and told in rows and in words."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ... import engines
from ...engines.engine import Tunable
from ...engines.knobs import as_text, merged
from ...reference.solve import Solution
from ..results import Results
from ..row import Cause, Comparison, Rungs
from ..trial.ladder import judged_step
from ..trial.start import first
from ..unit import Pair, solved
from .candidate import Candidate
from .cures import Cure, Cured, cures
from .ladder import climbed
from .lever import STEP, Field, halved, levers
from .together import Search, together
from .why import OURS, Rows, key_of

ALONE = 16  # times finer: as far as an engine's own ladder goes, or to the tuned setting's step
BESIDE = 4  # times, beside other changes, or to the tuned setting's step
FINEST = 8  # times, of the tuned setting, which has nothing else to be changed
NONE, UNSEARCHED = "none found", "not searched"


@dataclass(frozen=True)
class _Asked:
    """The rows of a pair that have to be searched."""

    pair: Pair
    field: Field
    rows: Sequence[Comparison]

    def cost(self, candidate: Candidate) -> float:
        engine, scene = self.pair.engine, self.pair.case.scene
        assert isinstance(engine, Tunable)
        base = engine.cost(self.field.base.options, self.field.base.step, scene)
        return engine.cost(candidate.options, candidate.step, scene) / base


def causes(
    comparisons: Sequence[Comparison],
    rungs: Sequence[Rungs],
    pairs: Iterable[Pair],
    results: Results,
    *,
    search: bool,
) -> list[Cause]:
    """Of every row above its tolerance: what brings it within; search: whether runs are made."""
    rows = Rows(comparisons)
    off, found = list(rows.off()), dict[tuple[str, ...], list[Cause]]()
    for row in off:
        if ours := rows.ours(row):
            found[key_of(row)] = [_ours(row, agreeing) for agreeing in ours]
    left = [row for row in off if key_of(row) not in found]
    if search:
        for asked, cured in _searched(left, rungs, pairs, results):
            found |= {key_of(row): _told(asked, row, cured[row.quantity]) for row in asked.rows}
    last = NONE if search else UNSEARCHED
    return [cause for row in off for cause in found.get(key_of(row), [_without(row, last)])]


def _searched(
    rows: Sequence[Comparison], rungs: Sequence[Rungs], pairs: Iterable[Pair], results: Results
) -> Iterator[tuple[_Asked, Mapping[str, Cured]]]:
    of: dict[tuple[str, str, str], list[Comparison]] = {}
    for row in rows:
        of.setdefault((row.case, row.engine, row.setting), []).append(row)
    tunable = {
        key: pair
        for pair in pairs
        for key in [(pair.case.name, pair.engine.name, pair.engine.setting)]
        if key in of and pair.case.states is None and isinstance(pair.engine, Tunable)
    }
    asked: dict[str, _Asked] = {}
    searches: dict[str, Search[dict[str, Cured]]] = {}
    for key, pair in _referenced(tunable, results).items():
        name, field = " ".join(key), _field(pair)
        mine = [rung for rung in rungs if (rung.case, rung.engine, rung.setting) == key]
        known = climbed(field.base, of[key], mine)
        asked[name] = _Asked(pair, field, of[key])
        looking = cures(field, known, [row.quantity for row in of[key]])
        searches[name] = Search(pair, known, looking)
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


def _field(pair: Pair) -> Field:
    """From the row's own setting to the tuned one; from the tuned one to smaller steps."""
    case, engine = pair.case, pair.engine
    assert isinstance(engine, Tunable)
    step, start = judged_step(case, engine), first(pair.reference())
    if engine.setting == "tuned":
        base = Candidate.of(engine.recipe(case.scene, start), step)
        steps = halved(step, step / FINEST)
        return Field(base, [STEP], steps, steps)
    own = {k: v for k, v in getattr(engine, "options", {}).items() if k != "step"}
    best = [engines.make(engine.name, "tuned")] if "tuned" in engines.settings(engine.name) else []
    least = min((judged_step(case, tuned) for tuned in best), default=step)
    found = levers(engine.knobs(case.scene, start), own)
    beside, alone = (halved(step, min(step / finer, least)) for finer in (BESIDE, ALONE))
    return Field(Candidate.of(own, step), [*found, STEP], beside, alone)


def _told(asked: _Asked, row: Comparison, cured: Cured) -> list[Cause]:
    """A row for each cure, the cheapest first."""
    found = sorted(cured.cures, key=lambda cure: asked.cost(cure.candidate))
    return [_cause(asked, row, cure, cured.elsewhere) for cure in found] or [_without(row, NONE)]


def _cause(asked: _Asked, row: Comparison, cure: Cure, elsewhere: bool) -> Cause:
    words = " + ".join(lever.words for lever in cure.turned)
    allowed = row.allowed or 0.0
    return replace(
        _without(row, f"{words}, but for the instant" if elsewhere else words),
        options=as_text(merged(*(lever.options for lever in cure.turned))),
        step=cure.candidate.step,
        error_after=cure.error * allowed,
        cost=asked.cost(cure.candidate),
        law=cure.law,
    )


def _ours(row: Comparison, agreeing: Comparison) -> Cause:
    return replace(
        _without(row, OURS[agreeing.realised]), step=agreeing.step, error_after=agreeing.largest
    )


def _without(row: Comparison, words: str) -> Cause:
    return Cause(
        row.case,
        row.engine,
        row.setting,
        row.quantity,
        row.largest,
        row.allowed,
        words,
        *("", None, None, None, ""),
    )
