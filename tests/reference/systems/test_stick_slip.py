"""What ends a mode of (2.89), as a table: with four bounds that all differ, none can stand in."""

import numpy as np
import pytest

from textmech.reference.laws.friction import Dry
from textmech.reference.motion.follow import follow
from textmech.reference.systems.friction import stick_slip
from textmech.reference.systems.friction.dynamometer import Dynamometer

DRY = Dry(F_minus=3.0, F_plus=1.0, Fs_minus=4.0, Fs_plus=2.0)


class Constant:
    """F_a [N], whatever happens."""

    def __init__(self, F_a: float) -> None:
        self._F_a = F_a

    def F_a(self, t: float, x: float) -> float:
        return self._F_a


def fallen(mode: str, F_a: float, v: float, *, Delta: float = 0.0) -> set[str]:
    """To which modes a guard lets go at this speed."""
    guards = stick_slip.guards(Constant(F_a), DRY, mode, Delta=Delta)  # type: ignore[arg-type]
    y = np.zeros(1), np.array([v])
    return {guard.then(0.0, *y)[0] for guard in guards if guard.g(0.0, *y) <= 0.0}


@pytest.mark.parametrize(
    ("F_a", "from_forward", "from_backward", "from_stuck"),
    [
        (-4.5, {"backward"}, set(), {"backward"}),  # beyond F_s₋
        (-3.5, {"stuck"}, {"stuck"}, set()),  # beyond F₋, and held by F_s₋
        (0.0, {"stuck"}, {"stuck"}, set()),
        (1.5, {"stuck"}, {"stuck"}, set()),  # beyond F₊, and held by F_s₊
        (2.5, set(), {"forward"}, {"forward"}),  # beyond F_s₊
    ],
)
def test_at_rest_the_static_bounds_decide(F_a, from_forward, from_backward, from_stuck):
    """(2.89): at v = 0 it sticks within the static bounds; a force that drives on ends nothing."""
    assert fallen("forward", F_a, 0.0) == from_forward
    assert fallen("backward", F_a, 0.0) == from_backward
    assert fallen("stuck", F_a, 0.0) == from_stuck


@pytest.mark.parametrize("F_a", [-4.5, 0.0, 2.5])
def test_what_moves_does_not_stick(F_a: float):
    assert fallen("forward", F_a, 1e-9) == set()
    assert fallen("backward", F_a, -1e-9) == set()


def test_the_band_of_karnopp_stands_for_rest():
    """(2.91): |v| ≤ Δ is as good as v = 0, on both sides."""
    for mode, v in (("forward", 1e-3), ("backward", -1e-3)):
        assert fallen(mode, 0.0, v, Delta=1e-3) == {"stuck"}
        assert fallen(mode, 0.0, 1.001 * v, Delta=1e-3) == set()


def test_each_mode_has_its_friction():
    """(2.89) F₋ where it slides backward, −F₊ forward; −F_a where it sticks."""
    at = 0.0, np.zeros(1), np.zeros(1)
    modes = stick_slip.modes(2.0, Constant(0.5), DRY)  # type: ignore[arg-type]
    forces = {name: mode.reactions(*at)["guide.fx"] for name, mode in modes.items()}
    assert forces == {"backward": 3.0, "forward": -1.0, "stuck": -0.5}
    changes = {name: mode.accelerations(*at)[0] for name, mode in modes.items()}
    assert changes == {"backward": 1.75, "forward": -0.25, "stuck": 0.0}


@pytest.mark.mutant("a block that overshoots held by kinetic friction")
@pytest.mark.parametrize(("Fs_minus", "sticks"), [(3.0, True), (2.001, True), (1.999, False)])
def test_what_overshoots_sticks_by_its_static_friction_backward(
    Fs_minus: float, sticks: bool
) -> None:
    """The spring is left with 2 F₊ − F_s₊ = −2 N: kinetic friction of 1.5 N would not hold it."""
    parameters = {"m": 1.3, "c": 4.0, "u": 1.0, "F_minus": 1.5, "F_plus": 1.0}
    system = Dynamometer(**parameters, Fs_minus=Fs_minus, Fs_plus=4.0)
    known = system.closed_events(5.0)
    assert (known is not None) == sticks
    found = [(event.name, event.time) for event in follow(system, np.linspace(0, 5, 11)).events]
    if known is None:
        assert found[1][1] > 3.6  # at 3.532 s it goes back, and stops later
    else:
        assert [name for name, _ in found] == [name for name, _ in known]
        times = [t for _, t in known]
        assert [t for _, t in found] == pytest.approx(times, abs=1e-11)
