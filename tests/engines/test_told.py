"""Forces that engines have no element for: by our laws, against the reference and typed values."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from given import scenes
from given.adapters.planning import CASES, SHIPPED, TUNED, apart, begun, moved, refused, ways
from given.scenes import slowed
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.scene import Anchor, Bounds, Drag, LinearMuscle, Magnetic, Muscle, Viscous
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.engines import point_forces as told
from textmech.engines.engine import Diverged, Refusal, Start
from textmech.engines.mujoco.model import force
from textmech.engines.mujoco.read import reaction
from textmech.engines.point_forces import Living, Place, law_of, living
from textmech.engines.pymunk.callbacks import force as of_pymunk
from textmech.engines.pymunk.model import damping
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import assembled

TABLE = json.loads((Path(__file__).parent / "law_table.json").read_text())
END = scenes.tail(1.0, 6)
# Measured at the steps: MuJoCo 1.1e-8 m, for the cart turns back, where its law has a corner, and
# 4e-8 N; pymunk, of second order, 3.6e-7 m.
STEP = {"mujoco": 1e-3, "pymunk": 2e-4}
REACHED = {"mujoco": 5e-8, "pymunk": 2e-6}
KINDS = {"drag": Drag, "viscous": Viscous, "magnetic": Magnetic}


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> tuple[Case, Trajectory, Start]:
    case = scenes.typed(tmp_path_factory.mktemp("told"), slowed.SLOWED, tail=END)
    motion = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in motion.states.items()}  # type: ignore[misc]
    return case, motion, start


@pytest.mark.slow
@pytest.mark.parametrize("row", TABLE["told"], ids=str)
def test_typed_values(row: dict[str, Any], known: tuple[Case, Trajectory, Start]) -> None:
    """The viscous ones along [1, 0.3] of a rail whose first part is turned by 0.3 rad."""
    scene, numbers = known[0].scene, dict(row["numbers"])
    if "coefficient" in numbers and row["kind"] == "viscous":
        numbers["coefficient"] = Bounds(*numbers["coefficient"])
    refers = {"drag": scene.forces["air"].refers()[:1], "viscous": ("rail",), "magnetic": ("rod",)}
    force = KINDS[row["kind"]]("some", *refers[row["kind"]], **numbers)
    points = [Place(*place) for place in row["points"]]
    found = law_of(scene, force)(0.0, points)
    np.testing.assert_allclose(found, row["forces"], rtol=1e-12, atol=1e-15)


@pytest.mark.slow
@pytest.mark.mutant("a power of no speed below 1, in an engine")
def test_a_drag_below_one_is_nothing_at_rest(tmp_path: Path) -> None:
    """(2.86) d |v|^α ends at 0 with v, though |v|^(α − 1) has no number there."""
    text = """\
scene:
  bodies: {ball: {particle: {mass: 1.0}}}
  forces: {air: {drag: ball.center, coefficient: 0.5, exponent: 0.5}}
