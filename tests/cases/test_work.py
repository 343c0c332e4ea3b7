"""What asks for endless work is said when the file is read, with its place and what is allowed."""

import re
import time
from pathlib import Path

import pytest
from given.pendulum import pendulum
from given.scenes import cases_of, mistakes_of

from textmech.cases.load import load
from textmech.cases.mistake import CaseError

SPRING = "{s: {spring: [rod.end, ground.O], stiffness: 1.0e12, rest_length: 0.1}}"
DAMPER = "{s: {damper: [rod.end, ground.O], damping: 1.0e9}}"
SINE = "{s: {push: rod.end, sine: {amplitude: [1, 0], angular_frequency: 1.0e5}}}"
MOTOR = "{s: {torque: rod, sine: {amplitude: 1, angular_frequency: 1.0e6 rpm}}}"


def chain(bars: int) -> str:
    """A chain of bars, each on its own lines."""
    bodies = [f"    b{i}: {{bar: {{mass: 1.0, length: 0.1}}}}" for i in range(bars)]
    ends = ["ground.O", *(f"b{i}.end" for i in range(bars))]
    joints = [f"    j{i}: {{pin: [{ends[i]}, b{i}.start]}}" for i in range(bars)]
    head = ["title: A chain", "scene:", "  points: {O: [0, 0]}", "  bodies:"]
    start = ", ".join(f"b{i}: {{angle: 0.1}}" for i in range(bars))
    tail = [f"initial: {{{start}}}", "duration: 1.0", "samples: 26", "allow: {b0.angle: 1.0e-2}"]
    return "\n".join([*head, *bodies, "  joints:", *joints, *tail])


def hung(bars: int) -> str:
    """As many pendulums, each on its own point of the ground."""
    text = chain(bars).replace("points: {O: [0, 0]}", f"points: {{{_points(bars)}}}")
    return re.sub(r"pin: \[[^,]*, b(\d+)", r"pin: [ground.P\1, b\1", text)


def _points(count: int) -> str:
    return ", ".join(f"P{i}: [{i}, 0]" for i in range(count))


def variants(count: int) -> str:
    return "\n".join(["variants:", *(f"  v{i}: {{duration: 2.0}}" for i in range(count))])


def said(text: str) -> list[tuple[str, str]]:
    """Place and words of every mistake."""
    return [(f"{m.line}:{m.column} {m.where}", m.what) for m in mistakes_of(text)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "place", "number"),
    [
        (pendulum(length=1e-9), "8:1 duration", "1.21e+05 rad/s"),
        (pendulum(duration=1e6, step=1.0), "8:1 duration", "5.42e+06 rad in all"),
        (pendulum(forces=SINE), "8:1 duration", "scene.forces.s swings at 1e+05 rad/s"),
        (pendulum(forces=MOTOR), "8:1 duration", "1.05e+05 rad/s"),
        (pendulum(forces=SPRING), "8:1 duration", "1e+06 rad/s"),
        (pendulum(forces=DAMPER), "8:1 duration", "2e+07 rad/s"),
        (pendulum(angle="0.3, omega: 1.0e6 rpm"), "8:1 duration", "initial.rod swings at 1.05e+05"),
        (pendulum(samples=250_001), "9:1 samples", "250001 rows"),
        (pendulum(more=variants(150)), "12:1 variants", "150 variants"),
        (chain(1000), "2:1 scene", "2000 bodies, joints"),
    ],
)  # fmt: skip
def test_endless_work_is_said_with_its_number_and_the_way_on(
    text: str, place: str, number: str
) -> None:
    (mistake,) = [m for m in said(text) if "limit" in m[1]]
    assert mistake[0] == place
    assert number in mistake[1]
    assert "--allow-long" in mistake[1]
    if "samples" not in place:  # these do not fit the step either
        (first, *_) = cases_of(text, long=True)
        assert first.long


SLED = """\
title: A sled spins on its blade
scene:
  gravity: none
  bodies: {{sled: {{rigid: {{mass: 1.7, inertia: 0.09}}, points: {{P: [-0.35, 0]}}}}}}
  constraints: {{blade: {{edge: sled.P, along: [1, 0.2]{speed}}}}}
initial: {{sled: {{x: 0, y: 0, angle: 0.1, omega: {omega}}}{start}}}
duration: 0.4
samples: 11
allow: {{sled.x: 1.0e-2}}
"""
FREE = SLED.format(speed="", omega="OMEGA", start=", blade: {speed: 0.4}")
DRIVEN = SLED.format(
    speed=", speed: {sine: {amplitude: 1, angular_frequency: OMEGA}}", omega="1", start=""
)
STATES = """\
title: A chain in space at many states
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{{bodies}}}
  joints: {{{joints}}}
states: {{random: 10000, seed: 1, q: [-1, 1], q_dot: [-1, 1]}}
allow: {{j0.torque: 1.0e-8}}
"""


def states(bars: int) -> str:
    ends = ["ground.O", *(f"b{i}.end" for i in range(bars))]
    return STATES.format(
        bodies=", ".join(f"b{i}: {{bar: {{mass: 1.0, length: 0.1}}}}" for i in range(bars)),
        joints=", ".join(
            f"j{i}: {{hinge: [{ends[i]}, b{i}.start], axis: [0, 1, 0]}}" for i in range(bars)
        ),
    )


