"""The pymunk adapter: what it builds, how well it moves, and that the checks can fail."""

import math
import subprocess
import sys
from collections.abc import Callable
from dataclasses import astuple, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pymunk
import pytest
from planning import planned, refused, ways
from pymunk.body import Body
from pymunk.constraints import PivotJoint
from pymunk.space import Space
from scipy.special import ellipj, ellipk

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.observe import observe
from textmech.cases.scene import Anchor, GroundPoint, Joint, Scene, Spring
from textmech.cases.shape import bar, block, particle
from textmech.cases.trajectory import ANGLE, Array, Trajectory, X, Y
from textmech.engines.engine import Diverged, Realised, Start
from textmech.engines.pymunk import Pymunk, settings
from textmech.engines.pymunk import scene as builder
from textmech.reference.generated.mode import Multibody
from textmech.reference.motion.bodies import Motion
from textmech.reference.motion.follow import follow
from textmech.reference.start.assembly import assemble
from textmech.reference.system import Only

CASES = Path(__file__).parents[2] / "cases"
SHIPPED, TUNED = Pymunk("shipped"), Pymunk("tuned")
G = 9.80665


@cache
def case(name: str) -> Case:
    return next(c for c in load(CASES / f"{name.partition('.')[0]}.yaml") if c.name == name)


@cache
def start(name: str) -> Start:
    mechanism = Multibody(case(name).scene, assemble(case(name)))
    return mechanism.poses(0.0, *mechanism.start())


def moved(
    name: str,
    step: float,
    *,
    engine: Pymunk = TUNED,
    realised: Realised = "native",
    reactions: tuple[str, ...] = (),
    times: Array | None = None,
) -> Trajectory:
    times = case(name).times if times is None else times
    scene, begin = case(name).scene, start(name)
    plan = planned(engine, scene, begin, realised)
    return engine.run(scene, begin, times, step, plan, reactions=reactions)


