"""Wheels, disks and a driven blade: closed forms, where they are stable, planted mistakes."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws import LIMIT, cut_bodies, difference
from given.laws import spatial_laws as laws
from given.machines.spatial import example, only, steady, variant
from given.machines.spatial import states as states_tilting
from given.machines.wheels import (
    CIRCLE,
    CLOSED,
    FROM_ABOVE,
    PARAMETERS,
    WEAVE,
    WHEEL,
    states,
    wheel,
)
from given.mutants import in_ground_axes, mutant, sound, too_fast, transposed
from mpmath import cos, exp, mp, mpf, quad
from scipy.special import j0

from textmech.reference.formalisms import (
    appell,
    chaplygin,
    energy,
    lagrange,
    newton_euler,
    voronets,
)
from textmech.reference.motion.follow import follow
from textmech.reference.system import MOVING, Array, Mode, Only
from textmech.reference.systems import written
from textmech.reference.systems.rolling import tilting_ring
from textmech.reference.systems.rolling.driven_edge import DrivenEdge
from textmech.reference.systems.rolling.tilting_ring import TiltingRing

# The upright wheel, free and driven: second derivations, closed forms, and planted mistakes.

G = 9.80665
NAMES = pytest.mark.parametrize("name", PARAMETERS)


def equations(mode: Mode) -> float:
    """Explicit accelerations and reactions against (2.60), relative to the largest."""
    worst = 0.0
    for t, q, v in states(mode):
        a, lam = lagrange.multipliers(mode, t, q, v)
        held = mode.reactions(t, q, v)
        own = [held["touch.fx"], held["touch.fy"]]
        if len(lam) == 4:
            own += [held["upright.theta_torque"], held["upright.phi_torque"]]
        worst = max(worst, difference(mode.accelerations(t, q, v), a), difference(own, lam))
    return worst


def cut_free(mode: Any) -> float:
    """Its own loads and cuts balance, and give the reactions that it states."""
    worst = 0.0
    for t, q, v in states(mode):
        left, found = cut_bodies.solved(mode, t, q, v, mode.accelerations(t, q, v))
        held = mode.reactions(t, q, v)
        couple = held["upright.mx"] * math.cos(q[2]) + held["upright.my"] * math.sin(q[2])
        known = {**held, "upright.couple": couple}
        apart = difference([found[name] for name in found], [known[name] for name in found])
        worst = max(worst, left, apart)
    return worst


def moves(mode: Mode) -> float:
    """`poses` moves as it says, and has the energy T."""
    return cut_bodies.moves(mode, states(mode))


def slips(mode: Any) -> float:
    """(2.19) v_c + ω × (−R e_z), the velocity of the rim's point, and f_a q̇ = g [m/s]."""
    worst = 0.0
    for t, q, v in states(mode):
        pose = mode.poses(t, q, v)["wheel"]
        omega = cut_bodies.matrix(pose) @ np.array(pose[10:])
        rim = np.array(pose[7:10]) + np.cross(omega, [0.0, 0.0, -WHEEL["R"]])
        worst = max(worst, abs(rim).max(), abs(mode.f_a(t, q) @ v - mode.g(t, q)).max())
    return worst / 5.0  # rad/s of the states, beside lengths of one


def power(mode: Mode) -> float:
    """(2.51) over the power of the weight."""
    found = [abs(energy.power_balance(mode, t, q, v)) / abs(v).max() for t, q, v in states(mode)]
    return max(found) / (WHEEL["m"] * G)


LAWS = [equations, cut_free, moves, slips, power]


@NAMES
@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_wheel_obeys(name: str, law: Any) -> None:
    assert law(wheel(name)) < LIMIT


def test_sides_of_the_contact_are_those_of_its_force() -> None:
    for t, q, v in states(mode := wheel("upright_wheel")):
        held = mode.reactions(t, q, v)
        turned = (held["touch.fx"] + 1j * held["touch.fy"]) * np.exp(-1j * q[2])
        assert abs(turned - (held["touch.along"] + 1j * held["touch.side"])) < 1e-13 * abs(turned)


