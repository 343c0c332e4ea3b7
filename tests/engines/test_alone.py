"""What is told from outside knows one thing that switches: beside another the engine is on its own.

Elements are added by people who do not know each other's: each is put beside each here.
"""

from pathlib import Path

import pytest
from given import scenes
from given.adapters.planning import TUNED

from textmech.engines.engine import Plan
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

Parts = dict[str, str]
"""By section of a scene what stands in it."""

SWITCHES: dict[str, Parts] = {
    "slide": {
        "bodies": "block: {particle: {mass: 1}}",
        "joints": "rail: {slide: [ground.O, block.center], along: [1, 0], "
        "dry_friction: {static: {forward: 3, backward: 3}, kinetic: {forward: 2, backward: 2}}}",
        "initial": "block: {x: 0, vx: 1}",
    },
    "contact": {
        "bodies": "block: {particle: {mass: 1}}",
        "contacts": "under: {between: [block, ground.floor], "
        "friction: {static: 0.5, kinetic: 0.4}}",
        "initial": "block: {x: 0, y: 0, vx: 1}",
    },
}
BESIDE: dict[str, Parts] = {
    "contact": {
        "bodies": "ball: {disk: {mass: 1, radius: 0.1}}",
        "contacts": "on: {between: [ball, ground.floor], friction: 0.3}",
        "initial": "ball: {x: 3, y: 0.1, angle: 0, vx: 1, vy: 0, omega: 0}",
    },
    "pair": {
        "bodies": "ball: {disk: {mass: 1, radius: 0.1}}, cue: {disk: {mass: 1, radius: 0.1}}",
        "contacts": "knock: {between: [cue, ball], friction: 0}",
        "initial": "ball: {x: 8, y: 5, angle: 0, vx: 0, vy: 0, omega: 0}, "
        "cue: {x: 7, y: 5, angle: 0, vx: 0.1, vy: 0, omega: 0}",
    },
    "rope": {
        "bodies": "ball: {particle: {mass: 1}}",
        "forces": "leash: {rope: [ground.Q, ball.center], length: 0.3}",
        "initial": "ball: {x: 3, y: 0.8, vx: 0.2, vy: 0}",
    },
    "stops": {
        "bodies": "gate: {bar: {mass: 1, length: 0.4}}",
        "joints": "post: {pin: [ground.Q, gate.start]}",
        "forces": "ends: {stops: post, low: -170 deg, high: 0 deg}",
        "initial": "gate: {angle: -90 deg, omega: 0.5}",
    },
}


def ways(folder: Path, engine: str, *parts: Parts) -> set[str]:
    """In which ways the engine would run the parts together."""
    lines = ["scene:", "  points: {O: [0, 0], Q: [3, 1]}"]
    for section in ("bodies", "joints", "contacts", "forces"):
        if found := [part[section] for part in parts if section in part]:
            lines.append(f"  {section}: {{{', '.join(found)}}}")
    lines.append(f"initial: {{{', '.join(p['initial'] for p in parts if 'initial' in p)}}}")
    lines.append("allow: {block.x: 1.0e-2}")
    case = scenes.typed(folder, "\n".join(lines) + "\n", tail=scenes.tail(0.2, 5))
    plans = TUNED[engine].plans(case.scene, first(solve(case).trajectory))
    return {plan.realised for plan in plans if isinstance(plan, Plan)}


@pytest.mark.parametrize("name", SWITCHES)
def test_alone_it_can_be_told_from_outside(name: str, tmp_path: Path) -> None:
    assert ways(tmp_path, "mujoco", SWITCHES[name]) > {"native"}


@pytest.mark.slow
@pytest.mark.parametrize("other", BESIDE)
@pytest.mark.parametrize("name", SWITCHES)
def test_beside_another_it_cannot(name: str, other: str, tmp_path: Path) -> None:
    assert ways(tmp_path, "mujoco", SWITCHES[name], BESIDE[other]) == {"native"}


@pytest.mark.slow
def test_pymunks_law_of_friction_needs_a_body_that_nothing_else_holds(tmp_path: Path) -> None:
    cord = {"forces": "cord: {rope: [ground.Q, block.center], length: 9}"}
    cord["initial"] = SWITCHES["slide"]["initial"]
    bare = {section: text for section, text in SWITCHES["slide"].items() if section != "initial"}
    assert "law" in ways(tmp_path, "pymunk", SWITCHES["slide"])
    assert "law" not in ways(tmp_path, "pymunk", bare, cord)
