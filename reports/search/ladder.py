"""What the ladder of a row's own setting tells already: its errors at smaller steps."""

from collections.abc import Iterator, Sequence

from ..row import Comparison, Rungs
from .candidate import Candidate
from .together import Known


def usable(
    rows: Sequence[Comparison], rungs: Sequence[Rungs]
) -> Iterator[tuple[Comparison, float, float]]:
    """Rows with the largest step [s] from which on their held ladder keeps what is allowed, and
    the error there; those that have one."""
    held = {
        (rung.case, rung.engine, rung.setting, rung.realised, rung.quantity): rung
        for rung in rungs
        if rung.ladder == "held" and rung.usable_step is not None
    }
    for row in rows:
        rung = held.get((row.case, row.engine, row.setting, row.realised, row.quantity))
        if rung is not None and rung.usable_step is not None:
            away = [abs(float(step) - rung.usable_step) for step in rung.steps.split()]
            yield row, rung.usable_step, float(rung.errors.split()[away.index(min(away))])


def climbed(base: Candidate, rows: Sequence[Comparison], rungs: Sequence[Rungs]) -> Known:
    """The errors of the rows at the ladder's steps, if it tells all of them, to three digits.

    rungs: of the case in the engine with that setting. An error of all samples stands for that
    away from instants too, which is no larger. Nothing is known where numbers follow the step, for
    then a ladder holds them; nor of a count, which has no ladder.
    """
    native = [rung for rung in rungs if rung.realised == "native"]
    if any(rung.ladder != "held" for rung in native):
        return {}
    of = {rung.quantity: list(map(float, rung.errors.split())) for rung in native}
    allowed = {row.quantity: row.allowed for row in rows}
    lengths = {len(errors) for errors in of.values()}
    whole = all(rung.steps.split()[-1] == f"{base.step:.3g}" for rung in native)
    if not (set(allowed) <= set(of) and len(lengths) == 1 and whole):
        return {}
    (count,) = lengths
    return {
        base.at(base.step / 2 ** (count - 1 - i)): {
            name: (of[name][i] / allow, of[name][i] / allow)
            for name, allow in allowed.items()
            if allow
        }
        for i in range(count - 1)  # the last is the row's own step
    }