initial: {ball: {x: 0, y: 0}}
allow: {ball.y: 1.0e-2}
"""
    case = scenes.typed(tmp_path, text, tail=END)
    motion = solve(case).trajectory
    for engine in TUNED.values():
        start: Start = {"ball": tuple(motion.states["ball"][0].tolist())}  # type: ignore[dict-item]
        found = moved(engine, case.scene, start, case.times, 1e-3, realised="law")
        assert found.states["ball"][:, 1] == pytest.approx(motion.states["ball"][:, 1], abs=1e-3)


@pytest.mark.parametrize("row", TABLE["living"], ids=str)
def test_typed_values_of_what_has_a_state(row: dict[str, Any]) -> None:
    """F₀ = 60 N, c_s = 300 N/m, c_p = 100 N/m from 0.15 m, between (1, 2) and (1.4, 2.3)."""
    kind = {"muscle": Muscle, "linear_muscle": LinearMuscle}[row["kind"]]
    ends = (Anchor("ground", "O"), Anchor("bob", "center"))
    force = kind("calf", *ends, 60.0, 300.0, 100.0, 0.15, 0.2, **row["numbers"])
    law = living(NOWHERE, force)
    points = [Place(1.0, 2.0, 0.0, 0.0, 0.0), Place(1.4, 2.3, 5.0, 5.0, 0.7)]
    assert law.begins == 0.2
    assert law.rate(points, row["u"]) == pytest.approx(row["rate"], abs=1e-12)
    np.testing.assert_allclose(law.exerts(points, row["u"]), row["forces"], rtol=1e-12)


NOWHERE: Any = None  # a muscle asks nothing of its scene


def off(engine: str, known: tuple[Case, Trajectory, Start], h: float) -> float:
    case, motion, start = known
    found = moved(TUNED[engine], case.scene, start, case.times, h, realised="law")
    return float(apart(motion, found)[:3].max())


@pytest.mark.slow
@pytest.mark.parametrize("engine", STEP)
def test_engines_move_as_the_reference(engine: str, known: tuple[Case, Trajectory, Start]) -> None:
    assert off(engine, known, STEP[engine]) < REACHED[engine]


@pytest.mark.slow
def test_their_joints_bear_what_the_laws_give(known: tuple[Case, Trajectory, Start]) -> None:
    case, motion, start = known
    wanted = ("hinge.fx", "hinge.fy", "rail.fx", "rail.torque")
    found = moved(
        TUNED["mujoco"], case.scene, start, case.times, 1e-3, realised="law", reactions=wanted
    )
    for name in wanted:
        assert np.max(np.abs(found.reactions[name] - motion.reactions[name])) < 2e-7


@pytest.mark.mutant("{kind} left out in {engine}", "{kind} with the wrong sign in {engine}")
@pytest.mark.slow
@pytest.mark.parametrize("engine", STEP)
@pytest.mark.parametrize("kind", KINDS)
def test_a_lost_law_and_a_wrong_sign_are_seen(
    engine: str,
    kind: str,
    known: tuple[Case, Trajectory, Start],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sound = told.TOLD[KINDS[kind]]
    for way in (0.0, -1.0):

        def wrong(scene: Any, force: Any, way: float = way) -> Any:
            law = sound(scene, force)
            return lambda t, points: [(way * x, way * y) for x, y in law(t, points)]

        monkeypatch.setitem(told.TOLD, KINDS[kind], wrong)
        assert off(engine, known, STEP[engine]) > 1e-3


@pytest.mark.parametrize("engine", STEP)
def test_natively_there_is_a_reason(engine: str, known: tuple[Case, Trajectory, Start]) -> None:
    case, _, start = known
    assert ways(TUNED[engine], case.scene, start) == ("native", "law")
    assert ways(SHIPPED[engine], case.scene, start) == ("native",)
    because = refused(SHIPPED[engine], case.scene, start)
    assert because is not None
    assert because.startswith("engine: ")


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [1, 2, 3])
def test_mujoco_damps_a_slide_by_itself(exponent: int, tmp_path: Path) -> None:
    """Alike both ways: and that is what the audit reads back."""
    both = "{forward: 0.8, backward: 1.7}, exponent: 1.5"
    alike = slowed.SLOWED.replace(both, f"0.8, exponent: {exponent}")
    for line in ("air", "wind", "field", "glow"):
        alike = "\n".join(x for x in alike.splitlines() if not x.startswith(f"    {line}:"))
    alike = alike.replace("air.force: 1.0, ", "") + "\n"
    case = scenes.typed(tmp_path, alike, tail=END)
    motion = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in motion.states.items()}  # type: ignore[misc]
    engine = TUNED["mujoco"]
    assert ways(engine, case.scene, start) == ("native",)
    assert engine.measure(case.scene, start)["oil.forward"] == 0.8
    found = moved(engine, case.scene, start, case.times, 1e-3)
    assert np.max(np.abs(found.states["cart"][:, :3] - motion.states["cart"][:, :3])) < 1e-9


def test_beside_what_does_not_count_them_they_are_refused(tmp_path: Path) -> None:
    edge = "  constraints: {blade: {edge: rod.end, along: [1, 0]}}\n"
    blade = slowed.SLOWED.replace("  forces:", f"{edge}  forces:")
    blade = blade.replace("  joints:\n    hinge: {pin: [ground.O, rod.start]}\n", "  joints:\n")
    scene = scenes.typed(tmp_path, blade).scene
    assert refused(TUNED["mujoco"], scene) == (
        "adapter: air by our law beside blade, which does not count it"
    )


# Drag in proportion to the speed, by what the engines have: dampings of slides, of the space.


D, M = 0.7, 0.5
DISK = f"disk: {{mass: {M}, radius: 0.1}}"
THROWN = f"""\
scene:
  gravity: none
  points: {{O: [0, 0], Q: [2, 0]}}
  bodies: {{ball: {{{DISK}, points: {{P: [0.05, 0]}}}}MORE}}
  forces: {{air: {{drag: ball.center, coefficient: {D}, exponent: 1}}FORCES}}
