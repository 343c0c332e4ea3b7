"""No answer depends on how often it is looked at, nor on the order of what a file names."""

from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws import resampled
from given.laws.refused import refused

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.reference import assumptions
from textmech.reference.assumptions import check_premises
from textmech.reference.motion.follow import follow
from textmech.reference.solve import mechanism, solve
from textmech.reference.systems import written

# No answer depends on how often it is looked at: fewer samples, more, and some on its events.
# A case of each shipped file is solved once more with another number of samples, and held against
# what its own say: the motion at common times, the events, and the verdict of the certificate.

NAMES = list(scenes.ONE_OF_EACH_FILE)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_other_samples_tell_the_same(name: str) -> None:
    """Three times as many of one case, a third of the next: to solve all twice is too dear."""
    case, known = scenes.SHIPPED[name], scenes.solved(name)
    which = NAMES.index(name) % 2
    other = resampled.resampled(case, resampled.counts(case)[which])
    assert list(resampled.differences(case, known, other, solve(other))) == []


TURNS = "elastic_pendulum.swings"  # its event is read from the motion, and changes no mode
SWITCHING = [n for n in scenes.ONE_OF_EACH_FILE if scenes.SHIPPED[n].events and n != TURNS]


@pytest.mark.slow
@pytest.mark.parametrize("name", SWITCHING)
def test_a_sample_on_an_event_changes_nothing(name: str) -> None:
    """Of the motion up to a little after its first event, which is the third of four samples."""
    case = scenes.SHIPPED[name]
    system = written(case.system, case.parameters) if case.system else mechanism(case)
    changes = [change.time for change in follow(system, case.times).changes if change.time > 0]
    first, many = changes[0], 201
    on = np.array([0.0, first / 2, first, 1.5 * first])
    off = np.array([0.0, *np.linspace(0.0, 1.5 * first, many)[1:-1] * 0.999, 1.5 * first])
    one, other = follow(system, on), follow(system, off)
    assert [c.name for c in one.changes] == [c.name for c in other.changes]
    ours, theirs = ([c.time for c in found.changes] for found in (one, other))
    late = max(1e-9, 2 * system.blurred)
    np.testing.assert_allclose(ours, theirs, atol=late)
    size = np.max(np.abs(other.y))
    # After an event both are as far apart as its time is known, by what changes most.
    np.testing.assert_allclose(one.y[-1], other.y[-1], atol=1e-8 * size)


@pytest.mark.slow
@pytest.mark.parametrize("samples", [101, 301, 1001])
def test_what_begins_gently_goes_on_at_any_number_of_samples(samples: int) -> None:
    """From rest, at 0 for its joint and some metres from the hook: with 301 it did not."""
    case = scenes.SHIPPED["stribeck_drive"]
    system = written(case.system, case.parameters) if case.system else None
    assert system is not None
    found = follow(mechanism(case), np.linspace(0.0, 10.0, samples))
    own = follow(system, case.times)
    assert found.changes[-1].name == "guide stops"
    assert found.changes[-1].time == pytest.approx(own.changes[-1].time, abs=1e-11)


WHEEL = """\
title: A wheel that is pushed for a moment
scene:
  points: {}
  bodies: {wheel: {disk: {mass: 2.0, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.2, ideal: rolling}}
  forces: {push: {push: wheel.center, polynomial: {along: [1, 0], coefficients: [0, 60, -60]}}}
initial: {wheel: {x: 0, y: 0.25, angle: 0, vx: 1.0}}
duration: 1.0
samples: 3
allow: {wheel.x: 1.0}
"""


def test_a_premise_is_asked_between_the_samples(tmp_path: Path) -> None:
    """It would slip at half of the time, and at no sample of two."""
    path = tmp_path / "wheel.yaml"
    path.write_text(WHEEL.replace("  points: {}\n", ""))
    (case,) = scenes.load(path)
    for samples in (2, 3, 11):
        with pytest.raises(CaseError, match="rolling is not possible with"):
            solve(replace(case, samples=samples))


def pushed(tmp_path: Path, part: float) -> Case:
    """A wheel under 6 sin 5t N: it needs 6 N/3 of friction at the most, and has that part of it."""
    path = tmp_path / "wheel.yaml"
    text = WHEEL.replace("  points: {}\n", "").replace("0.2,", f"{part * 2.0 / 9.80665 / 2.0!r},")
    law = "sine: {amplitude: [6, 0], angular_frequency: 5}"
    path.write_text(text.replace("polynomial: {along: [1, 0], coefficients: [0, 60, -60]}", law))
    (case,) = scenes.load(path)
    return replace(case, duration=2.0)


@pytest.mark.slow
@pytest.mark.parametrize("samples", [3, 5, 11, 26])
def test_a_premise_is_asked_between_the_steps(tmp_path: Path, samples: int) -> None:
    """At the ends of steps it needs up to 3e-4 less, as they lie."""
    for part in (1 - 1e-4, 1 - 1e-8):
        mistake = refused(replace(pushed(tmp_path, part), samples=samples))
        assert "rolling is not possible with" in mistake.what
    assert solve(replace(pushed(tmp_path, 1 + 1e-8), samples=samples)).holds


