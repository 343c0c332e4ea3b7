"""A motion that would never end ends with the budget; and matrices are solved by one thread."""

import numpy as np
import pytest
from given import scenes

from textmech.reference import solve as door
from textmech.reference.integrators import budget as purse
from textmech.reference.integrators.budget import Endless, apart, budget, motion, spend, tries
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.integrators.march import integrate
from textmech.reference.integrators.now import NOW
from textmech.reference.solve import _libraries, one_thread

# A motion that would never end ends with the budget, at the same evaluation everywhere.

SECOND = 1.0  # s an evaluation: the budget then counts them


def swing(t: float, y: np.ndarray) -> np.ndarray:
    return np.array([y[1], -1e4 * y[0]])


def moved(evaluations: float) -> DormandPrince:
    method = DormandPrince(swing, 2, 1e-12)
    with budget(evaluations, SECOND):
        integrate(method, [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)
    return method


def test_what_fits_is_not_hindered() -> None:
    assert moved(np.inf).evaluations == moved(1e5).evaluations > 1000


def test_what_does_not_ends_and_says_where_it_was() -> None:
    with pytest.raises(Endless, match=r"s after 10\d\d evaluations") as caught:
        moved(1000)
    assert 0.0 < caught.value.time < 2.0


def test_motions_share_one_budget() -> None:
    needed = moved(np.inf).evaluations
    method = DormandPrince(swing, 2, 1e-12)
    with budget(1.5 * needed, SECOND):
        integrate(method, [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)
        with pytest.raises(Endless):
            integrate(method, [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)


def test_a_budget_ends_with_its_block() -> None:
    with pytest.raises(Endless):
        moved(10)
    integrate(DormandPrince(swing, 2, 1e-12), [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)


def ended(pace: list[float], seconds: float, until: float) -> Endless | None:
    """A motion that gets so far [s] with each second of work."""
    t = 0.0
    with budget(seconds, SECOND):
        motion(0.0, until)
        try:
            for dt in pace:
                t += dt
                spend(1, t)
        except Endless as endless:
            return endless
    return None


def test_where_it_leads_is_asked_after_some_patience() -> None:
    """A second of work brings 0.1 s of the motion: 1000 s, and its second answer as long again."""
    endless = ended([0.1] * 1000, 300.0, 100.0)
    assert endless is not None
    assert endless.time == pytest.approx(0.1 * purse.PATIENCE)
    assert str(endless) == (
        "reached t = 1.5 of 100 s after 15 evaluations and needs about 33 minutes"
    )
    assert ended([0.1] * 1000, 2001.0, 100.0) is None
    assert NOW.text().startswith("the motion, at 100 of 100 s")


@pytest.mark.mutant("an evaluation of an island is paid for as one of the island before it")
def test_islands_share_one_budget_each_at_its_price() -> None:
    """And each has its motion and its second answer, as a case by itself."""
    with budget(10.0, SECOND):
        motion(0.0, 1.0)
        spend(6, 1.0)
        apart(SECOND / 100)
        motion(0.0, 1.0)
        assert NOW.what == "the motion"
        spend(300, 1.0)
        apart(SECOND)
        with pytest.raises(Endless):
            spend(2, 0.5)


def test_a_slow_beginning_does_not_end_a_motion_that_hurries_on() -> None:
    """The first 14 s of work bring nothing, and all that follows a lot: 14 + 25 s are needed.

    Foreseen from the first moment on, and not from its latest part, it would be refused.
    """
    pace = [1e-6] * 14 + [2.0] * 50
    assert ended(pace, 300.0, 50.0) is None


def test_what_gets_nowhere_is_ended_with_no_number_too_large_for_words() -> None:
    endless = ended([0.0] * 100, 300.0, 50.0)
    assert endless is not None
    assert "years" in str(endless)


@pytest.mark.mutant("what may go on in very many ways is tried until the budget is used up")
def test_too_many_ways_end_before_the_first_is_tried() -> None:
    tried = []
    with budget(1000, SECOND):
        motion(0.0, 5.0)
        spend(1, 2.0)
        with pytest.raises(Endless, match=r"t = 2 of 5 s .* in more than 99 ways"):
            tried += tries(lambda: iter(range(100)), 10, ())
        tried += tries(lambda: iter(range(99)), 10, ())
    assert tried == [*range(99)]


def test_of_ways_that_are_not_all_asked_for_only_those_tried_are_paid() -> None:
    with budget(1000, SECOND):
        for tried in tries(lambda: iter(range(99)), 10, ()):
            if tried == 50:
                break
        with pytest.raises(Endless):
            spend(1000 - 510 + 1, 0.0)


@pytest.mark.mutant("what the ways of an instant cost is taken for the pace of the motion")
def test_the_ways_of_an_instant_say_nothing_of_the_pace() -> None:
    with budget(300, SECOND):
        motion(0.0, 5.0)
        assert len([*tries(lambda: iter(range(20)), 1, ())]) > purse.PATIENCE
        spend(1, 0.5)


@pytest.mark.mutant("while very many ways are tried the line of progress stands")
def test_the_line_moves_while_ways_are_tried() -> None:
    with budget(1000, SECOND):
        motion(0.0, 5.0)
        spend(1, 2.0)
        said = [NOW.text() for _ in tries(lambda: iter(range(101)), 1, ())]
        assert said[100].startswith("the motion at 2 s, the ways to go on, at 100 of 101")
        assert NOW.text().startswith("the motion, at 2 of 5 s")


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