BELOWinitial: {{ball: {{x: 0, y: 0, vx: 3, vy: 4SPIN}}START}}
allow: {{ball.x: 1.0e-3}}
"""
H = 1e-3  # s


def thrown(folder: Path, **changed: str) -> Case:
    words = {"MORE": "", "FORCES": "", "BELOW": "", "SPIN": "", "START": ""} | changed
    text = THROWN
    for word, more in words.items():
        text = text.replace(word, more)
    return scenes.typed(folder, text)


def ran(engine: str, case: Case, **asked: Any) -> Any:
    return moved(TUNED[engine], case.scene, assembled(case), case.times, H, **asked)


def why(engine: str, case: Case) -> str:
    """Why it is not native."""
    first, *_ = TUNED[engine].plans(case.scene, assembled(case))
    assert isinstance(first, Refusal)
    return first.because


@pytest.mark.parametrize("engine", TUNED)
def test_a_thrown_disk_is_slowed_by_the_engine_itself(engine: str, tmp_path: Path) -> None:
    """v₀ exp(−d t/m), and the places that it makes: MuJoCo's of fourth order, pymunk's second."""
    case = thrown(tmp_path)
    states = ran(engine, case).states["ball"]
    slowed = np.exp(-D / M * case.times)
    assert states[:, 3:5] == pytest.approx(np.outer(slowed, [3.0, 4.0]), abs=1e-12)
    far = np.outer((1 - slowed) * M / D, [3.0, 4.0])
    near = {
        "mujoco": 1e-11,
        "pymunk": 5.0 * (D / M) * H**2 / 12 * 1.1,
    }  # of the trapezoid
    assert np.max(np.abs(states[:, :2] - far)) < near[engine]


@pytest.mark.parametrize("engine", TUNED)
def test_what_falls_comes_to_its_terminal_speed(engine: str, tmp_path: Path) -> None:
    """m g/d; pymunk's is larger by the half of d h/m, as gravity comes after the damping."""
    case = thrown(tmp_path)
    case = replace(case, scene=replace(case.scene, gravity=(0.0, -9.81)), duration=20.0)
    speed = -ran(engine, case).states["ball"][-1, 4] / (9.81 * M / D)
    assert speed == pytest.approx(1.0 + (D / M * H / 2 if engine == "pymunk" else 0.0), abs=1e-6)


def test_a_slide_holds_what_its_drag_leaves(tmp_path: Path) -> None:
    """On a slope of 0.6 to 0.8 the guide's force is 0.6 m g, whatever slows along it."""
    slide = "  joints: {guide: {slide: [ground.O, ball.center], along: [0.6, 0.8]}}\n"
    case = thrown(tmp_path, BELOW=slide)
    case = replace(case, scene=replace(case.scene, gravity=(0.0, -9.81)))
    motion = ran("mujoco", case, reactions=("guide.fx", "guide.fy"))
    held = np.array([-0.8, 0.6]) * 0.6 * 9.81 * M
    found = np.array([motion.reactions[f"guide.{axis}"] for axis in ("fx", "fy")]).T
    assert found == pytest.approx(np.tile(held, (len(found), 1)), abs=1e-9)


@pytest.mark.mutant("MuJoCo's damping of a slide is counted among what its guide holds")
def test_a_drag_that_the_guide_holds_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "damped", lambda scene, joint: [])
    with pytest.raises(AssertionError):
        test_a_slide_holds_what_its_drag_leaves(tmp_path)


