"""A motion that would never end ends with the budget, by the clock of its own work."""

import time

import numpy as np
import pytest
from given import scenes
from given.otherwise import otherwise
from given.scenes.pendulum import pendulum

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.reference import refusal
from textmech.reference import solve as door
from textmech.reference.integrators import budget as clock
from textmech.reference.integrators.budget import Endless, budget, motion, spend, tries
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.integrators.march import integrate
from textmech.reference.integrators.now import NOW, begun
from textmech.reference.solve import _libraries, one_thread, solve


def follow(until: float = 2.0) -> int:
    """Evaluations of a swing at 100 rad/s, which takes some 10 ms a second of it."""
    method = DormandPrince(lambda t, y: np.array([y[1], -1e4 * y[0]]), 2, 1e-12)
    integrate(method, [0.0, until], [1.0, 0.0], most=10**9)
    return method.evaluations


def test_what_fits_is_not_hindered() -> None:
    with budget(60.0):
        assert follow() == follow()


@pytest.mark.mutant("a motion without an end is followed for ever")
def test_what_does_not_ends_and_says_where_it_was() -> None:
    begun("swing")
    motion(0.0, 1e6)
    what = r"reached t = .* of 1e\+06 s after 0\.2 s of work"
    with budget(0.2), pytest.raises(Endless, match=what) as caught:
        follow(1e6)
    assert 0.0 < caught.value.time < 1e3
    endless = otherwise(clock, "thread_time() > end", "False")
    with endless.budget(0.0):
        endless.spend(1.0)


def test_motions_share_one_budget_which_ends_with_its_block() -> None:
    with budget(0.5), pytest.raises(Endless):
        any(follow() == 0 for _ in range(10**6))
    follow()


def test_what_others_do_meanwhile_takes_nothing_of_it() -> None:
    with budget(0.05):
        time.sleep(0.2)
        follow(0.01)


def test_too_many_ways_end_with_the_budget_and_what_they_are_among() -> None:
    begun("feet")
    motion(0.0, 5.0)
    spend(2.0)
    what = r"t = 2 of 5 s .* go on in very many ways"
    with budget(0.1), pytest.raises(Endless, match=what) as caught:
        all(way == 0 for way in tries(iter(int, 1), ("a", "b")))
    assert caught.value.among == ("a", "b")


@pytest.mark.mutant("while very many ways are tried the line of progress stands")
def test_the_line_moves_while_ways_are_tried() -> None:
    begun("feet")
    motion(0.0, 5.0)
    spend(2.0)
    lines = [NOW.text() for _ in tries(range(102), ())]
    assert lines[0] == lines[99] == "the motion, at 2 of 5 s"
    assert lines[101].startswith("the motion, way 102 to go on there, at 2 of 5 s")
    assert NOW.text().startswith("the motion, at 2 of 5 s")
    stands = otherwise(clock, "if k > SHOWN:", "if False:")
    assert {NOW.text() for _ in stands.tries(range(102), ())} == {lines[0]}


def test_each_task_names_its_motions_anew() -> None:
    for _ in range(2):
        begun("island")
        motion(0.0, 1.0)
        assert NOW.what == "the motion"
        motion(0.0, 1.0)
        assert NOW.what == "its second answer"


@pytest.mark.slow
@pytest.mark.parametrize(
    "text", [pendulum(length=1e-9), pendulum(duration=1e6, step=1.0)], ids=["fast", "long"]
)
def test_a_hopeless_case_ends_with_its_place_and_the_way_on(
    tmp_path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(text, encoding="utf-8")
    monkeypatch.setattr(refusal, "LIMIT", 2.0)
    begins = time.thread_time()
    with pytest.raises(CaseError, match=r"s after 2 s of work, and that is the limit: ") as caught:
        solve(load(file)[0])
    assert time.thread_time() - begins < 4.0
    (mistake,) = caught.value.mistakes
    assert (mistake.line, mistake.where) == (8, "duration")
    assert "--allow-long" in mistake.what


# Matrices of a reference are small: what shares them among threads waits, and rounds otherwise.


def counts() -> list[int]:
    return [count() for count, _ in _libraries()]


def test_there_is_one_within_and_afterwards_as_many_as_before() -> None:
    for _, put in _libraries():
        put(2)
    before = counts()
    with one_thread():
        assert counts() == [1] * len(before)
    assert counts() == before
    with pytest.raises(ZeroDivisionError), one_thread():
        raise ZeroDivisionError
    assert counts() == before


@pytest.mark.slow
def test_a_reference_is_solved_so(monkeypatch: pytest.MonkeyPatch) -> None:
    if not _libraries():
        pytest.skip("numpy brings no OpenBLAS here")
    for _, put in _libraries():
        put(2)
    seen: list[int] = []
    real = door.certify
    monkeypatch.setattr(door, "certify", lambda *a: (seen.extend(counts()), real(*a))[1])
    door.solve(next(iter(scenes.SHIPPED.values())))
    assert seen
    assert np.all(np.array(seen) == 1)
