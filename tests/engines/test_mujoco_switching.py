"""MuJoCo where motion switches: contacts that slide, stick and bounce, and dry friction."""

import math
from dataclasses import replace

import numpy as np
import pytest
from planning import planned, refused, ways
from scipy.integrate import solve_ivp

from textmech.cases.observe import observe
from textmech.cases.scene import (
    Anchor,
    Body,
    Bounds,
    Contact,
    DryFriction,
    GroundPoint,
    Joint,
    Push,
    Scene,
    Signal,
    Smooth,
    Spring,
)
from textmech.cases.shape import bar, disk, particle
from textmech.cases.trajectory import OMEGA, VX, VY, Array, Trajectory, X, Y
from textmech.engines.engine import Realised, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.contact import damping_ratio

TUNED = MuJoCo("tuned")
G, H, R = 9.80665, 1e-4, 0.3
DRY = DryFriction(Bounds(6.0, 6.0), Bounds(3.0, 3.0))
REST = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def floor(body: Body, *contacts: Contact, slope: float = 0.0) -> Scene:
    gravity = (G * math.sin(slope), -G * math.cos(slope))
    return Scene(gravity, {}, {body.name: body}, {}, {c.name: c for c in contacts}, {})


def touching(body: str, mu: float, bounce: float = 0.0, point: str = "center") -> Contact:
    return Contact(f"{body}_{point}", Anchor(body, point), mu, mu, bounce)


def run(
    scene: Scene,
    start: tuple[float, ...],
    duration: float,
    *,
    step: float = H,
    realised: Realised = "native",
    reactions: tuple[str, ...] = (),
) -> Trajectory:
    (name,) = scene.bodies
    x, y, angle, vx, vy, omega = start
    begin = {name: (x, y, angle, vx, vy, omega)}
    return TUNED.run(
        scene,
        begin,
        np.linspace(0, duration, 21),
        step,
        planned(TUNED, scene, begin, realised),
        reactions=reactions,
        record=True,
    )


def every(motion: Trajectory, body: str) -> Array:
    assert motion.record is not None
    return motion.record.states[body]


WHEEL = disk(name="wheel", mass=1.3, radius=R, points={})
BLOCK = particle(name="block", mass=1.3)


@pytest.mark.parametrize("spin", [0.0, 20.0])
def test_disk_slides_then_rolls(spin: float) -> None:
    mu, v0 = 0.2, 2.0
    motion = run(floor(WHEEL, touching("wheel", mu)), (0, R, 0, v0, 0, spin), 3.0)
    rolls = (v0 + R * spin) / (3 * mu * G)  # the slip falls by 3 mu g
    t = np.minimum(motion.times, rolls)
    x = v0 * t - mu * G * t**2 / 2 + (v0 - mu * G * rolls) * (motion.times - t)
    assert abs(motion.states["wheel"][:, X] - x).max() <= 5e-6
    rows = every(motion, "wheel")
    assert abs(rows[-1, VX] + R * rows[-1, OMEGA]) <= 1e-5


@pytest.mark.parametrize(("slope", "v0"), [(15.0, -3.0), (0.0, 3.0), (15.0, 0.0)])
def test_block_stops_and_does_not_creep(slope: float, v0: float) -> None:
    mu, beta = 0.4, math.radians(slope)
    motion = run(floor(BLOCK, touching("block", mu), slope=beta), (0, 0, 0, v0, 0, 0), 1.6)
    braking = G * (math.sin(beta) - np.sign(v0) * mu * math.cos(beta))
    t = np.minimum(motion.times, -v0 / braking if v0 else 0.0)
    assert abs(motion.states["block"][:, X] - (v0 * t + braking * t**2 / 2)).max() <= 1e-6
    assert abs(every(motion, "block")[-1, VX]) <= 1e-12