def apart(mode: Mode, times: Any) -> float:
    """Followed motion against the closed form, relative to the largest coordinate and rate."""
    y = follow(Only(mode), times).y
    known = np.array([np.concatenate(mode.closed_form(t) or ()) for t in times.tolist()])
    return max(difference(y[:, :4], known[:, :4]), difference(y[:, 4:], known[:, 4:]))


@pytest.mark.parametrize("name", CLOSED)
def test_motion_is_the_closed_form(name: str) -> None:
    system, changed = CLOSED[name]
    assert apart(wheel(system, **changed), np.linspace(0.0, 2.0, 21)) < LIMIT


def test_no_closed_form_is_claimed_for_other_paths() -> None:
    for changed in (WEAVE, {"k": 0.0}, {"A": 0.0}, {}):
        assert wheel("driven_wheel", **changed).closed_form(0.5) is None


def test_weaving_wheel_after_a_period() -> None:
    """x + iy = R w T e^{iz} J₀(z), z = A/ν: the integral of Bessel's J₀ over a whole period."""
    mode = wheel("driven_wheel", **WEAVE)
    period, z = 2 * math.pi / 3.0, 0.9 / 3.0
    x, y = follow(Only(mode), np.array([0.0, period])).y[-1, :2]
    known = 0.25 * 6.0 * period * np.exp(1j * z) * j0(z)
    assert abs(x + 1j * y - known) < LIMIT * abs(known)


def test_circle_needs_its_side_force_and_no_torque_on_the_level() -> None:
    """m R w Ω to the centre, and the couple −J₂₂ w Ω − R F·n; nothing else."""
    mode = wheel("driven_wheel", alpha=0.0, **CIRCLE)
    held = mode.reactions(0.0, *mode.start())
    side = 1.3 * 0.25 * 6.0 * 1.2
    assert math.isclose(held["touch.side"], side, rel_tol=1e-14)
    couple = -1.3 * 0.25**2 / 2 * 6.0 * 1.2 - 0.25 * side
    assert math.isclose(held["upright.mx"], couple, rel_tol=1e-14)
    for name in ("touch.along", "upright.theta_torque", "upright.phi_torque"):
        assert abs(held[name]) < 1e-15


def backward(self: Any, t: Any, q: Any, v: Any) -> Any:
    """φ about −y: the wheel's forward sense in the plane, clockwise."""
    turned = np.array([1.0, 1.0, 1.0, -1.0])
    return sound(self, "poses")(t, q * turned, v * turned)


def gyroscopic(self: Any, t: float, q: Any, v: Any) -> dict[str, float]:
    """Without J₂₂ φ̇ θ̇ in the couple."""
    lost = self.axle() * v[3] * v[2]
    held = sound(self, "reactions")(t, q, v)
    mx, my = lost * math.cos(q[2]), lost * math.sin(q[2])
    return held | {"upright.mx": held["upright.mx"] + mx, "upright.my": held["upright.my"] + my}


def centre(self: Any, t: Any, q: Any) -> Any:
    """Slip of the centre for the rim's point: R φ̇ left out."""
    rows = np.array(sound(self, "f_a")(t, q))
    rows[:2, 3] = 0.0
    return rows


def at_the_centre(self: Any, t: float, q: Any) -> Any:
    floor, *others = sound(self, "cuts")(t, q)
    return [replace(floor, at=(*floor.at[:2], self.R)), *others]


MISTAKES = {
    "transposed E": ({"poses": transposed}, cut_free),
    "ω in ground axes": ({"poses": in_ground_axes}, moves),
    "floor's force at the centre": ({"cuts": at_the_centre}, cut_free),
    "φ counted backward": ({"poses": backward}, slips),
    "lost gyroscopic couple": ({"reactions": gyroscopic}, cut_free),
    "slip of the centre": ({"f_a": centre}, slips),
    "slip of the centre, as equations": ({"f_a": centre}, equations),
    "accelerations off": ({"accelerations": too_fast}, power),
    "gravity uphill": (
        {"U": lambda self, t, q: self.m * G * q[0] * math.sin(self.alpha)},
        equations,
    ),
}


