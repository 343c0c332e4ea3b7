"""Steps models by their own settings with the MuJoCo that Python has, and writes that as JSON.

`textmech versions` starts it as a process of its own, with each release.
"""

import json
import sys
from typing import Any

from ....cases.mistake import CaseError
from ....cases.model_case import ModelCase
from ....engines.mujoco.callbacks.signal import listening
from ....engines.own_model.limit import stepped_states
from ....engines.own_model.opened import opened
from ...compare.own_steps import times_of
from ...runs.chosen_models import choose_models


def stepped(case: ModelCase) -> dict[str, Any]:
    """Returns samples y of (qpos, qvel, act) at times [s]; or because of what there are none."""
    try:
        own = opened(case).own
    except CaseError as error:
        return {"because": "; ".join(mistake.what for mistake in error.mistakes)}
    h = own.model.opt.timestep
    times = times_of(case, [h])
    y = stepped_states(own, times, {}, h)
    if y is None:
        return {"because": "its own step diverges"}
    return {"times": times.tolist(), "y": y.tolist()}


if __name__ == "__main__":
    with listening():
        samples = {case.name: stepped(case) for case in choose_models(sys.argv[1:]).cases}
    json.dump(samples, sys.stdout)