@pytest.mark.parametrize("text", [FREE, DRIVEN], ids=["set off", "driven"])
def test_what_spins_on_a_blade_is_counted(text: str) -> None:
    """Free it would only turn, which costs nothing; on a blade each turn is a swing."""
    assert said(text.replace("OMEGA", "50.0")) == []
    (mistake,) = said(text.replace("OMEGA", "1.0e+6"))
    assert "swings at 1e+06 rad/s, 4e+05 rad in all, which take about 2.5 hours" in mistake[1]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (pendulum(samples=199_999), "199999 samples of 1 body, 199999 rows, take about"),
        (chain(100).replace("samples: 26", "samples: 5001"), "5001 samples of 100 bodies"),
        (states(30), "10000 states of 30 bodies take about"),
    ],
)
def test_samples_and_states_cost_what_their_laws_cost(text: str, words: str) -> None:
    assert any(words in what for _, what in said(text))


@pytest.mark.slow
@pytest.mark.mutant("the bound that a refusal names is refused, or far below the limit")
@pytest.mark.parametrize(
    ("text", "key"),
    [
        (pendulum(samples=199_999), "samples"),
        (chain(100).replace("samples: 26", "samples: 5001"), "samples"),
        (pendulum(duration=1e4, samples=101, step=1e-2), "duration"),
    ],
)
def test_what_is_said_to_be_the_bound_is_one(text: str, key: str) -> None:
    """Two digits of it are allowed, and a tenth more is not."""
    (what,) = [what for _, what in said(text) if "limit" in what]
    (number,) = re.findall(r"minutes, or (?:a duration of )?([\d.e+]+)", what)
    most = float(number)

    def limited(value: float) -> bool:
        told = f"{key}: {round(value) if key == 'samples' else value}"
        again = re.sub(rf"^{key}: .*$", told, text, flags=re.MULTILINE)
        assert again != text
        return any("limit" in what for _, what in said(again))

    assert not limited(most)
    assert limited(1.1 * most)


@pytest.mark.slow
@pytest.mark.mutant("bodies that nothing joins cost as much as a chain of them")
def test_islands_cost_what_each_costs() -> None:
    """100 pendulums are 100 times one; what is looked at together by an event is one."""
    many = hung(100)
    alone = [what for _, what in said(many)]
    assert alone == []
    samples = many.replace("samples: 26", "samples: 2601")
    (what,) = [what for _, what in said(samples) if "limit" in what]
    assert "2601 samples of 100 bodies, at most 1 of which hang together" in what
    assert "or 780 samples" in what
    event = samples + "\nevents: {low: {b0.omega: falls to zero}}"
    (what,) = [what for _, what in said(event) if "limit" in what]
    assert "2601 samples of 100 bodies, 260100 rows" in what


@pytest.mark.parametrize(
    "text",
    [
        pendulum(),
        pendulum(duration=1e3),
        pendulum(length=1e-3, duration=10),
        pendulum(more=variants(100)),
        pendulum(forces=SPRING.replace("1.0e12", "1.0e8")),
        chain(100),
    ],
)
def test_what_takes_minutes_is_not_said(text: str) -> None:
    assert said(text) == []


def test_a_stiff_spring_between_light_jointed_links_is_no_fast_swing() -> None:
    """At the pin the light link moves the heavy bar: alone it would swing at 2e6 rad/s."""
    text = pendulum(forces=SPRING.replace("1.0e12", "1.0e6").replace("rod.end", "link.end"))
    text = text.replace("bodies: {", "bodies: {link: {bar: {mass: 1.0e-6, length: 0.1}}, ")
    text = text.replace("joints: {", "joints: {pin: {pin: [rod.end, link.start]}, ")
    assert said(text) == []


@pytest.mark.slow
def test_many_mistakes_are_found_quickly_and_shown_in_part(tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(pendulum(more="\n".join(f"k{i}: 1" for i in range(11_778))), encoding="utf-8")
    began = time.process_time()
    with pytest.raises(CaseError) as caught:
        load(file)
    assert time.process_time() - began < 20  # 3 s: every key is compared with every other word
    assert len(caught.value.mistakes) == 11_778
    *shown, last = str(caught.value).splitlines()
    assert len(shown) == 3 * 20
    assert last == f"{file}: and 11758 more"


TRAIN = """\
title: A train goes at a speed for ten minutes
scene:
  points: {O: [0, 0]}
  bodies: {train: {particle: {mass: 4.0e+5}}}
  joints: {rail: {slide: [ground.O, train.center], along: [1, 0]}}
  drive: {rail.speed: 80.0}
initial: {train: {x: 0}}
duration: 600.0
samples: 61
step: 1.0e-2
allow: {train.x: 1.0}
"""
DUST = """\
title: A grain falls through a thick fluid
scene:
  bodies: {b: {particle: {mass: 1.0e-6}}}
  forces: {air: {drag: b.center, coefficient: 1.0, exponent: 3}}
initial: {b: {x: 0, y: 0, vx: 0, vy: SPEED}}
duration: 2.0
samples: 21
allow: {b.y: 1.0e-3}
"""


def test_what_only_slides_does_not_swing() -> None:
    """At 80 m/s, which are no rad/s; a pin that is driven so fast makes 7,600 turns."""
    assert said(TRAIN) == []
    turns = TRAIN.replace(
        "slide: [ground.O, train.center], along: [1, 0]", "pin: [ground.O, b.end]"
    )
    turns = turns.replace("train: {particle: {mass: 4.0e+5}}", "b: {bar: {mass: 1, length: 1}}")
    turns = turns.replace("rail.speed: 80.0", "rail.omega: 80.0").replace("train", "b")
    turns = turns.replace("{x: 0}", "{angle: 0}")
    (mistake,) = said(turns)
    assert "scene.drive.rail.omega swings at 80 rad/s" in mistake[1]


def test_a_drag_is_as_quick_as_what_it_drags() -> None:
    """Its terminal speed is 0.021 m/s, at which it is a thousandth of what it is at 1 m/s."""
    assert said(DUST.replace("SPEED", "0")) == []
    (mistake,) = said(DUST.replace("SPEED", "-3.0"))
    assert "scene.forces.air swings at" in mistake[1]