@pytest.mark.mutant("{name}: {mistake}")
@NAMES
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_in_a_wheel_is_seen(name: str, mistake: str) -> None:
    methods, law = MISTAKES[mistake]
    assert law(mutant(wheel(name), **methods)) > 1e3 * LIMIT


@pytest.mark.mutant("upright_wheel: J of a ring everywhere")
def test_a_moment_of_inertia_that_is_wrong_everywhere_is_seen() -> None:
    """The laws agree on any; the closed form knows that of a thin disk."""
    ring = mutant(wheel("upright_wheel"), axle=lambda self: self.m * self.R**2)
    assert max(law(ring) for law in LAWS) < LIMIT
    assert apart(ring, np.linspace(0.0, 2.0, 5)) > 1e-3


# The wheel seen from above draws the path of the wheel in space; and planted mistakes.

GIVEN = FROM_ABOVE["wheel_from_above"]
TIMES = np.linspace(0.0, 4.0, 41)
# Changes of this system, and of the wheel in space: u₀ = R w, and the same turn of the heading.
ALIKE: list[tuple[dict[str, float], dict[str, float]]] = [
    ({}, {}),
    ({"alpha": 0.0}, {"alpha": 0.0}),
    ({"u0": -1.0}, {"w": -4.0}),
    ({"w0": 0.0}, {"Omega": 0.0}),
    ({"w0": -2.5, "u0": 0.0}, {"Omega": -2.5, "w": 0.0}),
]


def above(**changed: float) -> Mode:
    """Its only mode, with some of its parameters changed."""
    return written("wheel_from_above", {**GIVEN, **changed}).modes[MOVING]


def states_above() -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v; the heading stays away from ± 90°, where ẏ/ẋ ends."""
    random = np.random.default_rng(4)
    for _ in range(20):
        theta = random.uniform(-1.3, 1.3) + random.choice([0.0, math.pi])
        q = np.array([*random.uniform(-3, 3, 2), theta])
        yield random.uniform(0, 5), q, random.uniform(-5, 5, 2)


def formalisms(mode: Mode) -> float:
    """(2.44) by Hamel's form, (2.66), (2.67) and (2.80)."""
    worst = 0.0
    for t, q, v in states_above():
        a = mode.accelerations(t, q, v)
        for form in (lagrange, voronets, chaplygin, appell):
            found = form.accelerations(mode, t, q, v)
            assert found is not None
            worst = max(worst, difference(a, found, 1.0))
    return worst


def free_cut_above(mode: Mode) -> float:
    """(2.23), (2.27) and the reaction that they give."""
    worst = 0.0
    for t, q, v in states_above():
        found = newton_euler.balance(mode, t, q, v, mode.accelerations(t, q, v))
        own = mode.reactions(t, q, v)["edge.force"]
        worst = max(worst, found.share(), difference(found.reactions["edge.force"], own))
    return worst


def power_above(mode: Mode) -> float:
    """(2.51) over M g and a speed of 1 m/s."""
    weight = GIVEN["M"] * GIVEN["gravity"]
    return max(abs(energy.power_balance(mode, *at)) for at in states_above()) / weight / 5.0


def apart_above(mode: Mode) -> float:
    """Followed motion against the closed form."""
    y = follow(Only(mode), TIMES).y
    known = np.array([np.concatenate(mode.closed_form(t) or ()) for t in TIMES.tolist()])
    return difference(y, known)


def of_the_wheel(mode: Mode, **changed: float) -> float:
    """Path, heading and speed of the wheel in space; what it is held upright by is R λ [m, N m]."""
    other = wheel("upright_wheel", **changed)
    rows = zip(
        TIMES.tolist(), follow(Only(mode), TIMES).y, follow(Only(other), TIMES).y, strict=True
    )
    worst = 0.0
    for t, y, z in rows:
        (q, v), (p, w) = mode.parted(y), other.parted(z)
        held = other.reactions(t, p, w)
        couple = held["upright.mx"] * math.cos(p[2]) + held["upright.my"] * math.sin(p[2])
        torque = -WHEEL["R"] * mode.reactions(t, q, v)["edge.force"]
        worst = max(worst, *np.abs(q - p[:3]), abs(v[0] - WHEEL["R"] * w[3]), abs(torque - couple))
    return worst


