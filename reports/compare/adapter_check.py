"""An engine on shipped cases from the easiest on, each judged by itself: for whoever writes one.

What a run of the suite judges is how near an engine comes; here it is whether its adapter is right.
"""

import pickle
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ...cases.case import Case
from ...cases.language.check.work import LIMIT
from ...engines.engine import Claims, Diverged, Engine, Paced, Plan, Refusal, Tunable, lacking
from ...reference.solve import solve
from ..tables.row import DEVIATES, REFUSED
from .judge.compare import answered
from .likely_mistakes import ROUGH, Compared, explained, factor, shifted
from .trial import states
from .trial.answers import BadAnswer, moved
from .trial.audit import EQUAL, audited
from .trial.ladder import judged_step, sampled, wanted_reactions
from .trial.limit import limit
from .trial.run import climbed
from .trial.start import first
from .trial.table_text import why
from .trial.trial import Trial, with_room
from .trial.trial import ways as ways_of
from .trial.work import pace

LONGEST = 2.0  # s of a motion: more of it shows no other mistake
FINER = 4  # times the steps: what a coarse step is to blame for is less with them
AWAY = 20  # steps about a jump where nothing is compared: a floor that is a spring takes 16 for it

Outcome = Literal["works", "refused", "wrong", "crashed", "not there"]


@dataclass(frozen=True)
class Grade:
    """One thing to try: its name, the shipped case for it, and the reactions that are looked at."""

    name: str
    case: str
    reactions: tuple[str, ...] = ()


GRADES = (
    Grade("falls", "falling_too_far"),
    Grade("pendulum", "bar_pendulum", ("hinge.fx", "hinge.fy")),
    Grade("rod", "particle_pendulum", ("rod.fx", "rod.fy")),
    Grade("spring", "elastic_pendulum.swings"),
    Grade("slide and damper", "spring_mass_damper.underdamped"),
    Grade("torsion and motor", "torsion_pendulum.driven"),
    Grade("push", "pushed_cart.polynomial"),
    Grade("chain", "double_pendulum", ("elbow.fx", "elbow.fy")),
    Grade("free chain", "free_pair", ("elbow.fx", "elbow.fy")),
    Grade("loop", "four_bar", ("C.fx", "C.fy")),
    Grade("loop with a slide", "slider_crank"),
    Grade("drive", "trolley", ("rail.drive",)),
    Grade("blade", "knife_edge.thrown", ("edge.force",)),
    Grade("dry friction of a joint", "bearing.dry"),
    Grade("stops", "stopped_pendulum.rests"),
    Grade("rope", "ball_on_rope.caught"),
    Grade("rolling", "rolling_wheel.pushed", ("touch.normal", "touch.tangent")),
    Grade("friction", "sliding_block.braking", ("touch.normal", "touch.tangent")),
    Grade("sliding, then rolling", "sliding_disk.backspin"),
    Grade("impact", "bouncing_ball"),
    Grade("two bodies touch", "disk_on_disk.smooth", ("touch.normal",)),
    Grade("stack", "stacked_blocks.pulled"),
    Grade("space: free", "torque_free.thrown"),
    Grade("space: ball joint", "heavy_top.cusp", ("pivot.fx", "pivot.fy", "pivot.fz")),
    Grade("space: hinges", "skew_chain", ("q1.fx", "q1.fy", "q1.fz")),
    Grade("space: forces", "tethered_box"),
    Grade("space: loop", "spatial_four_bar"),
    Grade("space: drives", "cross_slide", ("guide.x_force", "guide.turn_torque")),
    Grade("space: rolling", "rolling_sphere", ("touch.fx", "touch.normal")),
    Grade("states", "planar_bodies"),
    Grade("states in space", "robot_states"),
)
"""From the easiest on."""

SCRIPT = "script"  # the one member of the protocol without which all cases still run
LOST = {
    Tunable: "`textmech advise` and `textmech causes` find no settings",
    Claims: "claims about states are refused",
    Paced: "limits of time count 25 µs a step and 1.5 µs a body",
}
"""What an engine may offer beside the protocol, and what one has not without it."""


