"""Every hand-written system that switches: its modes, its events, and mistakes planted in it."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, replace
from typing import Any

import mpmath
import numpy as np
import pytest
from given import laws
from given.examples import PARAMETERS as SMOOTH
from given.switching_examples import PARAMETERS, example, states
from scipy.integrate import solve_ivp

from textmech.reference.formalisms import lagrange, newton_euler
from textmech.reference.integrators.implicit import radau
from textmech.reference.laws.friction import Dry, smooth
from textmech.reference.motion.follow import follow
from textmech.reference.motion.stuck import slope
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.system import Array, Guard, Mode, System
from textmech.reference.systems import SYSTEMS
from textmech.reference.systems.dynamometer import Dynamometer

MODES = [(name, mode) for name in PARAMETERS for mode in example(name).modes]
LOCATED = 1e-12  # s
DURATION = {"sliding_block": 1.0, "sliding_disk": 2.0, "bouncing_disk": 3.0}  # 10 s else

VARIANTS: dict[str, tuple[str, dict[str, float], list[str]]] = {
    "plane, back": ("sliding_disk", {"beta": 0.0}, ["rolls"]),
    "plane, no spin": ("sliding_disk", {"beta": 0.0, "v0": -3.0, "w0": 0.0}, ["rolls"]),
    "up the incline": ("sliding_disk", {}, ["rolls"]),
    "too steep": ("sliding_disk", {"beta": math.radians(60)}, []),
    "too steep, released": (
        "sliding_disk", {"beta": math.radians(60), "v0": 0.0, "w0": 0.0}, [],
    ),
    "rolls from rest": ("sliding_disk", {"v0": 0.0, "w0": 0.0}, []),
    "stops above": ("sliding_block", {}, ["stops"]),
    "comes back": ("sliding_block", {"beta": math.radians(35)}, []),
    "rests": ("sliding_block", {"v0": 0.0}, []),
    "just sticks": ("sliding_block", {"v0": 0.0, "beta": math.atan(0.5) - 1e-6}, []),
    "just slides": ("sliding_block", {"v0": 0.0, "beta": math.atan(0.5) + 1e-6}, []),
    "brakes": ("sliding_block", {"beta": 0.0, "v0": 2.0}, ["stops"]),
    "slips for good": ("growing_force", {}, ["slips"]),
    "stick-slip": ("dynamometer", {}, ["slips", "stops"] * 2),
    "elastic": ("bouncing_disk", {}, ["bounces"] * 5),
    "plastic": ("bouncing_disk", {"e": 0.0}, ["lands"]),
}  # fmt: skip


def duration(name: str) -> float:
    return DURATION.get(name, 10.0)


def event_errors(known: System, system: System, until: float) -> list[float]:
    """Distances [s] of the events of one system from the closed ones of another; inf if others."""
    closed = known.closed_events(until)
    assert closed is not None
    found = follow(system, np.linspace(0.0, until, 31)).events
    if [event.name for event in found] != [name for name, _ in closed]:
        return [math.inf]
    return [abs(event.time - t) for event, (_, t) in zip(found, closed, strict=True)]


def test_every_system_is_tested():
    assert set(SYSTEMS) == set(PARAMETERS) | set(SMOOTH)


@pytest.mark.parametrize(("name", "mode"), MODES)
def test_mode_obeys_the_laws(name: str, mode: str):
    system, known = example(name).modes[mode], list(states(name, mode))
    for law in (laws.rates_of_poses, laws.koenig):
        assert law(system, name, known) <= laws.LIMIT
    for t, q, v in known:
        # At rest nothing has a size: 1 m/s² and 1 N then.
        a = system.accelerations(t, q, v)
        assert laws.difference(a, lagrange.multipliers(system, t, q, v)[0], 1.0) <= laws.LIMIT
        solved, forces = newton_euler.accelerations(system, t, q, v)
        assert laws.difference(a, solved, 1.0) <= laws.LIMIT
        balance, balanced = newton_euler.balance(system, t, q, v, a)
        assert balance <= laws.LIMIT
        written = system.reactions(t, q, v)
        for found in (forces, balanced):
            for key, value in found.items():
                assert laws.difference(written[key], value, 1.0) <= laws.LIMIT, key


@pytest.mark.parametrize(("name", "mode"), [m for m in MODES if not m[0].startswith("smooth")])
def test_mode_balances_its_power(name: str, mode: str):
    assert laws.power(example(name).modes[mode], name, states(name, mode)) <= laws.LIMIT


@pytest.mark.parametrize(("name", "mode"), MODES)
def test_constraints_of_a_mode_are_its_multipliers(name: str, mode: str):
    """λ of (2.60) are reactions, in the order of the rows."""
    system = example(name).modes[mode]
    for t, q, v in states(name, mode, 10):
        lam = lagrange.multipliers(system, t, q, v)[1]
        assert len(lam) == len(system.f_a(t, q)) == len(system.g(t, q))
        written = list(system.reactions(t, q, v).values())
        for value in lam:
            assert min(abs(value - w) for w in written) <= laws.LIMIT * max(1.0, abs(value))


@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_smooth_mode_within_its_band_is_the_printed_law(name: str):
    system = example(name).modes["moving"]
    dry, random = Dry(3.0, 3.0, 6.0, 6.0), np.random.default_rng(2)
    for _ in range(200):
        t, v = random.uniform(5.9999, 6.0001), random.uniform(-1e-3, 1e-3)
        x = 0.0 if "growing" in name else random.uniform(8.9999, 9.0001)
        F_a = -t if "growing" in name else 4 * t - 2 * x
        printed = F_a + smooth(dry, 5e-4, 1e5, v, F_a)
        written = system.accelerations(t, np.array([x]), np.array([v]))[0]
        # A times the rounding of F_a, 1e-15 of 15 N: what the steep edges make of it.
        assert written == pytest.approx(printed, abs=2e-9)


@pytest.mark.parametrize("variant", VARIANTS)
def test_motion_and_events_meet_the_closed_form(variant: str):
    name, changed, names = VARIANTS[variant]
    system, times = example(name, **changed), np.linspace(0.0, duration(name), 41)
    found = follow(system, times)
    assert [event.name for event in found.events] == names
    assert max(event_errors(system, system, times[-1]), default=0.0) <= LOCATED
    for t, mode, y in zip(times.tolist(), found.modes, found.y, strict=True):
        known = system.closed_form(t)
        assert known is not None
        np.testing.assert_allclose(y, np.concatenate(known), rtol=0, atol=1e-12 * (1 + t**3))
        assert system.possible(mode, t, *np.split(y, 2)) is None


def test_published_phase_times_of_example_2_4():
    found = follow(example("dynamometer"), np.linspace(0.0, 10.0, 11)).events
    assert [round(e.time, 6) for e in found] == [1.5, 4.790544, 6.290544, 9.581087]


def test_dynamometer_against_roots_to_thirty_digits():
    """Sinusoid and straight line: v = 0 by bisection in mpmath, phase by phase."""
    with mpmath.workdps(30):
        omega, t, x, known = mpmath.sqrt(2), mpmath.mpf(0), mpmath.mpf(0), []
        for _ in range(2):
            slips = (6 + 2 * x) / 4

            def v(s: Any) -> Any:
                return (
                    2
                    - 2 * mpmath.cos(omega * s)
                    + mpmath.mpf(3) / 2 * omega * mpmath.sin(omega * s)
                )

            tau = mpmath.findroot(v, (3.0, 3.5), solver="anderson")
            t = slips + tau
            z = mpmath.mpf(3) / 2 * mpmath.cos(omega * tau) + 2 / omega * mpmath.sin(omega * tau)
            x = 2 * t - mpmath.mpf(3) / 2 - z
            known += [float(slips), float(t)]
    found = follow(example("dynamometer"), np.linspace(0.0, 10.0, 11)).events
    assert [e.time for e in found] == pytest.approx(known, abs=LOCATED, rel=0)


def _drift_events(periods: int) -> Iterator[tuple[str, Any]]:
    """A sin ωt with A = 5, ω = 2π, F₋ = 3, F₊ = 1, F_s₋ = 4, F_s₊ = 1.5, m = 1, root by root."""
    A, w = mpmath.mpf(5), 2 * mpmath.pi

    def speed(t: Any, since: Any, F: Any) -> Any:
        return A / w * (mpmath.cos(w * since) - mpmath.cos(w * t)) + F * (t - since)

    def halt(since: Any, F: Any, near: tuple[float, float]) -> Any:
        bracket = [since + s for s in near]
        return mpmath.findroot(lambda t: speed(t, since, F), bracket, solver="anderson")

    for k in range(periods):
        slips = k + mpmath.asin(mpmath.mpf(3) / 10) / w
        yield "slips", slips
        turns = halt(slips, -1, (0.3, 0.9))
        force = A * mpmath.sin(w * turns)
        if force >= -4:
            yield "stops", turns
            backward = k + mpmath.mpf(1) / 2 + mpmath.asin(mpmath.mpf(4) / 5) / w
            if backward < turns:
                continue
            yield "slips", backward
            turns = backward
        yield "stops", halt(turns, 3, (0.05, 0.6))


def test_drift_against_roots_to_thirty_digits():
    system = example("anisotropic_drift")
    found = follow(system, np.linspace(0.0, 5.0, 51))
    with mpmath.workdps(30):
        known = [(name, float(t)) for name, t in _drift_events(6) if t <= 5]
    assert [e.name for e in found.events] == [name for name, _ in known]
    assert [e.time for e in found.events] == pytest.approx([t for _, t in known], abs=1e-10, rel=0)
    per_period = np.diff(found.y[::10, 0])
    assert np.ptp(per_period[1:]) < 1e-12  # the same way every period, to +x where it is easier
    assert per_period[1] > 0.1


@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_smooth_law_by_stiff_integrators(name: str):
    system, times = example(name), np.linspace(0.0, 10.0, 51)
    assert system.modes["moving"].stiff
    found = follow(system, times)
    assert found.events == ()
    f = slope(system.modes["moving"])
    seven = radau(f, times, np.zeros(2), stages=7, tolerance=1e-15).y
    other = solve_ivp(
        f, (0.0, 10.0), np.zeros(2), method="Radau", t_eval=times, rtol=1e-13, atol=1e-16,
        max_step=0.05,
    )  # fmt: skip
    assert np.abs(found.y - seven).max() <= 1e-9
    assert np.abs(found.y - other.y.T).max() <= 1e-9


def test_smooth_law_is_another_model():
    """Erratum 15: it never rests, and by 10 s it is 7.6e-4 m from the exact law."""
    times = np.linspace(0.0, 10.0, 2001)
    exact, found = (follow(example(n), times).y for n in ("dynamometer", "smooth_dynamometer"))
    assert np.abs(found - exact)[:, 0].max() == pytest.approx(7.6e-4, rel=0.02)
    sticks = found[(times > 4.85) & (times < 6.2), 1]
    assert 0.87 * 5e-4 < sticks.min() < sticks.max() < 5e-4


def test_spring_of_the_dynamometer():
    """Fig 2.24: at the first slip the force is F_s₊; where it stops, 2 F₊ − F_s₊ = 0."""
    system = example("dynamometer")
    assert isinstance(system, Dynamometer)
    forces = []
    for event in follow(system, np.linspace(0.0, 10.0, 11)).events:
        end, force = system.spring(event.time, event.after[:1])
        assert end == 2.0 * event.time
        forces.append(force)
    assert forces == pytest.approx([6.0, 0.0, 6.0, 0.0], abs=1e-12)


def test_friction_cone_is_not_ignored():
    q, v = np.array([0.0, 0.25, 0.0]), np.zeros(3)
    steep = example("sliding_disk", beta=math.atan(1.2) + 1e-9)
    message = steep.possible("rolling", 0.0, q, v)
    assert message == "rolling needs friction 0.4, there is 0.4"
    assert example("sliding_disk", beta=math.atan(1.2) - 1e-9).possible("rolling", 0, q, v) is None
    block = example("sliding_block", beta=math.atan(0.6))
    assert block.possible("sticks", 0.0, np.zeros(1), np.zeros(1)) is not None
    assert block.possible("down", 0.0, np.zeros(1), np.zeros(1)) is None
    for name, t in (("growing_force", 6.1), ("dynamometer", 1.6), ("anisotropic_drift", 0.25)):
        assert "sticking against" in str(example(name).possible("stuck", t, *np.zeros((2, 1))))


def test_contact_that_is_open_or_penetrates_is_said():
    disk = example("bouncing_disk")
    assert "below the floor" in str(disk.possible("flight", 0.0, np.array([0.19]), np.zeros(1)))
    block = example("sliding_block", beta=math.radians(100))
    assert "would have to pull" in str(block.possible("down", 0.0, np.zeros(1), np.zeros(1)))


@pytest.mark.parametrize(
    ("name", "changed", "words"),
    [
        ("sliding_block", {"mu_s": 0.3}, "μ_k ≤ μ_s"),
        ("sliding_block", {"mu_k": -0.1}, "μ_k ≤ μ_s"),
        ("growing_force", {"F_minus": 7.0}, "kinetic friction"),
        ("growing_force", {"b": 0.0}, "b > 0"),
        ("dynamometer", {"u": -1.0}, "u > 0"),
        ("dynamometer", {"Fs_plus": 2.0}, "kinetic friction"),
        ("bouncing_disk", {"e": 1.1}, "restitution"),
        ("bouncing_disk", {"y0": 0.1}, "above the floor"),
        ("smooth_dynamometer", {"F_plus": -3.0}, "negative"),
    ],
)
def test_impossible_parameters_are_refused(name: str, changed: dict[str, float], words: str):
    with pytest.raises(ValueError, match=words):
        example(name, **changed)


def mutant(system: System, **methods: Callable[..., Any]) -> System:
    """The same system with some of its methods replaced."""
    cls = type(system)
    known = {key: getattr(system, key) for key in PARAMETERS_OF[cls]}
    return type(f"Mutant{cls.__name__}", (cls,), methods)(**known)


PARAMETERS_OF = {SYSTEMS[name]: list(PARAMETERS[name]) for name in PARAMETERS}


@pytest.mark.parametrize("name", ["sliding_disk", "sliding_block", "dynamometer"])
def test_threshold_in_place_of_the_event_is_seen(name: str):
    """`stays zero` within 1e-6 m/s instead of g = 0."""
    system = example(name)

    def guards(self: System, mode: str) -> Sequence[Guard]:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) - 1e-6) for g in system.guards(mode)]

    assert max(event_errors(system, system, duration(name))) <= LOCATED
    assert max(event_errors(system, mutant(system, guards=guards), duration(name))) > 1e3 * LOCATED


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


@pytest.mark.parametrize("name", ["growing_force", "dynamometer"])
def test_sign_in_2_89_is_seen(name: str):
    """Friction that drives instead of braking; and the bound of the other side."""
    system = example(name, Fs_minus=6.0, Fs_plus=5.0)
    fed = mutant(system)
    modes = dict(fed.modes)
    for mode in ("forward", "backward"):
        modes[mode] = replace(modes[mode], F_fr=-modes[mode].F_fr)  # type: ignore[attr-defined, type-var]
    object.__setattr__(fed, "modes", modes)
    times = np.linspace(0.0, 10.0, 31)
    closed = [system.closed_form(t) for t in times.tolist()]
    known = np.array([np.concatenate(c) for c in closed if c is not None])
    assert np.abs(follow(system, times).y - known).max() < 1e-10
    assert np.abs(follow(fed, times).y - known).max() > 1.0
    swapped = example(name, Fs_minus=5.0, Fs_plus=6.0)
    assert max(event_errors(system, swapped, 4.0 if name == "dynamometer" else 10.0)) > 0.1


@pytest.mark.parametrize(
    ("name", "mode"), [("sliding_disk", "slips forward"), ("sliding_block", "down")]
)
def test_sign_of_friction_in_one_mode_is_seen_by_the_laws(name: str, mode: str):
    system = example(name).modes[mode]
    wrong = replace(system, sigma=-1)  # type: ignore[type-var, call-arg]

    def accelerations(self: Mode, t: float, q: Array, v: Array) -> Array:
        return wrong.accelerations(t, q, v)

    planted = type("Mixed", (type(system),), {"accelerations": accelerations})(**vars_of(system))
    known = list(states(name, mode, 5))
    for law in (laws.free_cut, laws.power):
        assert not laws.broken(law, law(system, name, known))
        assert laws.broken(law, law(planted, name, known))


def vars_of(system: Any) -> dict[str, Any]:
    return {field.name: getattr(system, field.name) for field in fields(system)}
