"""The rows of a user's model, in the tables of all cases: its limit stands for a reference."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf

from ...cases.model_case import ModelCase
from ...engines.own_model.limit import Limit, NoLimit
from ...engines.own_model.model import VERSION, OwnModel
from ...engines.own_model.opened import opened
from ...engines.own_model.quantities import Quantity, coordinates
from ..tables.model_line import ModelLine
from ..tables.row import (
    AGREES,
    BEYOND,
    CRASHED,
    DIVERGED,
    FAILS,
    REFUSED,
    Certificate,
    Comparison,
    Rungs,
    StepError,
)
from .judge import metric
from .judge.rows import Subject, measured
from .own_equations import ROUNDING, Part, equations
from .own_motion import motion
from .own_seen import Seen, seen
from .own_steps import KNOWN, OTHERS, OWN, Error, Setting, Stepped, Steps, integrator_of, steps

ENGINE, THEME, NATIVE, HELD = "mujoco", "own model", "native", "held"
DIGITS = 1e-3  # of an error: below it are digits that another processor has otherwise


@dataclass(frozen=True)
class Modelled:
    """A model's rows, and what is said of it: what it is, its start, its steps, its equations.

    integrators: by setting. coordinates: name and unit of each column of q. because: why there are
    no steps. seen: at its own steps.
    """

    case: ModelCase
    model: str
    started: str
    steps: Steps | None
    parts: Sequence[Part]
    because: str = ""
    comparisons: Sequence[Comparison] = ()
    rungs: Sequence[Rungs] = ()
    step_errors: Sequence[StepError] = ()
    certificates: Sequence[Certificate] = ()
    integrators: Mapping[str, str] = field(default_factory=dict[str, str])
    coordinates: Sequence[tuple[str, str]] = ()
    seen: Seen = field(default_factory=lambda: Seen({}))

    @property
    def limit(self) -> Limit | None:
        """The model's motion for h → 0."""
        return None if self.steps is None else self.steps.limit


def modelled(
    case: ModelCase, others: Sequence[str] = (*OTHERS,), named: Sequence[Setting] = ()
) -> Modelled:
    """Returns the rows of a model: its equations, and its steps in all settings.

    others: some of OTHERS; named: those of the user's files. Raises CaseError if it does not
    compile, or lacks a name of the case.
    """
    ready = opened(case)
    own = ready.own
    parts = equations(own)
    if not own.model.nv:
        return Modelled(case, str(own), "", None, parts, "nothing moves")
    try:
        result = steps(case, ready, others, named)
    except NoLimit as error:
        because = f"no limit: {error}"
        rows = [
            _about(case).row(q.name, q.unit, REFUSED, allowed=bar, because=because)
            for q, bar in ready.bars.items()
        ]
        return Modelled(case, str(own), own.started, None, parts, because, rows, (), (),
                        [*_certificates(case, parts)])  # fmt: skip
    parts.append(motion(own, result.limit))
    certificates = [*_certificates(case, parts)]
    if result.judges:
        certificates.append(_limit_certificate(case, result))
    own_errors = result.settings[0].errors
    off = any(e.off is None or e.off.max() > ready.bars[q] for q, e in own_errors.items())
    shown = seen(ready, result.limit, result.until, off=off)
    judged = [
        (_about(case, stepped.setting.name), (stepped, q, error))
        for stepped in result.settings
        for q, error in stepped.errors.items()
    ]
    ladders = [
        (about, (HELD, q.name, q.unit, error.ladder))
        for about, (_, q, error) in judged
        if error.ladder
    ]
    return Modelled(
        case, str(own), own.started, result, parts, "",
        [_row(about, own, result, shown, *each) for about, each in judged],
        [about.rungs(*ladder) for about, ladder in ladders],
        [row for about, ladder in ladders for row in about.steps(*ladder, _few_digits)],
        certificates,
        {stepped.setting.name: integrator_of(own, stepped.setting) for stepped in result.settings},
        coordinates(own.model),
        shown,
    )  # fmt: skip