@dataclass(frozen=True)
class Mark:
    """The result of a grade: in words, and with the mistakes that would explain it.

    off: how far the worst of it is off, over the size of that in the motion.
    """

    grade: str
    case: str
    outcome: Outcome
    what: str = ""
    off: float | None = None
    likely: tuple[str, ...] = ()

    @property
    def fails(self) -> bool:
        """Whether it is a mistake: what an engine does not offer, or refuses, is none."""
        return self.outcome in ("wrong", "crashed")


def members(engine: Engine) -> list[Mark]:
    """Marks of the parts of the protocol: whether each is there, and what is lost without it."""
    missing = [name for name in lacking(engine, Engine) if name != SCRIPT]
    text = f"it has no {', '.join(missing)}" if missing else f"version {engine.version}"
    marks = [Mark("protocol", "", "wrong" if missing else "works", text)]
    if not hasattr(engine, SCRIPT):
        marks.append(Mark(SCRIPT, "", "not there", "`textmech show` has nothing to show"))
    for protocol, lost in LOST.items():
        name = protocol.__name__
        if missing := lacking(engine, protocol):
            what = f"no {', '.join(missing)}: {lost}"
            marks.append(Mark(name, "", "not there", what))
        else:
            marks.append(Mark(name, "", "works"))
    return marks


@dataclass(frozen=True)
class Attempt:
    """An engine at a grade. It is pickled."""

    grade: Grade
    given: Case
    engine: Engine

    @property
    def name(self) -> str:
        """The name that progress shows."""
        return f"{self.grade.name} in {self.engine.name}.{self.engine.setting}"

    @property
    def limit(self) -> float:
        """The time [s] that it may take: its runs, and a few references."""
        return limit((1 + FINER) * self.given.duration / self.step * self._pace) + LIMIT

    @property
    def step(self) -> float:
        """The step of the run [s]."""
        return judged_step(self.given, self.engine)

    @property
    def _pace(self) -> float:
        return pace(self.given, self.engine)

    @cached_property
    def case(self) -> Case:
        """The case without its bars, as long as is of use, with samples that the steps meet."""
        if self.given.states is not None:
            return replace(self.given, reach={})
        n = min(self.given.samples, int(LONGEST / self.given.interval) + 1)
        duration = (n - 1) * self.given.interval
        short = replace(self.given, samples=n, duration=duration, allow={}, reach={}, deviates={})
        return sampled(short, self.engine)

    def mark(self, outcome: Outcome, what: str = "", **values: Any) -> Mark:
        """The mark of this attempt, with this outcome and these words."""
        return Mark(self.grade.name, self.given.name, outcome, what, **values)


def marked(attempt: Attempt) -> Mark:
    """The mark of an attempt, whatever the engine answers; who runs the task handles its errors."""
    try:
        return _states(attempt) if attempt.case.states is not None else _motion(attempt)
    except BadAnswer as bad:
        return attempt.mark("wrong", str(bad))
    except Diverged as gone:
        return attempt.mark("wrong", f"it diverges: {gone}")


def _motion(attempt: Attempt) -> Mark:
    case, engine = attempt.case, attempt.engine
    reference = solve(case).trajectory
    start = first(reference)
    ways = with_room(ways_of(engine, case.scene, start), case, engine)
    plans = [way for way in ways if isinstance(way, Plan)]
    if not plans:
        return attempt.mark("refused", "; ".join(w.because for w in ways if isinstance(w, Refusal)))
    plan = plans[0]
    if not_pickled := _not_pickled(plan):
        return attempt.mark("wrong", not_pickled)
    trial = Trial(case, reference, engine, plan)
    if wrong := _numbers(attempt, trial):
        return wrong
    compared = _run(attempt, trial, attempt.step)
    shares = compared.off() | compared.forces_off()
    off = max(shares.values())
    how = "" if plan.realised == "native" else f" by its {plan.realised}"
    if off <= ROUGH:
        return attempt.mark("works", f"{_percent(off)} off{how}", off=off, likely=shifted(compared))
    finer = _run(attempt, trial, attempt.step / FINER)
    less = max((finer.off() | finer.forces_off()).values())
    if less <= ROUGH:
        what = (
            f"{_percent(off)} off at {attempt.step:g} s, {_percent(less)} at a quarter of that{how}"
        )
        return attempt.mark("works", what, off=off)
    largest = ", ".join(f"{name} {_percent(x)}" for name, x in _largest(shares) if x > ROUGH)
    return attempt.mark("wrong", f"off: {largest}{how}", off=off, likely=explained(compared))


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"


