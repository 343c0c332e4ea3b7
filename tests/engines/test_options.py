"""A user's own options stand on top of the shipped ones, and every mistake in them is named."""

import math
from typing import Any

import pytest
from given.planning import NAMES, SHIPPED, TUNED, begun, planned

from textmech import engines

# Engine, options, words of the message.
MISTAKES: list[tuple[str, dict[Any, Any], str]] = [
    ("mujoco", {"integratr": "RK4"}, "did you mean 'integrator'"),
    ("mujoco", {1: 2}, "unknown option"),
    ("mujoco", {"integrator": "implict"}, "did you mean 'implicit'"),
    ("mujoco", {"cone": ["elliptic"]}, "pyramidal, elliptic"),
    ("mujoco", {"iterations": -1}, "whole number"),
    ("mujoco", {"iterations": 2.5}, "whole number"),
    ("mujoco", {"iterations": 10**30}, "whole number"),
    ("mujoco", {"iterations": math.inf}, "whole number"),
    ("mujoco", {"iterations": math.nan}, "whole number"),
    ("mujoco", {"iterations": True}, "whole number"),
    ("mujoco", {"iterations": "50"}, "whole number"),
    ("mujoco", {"tolerance": math.nan}, "at least 0"),
    ("mujoco", {"tolerance": 10**400}, "at least 0"),
    ("mujoco", {"impratio": -1.0}, "at least 0"),
    ("mujoco", {"step": 0}, "positive"),
    ("mujoco", {"step": None}, "positive"),
    ("mujoco", {"solref": [0.02]}, "list of 2"),
    ("mujoco", {"solref": 0.02}, "list of 2"),
    ("mujoco", {"solref": [True, 1.0]}, "list of 2"),
    ("mujoco", {"solimp": [0.9, math.nan, 0.1]}, "list of 3 or 5"),
    ("mujoco", {"solimp": [0.9, 0.9]}, "list of 3 or 5"),
    ("pymunk", {"iteration": 30}, "pymunk.iteration: unknown option; did you mean 'iterations'?"),
    ("pymunk", {"qqq": 1}, "pymunk.qqq: unknown option; known: step, iterations"),
    ("pymunk", {"iterations": 0}, "pymunk.iterations: should be a whole number from 1"),
    ("pymunk", {"iterations": 2.5}, "pymunk.iterations: should be a whole number"),
    ("pymunk", {"iterations": True}, "is True"),
    ("pymunk", {"error_bias": -0.1}, "pymunk.error_bias: should be a number from 0 to 1, is -0.1"),
    ("pymunk", {"max_bias": -1.0}, "pymunk.max_bias: should be a number from 0 on"),
    ("pymunk", {"max_bias": math.nan}, "is nan"),
    ("pymunk", {"damping": math.inf}, "pymunk.damping: should be a number from 0 on, is inf"),
    ("pymunk", {"collision_slop": "thin"}, "is 'thin'"),
    ("pymunk", {"collision_persistence": 0}, "should be a whole number from 1"),
    ("pymunk", {"step": 0.0}, "pymunk.step: should be a number above 0 seconds, is 0.0"),
    ("pymunk", {"step": math.nan}, "pymunk.step"),
]


@pytest.mark.parametrize(("name", "options", "words"), MISTAKES, ids=str)
def test_a_wrong_option_is_named(name: str, options: dict[Any, Any], words: str) -> None:
    with pytest.raises(ValueError, match=rf"^{name}\.{next(iter(options))}: ") as caught:
        engines.make(name, "own", options)
    assert words in str(caught.value)


SEVERAL = {
    "mujoco": {"inpratio": 1.0, "cone": "round", "step": -1},
    "pymunk": {"iteration": 30, "damping": -1.0, "step": -1},
}


@pytest.mark.parametrize("name", NAMES)
def test_all_mistakes_at_once(name: str) -> None:
    with pytest.raises(ValueError, match="unknown option") as caught:
        engines.make(name, "own", SEVERAL[name])
    lines = str(caught.value).splitlines()
    assert [line.partition(":")[0] for line in lines] == [f"{name}.{key}" for key in SEVERAL[name]]


# The step that a user gets, in s: MuJoCo's default; pymunk has none, its examples use 10 ms.
OWN_STEP = {"mujoco": 2e-3, "pymunk": 0.01}


@pytest.mark.parametrize("name", NAMES)
def test_own_step(name: str) -> None:
    assert engines.make(name, "own", {"step": 5e-4}).own_step == 5e-4
    assert engines.make(name, "own").own_step == SHIPPED[name].own_step == OWN_STEP[name]
    assert TUNED[name].own_step is None  # the case names it


# Options, and the choices of four_bar that they change.
OWN: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "mujoco": (
        {"iterations": 50, "solref": [0.03, 0.9], "step": 1e-3},
        {"option.iterations": 50, "connect.solref": [0.03, 0.9]},
    ),
    "pymunk": (
        {"iterations": 50, "error_bias": 0, "step": 1e-3, "max_bias": math.inf},
        {"space.iterations": 50, "constraint.error_bias": 0},
    ),
}


@pytest.mark.parametrize("name", NAMES)
def test_own_options_stand_on_top_of_the_shipped_ones(name: str) -> None:
    options, changed = OWN[name]
    own, shipped = (
        {c.name: c.value for c in planned(engine, *begun("four_bar")).choices(1e-3)}
        for engine in (engines.make(name, "own", options), SHIPPED[name])
    )
    assert own == shipped | changed
