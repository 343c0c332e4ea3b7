"""Which steps an engine is run with: the judged one, and the rungs of its ladders."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from ....cases.case import Case
from ....cases.scene import Scene
from ....cases.scene.quantity import table
from ....engines.engine import Engine, Plan

COARSEST = 8e-3  # s: larger steps are of no use to anyone who controls a body
SIZED = 4  # rungs, by which errors are seen to fall; with two exponents Romberg takes three
RUNGS_DOWN = 5  # from an engine's own step: enough for Romberg and three orders
USUAL = 1e-4  # s, where a case names no step: with it most shipped cases reach their textbook
WHOLE = 1e-9  # steps: a ratio that is whole up to rounding
MULTIPLE = 4  # of the step is the sample interval, or h, 2 h and 4 h do not meet every sample


@dataclass(frozen=True)
class Ladder:
    """`following`: tied numbers follow each step. `held`: they stay at the largest rung's."""

    name: str
    steps: tuple[float, ...]  # smallest first, doubling

    def plan(self, plan: Plan) -> Plan:
        """The plan with which the ladder is climbed."""
        return plan if self.name == "following" else plan.held_at(self.steps[-1])


def judged_step(case: Case, engine: Engine) -> float:
    """The step [s] at which an engine is judged: its own, else the case's, else the usual one.

    The case's divides the sample interval as it is; the usual one is shortened until it does. Its
    own stays what it is: another step is another question, see `sampled`.
    """
    if engine.own_step is not None:
        return engine.own_step
    given = case.step.get(engine.name) if isinstance(case.step, Mapping) else case.step
    if given is not None:
        return given
    return case.interval / (MULTIPLE * _whole(case.interval / (MULTIPLE * USUAL)))


def _whole(ratio: float) -> int:
    """Rounds a ratio up, unless it is whole up to rounding."""
    return max(1, -int(-(ratio - WHOLE) // 1))


def sampled(case: Case, engine: Engine) -> Case:
    """The case with samples that the engine's own step meets: as often as it says, or a bit more.

    The reference is solved for these times; nobody interpolates, and no step is shortened.
    """
    own = engine.own_step
    if case.states is not None:  # unrelated, and no step meets them
        return case
    if own is None or abs(case.interval / own - round(case.interval / own)) <= WHOLE:
        return case
    interval = own * max(1, int(case.interval / own))
    whole = int(case.duration / interval + WHOLE)
    return replace(case, duration=whole * interval, samples=whole + 1)


def ladders(case: Case, engine: Engine, plan: Plan) -> Iterator[Ladder]:
    """The plan's ladders for the case, the judged step's first; the second begins a rung above."""
    h = judged_step(case, engine)
    if engine.own_step is not None:
        yield Ladder("held", tuple(h / 2**k for k in reversed(range(RUNGS_DOWN))))
        return
    steps = tuple(_upward(h, case.interval))
    if plan.following is None:
        yield Ladder("held", steps)
        return
    yield Ladder("following", steps)
    if not plan.alike:
        # The finest rung is half of the work, and the numbers held are those of the largest.
        yield Ladder("held", steps[1:] if len(steps) > SIZED else steps)


def _upward(h: float, interval: float) -> Iterator[float]:
    per_sample = round(interval / h)
    yield h
    while per_sample % 2 == 0 and 2 * h <= COARSEST:
        h, per_sample = 2 * h, per_sample // 2
        yield h


def wanted_reactions(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """The reactions, that only the producer can give, from which the quantities follow."""
    parts = {*scene.joints, *scene.constraints, *scene.contacts, *scene.pairs, *scene.bodies}
    parts |= {force.name for force in scene.forces.values() if force.given}
    known = table(scene)
    forces = (
        name
        for name in names
        if name.split(".")[0] in parts
        and name in known
        and known[name].kind in ("force", "acceleration", "energy")  # of a joint: its drives' work
    )
    reactions = (given for name in forces for given in scene.told_by(name))
    return tuple(dict.fromkeys([*reactions, *scene.inner()]))