def _largest(shares: Mapping[str, float]) -> list[tuple[str, float]]:
    return sorted(shares.items(), key=lambda item: -item[1])[:3]


def _not_pickled(plan: Plan) -> str:
    try:
        pickle.loads(pickle.dumps(plan))
    except Exception as error:
        rule = "its functions are functions with a name, or `functools.partial` of them"
        return f"its plan cannot cross into another process ({why(error)}): {rule}"
    return ""


def _numbers(attempt: Attempt, trial: Trial) -> Mark | None:
    """Returns a mark if a number read back before any step, as a mass, is wrong."""
    wanted, read, off = audited(trial)
    wrong = sorted((name for name in off if off[name] > EQUAL), key=lambda name: -off[name])
    if not wrong:
        return None
    lines = [f"{name} is {read[name]:.6g}, the case says {wanted[name]:.6g}" for name in wrong[:3]]
    likely = [factor(name, read[name], wanted[name], trial.case.scene) for name in wrong[:3]]
    named = [f"{name}: {x}" for name, x in zip(wrong, likely, strict=False) if x]
    return attempt.mark("wrong", f"measure: {'; '.join(lines)}", likely=tuple(named))


def _run(attempt: Attempt, trial: Trial, step: float) -> Compared:
    """The run beside the reference. Raises BadAnswer and Diverged."""
    case, plan = trial.case, trial.plan
    names = tuple(r for r in attempt.grade.reactions if r not in plan.withheld)
    wanted = tuple(r for r in wanted_reactions(case.scene, names) if r not in plan.withheld)
    run = attempt.engine.run(
        case.scene, trial.start, case.times, step, plan, reactions=wanted, record=True
    )
    motion = moved(run, case.scene, case.times)
    for name, rows in motion.states.items():
        if not np.all(np.isfinite(rows)):
            raise BadAnswer(f"states of {name} are not finite: a motion that diverges is Diverged")
    if lost := [name for name in names if name not in motion.reactions]:
        raise BadAnswer(f"{', '.join(lost)} is asked for, is not withheld, and is not given")
    if motion.record is not None and len(motion.record.times) < round(case.times[-1] / step):
        raise BadAnswer(f"the record has {len(motion.record.times)} rows: it holds every step")
    reactions = {name: motion.reactions[name] for name in names}
    keep = trial.away(AWAY * step)
    keep = keep if np.any(keep) else np.full_like(keep, True)
    return Compared(case, step, trial.reference, motion.states, reactions, keep)


def _states(attempt: Attempt) -> Mark:
    """The mark of a claim about states, where nothing moves."""
    case, engine = attempt.case, attempt.engine
    reference = solve(case).trajectory
    way = states.ways(engine, case, first(reference))[0]
    if isinstance(way, Refusal):
        return attempt.mark("refused", way.because)
    trial = Trial(case, reference, engine, way)
    climb = climbed(states.rung(trial))
    outcome = answered(trial, climb)
    off = [r for r in outcome.rows if r.verdict not in (REFUSED, DEVIATES)]
    wrong = [row for row in off if row.ratio is None or not row.ratio <= 1]
    if not wrong:
        deviates = [row.because for row in outcome.rows if row.verdict == DEVIATES]
        words = f"{len(off) - 1} quantities"  # beside the audit
        return attempt.mark("works", "; but ".join([words, *deviates]))
    words = [f"{row.quantity} {row.because or f'×{row.ratio:.2g} its tolerance'}" for row in wrong]
    return attempt.mark("wrong", "; ".join(words[:3]))