def without(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """The tuned recipe without one of its numbers."""
    monkeypatch.setattr(settings, "_TUNED", [c for c in settings._TUNED if c.name != name])


# Construction

NAMES = [c.name for path in sorted(CASES.glob("*.yaml")) for c in load(path)]


def expected(name: str) -> dict[str, float]:
    """The physics of a scene, by the test's own formulas."""
    scene, poses = case(name).scene, start(name)
    found = {"gravity.x": scene.gravity[0], "gravity.y": scene.gravity[1]}
    found |= {f"{b.name}.mass": b.mass for b in scene.bodies.values()}
    found |= {f"{b.name}.inertia": b.inertia for b in scene.bodies.values() if b.inertia}
    found |= {f"{c.name}.friction": c.friction for c in scene.contacts.values()}
    for joint in scene.joints.values():
        if joint.dry_friction and len({*astuple(joint.dry_friction.kinetic)}) == 1:
            found[f"{joint.name}.friction_forward"] = joint.dry_friction.kinetic.forward
            found[f"{joint.name}.friction_backward"] = joint.dry_friction.kinetic.backward
    for spring in scene.springs():
        found[f"{spring.name}.stiffness"] = spring.stiffness
        found[f"{spring.name}.rest_length"] = spring.rest_length
    found |= {f"{d.name}.damping": d.damping for d in scene.dampers()}
    motions = [(b.mass, b.inertia or 0.0, poses[b.name][3:]) for b in scene.bodies.values()]
    found["energy.kinetic"] = sum(
        (m * (vx**2 + vy**2) + J * w**2) / 2 for m, J, (vx, vy, w) in motions
    )
    found["momentum.x"] = sum(m * v[0] for m, _, v in motions)
    found["momentum.y"] = sum(m * v[1] for m, _, v in motions)
    return found


@pytest.mark.parametrize("engine", [SHIPPED, TUNED], ids=lambda e: e.setting)
@pytest.mark.parametrize("name", NAMES)
def test_the_engine_holds_the_same_physics(name: str, engine: Pymunk) -> None:
    assert refused(engine, case(name).scene, start(name)) is None
    measured = engine.measure(case(name).scene, start(name))
    assert measured == pytest.approx(expected(name), rel=1e-12, abs=1e-15)


def heavier(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(builder, "Body", lambda m=0.0, J=0.0, **kw: Body(m, 1.05 * J, **kw))


def other_rule_of_friction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(builder, "FLOOR_FRICTION", 0.5)  # as if pymunk took the mean


@pytest.mark.parametrize(
    ("mutant", "quantity"),
    [(heavier, "wheel.inertia"), (other_rule_of_friction, "touch.friction")],
    ids=["inertia 5 % off", "friction's product rule broken"],
)
def test_the_audit_sees_a_mutant(
    monkeypatch: pytest.MonkeyPatch, mutant: Callable[[pytest.MonkeyPatch], None], quantity: str
) -> None:
    mutant(monkeypatch)
    name = "rolling_wheel.downhill"
    measured = TUNED.measure(case(name).scene, start(name))
    assert abs(measured[quantity] / expected(name)[quantity] - 1) > 0.04


def test_shipped_is_what_a_user_writes() -> None:
    """Bit for bit: nothing of pymunk's own is touched."""
    scene, poses = case("bar_pendulum").scene, start("bar_pendulum")
    space, rod = Space(), Body(1.2, 1.2 * 0.8**2 / 12)
    space.gravity = (0.0, -G)
    x, y, rod.angle, *_ = poses["bar"]
    rod.position = (x, y)
    hinge = PivotJoint(space.static_body, rod, (0.0, 0.0), (-0.4, 0.0))
    space.add(rod, hinge)
    for _ in range(100):
        space.step(0.01)
    end = SHIPPED.run(
        scene,
        poses,
        np.array([0.0, 1.0]),
        0.01,
        planned(SHIPPED, scene, poses),
        reactions=("hinge.force",),
    )
    assert end.states["bar"][1, :3].tolist() == [*rod.position, rod.angle]
    assert end.reactions["hinge.force"][1] == hinge.impulse / 0.01


# How well it moves

PENDULUM_BAR = 2e-5  # rad over 10 s at h = 1e-4, the case's reach


def pendulum(times: Array) -> tuple[Array, Array]:
    """Bar released far from hanging: its angle, and the hinge's force by Newton's law."""
    released = math.radians(24.6) + math.pi / 2
    k, frequency = math.sin(released / 2), math.sqrt(1.5 * G / 0.8)
    sn, cn, _, _ = ellipj(ellipk(k * k) - frequency * times, k * k)
    hanging = 2 * np.arcsin(k * sn)
    omega = 2 * k * frequency * cn  # up to its sign
    angular = -(frequency**2) * np.sin(hanging)
    along = 1.2 * (0.4 * omega**2 + G * np.cos(hanging))
    across = 1.2 * (0.4 * angular + G * np.sin(hanging))
    return hanging - math.pi / 2, np.hypot(along, across)


def pendulum_error(step: float) -> float:
    angle, _ = pendulum(case("bar_pendulum").times)
    return np.abs(moved("bar_pendulum", step).states["bar"][:, ANGLE] - angle).max()


def test_pendulum() -> None:
    run = moved("bar_pendulum", 1e-4, reactions=("hinge.force", "hinge.fx"))
    angle, force = pendulum(run.times)
    assert np.abs(run.states["bar"][:, ANGLE] - angle).max() < PENDULUM_BAR
    assert np.abs(run.reactions["hinge.force"] - force).max() < 2e-4
    assert "hinge.fx" not in run.reactions


def test_pendulum_is_of_second_order_and_its_limit_is_the_textbook() -> None:
    angle, _ = pendulum(case("bar_pendulum").times)
    u = [moved("bar_pendulum", h).states["bar"][:, ANGLE] for h in (4e-4, 2e-4, 1e-4)]
    order = math.log2(np.abs(u[1] - u[0]).max() / np.abs(u[2] - u[1]).max())
    assert order == pytest.approx(2, abs=0.1)
    second = [(4 * u[1] - u[0]) / 3, (4 * u[2] - u[1]) / 3]
    assert np.abs((8 * second[1] - second[0]) / 7 - angle).max() < 1e-9


@pytest.mark.parametrize("number", ["constraint.error_bias", "time.midpoint"])
def test_pendulum_misses_its_bar_without(monkeypatch: pytest.MonkeyPatch, number: str) -> None:
    without(monkeypatch, number)
    assert pendulum_error(1e-4) > 10 * PENDULUM_BAR


@pytest.mark.parametrize("variant", ["pushed", "downhill"])
def test_wheel_rolls_exactly(variant: str) -> None:
    name = f"rolling_wheel.{variant}"
    run = moved(name, 1e-3, reactions=("touch.normal", "touch.tangent"))
    push, beta = (2.5, 0.0) if variant == "pushed" else (0.0, math.radians(20))
    pull = 1.3 * G * math.sin(beta) + push
    x = 0.4 * run.times + pull / (1.5 * 1.3) / 2 * run.times**2
    assert np.abs(run.states["wheel"][:, X] - x).max() < 1e-10
    assert np.abs(observe(case(name).scene, run, "touch.slip")).max() < 1e-10
    # the floor's force on the wheel: upwards, and against a pull to the right
    assert run.reactions["touch.normal"] == pytest.approx(1.3 * G * math.cos(beta), abs=1e-8)
    assert run.reactions["touch.tangent"] == pytest.approx(-pull / 3, abs=1e-8)


def test_wheel_that_only_touches_falls_for_one_step(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "start.seed")
    run = moved("rolling_wheel.downhill", 1e-3)
    assert np.abs(observe(case("rolling_wheel.downhill").scene, run, "touch.gap")).max() > 1e-6


def damped(run: Trajectory, damping: float) -> float:
    """Largest error of the hung mass against m ÿ + d ẏ + c (y − y∞) = 0 in closed form."""
    rest, root = -0.5 - G / 36.0, np.emath.sqrt((damping / 2) ** 2 - 36.0)
    decay, t = damping / 2, run.times
    with np.errstate(invalid="ignore"):
        slope = np.where(root == 0, t, np.sinh(root * t) / (root or 1.0))
    y = rest + (-0.6 - rest) * np.real(np.exp(-decay * t) * (np.cosh(root * t) + decay * slope))
    return np.abs(run.states["mass"][:, Y] - y).max()


@pytest.mark.parametrize(
    ("variant", "damping"), [("underdamped", 1.2), ("critical", 12.0), ("overdamped", 30.0)]
)
def test_damper_of_the_engine_and_by_its_law(variant: str, damping: float) -> None:
    name = f"spring_mass_damper.{variant}"
    native, law = moved(name, 1e-4), moved(name, 1e-4, realised="law")
    assert damped(law, damping) < 5e-7 < damped(native, damping) < 5e-4


def reference(scene: Scene, poses: Start, times: Array) -> Trajectory:
    q, v = [], []
    for body in scene.bodies.values():
        x, y, angle, vx, vy, omega = poses[body.name]
        q += [x, y, angle] if body.turns else [x, y]
        v += [vx, vy, omega] if body.turns else [vx, vy]
    alone = Only(Multibody(scene, (np.array(q), np.array(v))))
    return Motion(alone, follow(alone, times)).trajectory(times)


def test_driven_point_push_and_forces_in_time() -> None:
    """Towed pendulum: every force that pymunk has to be told, at the midpoint."""
    scene, times = case("towed_pendulum").scene, case("towed_pendulum").times
    exact = reference(scene, start("towed_pendulum"), times)
    run = moved("towed_pendulum", 1e-3, reactions=("pivot.force",))
    assert np.abs(run.states["bob"][:, ANGLE] - exact.states["bob"][:, ANGLE]).max() < 1e-5
    assert np.abs(run.states["cart"][:, X] - exact.states["cart"][:, X]).max() < 2e-6
    force = observe(scene, exact, "pivot.force")
    assert np.abs(run.reactions["pivot.force"] - force).max() < 1e-3


# A slide on a body that turns: the block's own axes and point are turned and off its centre

ALONG = (math.cos(0.3), math.sin(0.3))


def sliding(kind: str) -> tuple[Scene, Start]:
    rod = bar(name="rod", mass=1.1, length=0.9, points={"P": (0.1, 0.07)})
    box = block(name="box", mass=0.6, width=0.2, height=0.1, points={"Q": (0.03, -0.04)})
    hinge = Joint("hinge", "pin", Anchor("ground", "O"), Anchor("rod", "start"))
    ends = Anchor("rod", "P"), Anchor("box", "Q")
    rail = Joint("rail", kind, *ends, along=ALONG, angle=0.5)  # type: ignore[arg-type]
    coil = Spring("coil", Anchor("rod", "end"), Anchor("box", "center"), 40.0, 0.3)
    scene = Scene(
        (0.0, -G),
        {"O": GroundPoint((0.0, 0.0))},
        {"rod": rod, "box": box},
        {"hinge": hinge, "rail": rail},
        {},
        {"coil": coil} if kind == "slide" else {},
    )
    a, omega, slip = -0.4, 1.5, 0.3 if kind == "slide" else 0.0

    def state(x: float, y: float, angle: float, slip: float) -> tuple[float, ...]:
        """Of a point (x, y) of the rod that slips along the rail, in ground axes."""
        cos, sin = math.cos(a), math.sin(a)
        x, y = cos * x - sin * y, sin * x + cos * y
        ux, uy = cos * ALONG[0] - sin * ALONG[1], sin * ALONG[0] + cos * ALONG[1]
        return (x, y, angle, -omega * y + slip * ux, omega * x + slip * uy, omega)

    cos, sin = math.cos(0.5), math.sin(0.5)
    center = 0.45 + 0.1 - (cos * 0.03 + sin * 0.04), 0.07 - (sin * 0.03 - cos * 0.04)
    return scene, {"rod": state(0.45, 0.0, a, 0.0), "box": state(*center, a + 0.5, slip)}  # type: ignore[dict-item]


def sliding_error(kind: str) -> tuple[float, float]:
    """Of the rod's angle and of the hinge's force, against the generated motion."""
    scene, poses = sliding(kind)
    times = np.linspace(0.0, 1.0, 26)
    exact = reference(scene, poses, times)
    run = TUNED.run(
        scene, poses, times, 1e-3, planned(TUNED, scene, poses), reactions=("hinge.force",)
    )
    force = observe(scene, exact, "hinge.force")
    return (
        np.abs(run.states["rod"][:, ANGLE] - exact.states["rod"][:, ANGLE]).max(),
        np.abs(run.reactions["hinge.force"] - force).max(),
    )


@pytest.mark.parametrize("kind", ["slide", "weld"])
def test_slide_and_weld_on_a_turning_body(kind: str) -> None:
    angle, force = sliding_error(kind)
    assert angle < 5e-5
    assert force < 1e-2


def test_slide_is_worse_where_a_user_would_put_the_groove(monkeypatch: pytest.MonkeyPatch) -> None:
    def naive(world: builder.World, joint: Joint) -> tuple[tuple[float, float], ...]:
        (x, y), (ux, uy) = world.local(joint.a), joint.along
        return (x - 3 * ux, y - 3 * uy), (x + 3 * ux, y + 3 * uy), world.local(joint.b)

    monkeypatch.setattr(builder, "groove", naive)
    angle, force = sliding_error("slide")
    assert angle > 1e-4
    assert force > 0.1


def test_angle_of_a_weld_may_stand_on_another_turn() -> None:
    scene, poses = sliding("weld")
    x, y, angle, vx, vy, omega = poses["box"]
    turned = dict(poses) | {"box": (x, y, angle + math.tau, vx, vy, omega)}
    times = np.array([0.0, 0.4])
    ends = [
        TUNED.run(scene, p, times, 1e-3, planned(TUNED, scene, p), reactions=())
        for p in (poses, turned)
    ]
    assert ends[1].states["rod"][-1] == pytest.approx(ends[0].states["rod"][-1], abs=1e-12)


# Iterations


def chain(n: int) -> tuple[Scene, Start]:
    """n bars hung from one pin, released horizontally."""
    bodies = {f"b{i}": bar(name=f"b{i}", mass=1.0, length=0.4, points={}) for i in range(n)}
    anchors = [Anchor("ground", "O"), *(Anchor(name, "end") for name in bodies)]
    joints = {
        f"j{i}": Joint(f"j{i}", "pin", anchors[i], Anchor(f"b{i}", "start")) for i in range(n)
    }
    scene = Scene((0.0, -G), {"O": GroundPoint((0.0, 0.0))}, bodies, joints, {}, {})
    return scene, {f"b{i}": (0.4 * i + 0.2, 0.0, 0.0, 0.0, 0.0, 0.0) for i in range(n)}


def energy_drift(n: int) -> float:
    scene, poses = chain(n)
    times = np.linspace(0.0, 0.8, 6)
    run = TUNED.run(scene, poses, times, 2e-4, planned(TUNED, scene, poses), reactions=())
    energy = observe(scene, run, "energy.total")
    return np.abs(energy - energy[0]).max()


@pytest.mark.parametrize("n", [5, 12])
def test_chain_keeps_its_energy(n: int) -> None:
    assert energy_drift(n) < 1e-3


def test_chain_with_the_default_iterations_gains_energy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        settings,
        "tuned",
        lambda scene: [replace(c, value=10) if "iter" in c.name else c for c in settings._TUNED],
    )
    assert energy_drift(12) > 1.0


# Settings, refusals, what is withheld


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"iteration": 30}, "pymunk.iteration: unknown option; did you mean 'iterations'?"),
        ({"qqq": 1}, "pymunk.qqq: unknown option; known: step, iterations"),
        ({"iterations": 0}, "pymunk.iterations: should be a whole number from 1"),
        ({"iterations": 2.5}, "pymunk.iterations: should be a whole number"),
        ({"iterations": True}, "is True"),
        ({"error_bias": -0.1}, "pymunk.error_bias: should be a number from 0 to 1, is -0.1"),
        ({"max_bias": -1.0}, "pymunk.max_bias: should be a number from 0 on"),
        ({"max_bias": math.nan}, "is nan"),
        ({"damping": math.inf}, "pymunk.damping: should be a number from 0 on, is inf"),
        ({"collision_slop": "thin"}, "is 'thin'"),
        ({"collision_persistence": 0}, "should be a whole number from 1"),
        ({"step": 0.0}, "pymunk.step: should be a number above 0 seconds, is 0.0"),
        ({"step": math.nan}, "pymunk.step"),
    ],
    ids=str,
)
def test_a_wrong_option_is_named(options: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match="pymunk") as caught:
        Pymunk("own", options)
    assert words in str(caught.value)


