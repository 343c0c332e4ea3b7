"""What would fill the memory is said when the file is read, with its place and what is allowed."""

import time
from pathlib import Path

import pytest
from given.scenes.pendulum import pendulum

from textmech.cases.load import load
from textmech.cases.mistake import CaseError


def chain(bars: int) -> str:
    """A chain of bars, each on its own lines."""
    bodies = [f"    b{i}: {{bar: {{mass: 1.0, length: 0.1}}}}" for i in range(bars)]
    ends = ["ground.O", *(f"b{i}.end" for i in range(bars))]
    joints = [f"    j{i}: {{pin: [{ends[i]}, b{i}.start]}}" for i in range(bars)]
    head = ["title: A chain", "scene:", "  points: {O: [0, 0]}", "  bodies:"]
    start = ", ".join(f"b{i}: {{angle: 0.1}}" for i in range(bars))
    tail = [f"initial: {{{start}}}", "duration: 1.0", "samples: 26", "allow: {b0.angle: 1.0e-2}"]
    return "\n".join([*head, *bodies, "  joints:", *joints, *tail])


def variants(count: int) -> str:
    return "\n".join(["variants:", *(f"  v{i}: {{duration: 2.0}}" for i in range(count))])


def said(folder: Path, text: str) -> list[tuple[str, str]]:
    """Place and words of every mistake."""
    file = folder / "case.yaml"
    file.write_text(text, encoding="utf-8")
    try:
        load(file)
    except CaseError as error:
        return [(f"{m.line}:{m.column} {m.where}", m.what) for m in error.mistakes]
    return []


STATES = """\
title: Particles at many states
scene: {{bodies: {{{bodies}}}}}
states: {{random: 10000, seed: 1, q: [-1, 1], q_dot: [-1, 1]}}
allow: {{energy.kinetic: 1.0e-8}}
"""


def states(count: int) -> str:
    return STATES.format(bodies=", ".join(f"b{i}: {{particle: {{mass: 1}}}}" for i in range(count)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        (pendulum(samples=250_001), "9:1 samples", "250001 samples of 1 body are 250001 rows"),
        (pendulum(samples=10**9), "9:1 samples", "1000000000 samples of 1 body"),
        (chain(100).replace("samples: 26", "samples: 2001"), "208:1 samples", "100 bodies are"),
        (states(30), "3:10 states.random", "10000 states of 30 bodies are 300000 rows"),
        (pendulum(more=variants(150)), "12:1 variants", "150 variants"),
        (chain(1000), "2:1 scene", "2000 bodies, joints"),
    ],
)
def test_what_memory_could_not_hold_is_said_with_its_number_and_the_way_on(
    tmp_path: Path, text: str, place: str, words: str
) -> None:
    (mistake,) = [m for m in said(tmp_path, text) if "limit" in m[1]]
    assert mistake[0] == place
    assert words in mistake[1]
    assert "--allow-long" in mistake[1]


def test_a_person_may_go_on(tmp_path: Path) -> None:
    said(tmp_path, pendulum(more=variants(150)))
    (first, *_) = load(tmp_path / "case.yaml", long=True)
    assert first.long


@pytest.mark.parametrize(
    "text", [pendulum(), pendulum(duration=1e6), pendulum(more=variants(100)), chain(100)]
)
def test_what_only_takes_time_is_not_said(tmp_path: Path, text: str) -> None:
    """The clock of who works tells: see `reference.integrators.budget`."""
    assert said(tmp_path, text) == []


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
