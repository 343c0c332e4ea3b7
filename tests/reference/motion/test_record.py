"""Every smooth case given an event: located in its record, and again by a guard of its own."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case, Event
from textmech.cases.scene.frame import PLANE
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Guard, System
from textmech.reports.compare.events.times import never, reference_events


def dry(case: Case) -> bool:
    """Whether a slide of it sticks and slips."""
    return any(joint.dry_friction for joint in case.scene.joints.values())


def switches(case: Case) -> bool:
    """Whether something of it touches and lets go."""
    touches = any(contact.ideal != "rolling" for contact in case.scene.contacts.values())
    holds = [*case.scene.one_sided(), *case.scene.limits()]
    return touches or bool(case.scene.pairs) or bool(holds)


# Straight again for an instant: a double zero, which rounding knows to 1e-6 s and not to 1e-9.
TOUCHING = ("driven_knee.spring", "driven_knee.damped")
HELD = ("muscle_isometric.rise", "muscle_isometric.release")  # nothing of it moves but inside
# In space one of each file: a spatial motion costs ten planar ones, and another start of the same
# mechanism has the same record.
SMOOTH = [
    name
    for name, case in scenes.SHIPPED.items()
    if (case.scene.frame is PLANE or name in scenes.ONE_OF_EACH_FILE)
    and not (case.scene.frame is PLANE and (dry(case) or switches(case)))
    and name not in (*TOUCHING, *HELD)
]
STILL = 1e-6  # m, rad, m/s, rad/s: what stays below does not move but by rounding
LOCATED = 1e-9  # s: a curve of seventh degree through the steps around it


@dataclass(frozen=True)
class Watched(System):
    """A system with one more guard, which changes nothing."""

    system: System
    guard: Guard

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", self.system.modes)

    def start(self) -> tuple[str, Array, Array]:
        return self.system.start()

    def guards(self, mode: str) -> Sequence[Guard]:
        return (self.guard,)


def with_event(case: Case) -> tuple[Case, bool]:
    """An event on the place or velocity that has soonest fallen through zero, once or twice.

    A planar wheel gets a rim point. The case ends after the second time. Where nothing falls
    through zero (it creeps to its rest, or goes on as it began) the event never happens.
    """
    bodies = {
        name: replace(body, points={**body.points, "P": (-body.radius, 0.0)})
        if body.radius and case.scene.frame is PLANE
        else body
        for name, body in case.scene.bodies.items()
    }
    case = replace(case, scene=replace(case.scene, bodies=bodies))
    motion = scenes.solved(case.name).trajectory
    falling, staying, leaving = [], [], []
    for name, quantity in table(case.scene).items():
        moves = quantity.kind in ("coordinate", "velocity") and quantity.field != "attitude"
        if not moves or quantity.part in case.scene.forces:
            continue
        u = observe(case.scene, motion, name)
        size = 1e-6 * np.max(np.abs(u))
        falls = np.flatnonzero((u[:-1] > size) & (u[1:] < -size))[:2]
        begins = not 0 < u[0] < size  # a zero that rounding made positive falls at once
        if len(falls) and begins and size > 1e-6 * STILL:
            falling.append((int(falls[-1]) + 2, name))
        if np.min(np.abs(u)) > size and np.ptp(u) > STILL:
            staying.append((len(case.times) // 4, name))
        if np.min(u[1:]) > size and np.ptp(u) > STILL:
            leaving.append((len(case.times) // 4, name))  # it begins at zero
    last, name = min(falling or staying or leaving)
    return until(case, name, last), bool(falling)


def until(case: Case, name: str, last: int) -> Case:
    """The case with the event, as far as its sample of this number."""
    event = {"turns": Event(name, "falls to zero")}
    last = min(last, len(case.times) - 1)
    return replace(case, events=event, duration=float(case.times[last]), samples=last + 1)


def located(case: Case) -> list[float]:
    """The times at which the guard falls, each the end of a step."""
    quantity = case.events["turns"].quantity
    mechanism = scenes.mechanism(case)

    def g(t: float, q: Array, v: Array) -> float:
        poses = mechanism.base.poses(t, q, v)
        states = {name: np.array([pose]) for name, pose in poses.items()}
        return float(observe(case.scene, Trajectory(np.array([t]), states, {}), quantity)[0])

    guard = Guard("turns", g, lambda t, q, v: (mechanism.start()[0], q, v))
    found = follow(Watched(mechanism, guard), case.times).events
    return [event.time for event in found if event.time > 0.0]  # the start itself is no event


@pytest.mark.slow
@pytest.mark.parametrize("name", SMOOTH)
def test_a_smooth_case_may_have_an_event(name: str) -> None:
    case, happens = with_event(scenes.SHIPPED[name])
    solution = solve(case)
    assert [check for check in solution.checks if not check.holds] == []
    record = solution.trajectory.record
    assert record is not None
    found = reference_events(case.scene, record, case.events["turns"])
    known = located(case)
    assert (len(known) > 0) == happens
    assert bool(never(case, solution.trajectory)) != happens
    assert found.tolist() == pytest.approx(known, abs=LOCATED, rel=0)


@pytest.mark.slow
def test_a_pendulum_turns_when_its_period_says(tmp_path: Path) -> None:
    """Small swings of a bar: T = 2π √(2 l / 3 g); ω falls through zero at T/2, 3 T/2, …"""
    text = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1, length: 0.6}}}
  joints: {hinge: {pin: [ground.O, rod.start]}}
initial: {rod: {angle: -89.9999 deg}}
events: {turns: {rod.omega: falls to zero}}
allow: {rod.angle: 1.0e-9}
"""
    case = scenes.typed(tmp_path, text, tail=scenes.TAIL.replace("duration: 1.0", "duration: 2.0"))
    record = solve(case).trajectory.record
    assert record is not None
    period = 2 * np.pi * np.sqrt(2 * 0.6 / (3 * 9.80665))
    found = reference_events(case.scene, record, case.events["turns"])
    assert found.tolist() == pytest.approx([period * (k + 1.0) for k in range(1)], abs=1e-9)
