"""The wheel seen from above draws the path of the wheel in space; and planted mistakes."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws import LIMIT, difference
from given.mutants import mutant
from given.wheels import FROM_ABOVE, PARAMETERS, WHEEL, wheel

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


def states() -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v; the heading stays away from ± 90°, where ẏ/ẋ ends."""
    random = np.random.default_rng(4)
    for _ in range(20):
        theta = random.uniform(-1.3, 1.3) + random.choice([0.0, math.pi])
        q = np.array([*random.uniform(-3, 3, 2), theta])
        yield random.uniform(0, 5), q, random.uniform(-5, 5, 2)


def formalisms(mode: Mode) -> float:
    """(2.44) by Hamel's form, (2.66), (2.67) and (2.80)."""
    worst = 0.0
    for t, q, v in states():
        a = mode.accelerations(t, q, v)
        for form in (lagrange, voronets, chaplygin, appell):
            found = form.accelerations(mode, t, q, v)
            assert found is not None
            worst = max(worst, difference(a, found, 1.0))
    return worst


def free_cut(mode: Mode) -> float:
    """(2.23), (2.27) and the reaction that they give."""
    worst = 0.0
    for t, q, v in states():
        found = newton_euler.balance(mode, t, q, v, mode.accelerations(t, q, v))
        own = mode.reactions(t, q, v)["edge.force"]
        worst = max(worst, found.share(), difference(found.reactions["edge.force"], own))
    return worst


def power(mode: Mode) -> float:
    """(2.51) over M g and a speed of 1 m/s."""
    weight = GIVEN["M"] * GIVEN["gravity"]
    return max(abs(energy.power_balance(mode, *at)) for at in states()) / weight / 5.0


def apart(mode: Mode) -> float:
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


LAWS: list[Callable[[Mode], float]] = [formalisms, free_cut, power, apart, of_the_wheel]


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
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


MISTAKES: dict[str, tuple[dict[str, Any], Callable[[Mode], float]]] = {
    "mass of a disk that glides": (off(M=1.3), free_cut),
    "gravity of one that glides": (off(gravity=9.80665), of_the_wheel),
    "gravity of one that glides, by the formalisms": (off(gravity=9.80665), formalisms),
    "gravity of one that glides, as power": (off(gravity=9.80665), power),
    "gravity of one that glides, as a motion": (off(gravity=9.80665), apart),
    "another slope": (off(alpha=0.2), free_cut),
    "rolls along its axle": ({"rates": across}, of_the_wheel),
}


@pytest.mark.slow
@pytest.mark.mutant("wheel from above: {mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_is_seen(mistake: str) -> None:
    methods, law = MISTAKES[mistake]
    assert law(mutant(above(), **methods)) > 1e3 * LIMIT


@pytest.mark.slow
@pytest.mark.mutant("wheel from above: mass and gravity of a disk that glides, everywhere")
def test_nothing_turns_it() -> None:
    """J drops out; with the mass of the disk alone the path would be another one everywhere."""
    for t, q, v in states():
        np.testing.assert_array_equal(
            above(J=1.0).accelerations(t, q, v), above().accelerations(t, q, v)
        )
    gliding = above(M=1.3, gravity=9.80665)
    assert max(law(gliding) for law in LAWS if law is not of_the_wheel) < LIMIT
    assert of_the_wheel(gliding) > 0.1
