"""Every shipped case moves the same, read a second time; and a planted mistake is seen."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from second import answer, both, equations, forces, model, read, start, switching
from second.motion import Motion
from textmech.reference.solve import solve

# Every shipped case that is smooth moves the same, read a second time.

BAR = 1e-7  # of the size of the motion: both integrate to some 1e-10 of it, forces to 1e-9
SWITCHES = {
    "anisotropic_drift", "ball_on_rope", "bearing", "bouncing_disk", "compass_walker", "cradle",
    "disk_on_disk", "dynamometer", "dynamometer_smooth", "friction_cone", "friction_of_rest",
    "growing_force", "growing_force_smooth", "rimless_wheel", "rolling_into_wall",
    "simplest_walker", "sliding_block", "sliding_disk", "sliding_ladder", "stacked_blocks",
    "stopped_pendulum", "stribeck_brake", "stribeck_drive", "tipping_block", "bouncing_ball",
    "break_away", "creeping_block", "friction_at_rest", "heavy_on_light", "held_joint", "landing",
    "rolling_down", "sinking_ball", "running_gait", "running_step", "spring_mass_jump",
    "trunk_on_legs",
}  # fmt: skip
"""Files whose motion is not smooth: `SWITCHING` below has them."""
PILES = {"brick_wall", "disks_in_a_bin", "ladder_between_stacks", "standing_stack"}
"""Files that are not read a second time: it tries each way of each contact, 3²⁰ of a wall. What the
first reading says of such piles is held against forces by hand in `test_possible_ways.py`."""
SHORT = {
    "charge_in_field", "elastic_pendulum", "falling_drag", "falling_too_far",
    "growing_force_viscous", "pushed_cart", "rolling_sphere", "rolling_wheel", "shaken_pendulum",
    "spinning_body", "torque_free", "turning_sled", "wheel_from_above",
}  # fmt: skip
"""Files that take a fifth of a second a case: the others are slow tests."""
SMOOTH = [
    name
    for name, case in both.EVERY.items()
    if case.states is None
    and name.split(".")[0] not in SWITCHES | PILES
    and name != "drag_stops.root"
]


def disagree(motion: Motion, told: both.Answer, wanted: list[str]) -> dict[str, float]:
    """The quantities that lie further apart than the bar, and by how much of the motion.

    A work is summed up by the reference over its samples, and no better than it says.
    """
    found = {}
    for name in wanted:
        known, seen = both.answered(told, name), answer.observed(motion, name)
        parts = both.parts(motion, name, known, seen)
        stated = both.stated(told, name) if name.endswith(".work") else 0.0
        if not parts < BAR + stated / both.size(motion, name, known):
            found[name] = parts
    return found


def at_samples(case: dict[str, Any]) -> list[str]:
    """The quantities that a case asks over its samples, and not at events."""
    return [name for name in case["allow"] if name.split(".")[0] not in (case.get("events") or {})]


def unhurried(names: list[str], short: set[str]) -> list[Any]:
    """The names, all but those of short files as slow tests."""
    return [
        n if n.split(".")[0] in short else pytest.param(n, marks=pytest.mark.slow) for n in names
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", unhurried(SMOOTH, SHORT))
def test_a_smooth_case_moves_the_same(name: str) -> None:
    case = both.reread(name)
    assert disagree(answer.motion(case), both.stored(name), at_samples(case)) == {}


# Every shipped case that switches moves the same, read a second time, with all its events.

EARLY = 1e-7  # of the duration: by so much may the time of an event differ
ROUND = 1e-5  # of the duration, where a speed ends as (T − t)²: it is 1e-10 m/s so much earlier
FLAT = {"drag_stops.root.stops"}
EVENT_BAR = 1e-6  # of the largest: what is read where time is known to 1e-7 of the duration
NEAR = 1e-3  # of the motion: the band of the smooth law is 5e-4 m/s beside speeds of 2 m/s
SMOOTHED = {"dynamometer_smooth", "growing_force_smooth"}  # `test_words.py` says why
TOO_SHORT = {
    "ball_on_rope", "bouncing_ball", "creeping_block", "held_joint", "landing", "rolling_down",
    "running_step", "sinking_ball", "sliding_block", "spring_mass_jump", "stopped_pendulum",
    "stribeck_brake",
}  # fmt: skip
"""Files that take a fifth of a second a case."""
EVENTFUL = [name for name, case in both.EVERY.items() if case.events]
SWITCHING = [
    name
    for name, case in both.EVERY.items()
    if case.states is None and name not in SMOOTH and name.split(".")[0] not in SMOOTHED | PILES
]


def unlike(motion: Motion, name: str) -> dict[str, object]:
    """The events that happen at other times, or where something else is read."""
    case, told = both.reread(name), both.stored(name)
    found: dict[str, object] = {}
    mine = {event: answer.times(motion, says) for event, says in case["events"].items()}
    for event, times in mine.items():
        known = both.happened(told, event)
        bar = (ROUND if f"{name}.{event}" in FLAT else EARLY) * case["duration"]
        if len(known) != len(times) or not np.allclose(known, times, rtol=0, atol=bar):
            found[event] = (known, times)
    for asked in case["allow"]:
        event, _, rest = asked.partition(".")
        if event not in mine or rest in ("time", "count"):
            continue
        quantity, _, side = rest.rpartition(".")
        if side not in ("before", "after"):
            quantity, side = rest, ""
        known = both.beside(told, asked)
        seen = [answer.beside(motion, quantity, t, side) for t in mine[event]]
        if not np.allclose(known, seen, rtol=0, atol=EVENT_BAR * max(1.0, *np.abs(known))):
            found[asked] = (known, seen)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", unhurried(SWITCHING, TOO_SHORT))
def test_a_case_that_switches_moves_the_same(name: str) -> None:
    case = both.reread(name)
    motion = answer.motion(case)
    assert disagree(motion, both.stored(name), at_samples(case)) == {}
    if case.get("events"):
        assert unlike(motion, name) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in EVENTFUL if name in SMOOTH])
def test_events_of_a_smooth_case_happen_at_the_same_times(name: str) -> None:
    assert unlike(answer.motion(both.reread(name)), name) == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(SMOOTHED))
def test_the_smooth_law_moves_as_the_exact_one(name: str) -> None:
    """The second reading takes it as if `smooth` were not said, which is what the law is for."""
    motion, told = answer.motion(both.reread(name)), both.stored(name)
    for quantity in both.reread(name)["allow"]:
        known, seen = both.answered(told, quantity), answer.observed(motion, quantity)
        assert both.parts(motion, quantity, known, seen) < NEAR


# Where a law jumps the second reading chooses anew what sticks, and reads the sample behind it.

M, MU, PUSH, AT, G = 2.0, 0.5, 15.0, 0.5, 9.80665
SCENE = f"""\
scene:
  bodies: {{block: {{particle: {{mass: {M}}}}}}}
  contacts: {{touch: {{between: [block, ground.floor], friction: {MU}}}}}
  forces: {{shove: {{push: block.center, step: {{amplitude: [{PUSH}, 0.0], at: {AT}}}}}}}
