"""The upright wheel, free and driven: second derivations, closed forms, and planted mistakes."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import free_cut
from given.laws import LIMIT, difference
from given.mutants import mutant
from given.wheels import CIRCLE, CLOSED, PARAMETERS, WEAVE, WHEEL, states, wheel
from scipy.special import j0

from textmech.reference.formalisms import energy, lagrange
from textmech.reference.motion.follow import follow
from textmech.reference.system import Mode, Only

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


def balance(mode: Any) -> float:
    """(2.23), (2.27) of the wheel cut free from the floor and from what holds it upright."""
    worst, down = 0.0, np.array([math.sin(mode.alpha), 0.0, -math.cos(mode.alpha)])
    for t, q, v in states(mode):
        held, centre = mode.reactions(t, q, v), np.array(mode.poses(t, q, v)["wheel"][:3])
        floor = free_cut.force(held, "touch", "fx fy normal")
        wrenches: list[free_cut.Wrench] = [
            ("wheel", centre, mode.m * G * down, np.zeros(3)),
            ("wheel", centre - [0.0, 0.0, WHEEL["R"]], floor, np.zeros(3)),
            ("wheel", centre, np.zeros(3), free_cut.force(held, "upright", "mx my mz")),
        ]
        changed = free_cut.change(mode, t, q, v, mode.accelerations(t, q, v))
        forces = free_cut.total(mode, t, q, v, wrenches)
        size = max(abs(floor).max(), mode.m * G)  # of what cancels in a row
        worst = max(worst, float(abs(changed - forces).max()) / size)
    return worst


def cut_free(mode: Any) -> float:
    """Its own loads and cuts balance, and give the reactions that it states."""
    worst = 0.0
    for t, q, v in states(mode):
        left, found = free_cut.solved(mode, t, q, v, mode.accelerations(t, q, v))
        held = mode.reactions(t, q, v)
        couple = held["upright.mx"] * math.cos(q[2]) + held["upright.my"] * math.sin(q[2])
        known = {**held, "upright.couple": couple}
        apart = difference([found[name] for name in found], [known[name] for name in found])
        worst = max(worst, left, apart)
    return worst


def moves(mode: Mode) -> float:
    """`poses` moves as it says, and has the energy T."""
    return free_cut.moves(mode, states(mode))


def slips(mode: Any) -> float:
    """(2.19) v_c + ω × (−R e_z), the velocity of the rim's point, and f_a q̇ = g [m/s]."""
    worst = 0.0
    for t, q, v in states(mode):
        pose = mode.poses(t, q, v)["wheel"]
        omega = free_cut.matrix(pose) @ np.array(pose[10:])
        rim = np.array(pose[7:10]) + np.cross(omega, [0.0, 0.0, -WHEEL["R"]])
        worst = max(worst, abs(rim).max(), abs(mode.f_a(t, q) @ v - mode.g(t, q)).max())
    return worst / 5.0  # rad/s of the states, beside lengths of one


def power(mode: Mode) -> float:
    """(2.51) over the power of the weight."""
    found = [abs(energy.power_balance(mode, t, q, v)) / abs(v).max() for t, q, v in states(mode)]
    return max(found) / (WHEEL["m"] * G)


LAWS = [equations, balance, cut_free, moves, slips, power]


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


def transposed(self: Any, t: Any, q: Any, v: Any) -> Any:
    """E as ground axes in body axes: the conjugate quaternion."""
    pose = type(self).__mro__[1].poses(self, t, q, v)["wheel"]
    return {"wheel": (*pose[:4], *(-x for x in pose[4:7]), *pose[7:])}


def in_ground_axes(self: Any, t: Any, q: Any, v: Any) -> Any:
    pose = type(self).__mro__[1].poses(self, t, q, v)["wheel"]
    return {"wheel": (*pose[:10], -v[3] * np.sin(q[2]), v[3] * np.cos(q[2]), v[2])}


def backward(self: Any, t: Any, q: Any, v: Any) -> Any:
    """φ about −y: the wheel's forward sense in the plane, clockwise."""
    turned = np.array([1.0, 1.0, 1.0, -1.0])
    return type(self).__mro__[1].poses(self, t, q * turned, v * turned)


def gyroscopic(self: Any, t: float, q: Any, v: Any) -> dict[str, float]:
    """Without J₂₂ φ̇ θ̇ in the couple."""
    lost = self.axle() * v[3] * v[2]
    held = type(self).__mro__[1].reactions(self, t, q, v)
    mx, my = lost * math.cos(q[2]), lost * math.sin(q[2])
    return held | {"upright.mx": held["upright.mx"] + mx, "upright.my": held["upright.my"] + my}


def centre(self: Any, t: Any, q: Any) -> Any:
    """Slip of the centre for the rim's point: R φ̇ left out."""
    rows = np.array(type(self).__mro__[1].f_a(self, t, q))
    rows[:2, 3] = 0.0
    return rows


def too_fast(self: Any, *given: Any) -> Any:
    """5 % on the accelerations."""
    return 1.05 * type(self).__mro__[1].accelerations(self, *given)


def uphill(self: Any, t: Any, q: Any) -> Any:
    return self.m * G * q[0] * math.sin(self.alpha)


def at_the_centre(self: Any, t: float, q: Any) -> Any:
    floor, *others = type(self).__mro__[1].cuts(self, t, q)
    return [replace(floor, at=(*floor.at[:2], self.R)), *others]


MISTAKES = {
    "transposed E": ({"poses": transposed}, balance),
    "ω in ground axes": ({"poses": in_ground_axes}, moves),
    "floor's force at the centre": ({"cuts": at_the_centre}, cut_free),
    "φ counted backward": ({"poses": backward}, slips),
    "lost gyroscopic couple": ({"reactions": gyroscopic}, balance),
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
def test_a_planted_mistake_is_seen(name: str, mistake: str) -> None:
    methods, law = MISTAKES[mistake]
    assert law(mutant(wheel(name), **methods)) > 1e3 * LIMIT


@pytest.mark.mutant("upright_wheel: J of a ring everywhere")
def test_a_moment_of_inertia_that_is_wrong_everywhere_is_seen() -> None:
    """The laws agree on any; the closed form knows that of a thin disk."""
    ring = mutant(wheel("upright_wheel"), axle=lambda self: self.m * self.R**2)
    assert max(law(ring) for law in LAWS) < LIMIT
    assert apart(ring, np.linspace(0.0, 2.0, 5)) > 1e-3
