"""Advice on a user's model, by experiment: what a person sees, what cures it, what costs least.

Static numbers say where to look, and stand beside what a run has shown; alone they say nothing.
"""

import copy
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import inf

import numpy as np

from ....cases.fields.number import Amount
from ....cases.model_case import JOINTS, ModelCase, ModelStart
from ....engines.own_model.changed import Changed, changes, option
from ....engines.own_model.limit import INTEGRATORS, NoLimit, apart_by_pairs, limit
from ....engines.own_model.model import OwnModel, joint_moves
from ....engines.own_model.opened import Opened, opened
from ....engines.own_model.seen import joint_of, motion_at_steps, servos, shaking, short_of_target
from ....engines.own_model.static import ALONE, SHORT, Suspicion, short_times, suspicions
from ...compare.own_seen import ARRIVES, FEW, LATE, seen
from ...compare.own_steps import (
    OWN,
    Setting,
    Stepped,
    Steps,
    in_setting,
    integrator_of,
    steps,
)
from ...runs.models import Task
from ...tables.short_numbers import milliseconds

EVALUATIONS = {"Euler": 1.0, "implicitfast": 1.0, "implicit": 1.6, "RK4": 3.7}
"""What a step costs beside Euler's: 0.9–1.05, 1.3–2.3, 3.5–3.9 of its time in seven models, nv 3 to
27. A number, so that advice is the same wherever it is given."""
FINE = 8  # parts of its own step from which a second ladder begins, where no setting keeps the bars
OF_STIFF = "recommended"  # the setting that is tried beside its own where the model is changed
FURTHER = 0.3  # rad, m: by how much targets are moved, to see what rest hides


@dataclass(frozen=True)
class Recipe:
    """A way to step a model: what changes, its cost over the model's own, and what to write.

    ratio: the worst error over what is allowed, of a quantity; None: it diverges. keeps: the step
    [s] from which on errors fit into that with the margin; None: no step that was tried. moves: how
    far a change of the model moves the model's own equations; then: what with it costs least
    within the bars.
    """

    change: str
    integrator: str
    step: float
    cost: float
    ratio: float | None
    quantity: str
    keeps: float | None
    lines: Sequence[str]
    moves: str = ""
    then: "Recipe | None" = None


@dataclass(frozen=True)
class Tried:
    """A motion of a model: what is seen of it, why that was suspected, and what helps.

    coarsest: by integrator. cures: the smallest first. because: why nothing is advised.
    """

    started: str
    limit: str
    until: float
    own: Recipe
    seen: Sequence[str] = ()
    suspected: Sequence[str] = ()
    coarsest: Sequence[Recipe] = ()
    cures: Sequence[Recipe] = ()
    cheapest: Recipe | None = None
    because: str = ""


@dataclass(frozen=True)
class OwnAdvice:
    """The advice on a model, one for each experiment; because: why there is none."""

    case: str
    model: str
    margin: float
    tried: Sequence[Tried]
    because: str = ""


@dataclass(frozen=True)
class AdviceTask(Task):
    """Asks for the advice on a model.

    tolerance [rad, m]: of all joints; None: what the case allows. margin: how often errors have to
    fit into it.
    """

    tolerance: float | None
    margin: float

    def answer(self) -> OwnAdvice:
        """Returns the advice. Raises CaseError if the model does not compile."""
        return advised(self.case, self.tolerance, self.margin)

    def lost(self, because: str, verdict: str) -> OwnAdvice:
        """Returns no advice, and why."""
        return OwnAdvice(self.case.name, "", self.margin, (), because)


@dataclass(frozen=True)
class _Asked:
    """A case, its model with the bars as they are allowed, and how often errors have to fit."""

    case: ModelCase
    opened: Opened
    margin: float

    @property
    def own(self) -> OwnModel:
        return self.opened.own

    @property
    def strict(self) -> Opened:
        """The model with bars in which errors fit with the margin."""
        return Opened(self.own, {q: bar / self.margin for q, bar in self.opened.bars.items()})

    def of(self, own: OwnModel) -> "_Asked":
        """Returns the same question about another model."""
        return replace(self, opened=replace(self.opened, own=own))


