"""A user's model at its own step and at finer ones, in several settings, against its limit.

The limit is of the engine's own continuous equations: what is off is the step's, and nothing is
said of the equations. These are compared in `own_equations`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...cases.model_case import TOLERANCE, ModelCase
from ...cases.trajectory import Array
from ...engines.own_model.limit import (
    INTEGRATORS,
    PAIRS,
    WORDS,
    Limit,
    NoLimit,
    apart_by_pairs,
    limit,
    repeat_limit,
    stepped_states,
)
from ...engines.own_model.model import OwnModel, displaced
from ...engines.own_model.opened import Opened
from ...engines.own_model.quantities import Motion, Quantity, differences
from .judge.convergence import Convergence, instants, study
from .judge.metric import sizes

RUNGS = (4.0, 2.0, 1.0, 1 / 2, 1 / 4, 1 / 8)  # of its own step
DISTURBED = 1e-9  # rad, m: what grows from it to the tolerance is chaos, and judged no longer
OWN = "own"
OTHERS: Mapping[str, Mapping[str, str | float]] = {
    "shipped": {"integrator": "Euler"},
    "recommended": {"integrator": "implicitfast"},
    "rk4": {"integrator": "RK4"},
    "solver": {"solver": "Newton", "iterations": 100, "ls_iterations": 50, "tolerance": 1e-8},
}
"""Further settings: what MuJoCo ships, what its documentation advises, and RK4; and MuJoCo's solver
as it ships, beside which a model's own may have fewer iterations."""
ROUNDING = 1e-12  # rad, m: below it errors are of rounding
CLEAR = 10  # times the limit's own error: below it an order is of that
FEWEST = 3  # samples: a limit that is known for fewer is rough from the start
KNOWN = 0.1  # of the tolerance: a limit that is not known so well judges nothing


@dataclass(frozen=True)
class Setting:
    """Options of `mjOption`, by name, over a model's own, and the step [s], by default its own."""

    name: str
    options: Mapping[str, Any]
    step: float = 0.0


@dataclass(frozen=True)
class Error:
    """How far off a quantity is in a setting: over time (N,), and what its ladder says.

    None, where the setting diverges at its own step.
    """

    off: Array | None
    ladder: Convergence | None


@dataclass(frozen=True)
class Stepped:
    """A model in a setting: by quantity how far off it is; y (N, m + n + a), None: it diverges."""

    setting: Setting
    y: Array | None
    errors: Mapping[Quantity, Error]

    @property
    def keeps(self) -> float | None:
        """The largest step [s] from which on every quantity keeps its bar."""
        ladders = [error.ladder for error in self.errors.values()]
        usable = [ladder.usable_step if ladder else None for ladder in ladders]
        return None if None in usable else min((h for h in usable if h is not None), default=None)


@dataclass(frozen=True)
class Steps:
    """A model at its steps: its limit, until when it is judged [s], and each setting.

    doubts: by quantity, how well the limit is known until then. late: why it is not judged to the
    end.
    """

    limit: Limit
    until: float
    doubts: Mapping[Quantity, float]
    settings: Sequence[Stepped]
    note: str = ""
    bars: Mapping[Quantity, float] = field(default_factory=dict[Quantity, float])
    late: str = ""

    @property
    def known(self) -> float:
        """The error bound [rad, m] of the limit's coordinates as far as it is judged."""
        return float(self.limit.errors[len(self.times) - 1])

    @property
    def judges(self) -> bool:
        """Whether the limit is known well enough of every quantity to judge steps."""
        return all(doubt <= KNOWN * self.bars[q] for q, doubt in self.doubts.items())

    @property
    def times(self) -> Array:
        """The samples that are judged."""
        return self.limit.times[self.limit.times <= self.until]


def settings_of(
    own: OwnModel, others: Sequence[str], named: Sequence[Setting] = ()
) -> list[Setting]:
    """Returns the model's own setting, the others that differ from it, and those that are named."""
    h = own.model.opt.timestep
    less = {
        name: {k: v for k, v in OTHERS[name].items() if _has_less(own, k, v)} for name in others
    }
    different = [Setting(name, options, h) for name, options in less.items() if options]
    named = [replace(setting, step=setting.step or h) for setting in named]
    return [Setting(OWN, {}, h), *different, *named]


def _has_less(own: OwnModel, option: str, value: str | float) -> bool:
    """Whether the model's own option is another word, fewer iterations, or a larger tolerance."""
    has = getattr(own.model.opt, option)
    if isinstance(value, str):
        return has != WORDS[option][value]
    return has > value if option == "tolerance" else has < value


def times_of(case: ModelCase, steps: Sequence[float]) -> Array:
    """(N,) [s] about as many samples as the case asks for, at which every rung of a ladder has one.

    They are multiples of the coarsest rungs of all settings, whose steps may differ.
    """
    apart = case.duration / (case.samples - 1)
    grid = max(RUNGS) * max(steps)
    for whole in range(1, MOST):  # settings of 2 and 5 ms share 40 ms
        if all(_whole(whole * grid / (max(RUNGS) * h)) for h in steps):
            grid *= whole
            break
    every = grid * max(1, round(apart / grid))
    return np.arange(max(1, int(case.duration / every + 1e-9)) + 1, dtype=np.float64) * every


MOST = 100  # times the coarsest rung, of a grid that all settings share


def _whole(number: float) -> bool:
    return abs(number - round(number)) < 1e-9