def test_noslip_needs_the_way_out_of_the_plane(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = floor(BLOCK, touching("block", 0.4), slope=math.radians(15))
    still = abs(every(run(scene, REST, 0.2), "block")[-1, VX])
    monkeypatch.setattr("textmech.engines.mujoco.scene._leaves_plane", lambda scene, numbers: False)
    creeping = abs(every(run(scene, REST, 0.2), "block")[-1, VX])
    assert still <= 1e-15 < 1e-9 <= creeping


def test_bar_lies_on_both_ends() -> None:
    rod = bar(name="rod", mass=2.0, length=0.8, points={})
    ends = touching("rod", 0.3, point="start"), touching("rod", 0.3, point="end")
    normals = tuple(f"{end.name}.normal" for end in ends)
    motion = run(floor(rod, *ends), REST, 0.2, reactions=normals)
    for normal in normals:
        assert motion.reactions[normal][5:] == pytest.approx(G, rel=1e-5)


def test_bar_end_slides_away() -> None:
    rod, angle, arm, mu = bar(name="rod", mass=2.0, length=0.8, points={}), 1.0, 0.4, 0.1
    scene = floor(rod, touching("rod", mu, point="start"))
    motion = run(scene, (0, arm * math.sin(angle), angle, 0, 0, 0), 0.3)
    assert rod.inertia is not None

    def slope(t: float, y: Array) -> list[float]:
        _, turned, vx, omega = y  # the end slides backwards: friction points forward
        lever = -arm * math.cos(turned) + arm * math.sin(turned) * mu
        normal = rod.mass * (G - arm * math.sin(turned) * omega**2)
        normal /= 1 - rod.mass * arm * math.cos(turned) * lever / (rod.inertia or 1.0)
        return [vx, omega, mu * normal / rod.mass, lever * normal / (rod.inertia or 1.0)]

    wanted = solve_ivp(
        slope, (0, 0.3), [0, angle, 0, 0], rtol=1e-11, atol=1e-13, t_eval=motion.times
    )
    rows = motion.states["rod"]
    assert abs(rows[:, X] - wanted.y[0]).max() <= 1e-7
    assert abs(rows[:, 2] - wanted.y[1]).max() <= 5e-6


@pytest.mark.parametrize("bounce", [0.0, 0.1, 0.5, 1.0])
def test_disk_bounces(bounce: float) -> None:
    scene = floor(WHEEL, touching("wheel", 0.3, bounce))
    rows = every(run(scene, (0, R + 0.5, 0, 0, 0, 0), 0.4), "wheel")
    speed = math.sqrt(2 * G * 0.5)
    assert rows[:, VY].max() / speed == pytest.approx(bounce, abs=0.02)
    lowest = np.argmin(rows[:, Y])
    assert abs(lowest * H - speed / G) <= 10 * H


@pytest.mark.parametrize("bounce", [1.0, 0.9, 0.3, 0.14, 0.13, 0.02])
def test_damper_throws_back(bounce: float) -> None:
    ratio = damping_ratio(bounce)

    def leaves(t: float, y: Array) -> float:
        return y[0] + 2 * ratio * y[1] if t else 1.0

    leaves.terminal = True  # type: ignore[attr-defined]
    leaves.direction = -1  # type: ignore[attr-defined]
    solution = solve_ivp(
        lambda t, y: [y[1], -y[0] - 2 * ratio * y[1]],
        (0, 100), [0.0, 1.0], events=leaves, rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    assert -solution.y[1, -1] == pytest.approx(bounce, abs=1e-6)


def test_refuses_a_bounce_too_small() -> None:
    reason = refused(TUNED, floor(WHEEL, touching("wheel", 0.3, 0.01)))
    assert reason is not None
    assert reason.startswith("engine: ")


def pulled(dry: DryFriction) -> Scene:
    """Example 2.3."""
    guide = Joint(
        "guide", "slide", Anchor("ground", "O"), Anchor("block", "center"), dry_friction=dry
    )
    block = replace(BLOCK, mass=1.0)
    push = Push("pull", Anchor("block", "center"), Signal("ramp", (-1.0, 0.0)))
    points = {"O": GroundPoint((0.0, 0.0))}
    return Scene((0, 0), points, {"block": block}, {"guide": guide}, {}, {"pull": push})


def drawn(dry: DryFriction) -> Scene:
    """Example 2.4: the spring's end moves with 2 m/s, so that it pulls with −2 x + 4 t."""
    scene = pulled(dry)
    spring = Spring("scale", Anchor("block", "center"), Anchor("ground", "hook"), 2.0, 5.0)
    points = {**scene.points, "hook": GroundPoint((5.0, 0.0), (2.0, 0.0))}
    return replace(scene, points=points, forces={"scale": spring})


@pytest.mark.parametrize(("realised", "limit"), [("law", 1e-5), ("driver", 1e-9)])
def test_growing_force(realised: Realised, limit: float) -> None:
    motion = run(
        pulled(DRY), REST, 8.0, step=1e-3, realised=realised, reactions=("guide.friction",)
    )
    slipping = np.maximum(motion.times - 6.0, 0.0)
    wanted = -(slipping**3 / 6 + 1.5 * slipping**2)
    assert abs(motion.states["block"][:, X] - wanted).max() <= limit
    friction = np.where(motion.times < 6.0, motion.times, 3.0)
    assert np.delete(motion.reactions["guide.friction"] - friction, 15) == pytest.approx(
        0, abs=1e-6
    )


@pytest.mark.parametrize(("realised", "limit"), [("law", 1e-5), ("driver", 1e-9)])
def test_dynamometer(realised: Realised, limit: float) -> None:
    """First cycle: from t = 1.5 s on ẍ = −2 x + 4 t − 3, at rest at t = 4.790543662… s."""
    motion = run(drawn(DRY), REST, 6.0, step=1e-3, realised=realised)
    w, t = math.sqrt(2.0), np.clip(motion.times - 1.5, 0.0, 3.290543662039922)
    # x = 2 t + 3/2 + a cos wt + b sin wt with x(0) = ẋ(0) = 0
    wanted = 2 * t + 1.5 - 1.5 * np.cos(w * t) - 2 / w * np.sin(w * t)
    assert abs(motion.states["block"][:, X] - wanted).max() <= limit


def test_native_has_one_number() -> None:
    motion = run(pulled(DRY), REST, 5.0, step=1e-3)
    assert motion.states["block"][-1, X] < -1.0  # it breaks loose at 3 N


@pytest.mark.parametrize("way", ["forward", "backward"])
def test_friction_to_and_fro(way: str) -> None:
    """Braking takes the bound of the way it goes."""
    scene = pulled(DryFriction(Bounds(2.0, 5.0), Bounds(2.0, 5.0)))
    scene = replace(scene, forces={})
    sign, force = (1, 2.0) if way == "forward" else (-1, 5.0)
    for realised in ("law", "driver"):
        motion = run(scene, (0, 0, 0, sign * 1.0, 0, 0), 1.0, step=1e-3, realised=realised)
        stops = motion.states["block"][-1, X]
        assert stops == pytest.approx(sign / (2 * force), abs=1e-5)


def test_smooth_law_creeps() -> None:
    dry = replace(DRY, smooth=Smooth(5e-4, 1e5))
    scene = drawn(dry)
    assert ways(TUNED, scene, {"block": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)}) == ("native", "law")
    motion = run(scene, REST, 6.0, realised="law")
    assert motion.record is not None
    stuck = (motion.record.times > 5.0) & (motion.record.times < 6.0)
    slip = observe(scene, motion.record, "guide.slip")[stuck]
    assert slip.min() >= 0.8 * 5e-4
    assert slip.max() <= 5e-4


def test_realisations() -> None:
    still: Start = {"block": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0), "wheel": (0.0, R, 0.0, 0.0, 0.0, 0.0)}
    assert ways(TUNED, pulled(DRY), still) == ("native", "law", "driver")
    assert ways(TUNED, floor(WHEEL, touching("wheel", 0.3)), still) == ("native",)