@pytest.mark.parametrize(("here", "there"), ALIKE)
def test_the_path_is_that_of_the_wheel_in_space(
    here: dict[str, float], there: dict[str, float]
) -> None:
    assert of_the_wheel(above(**here), **there) < 1e-12  # of metres: two integrations round


def test_the_case_is_that_of_the_upright_wheel() -> None:
    """Its typed numbers, of which YAML computes none."""
    p = scenes.SHIPPED["wheel_from_above.downhill"].parameters
    q = scenes.SHIPPED["upright_wheel.downhill"].parameters
    assert pytest.approx(p, rel=1e-15) == GIVEN
    assert {**PARAMETERS["upright_wheel"], "mu": q["mu"]} == pytest.approx(q, rel=1e-15)
    assert p["M"] == pytest.approx(1.5 * q["m"], rel=1e-15)
    assert p["J"] == pytest.approx(q["m"] * q["R"] ** 2 / 4, rel=1e-15)
    assert p["M"] * p["gravity"] == pytest.approx(q["m"] * 9.80665, rel=1e-15)
    assert (p["u0"], p["w0"], p["alpha"]) == (q["R"] * q["w"], q["Omega"], q["alpha"])


ABOVE_LAWS: list[Callable[[Mode], float]] = [
    formalisms,
    free_cut_above,
    power_above,
    apart_above,
    of_the_wheel,
]


@pytest.mark.slow
@pytest.mark.parametrize("law", ABOVE_LAWS, ids=lambda law: law.__name__)
def test_it_obeys(law: Callable[[Mode], float]) -> None:
    assert law(above()) < LIMIT


def off(**changed: float) -> dict[str, Any]:
    """The explicit accelerations and reactions of another one."""
    other = above(**changed)
    return {
        "accelerations": lambda self, t, q, v: other.accelerations(t, q, v),
        "reactions": lambda self, t, q, v: other.reactions(t, q, v),
    }


def across(self: Any, t: Any, q: Any, v: Any) -> Any:
    """Rolls along its axle."""
    return np.array([-v[0] * np.sin(q[2]), v[0] * np.cos(q[2]), v[1]])


ABOVE_MISTAKES: dict[str, tuple[dict[str, Any], Callable[[Mode], float]]] = {
    "mass of a disk that glides": (off(M=1.3), free_cut_above),
    "gravity of one that glides": (off(gravity=9.80665), of_the_wheel),
    "gravity of one that glides, by the formalisms": (off(gravity=9.80665), formalisms),
    "gravity of one that glides, as power": (off(gravity=9.80665), power_above),
    "gravity of one that glides, as a motion": (off(gravity=9.80665), apart_above),
    "another slope": (off(alpha=0.2), free_cut_above),
    "rolls along its axle": ({"rates": across}, of_the_wheel),
}


@pytest.mark.slow
@pytest.mark.mutant("wheel from above: {mistake}")
@pytest.mark.parametrize("mistake", ABOVE_MISTAKES)
def test_a_planted_mistake_in_the_wheel_from_above_is_seen(mistake: str) -> None:
    methods, law = ABOVE_MISTAKES[mistake]
    assert law(mutant(above(), **methods)) > 1e3 * LIMIT


@pytest.mark.slow
@pytest.mark.mutant("wheel from above: mass and gravity of a disk that glides, everywhere")
def test_nothing_turns_it() -> None:
    """J drops out; with the mass of the disk alone the path would be another one everywhere."""
    for t, q, v in states_above():
        np.testing.assert_array_equal(
            above(J=1.0).accelerations(t, q, v), above().accelerations(t, q, v)
        )
    gliding = above(M=1.3, gravity=9.80665)
    assert max(law(gliding) for law in ABOVE_LAWS if law is not of_the_wheel) < LIMIT
    assert of_the_wheel(gliding) > 0.1


# The disk that rolls and tilts: where it is stable, what stays, special motions, mistakes.

m, R = 1.3, 0.25


