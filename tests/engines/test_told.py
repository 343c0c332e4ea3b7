"""Forces that engines have no element for: by our laws, against the reference and typed values."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes, slowed
from given.planning import SHIPPED, TUNED, moved, refused, ways

from textmech.cases.case import Case
from textmech.cases.scene import Anchor, Bounds, Drag, LinearMuscle, Magnetic, Muscle, Viscous
from textmech.cases.trajectory import Trajectory
from textmech.engines import point_forces as told
from textmech.engines.engine import Start
from textmech.engines.point_forces import Place, law_of, living
from textmech.reference.solve import solve

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


def apart(engine: str, known: tuple[Case, Trajectory, Start], h: float) -> float:
    case, motion, start = known
    found = moved(TUNED[engine], case.scene, start, case.times, h, realised="law")
    return max(
        float(np.max(np.abs(found.states[body][:, :3] - rows[:, :3])))
        for body, rows in motion.states.items()
    )


@pytest.mark.slow
@pytest.mark.parametrize("engine", STEP)
def test_engines_move_as_the_reference(engine: str, known: tuple[Case, Trajectory, Start]) -> None:
    assert apart(engine, known, STEP[engine]) < REACHED[engine]


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
        assert apart(engine, known, STEP[engine]) > 1e-3


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