SHUTTLE = """\
title: A particle that is pushed to and fro on a block
scene:
  points: {O: [0, 0]}
  bodies: {low: {block: {mass: 5, width: WIDE, height: 0.2}}, up: {particle: {mass: 1}}}
  joints: {held: {weld: [ground.O, low.center]}}
  contacts: {lies: {between: [up, low.top], friction: 0}}
  forces: {push: {push: up.center,
                  sine: {amplitude: [1, 0], angular_frequency: 5, phase: 90 deg}}}
initial: {up: {x: 0, y: 0.1}}
duration: 2.0
samples: 3
allow: {up.x: 1.0e-3}
"""


@pytest.mark.slow
@pytest.mark.parametrize("samples", [3, 5, 11])
def test_the_end_of_a_face_is_seen_between_the_steps(tmp_path: Path, samples: int) -> None:
    """It comes to 2 N/(m ω²) = 0.08 m."""
    path = tmp_path / "shuttle.yaml"
    for part, holds in ((1 - 1e-6, False), (1 + 1e-6, True)):
        path.write_text(SHUTTLE.replace("WIDE", repr(2 * part * 2 / 25)))
        (case,) = scenes.load(path)
        case = replace(case, samples=samples)
        if holds:
            assert solve(case).holds
        else:
            assert "where it is past its end" in refused(case).what


@pytest.mark.slow
@pytest.mark.mutant("friction of what rolls asked at the ends of steps alone")
def test_a_premise_of_steps_alone_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(assumptions, "dips", lambda *_: [])
    assert solve(replace(pushed(tmp_path, 1 - 1e-4), samples=11)).holds


@pytest.mark.slow
@pytest.mark.mutant("the end of a face asked for at the ends of steps alone")
def test_a_face_that_ends_in_a_step_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(assumptions, "dips", lambda *_: [])
    with pytest.raises(pytest.fail.Exception):
        test_the_end_of_a_face_is_seen_between_the_steps(tmp_path, 5)


STILL = """\
title: A pendulum that is seen where it began
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {bob: {particle: {mass: 1.0}}}
  forces: {coil: {spring: [bob.center, ground.O], stiffness: 39.47841760435743, rest_length: 0}}
initial: {bob: {x: 0.5, y: 0}}
duration: 2.0
samples: 3
allow: {bob.x: 0.1}
"""


def still(tmp_path: Path, more: str = "") -> Case:
    path = tmp_path / "bob.yaml"
    path.write_text(STILL + more)
    (case,) = scenes.load(path)
    return case


def test_what_moves_between_samples_moves(tmp_path: Path) -> None:
    """A period of 1 s, and a sample each second."""
    assert solve(still(tmp_path)).holds
    with pytest.raises(CaseError, match="moves by 1 m"):
        solve(still(tmp_path, "stays: [bob.x]\n"))


@pytest.mark.mutant("premises asked at the samples alone")
def test_a_premise_of_samples_alone_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = still(tmp_path, "stays: [bob.x]\n")
    at_samples = solve(still(tmp_path)).trajectory
    monkeypatch.setattr(
        "textmech.reference.solve.check_premises",
        lambda case, motion, happened: check_premises(case, at_samples, happened),
    )
    assert solve(case).holds


# No answer depends on the order in which a file names its parts: the same motion, the same events.
# A shipped case of each file is solved once more with all its parts in the opposite order, from
# which the mechanism numbers its coordinates, its constraint rows and the elements that may change.

PARTS = ("bodies", "joints", "contacts", "forces", "constraints", "pairs", "drives")


def backward(scene: Scene) -> Scene:
    """The same scene with every part that has several elements in the opposite order."""
    turned: dict[str, Any] = {}
    for part in (f.name for f in fields(scene)):
        elements = getattr(scene, part)
        if part in PARTS and isinstance(elements, Mapping):
            turned[part] = {name: elements[name] for name in reversed([*elements])}
    return replace(scene, **turned)


def other(case: Case) -> Case:
    """The case with its scene turned around, which the hand-written system does not read."""
    return replace(case, scene=backward(case.scene))


def several(case: Case) -> bool:
    """Whether the scene has any two elements of one kind."""
    return any(len(getattr(case.scene, part)) > 1 for part in PARTS)


WITH_SEVERAL = [name for name in scenes.ONE_OF_EACH_FILE if several(scenes.SHIPPED[name])]


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH_SEVERAL)
def test_the_other_way_around_it_moves_the_same(name: str) -> None:
    case, known = scenes.SHIPPED[name], scenes.solved(name)
    turned = other(case)
    assert list(resampled.differences(case, known, turned, solve(turned))) == []


@pytest.mark.slow
@pytest.mark.mutant("a mass goes with the place in the file and not with its body")
def test_what_goes_by_its_place_is_seen() -> None:
    case, known = scenes.SHIPPED["cradle.alike"], scenes.solved("cradle.alike")
    bodies = case.scene.bodies
    heavy = {
        name: replace(body, mass=(i + 1) * body.mass)
        for i, (name, body) in enumerate(bodies.items())
    }
    assert len(bodies) > 1
    turned = replace(case, scene=replace(case.scene, bodies=heavy))
    assert list(resampled.differences(case, known, turned, solve(turned))) != []
