"""Whether an engine of somebody else's can be asked what of it can be turned."""

from collections.abc import Mapping

from .... import engines
from ....engines.engine import Plan, Tunable
from ...compare.trial.start import first
from ...compare.trial.trial import planned
from ...system.pool import Died
from ..task_results import Results
from ..tasks import Pair


def lost(pairs: Mapping[str, Pair], results: Results) -> dict[str, str]:
    """By their keys the pairs whose engine cannot, and why: tried in other processes.

    What passes is asked once more in this one, where the search is.
    """
    strange = {key: pair for key, pair in pairs.items() if engines.foreign(pair.engine.name)}
    found = results.anew("plans", _asked, strange) if strange else {}
    return {key: died.because for key, died in found.items() if isinstance(died, Died)}


def _asked(pair: Pair) -> None:
    engine, scene, start = pair.engine, pair.case.scene, first(pair.reference())
    ways = planned(engine, scene, start)
    native = any(isinstance(way, Plan) and way.realised == "native" for way in ways)
    if isinstance(engine, Tunable) and native:
        options = engine.recipe(scene, start)
        engine.knobs(scene, start)
        for step in engine.steps:
            float(engine.cost(options, step, scene))
            engine.snippet(scene, start, options, step)
