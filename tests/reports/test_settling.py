"""A ball that comes to rest bounces ever lower: what of that an engine has to tell."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from given.command import textmech

from textmech.cases.case import Event
from textmech.cases.scene import Body, Scene
from textmech.cases.trajectory import VX, Array, Trajectory
from textmech.reports.compare.events.times import falls, reference_events, surely

SCENE = Scene(
    (0.0, 0.0), {}, {"box": Body("box", "particle", 1.0, (), {"center": (0.0, 0.0)})}, {}, {}, {}
)

SETTLES = """\
title: A ball that comes to rest
scene:
  bodies: {ball: {disk: {mass: 1, radius: 0.1}}}
  contacts: {touch: {between: [ball, ground.floor], friction: 0, restitution: 0.35}}
initial: {ball: {x: 0, y: 0.3, angle: 0, vx: 0, vy: 0, omega: 0}}
duration: 0.7
samples: 8
step: 1.0e-3
events: {bounces: {touch.gap: falls to zero}}
allow: {ball.y: 1.0e-2, bounces.time: 1.0e-2}
"""


def settling(t: Array, *, e: float = 0.4, g: float = 9.80665) -> tuple[Array, Array]:
    """Height of a ball dropped from 1 m that keeps e of its speed, and its impacts until 1e-9 m."""
    height, impacts = 1 - g * t**2 / 2, [float(np.sqrt(2 / g))]
    speed = e * g * impacts[0]
    while speed**2 / (2 * g) > 1e-9:
        s = t - impacts[-1]
        height = np.where(s > 0, speed * s - g * s**2 / 2, height)
        impacts.append(impacts[-1] + 2 * speed / g)
        speed *= e
    return np.where(t > impacts[-1], 0.0, height), np.array(impacts)


@pytest.mark.parametrize("h", [1e-4, 1e-3])
def test_a_ball_that_settles_is_seen_to_bounce_as_long_as_steps_can_tell(h: float) -> None:
    t = np.arange(round(1.5 / h) + 1, dtype=np.float64) * h
    height, impacts = settling(t - h / 3)  # no step meets an impact
    impacts += h / 3
    found = falls(t, height)
    assert found == pytest.approx(impacts[: len(found)], abs=h)
    high = np.cumprod([1.0, *[0.16] * (len(impacts) - 1)]) > 1e-4  # of the first height
    long = np.diff(impacts, prepend=0.0) > 12 * h
    assert np.sum(high & long) <= len(found) < len(impacts)


@pytest.mark.slow
def test_an_engine_that_bounces_as_often_as_its_steps_can_tell_is_not_blamed(
    tmp_path: Path,
) -> None:
    """Nor are the counts called equal: of 14 bounces steps of 1 ms tell four for sure."""
    (tmp_path / "settles.yaml").write_text(SETTLES)
    done = textmech("run", tmp_path / "settles.yaml", "--engine", "pymunk.tuned")
    assert done.returncode == 0, done.stdout
    told = (
        "bounces.count not supported: adapter: reference 14 (of which 4 last long enough for this"
    )
    assert " ".join(done.stdout.split()).count(told) == 1


def hump(t: Array) -> Array:
    return (t - t[0]) * (t[-1] - t) / (t[-1] - t[0]) ** 2


def test_events_that_are_too_near_for_a_step_may_be_missed() -> None:
    edges = [0.0, 1.0, 1.4, 1.41]  # humps of 1 s, 0.4 s and 10 ms, of heights alike
    times = [np.linspace(a, b, 7) for a, b in pairwise([*edges, 2.0])]
    states = np.zeros((7 * len(times), 6))
    for k, t in enumerate(times[:-1]):  # in the last it rests
        states[7 * k : 7 * k + 7, VX] = hump(t)
    phase = np.repeat(np.arange(len(times)), 7)
    record = Trajectory(np.concatenate(times), {"box": states}, {}, phase=phase)
    event = Event("box.vx", "falls to zero")
    happened = reference_events(SCENE, record, event)
    assert len(happened) == 3
    steps = (1e-4, 1e-3, 5e-2, 0.2)
    told = {h: len(surely(SCENE, record, event, happened, h, 0.0)) for h in steps}
    assert told == {1e-4: 3, 1e-3: 2, 5e-2: 1, 0.2: 0}
