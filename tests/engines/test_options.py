"""A user's own options stand on top of the shipped ones, and every mistake in them is named."""

import math
import re
from pathlib import Path
from typing import Any

import pytest
from given.adapters.planning import NAMES, SHIPPED, TUNED, begun, planned

from textmech import engines
from textmech.engines.step_scaled import at, tied

# Engine, options, words of the message.
MISTAKES: list[tuple[str, dict[Any, Any], str]] = [
    ("mujoco", {"integratr": "RK4"}, "did you mean 'integrator'"),
    ("mujoco", {1: 2}, "unknown option"),
    ("mujoco", {"integrator": "implict"}, "did you mean 'implicit'"),
    ("mujoco", {"cone": ["elliptic"]}, "pyramidal, elliptic"),
    ("mujoco", {"iterations": 2.5}, "whole number"),
    ("mujoco", {"iterations": 10**30}, "whole number"),
    ("mujoco", {"iterations": True}, "whole number"),
    ("mujoco", {"tolerance": math.nan}, "from 0 on"),
    ("mujoco", {"tolerance": 10**400}, "from 0 on"),
    ("mujoco", {"impratio": -1.0}, "from 0 on"),
    ("mujoco", {"step": None}, "positive"),
    ("mujoco", {"solref": [0.02]}, "list of 2"),
    ("mujoco", {"solref": [True, 1.0]}, "list of 2"),
    ("mujoco", {"solimp": [0.9, math.nan, 0.1]}, "list of 3 or 5"),
    ("mujoco", {"solref": ["2hh", 1.0]}, "such as 2h, -1/h or -0.25/h2"),
    ("mujoco", {"solref": ["1/h3", 1.0]}, "such as 2h"),
    ("mujoco", {"solref": ["__import__('os')", 1.0]}, "such as 2h"),
    ("mujoco", {"solimp": ["2h", 0.9, 0.001]}, "list of 3 or 5 finite numbers, is"),
    ("mujoco", {"impratio": "2h"}, "from 0 on"),
    ("mujoco", {"diagexact": 1}, "true or false"),
    ("mujoco", {"settled": "yes"}, "true or false"),
    ("mujoco", {"contacts": "slidee"}, "did you mean 'slide'"),
    ("mujoco", {"pair": [2, 1]}, "should be a map of solref, solimp, solreffriction"),
    ("pymunk", {"iteration": 30}, "pymunk.iteration: unknown option; did you mean 'iterations'?"),
    ("pymunk", {"qqq": 1}, "pymunk.qqq: unknown option; known: step, iterations"),
    ("pymunk", {"iterations": 0}, "pymunk.iterations: should be a whole number from 1"),
    ("pymunk", {"error_bias": -0.1}, "should be a number from 0 to 1, or scene, is -0.1"),
    ("pymunk", {"max_bias": math.nan}, "is nan"),
    ("pymunk", {"damping": math.inf}, "pymunk.damping: should be a number from 0 on, is inf"),
    ("pymunk", {"collision_slop": "thin"}, "is 'thin'"),
    ("pymunk", {"collision_persistence": 0}, "should be a whole number from 1"),
    ("pymunk", {"step": 0.0}, "pymunk.step: should be a positive number of seconds, is 0.0"),
    ("pymunk", {"iterations": "scen"}, "a whole number from 1 to 1000000, or scene, is 'scen'"),
    ("pymunk", {"damping": "scene"}, "should be a number from 0 on, is 'scene'"),
    ("pymunk", {"midpoint": 1}, "pymunk.midpoint: should be true or false, is 1"),
    ("pymunk", {"seed": 1.0}, "pymunk.seed: should be a number from 0 to 0.001"),
    ("pymunk", {"start_iterations": 0}, "whole number from 1 to 1000000, or scene"),
    ("pymunk", {"max_bias": -1.0}, "pymunk.max_bias: should be a number from 0 on"),
]

