"""Random scenes of every smooth word, typed to a file: both read it and move the same."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from second import answer, both, drawn_plane, drawn_space, drawn_switching, events, read, size
from second.motion import Motion
from second.moving import Array
from second.test_shipped import disagree

MOVES = 1e-3  # of its size, and 1e-6 in SI: a quantity that moves less is left out of a claim
EARLY = 2e-8  # s, 1e-7 of what a scene lasts: by so much may the time of an event differ
READ = ("x", "y", "z", "vx", "vy", "vz", "speed", "angle", "omega", "shift")
EVERY = 1e3  # what is allowed: nothing is claimed of an engine here
PLANE, SPACE, SWITCHING = range(20), range(14), range(4)
CORNER = 158  # an event in the step before a table's corner
MORE_PLANE, MORE_SPACE, MORE_SWITCHING = range(20, 60), range(14, 40), range(4, 40)


def moving(motion: Motion, case: dict[str, Any]) -> list[str]:
    """The quantities that move: of others the suite wants to be told that they stay."""
    found = []
    for name in case["allow"]:
        seen = answer.observed(motion, name)
        span = float(np.max(np.ptp(seen, axis=0)))
        if span > max(1e-6, MOVES * size.size(motion, name, seen)):
            found.append(name)
    return found


def passed(motion: Motion, names: list[str]) -> dict[str, Any]:
    """An event half way through what moves evenly, if something does."""
    for name in names:
        if name[0] in "bj" and name.rsplit(".", 1)[-1] in READ:
            seen: Array = answer.observed(motion, name)
            steps = np.diff(seen)
            middle = float(seen[len(seen) // 2]) + 0.3 * float(steps[len(seen) // 2])
            least = 1e-6 * float(np.max(np.abs(steps)))  # less is no motion, but rounding at rest
            if np.all(steps > least):
                return {"passes": {name: {"rises to": middle}}}
            if np.all(steps < -least):
                return {"passes": {name: {"falls to": middle}}}
    return {}


def compared(told: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Where the two answers to a file disagree."""
    (case,) = read.cases(told, "drawn").values()
    motion = answer.motion(case)
    wanted = moving(motion, case)
    if not wanted:
        told["rests"], wanted = True, case["allow"]
    told |= {"allow": {name: 1e9 if name.endswith("work") else EVERY for name in wanted}}
    told["events"] |= {} if "rests" in told else passed(motion, wanted)
    told["allow"] |= {f"{event}.time": EVERY for event in told["events"]}
    path = folder / "drawn.yaml"
    path.write_text(json.dumps(told, ensure_ascii=False), encoding="utf-8")
    (answered,) = both.solved(path).values()
    found: dict[str, Any] = disagree(motion, answered, wanted)
    for event, says in told["events"].items():
        mine, known = events.times(motion, says), both.happened(answered, event)
        if len(mine) != len(known) or not np.allclose(mine, known, rtol=0, atol=EARLY):
            found[event] = (known, mine)
    return found


def seeds(normal: range, more: range) -> list[Any]:
    """Some of the normal test, and more of the whole one."""
    return [*normal, *(pytest.param(seed, marks=pytest.mark.slow) for seed in more)]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [*seeds(PLANE, MORE_PLANE), CORNER])
def test_a_random_scene_in_the_plane_moves_the_same(seed: int, tmp_path: Path) -> None:
    assert compared(drawn_plane.drawn(seed), tmp_path) == {}


@pytest.mark.slow
@pytest.mark.parametrize("seed", seeds(SPACE, MORE_SPACE))
def test_a_random_scene_in_space_moves_the_same(seed: int, tmp_path: Path) -> None:
    assert compared(drawn_space.drawn(seed), tmp_path) == {}


@pytest.mark.slow
@pytest.mark.parametrize("seed", seeds(SWITCHING, MORE_SWITCHING))
def test_a_random_scene_that_switches_moves_the_same(seed: int, tmp_path: Path) -> None:
    assert compared(drawn_switching.drawn(seed), tmp_path) == {}
