"""What rubs: modes and events of (2.89), the smooth law, drags, and planted mistakes."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import laws
from given.laws.events import LOCATED, event_errors
from given.machines.examples import duration, example, only
from given.mutants import mutant, with_mode

from textmech.reference.laws.friction import Dry, smooth
from textmech.reference.motion.follow import follow
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.bodies.drag_stops import Slowing
from textmech.reference.systems.friction import stick_slip
from textmech.reference.systems.friction.dynamometer import Dynamometer

# What ends a mode of (2.89), as a table: with four bounds that all differ, none can stand in.

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


# The smooth law (2.95) as a system: what it prints, how it is integrated, and what it is not.


@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_smooth_mode_within_its_band_is_the_printed_law(name: str):
    system = only(name)
    dry, random = Dry(3.0, 3.0, 6.0, 6.0), np.random.default_rng(2)
    for _ in range(200):
        t, v = random.uniform(5.9999, 6.0001), random.uniform(-1e-3, 1e-3)
        x = 0.0 if "growing" in name else random.uniform(8.9999, 9.0001)
        F_a = -t if "growing" in name else 4 * t - 2 * x
        printed = F_a + smooth(dry, 5e-4, 1e5, v, F_a)
        written = system.accelerations(t, np.array([x]), np.array([v]))[0]
        # A times the rounding of F_a, 1e-15 of 15 N: what the steep edges make of it.
        assert written == pytest.approx(printed, abs=2e-9)


def missed(mode: Any) -> float:
    """N: (2.23) m v̇ against the force along the slide and the friction that it tells."""
    random, worst = np.random.default_rng(7), 0.0
    for _ in range(50):
        t, x, v = random.uniform((0.0, -2.0, -1e-3), (8.0, 6.0, 1e-3))  # in the band, and out of it
        at = t, np.array([x]), np.array([v])
        acting = mode.r * t - mode.c * x
        held = mode.reactions(*at)["guide.fx"]
        worst = max(worst, abs(mode.m * mode.accelerations(*at)[0] - acting - held))
    return worst


@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_friction_that_is_told_is_that_which_brakes(name: str):
    """No cut finds it: it is an applied force, and no law but this one asks for it."""
    assert missed(only(name)) < 1e-8  # A times the rounding of 15 N, on the edges


@pytest.mark.mutant("smooth friction told of a spring that pushes where it pulls")
def test_friction_of_another_force_is_seen():
    sound: Any = only("smooth_dynamometer")
    told = lambda self, t, q, v: sound.reactions(t, -q, v)  # noqa: E731
    assert missed(mutant(sound, reactions=told)) > 1.0


@pytest.mark.slow
def test_smooth_law_is_another_model():
    """Erratum 15: it never rests, and by 10 s it is 7.6e-4 m from the exact law."""
    times = np.linspace(0.0, 10.0, 2001)
    exact, found = (follow(example(n), times).y for n in ("dynamometer", "smooth_dynamometer"))
    assert np.abs(found - exact)[:, 0].max() == pytest.approx(7.6e-4, rel=0.02)
    sticks = found[(times > 4.85) & (times < 6.2), 1]
    assert 0.87 * 5e-4 < sticks.min() < sticks.max() < 5e-4


# Blocks that viscous friction slows by a power of their speed: which stop, and how they rest.

TIMES = np.linspace(0.0, 4.0, 41)


def thrown(alpha: float) -> System:
    return example("drag_stops", alpha=alpha)


def apart(system: System, known: System) -> float:
    """The largest distance from a closed form."""
    closed = [known.closed_form(t) for t in TIMES.tolist()]
    rows = np.array([np.concatenate(row) for row in closed if row is not None])
    return float(np.abs(follow(system, TIMES).y - rows).max())


@pytest.mark.parametrize("alpha", [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0])
def test_motion_is_the_closed_form(alpha: float) -> None:
    assert apart(thrown(alpha), thrown(alpha)) < 1e-13


@pytest.mark.parametrize("alpha", [0.1, 0.25, 0.5, 0.75])
def test_it_stops_once_and_then_rests_exactly(alpha: float) -> None:
    system = thrown(alpha)
    found, known = follow(system, TIMES), system.closed_events(4.0)
    assert known is not None
    assert [e.name for e in found.events] == ["stops"] == [name for name, _ in known]
    assert abs(found.events[0].time - known[0][1]) < system.blurred
    rests = known[0][1] < TIMES
    assert rests.sum() > 3
    assert np.all(found.y[rests, 1] == 0.0)
    assert np.ptp(found.y[rests, 0]) == 0.0


@pytest.mark.parametrize("alpha", [1.0, 2.0])
def test_from_one_on_it_never_stops(alpha: float) -> None:
    system = thrown(alpha)
    assert system.closed_events(1e9) == []
    assert not follow(system, TIMES).events
    assert follow(system, TIMES).y[-1, 1] > 0.0


@pytest.mark.mutant("drag by a power {alpha}: {wrong} times what it is")
@pytest.mark.parametrize("alpha", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("wrong", [{"alpha": 1.1}, {"d": 1.05}, {"m": 0.95}, {"d": -0.02}])
def test_another_law_is_seen_by_the_closed_form(alpha: float, wrong: dict[str, float]) -> None:
    numbers = {"m": 2.0, "d": 3.0, "alpha": alpha}
    m, d, power = (value * wrong.get(key, 1.0) for key, value in numbers.items())
    off = Slowing(m, d, power)
    assert apart(with_mode(thrown(alpha), "moves", off), thrown(alpha)) > 1e-3


@pytest.mark.mutant("drag: a stop at 1e-6 m/s, not at zero")
def test_a_stop_at_a_threshold_is_seen() -> None:
    """`v < 1e-6` in the place of v = 0: 0.9 ms too early."""
    system: Any = thrown(0.5)

    def early(self: System, mode: str) -> Any:
        found = system.guards(mode)
        return [type(g)(g.event, lambda t, q, v: v[0] - 1e-6, g.then) for g in found]

    known = system.closed_events(4.0)[0][1]
    late = follow(mutant(system, guards=early), TIMES).events[0].time - known
    assert abs(late) > 100 * system.blurred


# Mistakes planted in systems that rub: bearings, falling friction, the cone, the dynamometer.


def off(system: System, other: System, until: float) -> float:
    """How far a motion is from the closed form of another system."""
    times = np.linspace(0.0, until, 31)
    closed = [system.closed_form(t) for t in times.tolist()]
    known = np.array([np.concatenate(c) for c in closed if c is not None])
    return float(np.max(np.abs(follow(other, times).y - known)))


PLANTED: dict[str, tuple[str, str, dict[str, Any]]] = {
    "dry friction that drives": ("bearing", "turns", {"M_k": -0.3}),
    "oil that drives": ("bearing", "turns", {"d": -0.05}),
    "a lost drive": ("bearing", "turns", {"M": 0.0}),
    "inertia 5 % off": ("bearing", "turns", {"R": 0.3 * 1.05**0.5}),
    "friction that does not fall": ("stribeck_brake", "forward", {"falls": None}),
    "friction that falls over another speed": (
        "stribeck_brake", "forward", {"falls": (-3.0, 0.525)},
    ),
    "friction of the other way": ("friction_cone", "down", {"sigma": -1}),
    "a lift that friction does not feel": ("friction_cone", "down", {"b_y": 0.0}),
    "a slope the other way": ("friction_cone", "down", {"beta": -0.17}),
    "a block of another mass": ("friction_of_rest", "forward", {"m": 1.05}),
}  # fmt: skip


@pytest.mark.mutant("what rubs: {what}")
@pytest.mark.parametrize("what", PLANTED)
def test_a_mistake_in_what_slides_leaves_the_closed_form(what: str) -> None:
    name, mode, changed = PLANTED[what]
    system, until = example(name), duration(name) / 2 if name == "friction_of_rest" else 1.9
    sound: Any = system.modes[mode]
    assert off(system, system, until) < 1e-11
    assert off(system, with_mode(system, mode, replace(sound, **changed)), until) > 1e-3


SEEN: dict[str, tuple[str, str, dict[str, Any], Callable[..., float]]] = {
    "oil that drives": ("bearing", "turns", {"d": -0.05}, laws.free_cut),
    "dry friction that drives": ("bearing", "turns", {"M_k": -0.3}, laws.power),
    "friction of the other way": ("friction_cone", "up", {"sigma": 1}, laws.free_cut),
    "a lift that friction does not feel": ("friction_cone", "up", {"b_y": 0.0}, laws.power),
    "friction that falls over another speed": (
        "stribeck_drive", "backward", {"falls": (3.0, 0.525)}, laws.free_cut,
    ),
    "the falling part of friction with the wrong sign": (
        "stribeck_drive", "forward", {"falls": (3.0, 0.5)}, laws.power,
    ),
}  # fmt: skip


@pytest.mark.mutant("what rubs: {what}, in the accelerations alone")
@pytest.mark.parametrize("what", SEEN)
def test_a_mistake_in_the_accelerations_breaks_a_law(what: str) -> None:
    name, mode, changed, law = SEEN[what]
    system = example(name)
    sound: Any = system.modes[mode]
    wrong = replace(sound, **changed)
    mixed = mutant(sound, accelerations=lambda self, t, q, v: wrong.accelerations(t, q, v))
    assert not laws.broken(law, law(system, (name, mode)))
    assert laws.broken(law, law(with_mode(system, mode, mixed), (name, mode)))


@pytest.mark.mutant("guards of {name} that fall 1e-6 too early")
@pytest.mark.parametrize("name", ["bearing", "friction_cone", "friction_of_rest", "stribeck_brake"])
def test_an_event_that_is_early_is_seen(name: str) -> None:
    """By 1e-6 of what the guard is of."""
    system = example(name)

    def guards(self: System, mode: str) -> Any:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) - 1e-6) for g in system.guards(mode)]

    until = duration(name)
    assert max(event_errors(system, system, until)) <= LOCATED
    assert max(event_errors(system, mutant(system, guards=guards), until)) > 1e3 * LOCATED


def test_static_bounds_of_the_cone() -> None:
    """(2.89) tan ρ in both directions, and the slope in favour of one: by statics alone."""
    m, g, mu = 2.0, 9.80665, 0.5
    for beta, b_x, b_y in ((0.1, 4.0, 1.0), (0.1, -4.0, 1.0), (0.0, -4.0, -1.5)):
        block = example("friction_cone", beta=beta, b_x=b_x, b_y=b_y)
        events = block.closed_events(5.0)
        assert events is not None
        ((_, t),) = events
        along = m * g * np.sin(beta) + b_x * t
        assert abs(along) == pytest.approx(mu * (m * g * np.cos(beta) - b_y * t), rel=1e-14)


def test_falling_friction_has_a_speed_that_it_keeps() -> None:
    """F(v) = P: slower it stops, faster it runs away."""
    speed = 0.5 * np.log(3.0 / 1.0)
    stays = example("stribeck_brake", P=4.0, v0=speed)
    times: Array = np.linspace(0.0, 0.5, 6)
    np.testing.assert_allclose(follow(stays, times).y[:, 1], speed, rtol=1e-12)
    for v0, events in ((speed - 0.01, 1), (speed + 0.01, 0)):
        found = follow(example("stribeck_brake", P=4.0, v0=v0), np.linspace(0.0, 3.0, 7))
        assert len(found.events) == events


# Mistakes planted in modes and guards: the events or the laws that see them.


@pytest.mark.mutant("guards of {name} that fall at a threshold of 1e-6, not at zero")
@pytest.mark.parametrize("name", ["sliding_disk", "sliding_block", "dynamometer"])
def test_threshold_in_place_of_the_event_is_seen(name: str):
    """`stays zero` within 1e-6 m/s instead of g = 0."""
    system = example(name)

    def guards(self: System, mode: str) -> Sequence[Guard]:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) - 1e-6) for g in system.guards(mode)]

    assert max(event_errors(system, system, duration(name))) <= LOCATED
    assert max(event_errors(system, mutant(system, guards=guards), duration(name))) > 1e3 * LOCATED


@pytest.mark.mutant("{name} without its stick mode")
@pytest.mark.parametrize("name", ["sliding_block", "dynamometer"])
def test_missing_stick_mode_is_seen(name: str):
    """Where it should stick it goes on sliding, the other way."""
    system = example(name)
    other = {"up": "down", "down": "up", "forward": "backward", "backward": "forward"}

    def guards(self: System, mode: str) -> Sequence[Guard]:
        def on(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return other[mode], q, np.zeros(1)

        return [replace(g, then=on) if g.event == "stops" else g for g in system.guards(mode)]

    with pytest.raises(ZenoError):  # it chatters between the two
        event_errors(system, mutant(system, guards=guards), duration(name))


@pytest.mark.mutant("friction that drives {name}, against (2.89)", "F₋ and F₊ of {name} exchanged")
@pytest.mark.slow
@pytest.mark.parametrize("name", ["growing_force", "dynamometer"])
def test_sign_in_2_89_is_seen(name: str):
    """Friction that drives instead of braking; and the bound of the other side."""
    system = example(name, Fs_minus=6.0, Fs_plus=5.0)
    fed = system
    for mode in ("forward", "backward"):
        wrong: Any = system.modes[mode]
        fed = with_mode(fed, mode, replace(wrong, F_fr=-wrong.F_fr))
    times = np.linspace(0.0, 10.0, 31)
    closed = [system.closed_form(t) for t in times.tolist()]
    known = np.array([np.concatenate(c) for c in closed if c is not None])
    assert np.abs(follow(system, times).y - known).max() < 1e-10
    assert np.abs(follow(fed, times).y - known).max() > 1.0
    swapped = example(name, Fs_minus=5.0, Fs_plus=6.0)
    assert max(event_errors(system, swapped, 4.0 if name == "dynamometer" else 10.0)) > 0.1


@pytest.mark.mutant("sign of friction in {name}, mode {mode}")
@pytest.mark.parametrize(
    ("name", "mode"), [("sliding_disk", "slips forward"), ("sliding_block", "down")]
)
def test_sign_of_friction_in_one_mode_is_seen_by_the_laws(name: str, mode: str):
    system = example(name)
    sound: Any = system.modes[mode]
    wrong = replace(sound, sigma=-1)
    mixed = mutant(sound, accelerations=lambda self, t, q, v: wrong.accelerations(t, q, v))
    for law in (laws.free_cut, laws.power):
        assert not laws.broken(law, law(system, (name, mode)))
        assert laws.broken(law, law(with_mode(system, mode, mixed), (name, mode)))
