"""Mistakes planted in the second reading, or in what it is given, are seen by the comparison."""

from typing import Any

import numpy as np
import pytest

from second import answer, both, equations, forces, model, rates
from second.test_shipped import at_samples, disagree


def changed(told: Any, path: tuple[str, ...], by: Any) -> Any:
    """A case with one number put differently."""
    if not path:
        return by(told)
    return told | {path[0]: changed(told[path[0]], path[1:], by)}


def seen(name: str, case: dict[str, Any] | None = None) -> bool:
    """Whether the comparison sees that something is wrong."""
    mine = case or both.reread(name)
    return disagree(answer.motion(mine), both.stored(name), at_samples(mine)) != {}


INPUT: dict[str, tuple[str, tuple[str, ...], Any]] = {
    "deg taken as rad": (
        "torsion_pendulum.free", ("initial", "disk", "angle"), lambda x: np.degrees(x)
    ),
    "a phase dropped": (
        "shaken_pendulum", ("scene", "points", "O", "moves", "sine", "phase"), lambda x: 0.0
    ),
    "a driven rate off by 1e-6": (
        "driven_knee.spring",
        ("scene", "drive", "knee.omega", "sine", "amplitude"),
        lambda x: x * (1 + 1e-6),
    ),
    "a friction coefficient 1 % off": (
        "sliding_disk.uphill", ("scene", "contacts", "touch", "friction"), lambda x: 1.01 * x
    ),
    "a restitution 1e-6 off": (
        "stopped_pendulum.thrown_back",
        ("scene", "forces", "stop", "restitution"),
        lambda x: x + 1e-6,
    ),
    "ends of a joint exchanged": (
        "crossed_pendulum", ("scene", "joints", "elbow"), lambda j: {**j, "hinge": j["hinge"][::-1]}
    ),
    "turns of an attitude in the other order": (
        "torque_free.about_axis_3", ("initial", "body", "attitude"), lambda turns: turns[::-1]
    ),
    "forward and backward exchanged": (
        "anisotropic_drift",
        ("scene", "joints", "guide", "dry_friction", "kinetic"),
        lambda k: {"forward": k["backward"], "backward": k["forward"]},
    ),
    "stiction left out": (
        "friction_of_rest", ("scene", "contacts", "touch", "friction"), lambda f: f["kinetic"]
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("{mistake}, read a second time")
@pytest.mark.parametrize("mistake", INPUT)
def test_a_file_that_is_misread_is_seen(mistake: str) -> None:
    name, path, by = INPUT[mistake]
    assert seen(name, changed(both.reread(name), path, by))


def weighed(now: Any) -> Any:
    """All that acts, without the gyroscopic moment."""
    Q = equations_applied(now)
    for name, b in now.model.bodies.items():
        pose = now.poses[name]
        Q[b.columns[1]] += np.cross(pose.w, pose.R @ b.inertia @ pose.R.T @ pose.w)
    return Q


equations_applied = equations.applied
gravity_of = model.gravity
stretched_of = forces.stretched


def pushed(told: Any, kind: str, l: Any) -> forces.Effect:
    """A spring with the other sign."""
    effect = stretched_of(told, kind, l)
    return effect._replace(on=[(thing, -f) for thing, f in effect.on])


PHYSICS: dict[str, tuple[str, Any, str, Any]] = {
    "gravity upward": ("bar_pendulum", model, "gravity", lambda *a: -gravity_of(*a)),
    "g = 9.81 m/s²": (
        "falling_too_far", model, "gravity", lambda *a: gravity_of(*a) * 9.81 / 9.80665
    ),
    "a spring that pushes where it should pull": (
        "elastic_pendulum.swings", forces, "stretched", pushed
    ),
    "the gyroscopic moment left out": (
        "torque_free.about_axis_3", equations, "applied", weighed
    ),
    "rates given by a file passed over": ("free_pair", rates, "given", lambda *a: None),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("{mistake}, in the second reading")
@pytest.mark.parametrize("mistake", PHYSICS)
def test_wrong_physics_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name, where, what, by = PHYSICS[mistake]
    assert not seen(name)
    monkeypatch.setattr(where, what, by)
    assert seen(name)


@pytest.mark.slow
@pytest.mark.mutant("Steiner term left out of the second reading's bar")
def test_an_inertia_about_the_wrong_point_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A bar about its end has m l²/3; with m l²/12 there the pendulum swings at another rate."""
    case = both.reread("bar_pendulum")
    m, l = (case["scene"]["bodies"]["bar"]["bar"][key] for key in ("mass", "length"))

    def misplaced(now: Any) -> Any:
        M = mass_of(now)
        M[2, 2] -= m * l * l / 4
        return M

    mass_of = equations.mass
    monkeypatch.setattr(equations, "mass", misplaced)
    assert seen("bar_pendulum")