def advised(case: ModelCase, tolerance: float | None, margin: float) -> OwnAdvice:
    """Returns the advice on a model. Raises CaseError if it does not compile.

    tolerance [rad, m]: of all joints; None: what the case allows.
    """
    if tolerance is not None:
        case = replace(case, allow={JOINTS: Amount(tolerance)})
    ready = opened(case)
    own, name = ready.own, str(ready.own)
    if not own.model.nv:
        return OwnAdvice(case.name, name, margin, (), "nothing moves")
    suspected = suspicions(own)
    asked = _Asked(case, ready, margin)
    try:
        tried = [_advice_on(asked, suspected)]
        further = _further(asked, suspected)
        if further and not tried[0].seen and _would_be_seen(further):
            moved = _advice_on(further, suspected)
            tried += [moved] if moved.seen else []
    except NoLimit as error:
        return OwnAdvice(case.name, name, margin, (), f"no limit: {error}")
    return OwnAdvice(case.name, name, margin, tried)


def _further(asked: _Asked, suspected: Sequence[Suspicion]) -> _Asked | None:
    """Returns a model without a motion of its own with the targets of its servos moved."""
    own, start = asked.own, asked.own.start()
    targets = servos(own)
    suspects = {suspicion.dof for suspicion in suspected}
    if asked.case.control or asked.case.initial != ModelStart() or not suspects & {*targets}:
        return None
    for k, servo in targets.items():
        by = FURTHER * -servo.bias[1] / servo.gain[0] * servo.moments[k]
        beyond = not servo.control[0] <= start.ctrl[servo.u] + by <= servo.control[1]
        start.ctrl[servo.u] = np.clip(start.ctrl[servo.u] + (-by if beyond else by), *servo.control)
    begins = f"{own.started.removeprefix('from ')}, each servo's target {FURTHER} rad or m further"
    return asked.of(replace(own, begun=start, begins=begins))


def _would_be_seen(asked: _Asked) -> bool:
    """Whether at its own steps anything diverges, or at the end shakes or stays far off."""
    moved = motion_at_steps(asked.own, asked.case.duration)
    if moved is None:
        return True
    times, y = moved
    shakes = shaking(asked.own, times, y, asked.opened.joint_bars)
    short = short_of_target(asked.own, float(times[-1]), y[-1])
    late = any(shake.ends >= LATE * times[-1] for shake in shakes.values())
    return late or any(off > asked.opened.joint_bars[k] for k, off in short.items())


def _advice_on(asked: _Asked, suspected: Sequence[Suspicion]) -> Tried:
    own, h = asked.own, asked.own.model.opt.timestep
    mine = integrator_of(own, Setting(OWN, {}, h))
    named = [Setting(i, {"integrator": i}, h) for i in INTEGRATORS if i != mine]
    result = steps(asked.case, asked.strict, ("solver",), named)
    exact = result.limit
    first, *others = result.settings
    known = f"{exact.method}, known to {result.known:.0e} rad or m"
    base = Tried(own.started, known, result.until, _recipe(asked, first, h))
    if not result.judges:
        return replace(base, because="its limit is not known well enough to judge steps")
    shown = seen(asked.opened, exact, result.until).joints
    coarsest = _coarsest(asked, result, [first, *others[-len(named) :]])
    usable = [recipe for recipe in coarsest if recipe.keeps]
    own_ratio = inf if base.own.ratio is None else base.own.ratio
    nearer = any((recipe.ratio or inf) < ARRIVES * own_ratio for recipe in coarsest)
    if own_ratio > 1 and not shown and not nearer:
        return replace(base, because="finer steps come no nearer to its limit")
    cures: list[Recipe] = []
    if shown or own_ratio > 1:
        at_own = [each for each in others if (each.keeps or 0.0) >= h]
        cures += [_recipe(asked, each, h) for each in at_own]
        cures += [recipe for recipe in usable if recipe.integrator == mine and recipe.step < h]
    kinds = own.model.jnt_type[own.model.dof_jntid]
    simple = [k for k in shown if k is not None and kinds[k] in ALONE]  # they turn, or shift
    for kind in changes(asked.case, own, simple):
        tried = (_changed(asked, change, result) for change in kind)
        cures += [*islice(filter(None, tried), 1)]
    return replace(
        base,
        seen=[*shown.values(), *_softened(asked, result)],
        suspected=[each.words for each in suspected if each.dof in shown],
        coarsest=coarsest,
        cures=cures,
        cheapest=_cheapest(usable),
    )


