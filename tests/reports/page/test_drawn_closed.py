"""What is certified closed is drawn closed: places of the drawing, at times between its poses."""

import json
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.browser import Tab, browser, found

from textmech.cases.case import Case
from textmech.cases.scene.point import GROUND
from textmech.reports.batch import suite
from textmech.reports.batch.selection import choose_cases, choose_engines
from textmech.reports.page.page import NAME, write_measured

OPEN = 0.5  # px: what nobody sees
SHIPPED = ("four_bar", "opening_loop", "slider_crank", "particle_pendulum", "skew_chain",
           "five_axis_robot.swinging", "gyroscope", "heavy_top.loops")  # fmt: skip
OWN = """
title: A four-bar whose crank turns by ten radians from sample to sample
scene:
  points: {O: [0, 0], Q: [1.2, 0.1]}
  bodies:
    crank: {bar: {mass: 0.5, length: 0.35}}
    coupler: {bar: {mass: 1.0, length: 1.1}}
    rocker: {bar: {mass: 0.8, length: 0.7}}
  joints:
    A: {pin: [ground.O, crank.start]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
  forces: {engine: {torque: crank, constant: 6.0}}
initial: {crank: {angle: 50 deg, omega: 10.0}}
near: {rocker: {angle: 100 deg}}
duration: 1.0
samples: 11
allow: {crank.angle: 1.0e-2, C.gap: 1.0e-4}
"""

pytestmark = [
    pytest.mark.skipif(found() is None, reason="there is no Chromium on this machine to look with"),
    pytest.mark.slow,
]


@pytest.fixture(scope="module")
def tab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tab]:
    with browser(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A page of these cases and of one of a user's own, by their names."""
    place = tmp_path_factory.mktemp("closed")
    (place / "own_four_bar.yaml").write_text(OWN, encoding="utf-8")
    cases = choose_cases([*SHIPPED, str(place / "own_four_bar.yaml")])
    engines = choose_engines(["mujoco"], ["shipped"])
    report = suite.measure(cases, engines, progress=lambda *_: None)
    assert not report.mistakes
    write_measured(report, place / "page")
    address = (place / "page" / NAME).as_uri()
    return SimpleNamespace(address=address, cases={case.name: case for case in cases})


def opened(tab: Tab, made: SimpleNamespace, name: str) -> None:
    tab.open(f"{made.address}#{name}", width=1440, prefers_reduced_motion="reduce")
    tab.until(f"document.getElementById({name!r}).querySelector('svg.mechanism')")


def ends(case: Case) -> dict[str, list[Any]]:
    """Of each joint that lets nothing shift its two places, each on its part."""

    def place(at: Any) -> list[Any]:
        if at.body == GROUND:
            return ["", [float(x) for x in case.scene.points[at.point].at]]
        return [at.body, [float(x) for x in case.scene.bodies[at.body].points[at.point]]]

    joints = {name: joint for name, joint in case.scene.joints.items() if not joint.shifts}
    return {name: [place(at) for at in joint.refers()] for name, joint in joints.items()}


APART = """((name, joints, straight) => {
    const motion = MOTIONS[name], pose = poser(motion), t = unpackPose(motion.times);
    const window = frame(motion, camera(motion, 35), pose, t), last = t[t.length - 1];
    const width = document.getElementById(name).querySelector('svg.mechanism')
        .getBoundingClientRect().width / CANVAS.width;
    const line = (time) => {
        const k = Math.max(1, t.findIndex((at) => at >= time)), [from, to] = [t[k - 1], t[k]];
        const [a, b] = [pose(from), pose(to)], s = (time - from) / (to - from);
        const between = (part, c) => c.map((v, i) => v + s * (b.get(part)[i] - v));
        return new Map([...a].map(([part, c]) => [part, between(part, c)]));
    };
    return joints.map((ends) => Array.from({length: 1500}, (_, k) => {
        const time = last * (k + .5) / 1500, now = straight ? line(time) : pose(time);
        const [[x, y], [u, v]] = ends.map(([part, place]) => window(placed(now.get(part), place)));
        return width * Math.hypot(x - u, y - v);
    })); })"""


@pytest.mark.mutant("straight lines between the poses of the animation")
@pytest.mark.parametrize("name", [*SHIPPED, "own_four_bar"])
def test_no_joint_is_drawn_open(tab: Tab, made: SimpleNamespace, name: str) -> None:
    """By the page's own functions, in pixels of its drawing, at 1500 times; a rod stays long."""
    case = made.cases[name]
    opened(tab, made, name)
    joints = ends(case)

    def opens(straight: str) -> float:
        asked = json.dumps([*joints.values()])
        apart = np.array(tab.ask(f"{APART}({name!r}, {asked}, {straight})"))
        rods = [getattr(case.scene.joints[joint], "swings", False) for joint in joints]
        return float(np.max(np.where(rods, np.ptp(apart, axis=1), np.max(apart, axis=1))))

    assert opens("false") < OPEN
    if name in ("four_bar", "opening_loop", "own_four_bar"):
        assert opens("true") > 2 * OPEN


BARS = """((name) => {
    const section = document.getElementById(name), root = section.querySelector('svg.mechanism');
    const slider = section.querySelector('[aria-label=time]');
    const width = root.getBoundingClientRect().width / CANVAS.width;
    const number = (text) => width * Number(text);
    const bars = [...root.querySelectorAll('.reference .body')];
    return Array.from({length: 334}, (_, k) => {
        slider.value = 3 * k;
        slider.dispatchEvent(new Event('input', {bubbles: true}));
        return bars.map((bar) => bar.getAttribute('points').split(' ').map(
            (point) => point.split(',').map(number)));
    }); })"""


@pytest.mark.parametrize("name", ["four_bar", "opening_loop", "own_four_bar"])
def test_the_bars_that_are_drawn_hang_together(tab: Tab, made: SimpleNamespace, name: str) -> None:
    """Read from the drawing itself, at 334 places of its slider; no bar is drawn shorter."""
    opened(tab, made, name)
    bars = np.array(tab.ask(f"{BARS}({name!r})"))  # time, bar, end, axis
    crank, coupler, rocker = np.moveaxis(bars, 1, 0)
    gaps = [crank[:, 1] - coupler[:, 0], coupler[:, 1] - rocker[:, 1]]
    gaps += [end - end[0] for end in (crank[:, 0], rocker[:, 0])]  # on the ground
    assert np.max(np.linalg.norm(gaps, axis=-1)) < OPEN
    lengths = np.linalg.norm(bars[:, :, 1] - bars[:, :, 0], axis=-1)
    assert np.max(np.ptp(lengths, axis=0)) < OPEN
    angle = np.unwrap(np.arctan2(*(crank[:, 1] - crank[:, 0]).T))
    assert np.ptp(angle) > 0.5  # it moves
