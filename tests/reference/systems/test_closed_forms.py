"""Closed forms share nothing with the motion: not a line of code runs in both."""

import sys
from collections.abc import Callable, Iterator
from types import CodeType, FrameType
from typing import Any

import numpy as np
import pytest
from given.machines import spatial
from given.machines.examples import PARAMETERS, VARIANTS, example
from given.machines.gimbals import VARIANTS as GIMBALS
from given.machines.gimbals import gimbal
from given.machines.robots import robot
from given.machines.wheels import CLOSED, FROM_ABOVE, wheel

from textmech.reference.system import Guard, Only, System
from textmech.reference.systems import written

TIMES = (0.0, 0.3, 1.1, 2.9)
KNOWN = [name for name in PARAMETERS if example(name).closed_form(0.5) is not None]
LIKE = {name: (system, changed) for name, (system, changed, _) in VARIANTS.items()}
SYSTEMS = {name: example(name) for name in KNOWN}
SYSTEMS |= {name: example(system, **changed) for name, (system, changed) in LIKE.items()}
SYSTEMS |= {name: Only(wheel(system, **changed)) for name, (system, changed) in CLOSED.items()}
SYSTEMS |= {f"gimbal, {name}": Only(gimbal(**changed)) for name, changed in GIMBALS.items()}
SYSTEMS |= {name: written(name, given) for name, given in FROM_ABOVE.items()}
SYSTEMS |= {"driven robot": Only(robot("driven_robot"))}
SYSTEMS |= {name: spatial.variant(name) for name in spatial.VARIANTS}


def executed(run: Callable[[], Any]) -> set[CodeType]:
    """The functions of the hand-written systems that are called on the way."""
    found: set[CodeType] = set()

    def note(frame: FrameType, event: str, argument: Any) -> None:
        if event == "call" and "textmech.reference.systems" in frame.f_globals["__name__"]:
            found.add(frame.f_code)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        run()
    finally:
        sys.setprofile(before)
    return found


def known(system: System) -> None:
    """All that is known by functions."""
    system.closed_events(5.0)
    for t in TIMES:
        system.closed_form(t)


def moves(system: System) -> None:
    """All that makes the motion, in each mode."""
    _, q, v = system.start()
    for name, mode in system.modes.items():
        for _ in _asked(system.guards(name), q, v):
            pass
        mode.accelerations(0.3, q, v)
        mode.rates(0.3, q, v)
        mode.poses(0.3, q, v)
        mode.reactions(0.3, q, v)
        system.possible(name, 0.3, q, v)


def _asked(guards: Any, q: Any, v: Any) -> Iterator[Any]:
    for guard in guards:
        assert isinstance(guard, Guard)
        yield guard.g(0.3, q, v), guard.then(0.3, q, v)


@pytest.mark.parametrize("name", SYSTEMS)
def test_a_closed_form_shares_no_function_with_the_motion(name: str) -> None:
    built = SYSTEMS[name]
    ours, theirs = executed(lambda: known(built)), executed(lambda: moves(built))
    assert ours, "nothing is known"
    assert theirs, "nothing moves"
    assert {code.co_qualname for code in ours & theirs} == set()


@pytest.mark.mutant("accelerations of {name} 5 % off: its closed form must not follow")
@pytest.mark.parametrize("name", ["sliding_block", "sliding_disk", "rolling_wheel"])
def test_a_mistake_of_the_motion_leaves_the_closed_form(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before, 5 % on the accelerations were 5 % in both, and nothing was compared."""
    system = example(name)
    before = [np.concatenate(system.closed_form(t) or ()) for t in TIMES]
    for kind in {type(mode) for mode in system.modes.values()}:
        a = kind.accelerations
        wrong = lambda self, t, q, v, a=a: 1.05 * a(self, t, q, v)  # noqa: E731
        monkeypatch.setattr(kind, "accelerations", wrong)
    after = [np.concatenate(system.closed_form(t) or ()) for t in TIMES]
    np.testing.assert_array_equal(after, before)


def numbers(system: System) -> Iterator[Any]:
    """All that is known by functions, and what its first mode says of the start and of forces."""
    for t in TIMES:
        yield from system.closed_form(t) or ()
    yield from (t for _, t in system.closed_events(5.0) or ())
    name, q, v = system.start()
    mode = system.modes[name]
    yield from (q, v, mode.accelerations(0.0, q, v), mode.rates(0.0, q, v))
    yield from mode.reactions(0.0, q, v).values()


@pytest.mark.parametrize("name", SYSTEMS)
def test_no_number_is_complex(name: str) -> None:
    """By accident, that is: see tests/conftest.py."""
    for found in numbers(SYSTEMS[name]):
        assert np.isrealobj(np.asarray(found)), found


def test_eigenvalues_are_complex_in_all_tests() -> None:
    """Else the test above, and all others, would not see who takes them for real."""
    matrix = np.diag([1.0, 2.0])
    roots = np.roots([1.0, -3.0, 2.0]), np.polynomial.Legendre([1.0, 2.0, 3.0]).roots()
    for found in (np.linalg.eigvals(matrix), *np.linalg.eig(matrix), *roots):
        assert np.iscomplexobj(found)
