"""The reference's own error in each observed quantity, against what the case asks of it."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from ...cases.case import Case
from ...cases.fields.kind import WORK
from ...cases.mistake import Mistake
from ...cases.scene.difference import deviation
from ...cases.scene.observe import observe
from ...cases.scene.quantity import at_event, event_quantities
from ...cases.trajectory import Array, Trajectory
from ..motion.zeno import to_limit
from .agreement import Check, worst
from .event_time_error import lateness

SHARE = 0.01  # of the smallest tolerance: what the reference's own error may take
EPS = float(np.finfo(np.float64).eps)
ERROR = "error of "


def errors(
    case: Case,
    motion: Trajectory,
    others: Mapping[str, Trajectory],
    late: float,
    worked: Callable[[Sequence[str]], Mapping[str, float]] | None = None,
) -> Iterator[Check]:
    """The share of the smallest `allow` or `reach` that each quantity's own error takes.

    The error is the largest difference to any other answer, and at least the rounding of a double.
    late: how well the times are known at which modes change [s]. worked: the errors
    of sums over the samples, by name; None: what is asked for has none.
    """
    known = case.quantities
    sums = [name for name in case.allow if name in known and known[name].field in WORK]
    summed = worked(sums) if sums and worked else {}
    times = {name: q for name, q in event_quantities(case.events).items() if q.field == "time"}
    for name in case.allow:
        bar, at = least(case, name), at_event(name, case.events)
        if name in known:
            error, unit = _error(case, motion, others, name), known[name].unit
            error += summed.get(name, 0.0)
        elif name in times:
            event = case.events[times[name].part]
            shift = late + _bound(case, motion, others, times[name].part)
            shift += _pile_limit(motion.endless) if event.rule == "stays zero" else 0.0
            error, unit = max(EPS * float(motion.times[-1]), shift), times[name].unit
        elif at is not None:  # known as everywhere in the motion, but the event is late
            own = observe(case.scene, motion, at.quantity)
            fastest = worst(np.abs(np.diff(own))) / case.interval
            shift = late + _bound(case, motion, others, at.event)
            error = _error(case, motion, others, at.quantity) + fastest * shift
            unit = known[at.quantity].unit
        else:
            continue  # a count: the changes of mode are compared by name and number
        if bar is not None:
            yield Check(f"{ERROR}{name}", error / bar, SHARE, error, unit)


def _pile_limit(endless: Sequence[Array]) -> float:
    """Largest time [s] from the last event of a pile-up that was followed to its limit."""
    return max(map(to_limit, endless), default=0.0)


def _bound(case: Case, motion: Trajectory, others: Mapping[str, Trajectory], name: str) -> float:
    """Error [s] of an event at which a quantity passes through zero within a mode."""
    event = case.events[name]
    if motion.record is None or not event.crosses:
        return 0.0
    return lateness(case.scene, motion.record, event, _error(case, motion, others, event.quantity))


def _error(case: Case, motion: Trajectory, others: Mapping[str, Trajectory], name: str) -> float:
    """Largest difference of a quantity's samples from those of the other answers."""
    own = observe(case.scene, motion, name)
    differences = [deviation(own, observe(case.scene, other, name)) for other in others.values()]
    size, quantity = worst(np.abs(own).ravel()), case.quantities[name]
    columns = case.scene.frame.alike(quantity.unit)
    if quantity.kind == "force":
        # One that is none, as the moment about a hinge's own axis, is what the others leave.
        size = worst([size, *(worst(np.abs(x).ravel()) for x in _peers(case, motion, name))])
    else:
        # How far places are apart is known as well as they are, which may be far from the origin;
        # and one coordinate of a body on a wire as well as the other.
        mine = motion.states.get(quantity.part)
        states = motion.states.values() if mine is None else [mine]
        size = worst([size, *(worst(np.abs(s[:, columns]).ravel()) for s in states)])
    return worst([EPS * size, *map(worst, differences)])


def _peers(case: Case, motion: Trajectory, name: str) -> Iterator[Array]:
    """Yields the samples of all reactions of the same part and unit."""
    known, (part, _, _) = case.quantities, name.rpartition(".")
    for other, values in motion.reactions.items():
        alike = other in known and known[other].unit == known[name].unit
        if alike and other.rpartition(".")[0] == part:
            yield values


def least(case: Case, name: str) -> float | None:
    """The smallest `allow` or `reach` of a quantity, or None if nothing bounds it."""
    return min((bar for _, bar in _bars(case, name)), default=None)


def beyond(case: Case, checks: Sequence[Check]) -> list[Mistake]:
    """Each `allow` or `reach` that asks more than can be certified, if nothing else is wrong.

    Where a motion is so sensitive that its states are not known, two answers to it may also differ
    in when something happens, and in how often: that is no second mistake.
    """
    broken = [check for check in checks if not check.holds]
    own = [check for check in broken if check.name.startswith(ERROR)]
    sensitive = any(math.isfinite(check.certified or math.inf) for check in own)
    if not sensitive or any(
        not check.name.endswith("events") for check in broken if check not in own
    ):
        return []
    mistakes = []
    for check in own:
        assert check.certified is not None
        name = check.name.removeprefix(ERROR)
        summed = name in case.quantities and case.quantities[name].field in WORK
        cure = ", or take more samples" if summed else ", or a shorter duration"
        cure = cure if case.states is None else ""
        mistakes += [
            case.mistake(path, _asks(bar, check.certified, check.unit, cure))
            for path, bar in _bars(case, name)
            if not check.certified <= SHARE * bar
        ]
    return mistakes


def _bars(case: Case, name: str) -> Iterator[tuple[tuple[str, ...], float]]:
    """Yields the path and the value of each bound that the case sets on a quantity."""
    allowed = case.allow[name]
    if allowed is not None:
        yield ("allow", name), allowed
    for engine, bars in case.reach.items():
        if name in bars:
            yield ("reach", engine, name), bars[name]


def _asks(bar: float, certified: float, unit: str, cure: str) -> str:
    if not math.isfinite(certified):
        return (
            f"{bar:.3g} asks more than can be certified: two answers to this motion differ in how "
            "often it happens; give a shorter duration"
        )
    digit = 10.0 ** math.floor(math.log10(certified / SHARE))
    enough = math.ceil(certified / SHARE / digit) * digit
    return (
        f"{bar:.3g} asks more than can be certified: the reference knows this to "
        f"{certified:.1e} {unit}, and that may be {SHARE:.0%} of it; "
        f"give at least {enough:.0e}{cure}"
    )