@pytest.mark.parametrize(
    ("engine", "planted"),
    [
        pytest.param("pymunk", "rate", marks=pytest.mark.mutant("pymunk slows by d, not by d/m")),
        pytest.param("mujoco", "write", marks=pytest.mark.mutant("MuJoCo damps by the double")),
    ],
)
def test_the_audit_reads_the_coefficient_back(
    engine: str, planted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = thrown(tmp_path)
    start = assembled(case)
    sound = TUNED[engine].measure(case.scene, start)
    assert sound["air.coefficient"] == pytest.approx(D, rel=1e-14)
    if planted == "rate":
        monkeypatch.setattr(of_pymunk, "rate", lambda scene: D)
    else:
        double = lambda sections, force, *slides: [s.give("damping", 2 * D) for s in slides]  # noqa: E731
        known = force.ELEMENTS[type(case.scene.forces["air"])]
        changed = {**force.ELEMENTS, type(case.scene.forces["air"]): replace(known, write=double)}
        monkeypatch.setattr(force, "ELEMENTS", changed)
    assert TUNED[engine].measure(case.scene, start)["air.coefficient"] != pytest.approx(D, rel=0.1)


BOTH = ("native", "law")
SECOND = ", other: {particle: {mass: 1}}"
AT_REST = ", other: {x: 1, y: 1}"


@pytest.mark.parametrize(
    ("changed", "mujoco", "pymunk"),
    [
        ({}, "", ""),
        ({"SPIN": ", omega: 2"}, "", "slows turning too, as that of ball"),
        ({"FORCES": ", w: {torque: ball, constant: 1}"}, "", "slows turning too"),
        (
            {"SPIN": ", angle: 0", "FORCES": ", w: {push: ball.P, constant: [1, 0]}"},
            "",
            "slows turning too",
        ),
        (
            {"MORE": SECOND, "START": AT_REST},
            "",
            "slows all bodies alike: ball loses 1.4 1/s and other 0",
        ),
        (
            {
                "MORE": SECOND,
                "START": AT_REST,
                "FORCES": ", oil: {drag: other.center, coefficient: 1.4, exponent: 1}",
            },
            "",
            "",
        ),
        (
            {"FORCES": ", oil: {drag: ball.center, coefficient: 0.1, exponent: 1}"},
            "damps a slide once, and oil is beside air",
            "",
        ),
        (
            {"FORCES": ", oil: {drag: ball.center, coefficient: 0.1, exponent: 2}"},
            "has no drag at a point",
            "no friction by a power of the speed",
        ),
        (
            {
                "SPIN": ", angle: 0",
                "FORCES": ", oil: {drag: ball.P, coefficient: 0.1, exponent: 1}",
            },
            "has no drag at a point",
            "and oil a point beside its centre",
        ),
        (
            {
                "SPIN": ", angle: 0",
                "FORCES": ", o: {drag: ball.center, coefficient: 1, exponent: 1, along: [1, 0], "
                "across: 1}",
            },
            "has no drag at a point",
            "slows alike in all directions, and o does not",
        ),
    ],
)  # fmt: skip
def test_where_it_is_the_engines_own(
    changed: dict[str, str], mujoco: str, pymunk: str, tmp_path: Path
) -> None:
    """And where not, for which reason: beside one that is told, pymunk's space damps nothing."""
    case = thrown(tmp_path, **changed)
    start = assembled(case)
    for engine, reason in (("mujoco", mujoco), ("pymunk", pymunk)):
        if reason:
            assert reason in why(engine, case)
            assert ways(TUNED[engine], case.scene, start)[-1] == "law"
        else:
            own = ("native",) if engine == "mujoco" else BOTH
            assert ways(TUNED[engine], case.scene, start) == own


@pytest.mark.parametrize(
    ("joint", "mujoco", "pymunk"),
    [
        ("slide: [ground.O, ball.center], along: [0.6, 0.8]", "", ""),
        ("slot: [ground.O, ball.center], along: [0.6, 0.8]", "", "slows turning too"),
        ("slot: [ground.O, ball.P], along: [0.6, 0.8]", "by no slides alone", "slows turning too"),
        ("pin: [ground.O, ball.P]", "by no slides alone", "slows turning too"),
    ],
)
def test_what_a_joint_leaves_decides(joint: str, mujoco: str, pymunk: str, tmp_path: Path) -> None:
    start = "" if "slide" in joint else ", angle: 0"
    text = THROWN.replace(", vx: 3, vy: 4SPIN", start).replace("x: 0, y: 0", "x: 0")
    for word in ("MORE", "FORCES", "START"):
        text = text.replace(word, "")
    text = text.replace("BELOW", f"  joints: {{j: {{{joint}}}}}\n")
    if "ball.P" in joint:
        text = text.replace("x: 0, angle", "angle" if "pin" in joint else "x: 0, angle")
    case = scenes.typed(tmp_path, text)
    for engine, reason in (("mujoco", mujoco), ("pymunk", pymunk)):
        first, *_ = TUNED[engine].plans(case.scene, assembled(case))
        told = first.because if isinstance(first, Refusal) else ""
        assert bool(told) == bool(reason), told
        assert reason in told


def test_a_pendulum_in_oil(tmp_path: Path) -> None:
    """A particle on a rod, which pymunk slows as a whole: l φ̈ = −g sin φ − d l φ̇/m.

    As near as the damping, which comes before gravity, lets it be: h d/m of 0.5 m.
    """
    text = f"""\
scene:
  points: {{O: [0, 0]}}
  bodies: {{bob: {{particle: {{mass: {M}}}}}}}
  joints: {{rod: {{distance: [ground.O, bob.center], length: 0.5}}}}
  forces: {{air: {{drag: bob.center, coefficient: {D}, exponent: 1}}}}
initial: {{bob: {{x: 0.3, y: -0.4}}}}
allow: {{bob.x: 1.0e-3}}
"""
    case = scenes.typed(tmp_path, text)
    assert "by no slides alone" in why("mujoco", case)
    states = ran("pymunk", case).states["bob"]
    swung = solve_ivp(
        lambda t, y: [y[1], -9.80665 / 0.5 * math.sin(y[0]) - D / M * y[1]],
        (0.0, float(case.times[-1])),
        [math.asin(0.6), 0.0],
        rtol=1e-10,
        atol=1e-12,
        t_eval=case.times,
    ).y[0]
    assert states[:, 0] == pytest.approx(0.5 * np.sin(swung), abs=H * D / M * 0.5)


@pytest.mark.mutant("pymunk's space damps what turns")
def test_a_spin_that_is_damped_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = thrown(tmp_path, SPIN=", omega: 2")
    assert ran("pymunk", case, realised="law").states["ball"][-1, 5] == pytest.approx(2.0)
    monkeypatch.setattr(damping, "_stays_unturned", lambda scene, body, start: True)
    spun = ran("pymunk", case).states["ball"][-1, 5]
    assert spun == pytest.approx(2.0 * math.exp(-D / M), rel=1e-9)


# Inner states in engines: orders, what they begin with, and planted mistakes.


NAME, U = "muscle_load", "muscle.contractile_length"
STEPS = {"mujoco": 1e-3, "pymunk": 2e-4}


def pulled(engine: str, h: float) -> float:
    """Of the load and of what contracts, the largest [m]."""
    scene, start = begun(NAME)
    case, known = CASES[NAME], scenes.solved(NAME).trajectory
    found = moved(TUNED[engine], scene, start, case.times, h, realised="law", reactions=(U,))
    return max(
        float(np.max(np.abs(observe(scene, found, name) - observe(scene, known, name))))
        for name in ("load.y", U)
    )


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "order"), [("mujoco", 4), ("pymunk", 2)])
def test_the_state_is_of_the_engine_s_order(engine: str, order: int) -> None:
    h = STEPS[engine]
    assert math.log2(pulled(engine, 2 * h) / pulled(engine, h)) == pytest.approx(order, abs=0.1)


