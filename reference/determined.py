"""Whether each force that a case asks for has one value, at every sample.

All rows that hold are looked at by their rank, and not by what a solver's pivots make of it: of
forces that equilibrium leaves open the laws of contact may still leave one value each.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from ..cases.case import Case
from ..cases.fields.kind import WORK
from ..cases.mistake import CaseError
from ..cases.scene.observe import observe
from ..cases.scene.quantity import at_event, table
from ..cases.trajectory import Trajectory
from .certificate.agreement import Check, worst
from .mechanism.constraints.leeway import LEANS, Leeway
from .mechanism.modes.mechanism import Mechanism
from .motion.bodies import Answer
from .system import Pose

NAME = "forces determined"
POINT = 1e-8  # of the largest force: a span that is shorter is one value, as a programme knows it
STEADY = 3  # samples of one state: with constant forces work is a sum over them

WHAT = (
    "statics does not decide it at t = {:.3g} s: {}; what sticks, rubs or leans there holds more "
    "than there is to hold; leave it out"
)

Spans = Mapping[str, tuple[float, float]]
"""By reaction: its least and its largest value."""


def check_determined(case: Case, built: Answer, generated: Mechanism) -> tuple[Check, ...]:
    """Checks that statics determines each force that is asked for, relative to the largest.

    Raises CaseError with those that statics does not decide.
    """
    asked = dict(_bounded_quantities(case))
    forces = [name for name in dict.fromkeys(asked.values()) if _depends_on_forces(case, name)]
    if not forces:
        return ()
    undetermined: dict[str, tuple[float, str]] = {}
    widest = [0.0]
    for t, poses, leeway in _samples(case, built, generated):
        moved = list(_open_quantities(case, poses, leeway, forces))
        widest += [width for _, width, _ in moved]
        for name, width, spans in moved:
            if width > POINT and name not in undetermined:
                undetermined[name] = t, _spans_text(case, name, spans)
    mistakes = [
        case.mistake(path, WHAT.format(*undetermined[name]))
        for path, name in asked.items()
        if name in undetermined
    ]
    if mistakes:
        raise CaseError(mistakes)
    return (Check(NAME, worst(widest), POINT),)


def _bounded_quantities(case: Case) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yields the path and the name of each quantity that the case asks for."""
    for name in case.allow:
        at = at_event(name, case.events)
        yield ("allow", name), name if at is None else at.quantity
    yield from ((("events", name), event.quantity) for name, event in case.events.items())


def _depends_on_forces(case: Case, name: str) -> bool:
    """Whether a quantity is a force or a work."""
    known = table(case.scene)
    return name in known and (known[name].kind == "force" or known[name].field in WORK)


def _samples(
    case: Case, built: Answer, generated: Mechanism
) -> Iterator[tuple[float, Mapping[str, Pose], Leeway]]:
    """Yields time, poses and open forces of each sample at which equilibrium leaves any open."""
    followed = built.followed
    for t, name, y in zip(case.times.tolist(), followed.modes, followed.y, strict=True):
        mode = generated.modes[name]
        q, v = mode.parted(y)
        if (leeway := generated.leeway(name, t, q, v)) is not None:
            yield t, mode.poses(t, q, v), leeway


def _open_quantities(
    case: Case, poses: Mapping[str, Pose], leeway: Leeway, forces: list[str]
) -> Iterator[tuple[str, float, Spans]]:
    """Yields each open quantity, its width as a share of the largest force, and the spans."""
    states = {name: np.tile(pose, (STEADY, 1)) for name, pose in poses.items() if len(pose) > 1}
    inner = {name: pose[0] for name, pose in poses.items() if len(pose) == 1}
    times = np.arange(float(STEADY))

    def seen(name: str, reactions: Mapping[str, float]) -> float:
        values = {key: np.full(STEADY, x) for key, x in {**reactions, **inner}.items()}
        return float(observe(case.scene, Trajectory(times, states, values), name)[-1])

    for name in forces:
        own = seen(name, leeway.forces)
        others = [seen(name, way) for way in leeway.ways]
        if all(abs(other - own) <= LEANS * leeway.size for other in others):
            continue
        spans = {name: leeway.spanned(own, others)}
        if not _linear(leeway, own, others, lambda forces, name=name: seen(name, forces)):
            part = f"{table(case.scene)[name].part}."
            parts = (x for x in leeway.forces if x.startswith(part) and leeway.open(x))
            spans = {x: leeway.span(x) for x in parts}
        spans = {x: _without_rounding(span, leeway.size) for x, span in spans.items()}
        yield name, worst(high - low for low, high in spans.values()) / leeway.size, spans


def _linear(
    leeway: Leeway,
    own: float,
    others: Sequence[float],
    seen: Callable[[Mapping[str, float]], float],
) -> bool:
    """Whether a quantity is linear in the forces, tested at twice the ways."""
    far = {
        name: x + 2 * sum(way[name] - x for way in leeway.ways) for name, x in leeway.forces.items()
    }
    expected = own + 2 * sum(other - own for other in others)
    return abs(seen(far) - expected) <= LEANS * leeway.size


def _without_rounding(span: tuple[float, float], size: float) -> tuple[float, float]:
    """A span without the rounding of a bound that is 0."""
    low, high = (0.0 if abs(x) <= LEANS * size else x for x in span)
    return low, high


def _spans_text(case: Case, name: str, spans: Spans) -> str:
    """Words for spans: `foot.normal: anything from 43.67 to 57.19 N`."""
    known = table(case.scene)
    each = [
        f"{force}: {_interval(*span)} {known[force].unit if force in known else known[name].unit}"
        for force, span in spans.items()
    ]
    return each[0] if name in spans else f"{name} ({', '.join(each)})"


def _interval(low: float, high: float) -> str:
    match math.isinf(low), math.isinf(high):
        case True, True:
            return "anything, in"
        case True, False:
            return f"anything up to {high:.4g}"
        case False, True:
            return f"anything from {low:.4g} on, in"
        case _:
            return f"anything from {low:.4g} to {high:.4g}"