def test_own_options_stand_on_top_of_the_shipped_ones() -> None:
    scene = case("four_bar").scene
    own = Pymunk("own", {"iterations": 50, "error_bias": 0, "step": 1e-3, "max_bias": math.inf})
    chosen = {c.name: c.value for c in planned(own, scene, start("four_bar")).choices(1e-3)}
    shipped = {c.name: c.value for c in planned(SHIPPED, scene, start("four_bar")).choices(1e-3)}
    assert chosen == shipped | {"space.iterations": 50, "constraint.error_bias": 0}
    assert own.own_step == 1e-3
    assert (SHIPPED.own_step, TUNED.own_step) == (0.01, None)


def test_every_choice_has_its_reason() -> None:
    for name in NAMES:
        for engine in (SHIPPED, TUNED):
            assert all(
                choice.because
                for choice in planned(engine, case(name).scene, start(name)).choices(1e-3)
            )


def test_refused_scenes() -> None:
    scene, _ = sliding("slide")
    itself = Joint("loop", "pin", Anchor("rod", "start"), Anchor("rod", "end"))
    pin = replace(scene, joints={"loop": itself})
    assert refused(TUNED, pin) == "engine: loop joins rod to itself, on which pymunk aborts"
    bead = particle(name="bead", mass=0.1)
    rail = Joint("rail", "slide", Anchor("rod", "P"), Anchor("bead", "center"), along=ALONG)
    beside = replace(scene, bodies={**scene.bodies, "bead": bead}, joints={"rail": rail})
    assert refused(TUNED, beside) is None
    begin = dict.fromkeys(beside.bodies, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert planned(TUNED, beside, begin).exponents == (1, 2)
    first = Joint("rail", "slide", Anchor("bead", "center"), Anchor("rod", "P"))
    assert "which has no axes" in str(refused(TUNED, replace(beside, joints={"rail": first})))
    hollow = replace(scene, bodies={"rod": replace(scene.bodies["rod"], mass=math.inf)}, joints={})
    assert "positive finite masses" in str(refused(TUNED, hollow))


def test_what_an_impulse_cannot_tell() -> None:
    withheld = planned(TUNED, case("slider_crank").scene, start("slider_crank")).withheld
    for quantity in ("main.fx", "bore.fy", "bore.torque"):
        assert withheld[quantity] == "engine: pymunk reports a joint's impulse as a magnitude only"
    assert "main.force" not in withheld
    assert "crank.angle" not in withheld


def test_declared_expansions_and_realisations() -> None:
    free, oiled = (
        (case(f"spring_mass_damper.{v}").scene, start(f"spring_mass_damper.{v}"))
        for v in ("free", "critical")
    )
    assert planned(SHIPPED, *oiled).exponents == (1, 2)
    assert planned(TUNED, *oiled).exponents == (1, 2)
    assert planned(TUNED, *oiled, "law").exponents == (2, 3)
    assert planned(TUNED, *free).exponents == (2, 3)
    assert ways(TUNED, *oiled) == ("native", "law")
    assert ways(SHIPPED, *oiled) == ("native",)
    wheel = "rolling_wheel.pushed"
    shipped, tuned = (
        planned(engine, case(wheel).scene, start(wheel)).protocol(1e-3)
        for engine in (SHIPPED, TUNED)
    )
    assert shipped == ""
    assert tuned == (
        "started 0.0005 s back, positions read 0.0005 s ahead; wheel started 1e-09 m in the floor"
    )


# Running


@pytest.mark.parametrize("engine", [SHIPPED, TUNED], ids=lambda e: e.setting)
@pytest.mark.parametrize("name", ["slider_crank", "towed_pendulum", "rolling_wheel.downhill"])
def test_the_script_makes_the_same_motion(name: str, engine: Pymunk) -> None:
    scene, begin = case(name).scene, start(name)
    script = engine.script(scene, begin, 0.01, planned(engine, scene, begin))
    out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    ends = {line.split()[0]: line.split()[1:] for line in out.stdout.splitlines()}
    run = moved(name, 0.01, engine=engine, times=np.array([0.0, 1.0]))
    for body, states in run.states.items():
        assert [float(x) for x in ends[body]] == pytest.approx(states[-1].tolist(), abs=1e-12)


def test_two_runs_are_the_same_bit_for_bit() -> None:
    """Also whatever is read, and however often."""
    times = case("slider_crank").times
    first = moved("slider_crank", 1e-3, realised="law")
    again = moved("slider_crank", 1e-3, realised="law", reactions=("main.force", "bore.force"))
    sparse = moved("slider_crank", 1e-3, realised="law", times=times[::25])
    for body, states in first.states.items():
        assert np.array_equal(states, again.states[body])
        assert np.array_equal(states[::25], sparse.states[body])


def test_bare_loop_is_the_same_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    worlds: list[builder.World] = []

    def kept(*arguments: Any) -> builder.World:
        worlds.append(builder.build(*arguments))
        return worlds[-1]

    monkeypatch.setattr("textmech.engines.pymunk.run.build", kept)
    scene, begin = case("towed_pendulum").scene, start("towed_pendulum")
    steps = TUNED.loop(scene, begin, 1e-3, planned(TUNED, scene, begin))
    steps(300)
    steps(700)
    monkeypatch.undo()
    run = moved("towed_pendulum", 1e-3, times=np.array([0.0, 1.0]))
    assert tuple(worlds[0].bodies["bob"].velocity) == tuple(run.states["bob"][-1, 3:5])


def test_a_wheel_that_leaves_the_floor_diverges_at_the_first_sample_beyond() -> None:
    with pytest.raises(Diverged, match=r"a body left the floor's .* at t = 10 s"):
        moved("rolling_wheel.downhill", 0.01, engine=SHIPPED, times=np.linspace(0.0, 14.0, 8))


def test_a_step_that_is_too_large_diverges() -> None:
    stiff = Spring("coil", Anchor("ground", "O"), Anchor("bead", "center"), 1e6, 0.5)
    scene = Scene(
        (0.0, -G),
        {"O": GroundPoint((0.0, 0.0))},
        {"bead": particle(name="bead", mass=1.0)},
        {},
        {},
        {"coil": stiff},
    )
    poses = {"bead": (0.0, -0.6, 0.0, 0.0, 0.0, 0.0)}
    times = np.linspace(0.0, 10.0, 11)
    with pytest.raises(Diverged, match=r"not finite any more at t = \d"):
        TUNED.run(scene, poses, times, 0.01, planned(TUNED, scene, poses), reactions=())


def test_samples_that_no_step_meets() -> None:
    with pytest.raises(ValueError, match=r"no whole multiples of the step 0\.003"):
        moved("bar_pendulum", 3e-3)


def test_version_is_the_package_s() -> None:
    assert TUNED.version == pymunk.version
