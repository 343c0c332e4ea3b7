"""What is only a part of a check, and was never seen to make it fail: each by itself."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes, written_scenes
from given.certified import certified
from given.claims import CHAIN, claimed
from given.mutants import mutant

from textmech.cases.scene.joint import Joint
from textmech.reference.certificate import agreement, errors
from textmech.reference.certificate.agreement import Check
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.states import answer
from textmech.reference.states import answer as held
from textmech.reference.system import System
from textmech.reference.systems import written

Patch = pytest.MonkeyPatch
JUMP = "spring_mass_jump.best"
Event = tuple[str, float]


def muscle(share: float, inner: bool = True) -> float:
    """How far a muscle's motion is from itself with its inner state so much longer."""
    case, motion = scenes.SHIPPED["muscle_load"], scenes.solved("muscle_load").trajectory
    (name,) = case.scene.inner()
    lengths = {**motion.reactions, name: (1 + share) * motion.reactions[name]}
    other = replace(motion, reactions=lengths)
    return agreement.difference(motion, other, case.scene.inner() if inner else ())


def test_inner_states_are_compared() -> None:
    assert muscle(0.0) == 0.0
    assert muscle(1e-6) == pytest.approx(1e-6, rel=1e-6)


@pytest.mark.mutant("inner states of muscles not compared")
def test_a_muscle_that_is_not_compared_is_seen() -> None:
    assert muscle(1e-6, inner=False) == 0.0


def events(folder: Path, known: Callable[[list[Event]], list[Event]]) -> Check:
    """The check of what a block's system says that it does, said otherwise."""
    case = written_scenes.case(folder, "braking")
    sound: System = written(case.system or "", case.parameters)

    def closed_events(self: System, until: float) -> list[Event]:
        return known(sound.closed_events(until) or [])

    checks = certified(case, mutant(sound, closed_events=closed_events))
    return next(check for check in checks if check.name == "closed events")


SAID: dict[str, Callable[[list[Event]], list[Event]]] = {
    "one fewer": lambda said: said[1:],
    "one more": lambda said: [*said, (said[0][0], said[0][1] + 0.1)],
    "one of another name": lambda said: [*said, ("leaves", said[0][1])],
    "another name": lambda said: [("leaves", t) for _, t in said],
    "1e-9 s later": lambda said: [(name, t + 1e-9) for name, t in said],
}


def test_known_events_agree(tmp_path: Path) -> None:
    assert events(tmp_path, lambda said: said).holds


@pytest.mark.mutant("known functions tell of the events {said}")
@pytest.mark.parametrize("said", SAID)
def test_other_known_events_are_seen(said: str, tmp_path: Path) -> None:
    assert not events(tmp_path, SAID[said]).holds


def at_event(late: float) -> Check:
    """What is certified of a jumper's speed as it takes off, if that is known so well [s]."""
    case, motion = scenes.SHIPPED[JUMP], scenes.solved(JUMP).trajectory
    found = errors.errors(case, motion, {}, late)
    return next(c for c in found if c.name == "error of takes_off.jumper.vy")


@pytest.mark.slow
def test_a_state_at_an_event_is_known_as_well_as_its_time() -> None:
    """Beside what it is off by itself, the fastest change times what the event is late."""
    motion = scenes.solved(JUMP).trajectory
    vy = motion.states["jumper"][:, 4]
    fastest = np.max(np.abs(np.diff(vy) / np.diff(motion.times)))
    one, other = at_event(0.0).certified, at_event(1e-3).certified
    assert one is not None
    assert other is not None
    assert other - one == pytest.approx(1e-3 * fastest, rel=1e-9)


@pytest.mark.mutant("the share of a late event in the error of a state left out")
def test_a_late_event_that_does_not_count_is_seen(monkeypatch: Patch) -> None:
    flat = SimpleNamespace(**(vars(np) | {"diff": lambda x: 0.0 * np.diff(x)}))
    monkeypatch.setattr(errors, "np", flat)
    assert at_event(1e-3).certified == at_event(0.0).certified


def hurried() -> Callable[..., Any]:
    """Accelerations that are a thousandth too large."""
    sound = held.moving

    def moving(*given: Any) -> Any:
        return {name: 1.001 * x for name, x in sound(*given).items()}

    return moving


def slower(self: Any, *given: Any) -> Any:
    """Rates of joints read a thousandth too small."""
    places, rates = COORDINATES(self, *given)
    return places, 0.999 * rates


def nearer(self: Any, *given: Any) -> Any:
    places, rates = COORDINATES(self, *given)
    return 0.999 * places, rates


def otherwise(part: int) -> Callable[..., Any]:
    """States with one part off by a thousandth: places (0), or velocities (1)."""
    place = SpatialMultibody.place

    def placed(self: Any, poses: Any) -> Any:
        at = [*place(self, poses)]
        at[part] = at[part] + 1e-3
        return tuple(at)

    return placed


COORDINATES = Joint.coordinates
STATES: dict[str, tuple[str, Any, str, Callable[..., Any]]] = {
    "accelerations of a chain": ("joints hold", held, "moving", hurried()),
    "velocities of a chain": ("joints hold", SpatialMultibody, "place", otherwise(1)),
    "places of a chain": ("joints hold", SpatialMultibody, "place", otherwise(0)),
    "rates of joints": ("coordinates read back", Joint, "coordinates", slower),
    "places of joints": ("coordinates read back", Joint, "coordinates", nearer),
}


def broken(folder: Path) -> set[str]:
    _, checks = answer.answered(claimed(folder, CHAIN))
    return {check.name.partition(" (")[0] for check in checks if not check.holds}


@pytest.mark.slow
@pytest.mark.mutant("{what} a thousandth off, in a claim about states")
@pytest.mark.parametrize("what", STATES)
def test_a_check_of_states_fails_by_itself(what: str, tmp_path: Path, monkeypatch: Patch) -> None:
    seen, owner, name, plant = STATES[what]
    assert broken(tmp_path) == set()
    monkeypatch.setattr(owner, name, plant)
    assert seen in broken(tmp_path)