def test_moments_of_a_disk_and_of_a_ring():
    """Exercise 2.2: m R²/4 about a diameter, m R²/2 about the axle, which is axis 2 of the body."""
    known = m * R * R * np.diag([0.25, 0.5, 0.25])
    np.testing.assert_allclose(only("tilting_disk").masses["disk"].J, known, rtol=1e-15)
    ring = only("tilting_ring").masses["disk"].J
    np.testing.assert_array_equal(ring, np.diag([0.03, 0.07, 0.03]))


@pytest.mark.parametrize("moments", [None, (0.03, 0.07)])
@pytest.mark.parametrize(("part", "stable"), [(0.95, False), (1.05, True)])
def test_limit_of_upright_rolling(moments: tuple[float, float] | None, part: float, stable: bool):
    """It stays upright if ω² > m g R A/(C (C + m R²)); a disk, if ω² > g/(3 R).

    Of a small tilt (A + m R²) β̈ = (m g R − (C + m R²) C/A ω²) β where A ω₃ = −C ω β: it grows, or
    swings, at this rate.
    """
    A, C = moments or (m * R * R / 4, m * R * R / 2)
    limit = math.sqrt(m * G * R * A / (C * (C + m * R * R)))
    if moments is None:
        assert limit == pytest.approx(math.sqrt(G / (3 * R)), rel=1e-14)
    omega, tilt = part * limit, 1e-6
    start = {"beta0": tilt, "w1": 0.0, "w2": omega, "w3": -C / A * omega * tilt}
    more = {"A": A, "C": C} if moments else {}
    system = example("tilting_ring" if moments else "tilting_disk", **start, **more)
    times = np.linspace(0.0, 4.0, 41)
    beta = follow(system, times).y[:, 3]
    stiff = ((C + m * R * R) * C / A * omega**2 - m * G * R) / (A + m * R * R)
    rate = math.sqrt(abs(stiff))
    known = tilt * (np.cos(rate * times) if stable else np.cosh(rate * times))
    assert (stiff > 0) == stable
    left_out = 10 * np.abs(known).max() ** 3  # of the third order: sin, tan and cos of a tilt
    np.testing.assert_allclose(beta, known, rtol=0.0, atol=left_out + 1e-9 * tilt)


def test_steady_circle():
    """The floor carries m g and turns the centre: side force m r Ω², nothing along the track."""
    system = variant("steady circle")
    mode, (_, q, v) = system.modes["moving"], system.start()
    beta, turn = math.radians(20), -1.2 / math.cos(math.radians(20))
    roll = v[3] - v[4] * math.tan(beta)
    centre = R * roll / turn + R * math.sin(beta)  # of a circle to the right, seen from its left
    forces = mode.reactions(0.0, q, v)
    assert forces["touch.normal"] == pytest.approx(m * G, rel=1e-14)
    assert forces["touch.fx"] == pytest.approx(0.0, abs=1e-14 * m * G)
    assert forces["touch.fy"] == pytest.approx(m * centre * turn**2, rel=1e-13)
    assert centre < 0.0
    assert forces["touch.fy"] < 0.0


def test_other_motions_have_no_closed_form():
    """Nor a circle whose ω₂ is off by 1e-12, to either side."""
    assert example("tilting_disk").closed_form(1.0) is None
    near = {"w1": 0.0, "w2": (1 + 1e-12) * steady(20.0, -1.2), "w3": -1.2}
    assert example("tilting_disk", **near, beta0=math.radians(20)).closed_form(1.0) is None


@pytest.mark.parametrize("degrees", [*range(5, 86, 5)])
def test_every_steady_circle_has_one(degrees: int):
    """Whatever its tilt: the moments cancel but for rounding, which is of their size."""
    for turn in (-0.3, -1.2, 2.7, 19.0):
        spin = {"w1": 0.0, "w2": steady(degrees, turn), "w3": turn}
        known = example("tilting_disk", **spin, beta0=math.radians(degrees)).closed_form(1.0)
        assert known is not None, turn


