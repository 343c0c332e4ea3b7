"""What lies between a row's own setting and the tuned one: its levers, and its steps."""

from ... import engines
from ...engines.engine import Tunable
from ..trial.ladder import judged_step
from ..trial.start import first
from ..unit import Pair
from .candidate import Candidate
from .lever import STEP, Field, halved, levers, remainder

ALONE = 16  # times finer: as far as an engine's own ladder goes, or to the tuned setting's step
BESIDE = 4  # times, beside other changes, or to the tuned setting's step
FINEST = 8  # times, of the tuned setting, which has nothing else to be changed


def between(pair: Pair) -> Field:
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
    knobs = engine.knobs(case.scene, start)
    found = levers(knobs, own)
    beside, alone = (halved(step, min(step / finer, least)) for finer in (BESIDE, ALONE))
    rest = remainder(knobs, engine.recipe(case.scene, start)) if best else None
    return Field(Candidate.of(own, step), [*found, STEP], beside, alone, rest)