def lost(case: ModelCase, because: str, verdict: str = CRASHED) -> Modelled:
    """Returns the row of a model that ended its process, took too long, or does not compile."""
    row = _about(case).row("motion", "", verdict, because=because)
    return Modelled(case, "", "", None, (), because, [row])


def worst_of(rows: Sequence[Comparison]) -> Comparison:
    """Returns the row that is furthest off of what is allowed; what has no error is further."""
    return max(rows, key=lambda row: inf if row.error is None else row.ratio or 0.0)


def line(model: Modelled, cure: str = "") -> ModelLine:
    """Returns a model's row of the table of models; cure: in words."""
    own = [row for row in model.comparisons if row.setting == OWN]
    if not own:
        return ModelLine(model.case.name, because=model.because)
    worst = worst_of(own)
    settings = model.steps.settings if model.steps else ()
    best = max(settings, key=lambda each: each.keeps or 0.0, default=None)
    fails = [f"FAILS: {part.name}" for part in model.parts if not part.holds]
    unread = (what for part in model.parts for what in part.unread)
    return ModelLine(
        model.case.name, model.integrators.get(OWN, ""), worst.step, worst.quantity, worst.unit,
        worst.error, worst.when, worst.allowed, worst.ratio, worst.verdict,
        "; ".join(model.seen.joints.values()),
        best.setting.name if best and best.keeps else "none tried" if settings else "",
        best.keeps if best else None,
        cure,
        "; ".join(dict.fromkeys(unread)),
        "; ".join(filter(None, [*fails, model.because])),
    )  # fmt: skip


def _row(
    about: Subject,
    own: OwnModel,
    result: Steps,
    shown: Seen,
    stepped: Stepped,
    q: Quantity,
    error: Error,
) -> Comparison:
    bar, setting, doubt = result.bars[q], stepped.setting, result.doubts[q]
    words = [shown.of(q)] if setting.name == OWN else []
    verdict, numbers = DIVERGED, {}
    if error.off is None:
        words.append("its own step diverges")
    else:
        size = metric.error(error.off, error.off * 0.0)
        least = max(doubt, DIGITS * size.largest)
        numbers = measured(size, least, bar, float(result.times[size.at]))
        largest = numbers["error"]
        if largest - doubt > bar:
            verdict = BEYOND
        elif largest + doubt <= bar:
            verdict = AGREES
        else:
            verdict = REFUSED
            words.append(f"the limit is known to {doubt:.0e} {q.unit}".rstrip() + " only")
        if result.late:
            words.append(f"judged until {result.until:.3g} s: {result.late}")
    return about.row(
        q.name, q.unit, verdict, step=setting.step, allowed=bar, **numbers,
        protocol=f"{integrator_of(own, setting)} against the limit by {result.limit.method}",
        because="; ".join(filter(None, words)),
    )  # fmt: skip


def _few_digits(error: float) -> float:
    return metric.round_to_floor(error, DIGITS * error)


def _about(case: ModelCase, setting: str = OWN) -> Subject:
    return Subject(case.name, THEME, case.title, ENGINE, VERSION, setting, NATIVE)


def _certificates(case: ModelCase, parts: Sequence[Part]) -> Iterator[Certificate]:
    for part in parts:
        if part.off is not None:
            difference = metric.round_to_floor(part.off, ROUNDING)
            verdict = "holds" if part.holds else FAILS
            yield Certificate(case.name, case.title, "compiled", part.name, difference, part.bound,
                              None, "", verdict)  # fmt: skip


def _limit_certificate(case: ModelCase, result: Steps) -> Certificate:
    """The row of the limit's own error: the largest of a quantity's over what is allowed."""
    share = max(doubt / result.bars[q] for q, doubt in result.doubts.items())
    return Certificate(case.name, case.title, result.limit.method, "error of the limit", share,
                       KNOWN, result.known, "", "holds")  # fmt: skip