# In a group of MuJoCo's, with the whole line that names it.
IN_GROUPS: list[tuple[dict[str, Any], str]] = [
    (
        {"pair": {"solrf": [0.02, 1.0]}},
        "mujoco.pair.solrf: unknown option; did you mean 'solref'?",
    ),
    (
        {"connect": {"solreffriction": [0.02, 1.0]}},
        "mujoco.connect.solreffriction: unknown option; did you mean 'solref'?",
    ),
    (
        {"joint": {"solimpfriction": [0.9, "2h", 0.001]}},
        "mujoco.joint.solimpfriction: should be a list of 3 or 5 finite numbers, "
        "is [0.9, '2h', 0.001]",
    ),
    (
        {"pair": {"solref": ["h", 1.0]}},
        "mujoco.pair.solref: should be a list of 2 finite numbers, or texts such as 2h, -1/h or "
        "-0.25/h2, where h is the step, is ['h', 1.0]",
    ),
    (
        {"each": {"wall": {"solrf": [0.02, 1.0]}}},
        "mujoco.each.wall.solrf: unknown option; did you mean 'solref'?",
    ),
    (
        {"each": {"../x": {"solref": [0.02, 1.0]}}},
        "mujoco.each: '../x' can be the name of no contact and no joint",
    ),
    (
        {"each": {"wall": [0.02, 1.0]}},
        "mujoco.each.wall: should be a map of solreflimit, solimplimit, solref, solimp, "
        "solreffriction, margin, is [0.02, 1.0]",
    ),
    (
        {"each": "wall"},
        "mujoco.each: should be a map of contacts and stops, by their names, is 'wall'",
    ),
    (
        {"pair": {1: 2}},
        "mujoco.pair.1: unknown option; known: solref, solimp, solreffriction, margin",
    ),
]


@pytest.mark.parametrize(("options", "line"), IN_GROUPS, ids=str)
def test_a_wrong_option_of_a_group_is_named(options: dict[str, Any], line: str) -> None:
    with pytest.raises(ValueError, match="mujoco") as caught:
        engines.make("mujoco", "own", options)
    assert str(caught.value) == line


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


ALONE = {
    "solref": [0.03, 0.9],
    "solimp": [0.8, 0.9, 0.01],
    "solreffriction": [0.04, 0.9],
    "solreflimit": [0.05, 0.9],
    "solimplimit": [0.7, 0.9, 0.01],
}
"""All that one contact or one joint's stops may have of its own."""


@pytest.mark.parametrize(
    ("case", "element", "taken"),
    [
        ("friction_cone.forward", "touch", ["solref", "solimp", "solreffriction"]),
        ("stopped_pendulum.rests", "stop", ["solreflimit", "solimplimit"]),
    ],
)
def test_an_element_takes_what_is_of_its_kind(case: str, element: str, taken: list[str]) -> None:
    """A contact has no limit, and what stops a joint no friction: MJCF knows no such attribute."""
    own = engines.make("mujoco", "own", {"each": {element: ALONE}})
    values = {c.name: c.value for c in planned(own, *begun(case)).choices(1e-3)}
    found = {name: value for name, value in values.items() if name.startswith("each.")}
    assert found == {f"each.{element}.{name}": ALONE[name] for name in taken}


def known(name: str, **option: Any) -> list[str]:
    """What a wrong option's message says that there is."""
    with pytest.raises(ValueError, match="known: ") as caught:
        engines.make(name, "own", option)
    return str(caught.value).rpartition("known: ")[2].split(", ")


@pytest.mark.parametrize("name", NAMES)
def test_the_readme_names_every_option(name: str) -> None:
    text = (Path(engines.__file__).parent / "README.md").read_text(encoding="utf-8")
    table = text.partition(f"| {name} | |")[2].partition("\n\n")[0]
    for option in known(name, xyzzy=1):
        assert f"`{option}" in table, option
    for group in ("connect", "rod", "pair", "joint", "tendon") if name == "mujoco" else ():
        said = ", ".join(re.findall(rf"`{group}: {{(.*?)}}`", table)).split(", ")
        assert set(said) == set(known(name, **{group: {"xyzzy": 1}})), group


# Numbers that follow the step, by a closed grammar.


H = 0.5  # s: every power of it is exact, and another number

FOLLOWS = {"2h": 1.0, "-2h": -1.0, "8.0h": 4.0, "2 h": 1.0, " .5h": 0.25, "1e1h": 5.0}
FOLLOWS |= {"-1/h": -2.0, "-1 / h": -2.0, "0.25/h2": 1.0, "-0.25/h²": -1.0, "+3/h2": 12.0}


@pytest.mark.parametrize("text", FOLLOWS)
def test_what_follows(text: str) -> None:
    assert tied(text)
    assert at(text, H) == FOLLOWS[text]


FOLLOWS_NOT = ["h", "2", "RK4", "2hh", "2h2", "1/h3", "1/(h)", "2*h", "h/2", "nanh", "infh", ""]


@pytest.mark.parametrize("text", [*FOLLOWS_NOT, "1e101h", "-1e309/h", "1e5"])
def test_what_does_not(text: str) -> None:
    assert not tied(text)
    assert at(text, H) == text


def test_entries_of_lists() -> None:
    assert at(["2h", 1.0, ("-1/h", "word")], H) == [1.0, 1.0, [-2.0, "word"]]
    assert at({"a": "2h"}, H) == {"a": "2h"}