@pytest.mark.mutant("muscle in {engine}: {planted} of its inner state")
@pytest.mark.parametrize("engine", STEPS)
@pytest.mark.parametrize("planted", ["a rate of the other sign", "no rate", "another start"])
def test_a_planted_mistake_is_seen(
    engine: str, planted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind = type(CASES[NAME].scene.forces["muscle"])
    sound = told.LIVING[kind]
    way = {"a rate of the other sign": -0.1, "no rate": 0.0}.get(planted, 1.0)

    def wrong(scene: Any, force: Any) -> Living:
        law = sound(scene, force)
        return replace(law, rate=lambda points, u: way * law.rate(points, u))

    monkeypatch.setitem(told.LIVING, kind, wrong)
    if planted == "another start":
        monkeypatch.setattr(kind, "begins", property(lambda self: 0.299))
    try:
        off = pulled(engine, STEPS[engine])
    except Diverged:  # onto the other branch of Hill's hyperbola
        off = math.inf
    assert off > 1e-4


def test_the_users_callback_comes_back() -> None:
    def mine(model: mujoco.MjModel, data: mujoco.MjData, actuator: int) -> float:
        return 0.0

    mujoco.set_mjcb_act_dyn(mine)
    try:
        pulled("mujoco", 2e-3)
        assert mujoco.get_mjcb_act_dyn() is mine
    finally:
        mujoco.set_mjcb_act_dyn(None)
    pulled("mujoco", 2e-3)
    assert mujoco.get_mjcb_act_dyn() is None


@pytest.mark.slow
def test_a_joint_bears_what_a_muscle_leaves() -> None:
    name = "muscle_isometric.rise"
    scene, start = begun(name)
    known = scenes.solved(name).trajectory.reactions["glue.fy"]
    found = moved(
        TUNED["mujoco"], scene, start, CASES[name].times, 5e-4,
        realised="law", reactions=("glue.fy", U),
    )  # fmt: skip
    assert np.max(np.abs(found.reactions["glue.fy"] - known)) < 1e-5