def steps(
    case: ModelCase,
    opened: Opened,
    others: Sequence[str] = (*OTHERS,),
    named: Sequence[Setting] = (),
) -> Steps:
    """Runs a model in all settings. Raises NoLimit."""
    own, bars = opened.own, opened.bars
    asked = settings_of(own, others, named)
    times = times_of(case, [setting.step for setting in asked])
    exact, until, late = limit_and_horizon(opened, times)
    last = np.flatnonzero(times <= until)[-1]
    doubts = {q: float(doubt[last]) for q, doubt in limit_doubts(opened, exact).items()}
    note = PAIRS if apart_by_pairs(own.model) else ""
    rows = [in_setting(opened, setting, exact, doubts, until) for setting in asked]
    return Steps(exact, until, doubts, rows, note, bars, late)


def limit_doubts(opened: Opened, exact: Limit) -> dict[Quantity, Array]:
    """Returns by quantity (N,) how far apart the limit's two answers are up to each time."""
    answers = (Motion(opened.own, exact.times, y) for y in (exact.coarser, exact.y))
    off = differences([*opened.bars], *answers)
    return {quantity: np.maximum.accumulate(sizes(values)) for quantity, values in off.items()}


def limit_and_horizon(opened: Opened, times: Array) -> tuple[Limit, float, str]:
    """Returns the limit, until when steps are judged [s], and why not to the end.

    That is until a disturbance of the start exceeds a bar, or until the limit is known too roughly,
    as far as it is known at all. Raises NoLimit.
    """
    own, bars = opened.own, opened.bars
    within = KNOWN * min((bar for q, bar in bars.items() if q.unit in ("rad", "m")),
                         default=TOLERANCE)  # fmt: skip
    exact = limit(own, times, within=within)
    a, b = (Motion(own, exact.times, y) for y in (exact.y, disturbed(own, exact)))
    off = differences([*bars], a, b)
    ratios = [sizes(values) / bars[quantity] for quantity, values in off.items()]
    far = np.flatnonzero(np.max(ratios, axis=0) > 1.0) if ratios else []
    end = float(exact.times[-1])
    horizon = float(exact.times[max(far[0] - 1, 0)]) if len(far) else end
    if horizon == exact.times[0] < end:  # of which nobody learns how it moves
        raise NoLimit(f"a disturbance of {DISTURBED:g} exceeds a tolerance at once")
    doubts = limit_doubts(opened, exact)
    first = {q: int(np.searchsorted(doubt, KNOWN * bars[q], side="right")) - 1
             for q, doubt in doubts.items()}  # fmt: skip
    rough = min(first, key=lambda q: first[q])
    until = float(exact.times[first[rough]])
    if until < horizon and first[rough] >= min(FEWEST, len(exact.times) - 1):
        doubt = f"{doubts[rough][-1]:.0e} {rough.unit}".rstrip()
        return exact, until, f"later {rough.name} of the limit is known to {doubt} only"
    late = f"later a disturbance of {DISTURBED:g} exceeds a tolerance" if horizon < end else ""
    return exact, horizon, late


def disturbed(own: OwnModel, exact: Limit) -> Array:
    """Returns y (N, k) as a limit has it, of a start of which each joint is off by DISTURBED."""
    start = own.start()
    by = np.random.default_rng(0).choice((-DISTURBED, DISTURBED), own.model.nv)
    start.qpos[:] = displaced(own.model, start.qpos, by)
    return repeat_limit(own, exact, start)


def in_setting(
    opened: Opened,
    setting: Setting,
    exact: Limit,
    doubts: Mapping[Quantity, float],
    until: float,
) -> Stepped:
    """Returns how far off a setting is from the limit at each rung of its ladder."""
    own, bars = opened.own, opened.bars
    off: dict[float, dict[Quantity, Array]] = {}
    y: Array | None = None
    wanted = Motion(own, exact.times, exact.y)
    for k in sorted(_rungs(own)):  # the finest first: above one that diverges none is usable
        h = setting.step * k
        samples = stepped_states(own, exact.times, setting.options, h)
        if samples is None:
            break
        y = samples if k == 1.0 else y
        off[h] = differences([*bars], wanted, Motion(own, exact.times, samples))
    judged = exact.times <= until
    errors = {q: _error(q, off, setting, judged, doubts[q], bar) for q, bar in bars.items()}
    return Stepped(setting, y, errors)


def _error(
    quantity: Quantity,
    off: Mapping[float, Mapping[Quantity, Array]],
    setting: Setting,
    judged: NDArray[np.bool_],
    doubt: float,
    bar: float,
) -> Error:
    ladder = {h: by_quantity[quantity][judged] for h, by_quantity in off.items()}
    at_own = ladder.get(setting.step)
    over_time = None if at_own is None else np.asarray(sizes(at_own))
    if not ladder:
        return Error(over_time, None)
    floor = max(CLEAR * doubt, ROUNDING)
    largest = {h: float(np.max(sizes(errors))) for h, errors in ladder.items()}
    clear = {h: errors for h, errors in ladder.items() if largest[h] > floor}
    sure = instants(largest, bar - doubt)  # of a rough limit less is known to be within
    if not clear:
        return Error(over_time, sure)
    zero = np.zeros_like(next(iter(clear.values())))
    fit = study(clear, zero, exponents=(), allow=bar, floor=floor)
    return Error(over_time, Convergence(fit.verdict, largest, sure.usable_step, fit.order,
                                        fit.order_low, fit.order_high))  # fmt: skip


def _rungs(own: OwnModel) -> tuple[float, ...]:
    """Returns the ladder's steps over its own; a finer one only where its law can be held."""
    return tuple(k for k in RUNGS if k >= 1) if apart_by_pairs(own.model) else RUNGS


def integrator_of(own: OwnModel, setting: Setting) -> str:
    """Returns the name of the integrator that a setting steps with."""
    number = own.model.opt.integrator
    names = [name for name, each in INTEGRATORS.items() if each == number]
    return str(setting.options.get("integrator") or names[0])