@pytest.mark.mutant("moments of a steady circle that cancel exactly, or not at all")
def test_a_circle_that_rounding_takes_away_is_seen(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(tilting_ring, "STEADY", 0.0)
    lost = 0
    for degrees in range(5, 86, 5):
        try:
            test_every_steady_circle_has_one(degrees)
        except AssertionError:
            lost += 1
    assert lost > 3


def changed(**terms: float) -> Any:
    """Accelerations with some terms of (2.33) taken `terms` times."""

    def accelerations(self: TiltingRing, t: float, q: Array, v: Array) -> Array:
        a = TiltingRing.accelerations(self, t, q, v)
        _, _, w1, w2, w3 = v
        square, tan = self.m * self.R**2, math.tan(q[3])
        a[2] += (terms.get("gyro", 1.0) - 1) * self.C * w2 * w3 / (self.A + square)
        a[2] -= (terms.get("turning", 1.0) - 1) * self.A * w3 * w3 * tan / (self.A + square)
        a[4] += (terms.get("axes", 1.0) - 1) * w3 * tan * w1
        return a

    told = [f"the {name} term of (2.33) taken {times:g} times" for name, times in terms.items()]
    accelerations.__doc__ = ", ".join(told)
    return accelerations


def centre_slips_not(self: TiltingRing, t: Any, q: Any) -> Any:
    """The centre's speed in place of the touching point's: ẋ_c = R φ̇ cos θ."""
    rows = np.array(TiltingRing.f_a(self, t, q))
    rows[0, 4] += self.R * np.sin(q[3]) * np.cos(q[2]) / np.cos(q[3])
    return rows


@pytest.mark.mutant("tilting ring: {mistake}")
@pytest.mark.parametrize(
    ("mistake", "law"),
    [
        ({"accelerations": changed(gyro=0.0)}, laws.lagrangian("tilting_ring")),
        ({"accelerations": changed(gyro=0.0)}, laws.free_bodies),
        ({"accelerations": changed(gyro=-1.0)}, laws.energy),
        ({"accelerations": changed(turning=0.0)}, laws.lagrangian("tilting_ring")),
        ({"accelerations": changed(turning=0.0)}, laws.energy),
        ({"accelerations": changed(axes=0.0)}, laws.free_bodies),
        ({"f_a": centre_slips_not}, laws.rolling),
    ],
)
def test_a_planted_mistake_in_the_tilting_disk_is_seen(mistake: dict[str, Any], law: laws.Law):
    sound = only("tilting_ring")
    assert not laws.broken(law(sound, states_tilting("tilting_ring", 10)))
    assert laws.broken(law(mutant(sound, **mistake), states_tilting("tilting_ring", 10)))


# The sleigh whose blade is driven: its path by quadrature, and where that is given up.

SHIPPED = {"m": 1.7, "J": 0.09, "a": 0.35, "w0": 1.5, "A": 0.8, "Omega": 2.0, "alpha": 0.9}


def angle(system: DrivenEdge, t: float) -> float:
    """θ by 30 digits."""
    kappa = mpf(system.m) * system.a / (mpf(system.J) + mpf(system.m) * mpf(system.a) ** 2)
    reach = kappa * system.A / system.Omega
    with mp.workdps(30):
        law = lambda s: exp(-reach * (cos(system.alpha) - cos(system.Omega * s + system.alpha)))  # noqa: E731
        turned: Any = quad(law, [t * k / 16 for k in range(17)])
        return float(system.w0 * turned)


@pytest.mark.parametrize("A", [0.8, -0.4, 2.4, 4.0])
def test_its_angle_is_exact_however_strongly_it_is_driven(A: float) -> None:
    system = DrivenEdge(**{**SHIPPED, "A": A})
    known = system.closed_form(5.0)
    assert known is not None
    assert known[0][2] == pytest.approx(angle(system, 5.0), rel=1e-14)


@pytest.mark.parametrize("changed", [{"A": 40.0}, {"A": -8.0}, {"Omega": 300.0}, {"w0": 900.0}])
def test_what_takes_minutes_has_none(changed: dict[str, float]) -> None:
    """Then the two marches answer for each other, as where nobody knows a function."""
    assert DrivenEdge(**{**SHIPPED, **changed}).closed_form(5.0) is None
