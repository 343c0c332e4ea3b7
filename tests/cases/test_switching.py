"""Case files with contacts that open, slide and stick, with dry friction, and with events."""

from pathlib import Path

import pytest

from textmech.cases.case import Case, Event
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Bounds, Contact, DryFriction, Smooth
from textmech.cases.scene.quantity import event_quantities

BACKSPIN = """\
title: Disk thrown up an incline with backspin slides, then rolls
source: {equations: ["2.16", "2.23", "2.34", "2.87"]}
parameters: {m: 1.3, R: 0.25, mu: 0.4, beta: 10 deg, v0: 3.0, w0: 20.0}
drops_out: [m]
scene:
  incline: beta
  bodies: {wheel: {disk: {mass: m, radius: R}}}
  contacts:
    touch: {between: [wheel, ground.floor], friction: mu}
initial: {wheel: {x: 0, y: R, vx: -v0, omega: -w0}}
events: {rolls: {touch.slip: stays zero}}
duration: 2.0
samples: 51
step: {mujoco: 1.0e-4, pymunk: 1.0e-4}
allow: {wheel.x: 1.0e-3, touch.slip: 1.0e-3, rolls.time: 1 ms, rolls.count: 0.5}
reach:
  mujoco: {wheel.x: 5.0e-6, rolls.time: 5.0e-6}
"""

STICK_SLIP = """\
title: Block pulled through a spring whose end moves sticks and slips
source: {example: "2.4", equations: ["2.88", "2.89", "2.90", "2.98"]}
parameters: {m: 1.0, d: 2.0, v: 2.0, Fs: 6.0, F: 3.0, l: 0.5}
drops_out: [l]
scene:
  points: {O: [0, 0], hook: {at: [l, 0], velocity: [v, 0]}}
  bodies: {block: {block: {mass: m, width: 0.1, height: 0.1}}}
  joints:
    rail:
      slide: [ground.O, block.center]
      along: [1, 0]
      dry_friction: {static: Fs, kinetic: F}
  forces:
    dynamometer: {spring: [block.center, ground.hook], stiffness: d, rest_length: l}
initial: {block: {x: 0}}
events: {slips: {rail.slip: leaves zero}, sticks: {rail.slip: stays zero}}
duration: 10.0
samples: 51
step: {mujoco: 1.0e-4, pymunk: 1.0e-4}
allow: {block.x: 1.0e-3, rail.friction: 1.0e-2, slips.time: 1.0e-3, sticks.time: unknown}
reach:
  mujoco.driver: {block.x: 1.0e-9}
  pymunk.law: {block.x: 2.0e-4}
variants:
  exact: {}
  anisotropic:
    scene: {joints: {rail: {dry_friction: {kinetic: {forward: F, backward: 1.0}}}}}
  smooth:
    scene: {joints: {rail: {dry_friction: {smooth: {band: 0.0005, sharpness: 1.0e5}}}}}
"""

BOUNCES = """\
title: Disk, particle and bar bounce
parameters: {R: 0.25, e: 0.8}
scene:
  bodies:
    wheel: {disk: {mass: 1.3, radius: R}}
    ball: {particle: {mass: 0.2}}
    rod: {bar: {mass: 0.4, length: 0.5}}
  contacts:
    touch: {between: [wheel, ground.floor], friction: {static: 0.5, kinetic: 0.4}, restitution: e}
    hit: {between: [ball, ground.floor], friction: 0, restitution: 1}
    tip: {between: [rod.end, ground.floor], friction: 0.3}
initial: {wheel: {x: 0, y: 1.0}, ball: {x: 1, y: 1}, rod: {x: 2, y: 1, angle: -80 deg}}
events: {lands: {touch.gap: falls to zero}, rises: {hit.normal: falls to zero}}
duration: 1.0
samples: 26
step: {mujoco: 1.0e-4}
allow: {wheel.y: 1.0e-3, lands.time: 1.0e-3, lands.count: 0.5, tip.gap: 1.0e-3}
"""


def written(tmp_path: Path, text: str) -> list[Case]:
    path = tmp_path / "own.yaml"
    path.write_text(text)
    return load(path)


