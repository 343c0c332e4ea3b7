"""The sprung gimbal: second derivations, its closed form, and planted mistakes."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given import free_cut
from given.gimbals import GIMBAL, VARIANTS, gimbal, states
from given.laws import LIMIT, difference
from given.mutants import mutant

from textmech.reference.formalisms import energy, lagrange
from textmech.reference.motion.follow import follow
from textmech.reference.system import Mode, Only


def equations(mode: Mode) -> float:
    """(2.44) of T, U, D and Q₄."""
    return max(
        difference(mode.accelerations(t, q, v), lagrange.accelerations(mode, t, q, v))
        for t, q, v in states()
    )


def power(mode: Mode) -> float:
    """(2.51) relative to what the motor, the springs and the dampers could do."""
    return max(abs(energy.power_balance(mode, t, q, v)) for t, q, v in states()) / 30.0


def balance(mode: Mode) -> float:
    """(2.23), (2.27) with all that the gimbal exerts: springs, dampers and motor, too."""
    worst = 0.0
    for t, q, v in states():
        held = mode.reactions(t, q, v)
        force, moment = (free_cut.force(held, "gimbal", f"{x}x {x}y {x}z") for x in "fm")
        weight = np.array([0.0, 0.0, -GIMBAL["m"] * 9.80665])
        wrenches: list[free_cut.Wrench] = [("globe", np.zeros(3), weight + force, moment)]
        changed = free_cut.change(mode, t, q, v, mode.accelerations(t, q, v))
        worst = max(worst, difference(changed, free_cut.total(mode, t, q, v, wrenches)))
    return worst


def cut_free(mode: Mode) -> float:
    """Its loads and cuts balance, and have the moment that it states: torques and a couple."""
    worst = 0.0
    for t, q, v in states():
        left, found = free_cut.solved(mode, t, q, v, mode.accelerations(t, q, v))
        held = mode.reactions(t, q, v)
        ((across,), (load,)) = mode.cuts(t, q)[0].moments, mode.loads(t, q, v)
        moment = np.asarray(load.moment) + found["gimbal.couple"] * np.array(across)
        own = free_cut.force(held, "gimbal", "mx my mz")
        worst = max(
            worst, left, difference(moment, own), abs(found["gimbal.fz"] - held["gimbal.fz"])
        )
    return worst


def moves(mode: Mode) -> float:
    """`poses` moves as it says, and has the energy T."""
    return free_cut.moves(mode, states())


def apart(mode: Mode) -> float:
    """Followed motion against the closed form, relative to the largest angle and rate."""
    times = np.linspace(0.0, 2.0, 21)
    y = follow(Only(mode), times).y
    known = np.array([np.concatenate(mode.closed_form(t) or ()) for t in times.tolist()])
    return max(difference(y[:, :2], known[:, :2]), difference(y[:, 2:], known[:, 2:]))


def start(mode: Mode) -> float:
    """How far the start is from the typed one: two turns, and ω in body axes."""
    q, v = mode.start()
    pose = mode.poses(0.0, q, v)["globe"]
    c20, s20, c15, s15 = (f(math.radians(a)) for a in (20, 15) for f in (math.cos, math.sin))
    attitude = [c20 * c15 + 0.8 * s20 * s15, -0.6 * c20 * s15, -0.6 * s20 * s15,
                s20 * c15 - 0.8 * c20 * s15]  # fmt: skip
    spin = np.array(pose[10:]) @ [0.6, 0.0, 0.8]  # along n₂: κ θ̇ + φ̇
    typed = [*np.radians([40, -30]), 0.7, -1.0, *attitude, 0.8 * 0.7 - 1.0]
    return float(np.max(np.abs(np.array([*q, *v, *pose[3:7], spin]) - typed)))


LAWS: list[Callable[[Any], float]] = [equations, power, balance, cut_free, moves, apart, start]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_gimbal_obeys(law: Callable[[Mode], float]) -> None:
    assert law(gimbal()) < LIMIT


@pytest.mark.slow
@pytest.mark.parametrize("name", VARIANTS)
def test_motion_is_the_closed_form(name: str) -> None:
    assert apart(gimbal(**VARIANTS[name])) < LIMIT


def sound(mode: Any, name: str) -> Callable[..., Any]:
    """A method as it is without the mistake."""
    return getattr(super(type(mode), mode), name)


def of_crossed_axes(self: Any, t: float, q: Any, v: Any) -> Any:
    """As if κ were zero."""
    one, two = self._torques(t, q, v)
    return np.array([one / self.J, two / self.J])


def without_turning(self: Any, t: float, q: Any, v: Any) -> Any:
    """Without θ̇ φ̇ n₁ × n₂."""
    held, n2 = sound(self, "reactions")(t, q, v), self._second(q)
    lost = self.J * v[0] * v[1]
    return held | {
        "gimbal.mx": held["gimbal.mx"] + lost * n2[1],
        "gimbal.my": held["gimbal.my"] - lost * n2[0],
    }


def backward(self: Any, t: Any, q: Any, v: Any) -> Any:
    """φ about −n₂."""
    turned = np.array([1.0, -1.0])
    return sound(self, "poses")(t, q * turned, v * turned)


def in_ground_axes(self: Any, t: Any, q: Any, v: Any) -> Any:
    pose = sound(self, "poses")(t, q, v)["globe"]
    return {"globe": (*pose[:10], *(free_cut.matrix(pose) @ np.array(pose[10:])))}


def each_about_its_axis(self: Any, t: float, q: Any, v: Any) -> Any:
    """Loads as if M₁ n₁ + M₂ n₂ did not turn the other axis too."""
    (load,), (one, two) = sound(self, "loads")(t, q, v), self._torques(t, q, v)
    n2 = self._second(q)
    return [
        type(load)(load.body, load.at, load.force, (two * n2[0], two * n2[1], one + two * n2[2]))
    ]


MISTAKES: dict[str, tuple[dict[str, Any], Callable[[Mode], float]]] = {
    "coupling lost": ({"accelerations": of_crossed_axes}, equations),
    "coupling lost, as a motion": ({"accelerations": of_crossed_axes}, apart),
    "coupling lost, as power": ({"accelerations": of_crossed_axes}, power),
    "turning axis lost": ({"reactions": without_turning}, balance),
    "φ counted backward": ({"poses": backward}, moves),
    "ω in ground axes": ({"poses": in_ground_axes}, moves),
    "torques along the axes": ({"loads": each_about_its_axis}, cut_free),
    "spring pushes": ({"U": lambda self, t, q: -type(gimbal()).U(self, t, q)}, equations),
    "damper drives": ({"D": lambda self, t, q, v: -type(gimbal()).D(self, t, q, v)}, equations),
    "motor on the wrong axis": (
        {"Q4": lambda self, t, q, v: type(gimbal()).Q4(self, t, q, v)[::-1]},
        equations,
    ),
}


@pytest.mark.mutant("sprung gimbal: {mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_is_seen(mistake: str) -> None:
    methods, law = MISTAKES[mistake]
    assert law(mutant(gimbal(), **methods)) > 1e3 * LIMIT


@pytest.mark.mutant("sprung gimbal: J of a hollow globe everywhere")
def test_a_moment_of_inertia_that_is_wrong_everywhere_is_seen() -> None:
    """The laws agree on any; the closed form knows that of a homogeneous globe."""
    wrong: Any = {"J": property(lambda self: 2 * self.m * self.R**2 / 3)}
    hollow = mutant(gimbal(), **wrong)
    assert max(law(hollow) for law in LAWS if law is not apart) < LIMIT
    assert apart(hollow) > 1e-2


@pytest.mark.mutant("sprung gimbal: {parameter} 5 % off")
@pytest.mark.parametrize("parameter", GIMBAL)
def test_each_parameter_is_in_the_motion(parameter: str) -> None:
    """5 % off in the explicit accelerations or at the start."""
    off: Any = gimbal(**{parameter: 1.05 * GIMBAL[parameter]})
    planted = mutant(gimbal(), accelerations=lambda self, t, q, v: off.accelerations(t, q, v))
    assert max(equations(planted), start(off)) > 1e-4