def _recipe(asked: _Asked, stepped: Stepped, step: float) -> Recipe:
    own, setting = asked.own, stepped.setting
    h, mine = own.model.opt.timestep, integrator_of(own, Setting(OWN, {}))
    ratios = {
        quantity: (error.ladder.errors.get(step, inf) if error.ladder else inf) / bar
        for (quantity, bar), error in zip(
            asked.opened.bars.items(), stepped.errors.values(), strict=True
        )
    }
    worst = max(ratios, key=lambda quantity: ratios[quantity])
    integrator = integrator_of(own, setting)
    written = ({} if step == h else {"timestep": step}) | dict(setting.options)
    words = [str(v) if k == "integrator" else f"{k} {v}" for k, v in setting.options.items()]
    return Recipe(
        ", ".join([*words, *([] if step == h else [milliseconds(step)])]),
        integrator,
        step,
        float(f"{EVALUATIONS[integrator] / step / (EVALUATIONS[mine] / h):.3g}"),
        ratios[worst] if ratios[worst] < inf else None,
        worst.name,
        stepped.keeps,
        option(written),
    )


def _coarsest(asked: _Asked, result: Steps, rows: Sequence[Stepped]) -> list[Recipe]:
    """Returns for each row its coarsest step within the bars, or the finest that was tried.

    Steps below the ladder are tried where they may cost less than what keeps the bars.
    """
    recipes = [_recipe(asked, row, _step(asked, row)) for row in rows]
    if apart_by_pairs(asked.own.model):
        return recipes
    for k in np.argsort([recipe.cost for recipe in recipes]):
        recipe, best = recipes[k], _cheapest(recipes)
        if recipe.keeps is None and (best is None or 2 * recipe.cost < best.cost):
            setting = replace(rows[k].setting, step=rows[k].setting.step / FINE)
            finer = in_setting(asked.strict, setting, result.limit, result.doubts, result.until)
            recipes[k] = _recipe(asked, finer, _step(asked, finer))
    return recipes


def _step(asked: _Asked, row: Stepped) -> float:
    """Returns the coarsest step [s] that keeps the bars, or the finest that was tried.

    None at which `refsafe` raises what it leaves at the model's own: another motion may touch it.
    """
    tried = {h for error in row.errors.values() if error.ladder for h in error.ladder.errors}
    if not tried:
        return row.setting.step
    raised = short_times(asked.own)
    usable = [h for h in tried if row.keeps and h <= row.keeps and (
        h <= asked.own.model.opt.timestep or short_times(asked.own, h) == raised)]  # fmt: skip
    return max(usable, default=min(tried))


def _cheapest(recipes: Sequence[Recipe]) -> Recipe | None:
    """Returns the one of least cost that keeps its bars; of equals the one that writes less."""
    usable = [recipe for recipe in recipes if recipe.keeps]
    return min(usable, key=lambda each: (each.cost, len(str(each.lines))), default=None)


def _changed(asked: _Asked, change: Changed, before: Steps) -> Recipe | None:
    """Returns a change if it cures at the model's own step.

    What it is compared with is its own limit: it has equations of its own.
    """
    new, m = asked.of(change.own), asked.own.model
    moved = motion_at_steps(new.own, before.until)
    if moved is None or shaking(new.own, *moved, new.opened.joint_bars):
        return None
    result = steps(asked.case, new.strict, (OF_STIFF,))
    if seen(new.opened, result.limit, result.until).joints:
        return None
    both = before.limit.times <= min(before.until, result.until)
    off = np.abs(joint_moves(m, before.limit.q, result.limit.q))[both].max(axis=0)
    k = int(np.argmax(off / asked.opened.joint_bars))
    name, unit = joint_of(m, k)
    return replace(
        _recipe(new, result.settings[0], m.opt.timestep),
        change=change.words,
        lines=change.lines,
        moves=f"{name} by up to {off[k]:.2g} {unit}",
        then=_cheapest(_coarsest(new, result, result.settings)),
    )


def _softened(asked: _Asked, result: Steps) -> Iterator[str]:
    """Yields what `refsafe` makes otherwise than it is written, if the motion shows it."""
    raised = short_times(asked.own)
    if not raised:
        return
    model, least = copy.copy(asked.own.model), min(time for _, time in raised) / SHORT
    model.opt.timestep = least
    try:
        written = limit(replace(asked.own, model=model), result.limit.times)
    except NoLimit:
        return
    off = np.abs(joint_moves(model, result.limit.q, written.q))[result.limit.times <= result.until]
    ratios = off.max(axis=0) / asked.opened.joint_bars
    k = int(np.argmax(ratios))
    if off[:, k].max() > asked.opened.joint_bars[k] + result.known + written.error:
        name, unit = joint_of(model, k)
        who = ", ".join(
            [*[element for element, _ in raised[:FEW]], *(["…"] if raised[FEW:] else [])]
        )
        yield (
            f"{who}: softer than written, as solref is raised to 2h: as written {name} moves "
            f"{off[:, k].max():.2g} {unit} otherwise; {milliseconds(least)} takes it as written"
        )