def test_a_disk_that_slides_and_rolls(tmp_path: Path) -> None:
    (case,) = written(tmp_path, BACKSPIN)
    assert case.scene.contacts == {"touch": Contact("touch", Anchor("wheel", "center"), 0.4, 0.4)}
    assert case.scene.contacts["touch"].switches
    assert case.initial["wheel"].given == {
        "x": 0.0, "y": 0.25, "angle": 0.0, "vx": -3.0, "omega": -20.0,
    }  # fmt: skip
    assert case.events == {"rolls": Event("touch.slip", "stays zero")}
    assert (case.allow["rolls.time"], case.allow["rolls.count"]) == (1e-3, 0.5)
    assert case.reach["mujoco"]["rolls.time"] == 5e-6


def test_a_block_that_sticks_and_slips(tmp_path: Path) -> None:
    exact, anisotropic, smooth = written(tmp_path, STICK_SLIP)
    six, three = Bounds(6.0, 6.0), Bounds(3.0, 3.0)
    dry = [case.scene.joints["rail"].dry_friction for case in (exact, anisotropic, smooth)]
    assert dry == [
        DryFriction(six, three),
        DryFriction(six, Bounds(forward=3.0, backward=1.0)),
        DryFriction(six, three, Smooth(band=0.0005, sharpness=1e5)),
    ]
    assert list(exact.events) == ["slips", "sticks"]
    assert exact.events["slips"].rule == "leaves zero"
    assert exact.reach["mujoco.driver"] == {"block.x": 1e-9}


def test_static_friction_is_the_kinetic_one_if_not_given(tmp_path: Path) -> None:
    text = STICK_SLIP.replace("static: Fs, kinetic: F", "kinetic: {forward: Fs, backward: F}")
    exact, anisotropic, _ = written(tmp_path, text)
    both = Bounds(forward=6.0, backward=3.0)
    assert exact.scene.joints["rail"].dry_friction == DryFriction(both, both)
    assert anisotropic.scene.joints["rail"].dry_friction == DryFriction(
        Bounds(forward=3.0, backward=1.0), Bounds(forward=3.0, backward=1.0)
    )


def test_bodies_that_bounce(tmp_path: Path) -> None:
    (case,) = written(tmp_path, BOUNCES)
    assert list(case.scene.contacts.values()) == [
        Contact("touch", Anchor("wheel", "center"), static=0.5, kinetic=0.4, restitution=0.8),
        Contact("hit", Anchor("ball", "center"), 0.0, 0.0, restitution=1.0),
        Contact("tip", Anchor("rod", "end"), 0.3, 0.3),
    ]
    assert case.scene.contacts["touch"].friction == 0.4
    assert case.events["lands"] == Event("touch.gap", "falls to zero")


def test_a_variant_changes_the_friction_alone(tmp_path: Path) -> None:
    variants = "variants:\n  rough: {scene: {contacts: {touch: {friction: 0.9}}}}\n"
    variants += "  bare: {events: {rolls: {touch.slip: leaves zero}}}\n"
    rough, bare = written(tmp_path, BACKSPIN + variants)
    assert rough.scene.contacts["touch"].static == 0.9
    assert rough.events == {"rolls": Event("touch.slip", "stays zero")}
    assert bare.events == {"rolls": Event("touch.slip", "leaves zero")}


@pytest.mark.parametrize(
    ("old", "new", "places"),
    [
        ("touch.slip: stays", "touch.slip: stay", ["events.rolls.touch.slip"]),
        ("events: {rolls: {touch.slip: stays zero}}", "events: 3", ["events"]),
        ("friction: mu}", "friction: -1}", ["scene.contacts.touch.friction"]),
    ],
)
def test_a_mistaken_part_drags_nothing_along(
    tmp_path: Path, old: str, new: str, places: list[str]
) -> None:
    """Neither the bounds of a mistaken event nor the event of a mistaken contact are mistakes."""
    with pytest.raises(CaseError) as caught:
        written(tmp_path, BACKSPIN.replace(old, new).replace("drops_out: [m]\n", "system: any\n"))
    assert [m.where for m in caught.value.mistakes] == places


def test_event_quantities() -> None:
    found = event_quantities({"rolls": Event("touch.slip", "stays zero")})
    assert [(q.name, q.part, q.unit, q.kind) for q in found.values()] == [
        ("rolls.time", "rolls", "s", "event"),
        ("rolls.count", "rolls", "1", "event"),
    ]