initial: {{block: {{x: 0, y: 0}}}}
allow: {{block.x: 1.0e-3, block.vx: 1.0e-3, touch.tangent: 1.0e-2}}
"""
RATE = PUSH / M - MU * G  # m/s², from the corner on


def off(tmp_path: Path) -> float:
    """How far a block is, in m, m/s and N, from where it must be: it lies until it is pushed."""
    case = scenes.typed(tmp_path, SCENE, tail=scenes.tail(1.0, 11))
    (told,) = read.file(tmp_path / "typed.yaml").values()
    motion = answer.motion(told)
    since = np.maximum(0.0, case.times - AT)
    pushed = case.times >= AT  # on the corner too
    known = {
        "block.x": RATE * since**2 / 2,
        "block.vx": RATE * since,
        "touch.tangent": np.where(pushed, -MU * M * G, 0.0),
    }
    return max(
        float(np.max(np.abs(answer.observed(motion, name) - values)))
        for name, values in known.items()
    )


@pytest.mark.slow
def test_what_sticks_is_chosen_anew_where_a_law_jumps(tmp_path: Path) -> None:
    """The force is twice what friction holds from the corner on, which is a sample."""
    assert off(tmp_path) < 1e-9


@pytest.mark.slow
@pytest.mark.mutant("the second reading keeps its mode where a law jumps")
def test_a_mode_that_outlives_a_jump_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No guard falls there: from the jump on friction is above its bound, and no fall is met."""
    sound = switching.next_mode

    def kept(now, mode, site, what):  # type: ignore[no-untyped-def]
        return mode if what == "" and site is None else sound(now, mode, site, what)

    monkeypatch.setattr(switching, "next_mode", kept)
    assert off(tmp_path) > 1e-3


FALLS = """\
scene:
  bodies: {bob: {particle: {mass: 0.25}}}
  contacts: {c: {between: [bob, ground.floor], friction: {static: 0.59, kinetic: 0.34}}}
initial: {bob: {x: 0, y: 0.45, vx: -1.1}}
events: {lands: {c.gap: falls to zero}}
allow: {bob.x: 1.0e-3}
"""


@pytest.mark.slow
def test_a_blow_rubs_by_the_kinetic_coefficient_in_both_readings(tmp_path: Path) -> None:
    """It arrives with v = √(2 g 0.45 m) and keeps 1.1 − 0.34 v, which 0.59 v would stop."""
    case = scenes.typed(tmp_path, FALLS, tail=scenes.tail(0.6, 7))
    v = (2 * G * 0.45) ** 0.5
    left = 1.1 - 0.34 * v
    assert left > 0 > 1.1 - 0.59 * v
    known = -1.1 * v / G - left**2 / (2 * 0.34 * G)
    (told,) = read.file(tmp_path / "typed.yaml").values()
    motion = solve(case)
    assert motion.holds
    assert motion.trajectory.states["bob"][-1, 0] == pytest.approx(known, abs=1e-12)
    assert answer.observed(answer.motion(told), "bob.x")[-1] == pytest.approx(known, abs=1e-7)


# Mistakes planted in the second reading, or in what it is given, are seen by the comparison.


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
    "rates given by a file passed over": ("free_pair", start, "given", lambda *a: None),
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
