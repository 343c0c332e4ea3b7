"""A run is compared with the plain loop of the same motion, and with no other."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from given.planning import CASES, EVERY, SHIPPED, TUNED, planned

from bench.adapters import LOOPS, Amount, Pair, one_of_each_file, rows
from bench.plain import Begin
from textmech.cases.case import Case
from textmech.cases.fields.friction import Bounds
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Diverged, Engine, Plan, Refusal, Start

FEW = Amount(steps=4, samples=5, rounds=1)


def briefly(name: str, duration: float) -> Case:
    return replace(CASES[name], duration=duration)


@pytest.mark.parametrize("engine", [*SHIPPED.values(), *TUNED.values()], ids=str)
@pytest.mark.parametrize("name", ["four_bar", "rolling_wheel.pushed", "towed_pendulum"])
def test_a_plain_loop_makes_the_adapters_motion(name: str, engine: Engine) -> None:
    """To the last bits: it takes the same steps."""
    (row,) = [r for r in rows(briefly(name, 0.02), [engine], FEW) if r.realised == "native"]
    assert row.apart < 1e-12
    assert not row.because
    assert row.samples
    assert row.recorded
    assert row.building


LAWS = [
    ("growing_force", "mujoco", {"law"}),  # breaks loose at 6 s
    ("growing_force", "pymunk", {"law"}),
    ("spring_mass_damper.underdamped", "pymunk", {"law"}),
    ("stribeck_brake.thrown", "mujoco", {"law"}),  # which moves from the start on
    ("stribeck_brake.thrown", "pymunk", {"law"}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "engine", "ways"), LAWS)
def test_the_force_of_the_present_instant_is_of_first_order(
    name: str, engine: str, ways: set[str]
) -> None:
    found = rows(CASES[name], [TUNED[engine]], replace(FEW, steps=200))
    told = [row for row in found if row.realised != "native"]
    assert {row.realised for row in told} == ways
    for row in told:
        assert not row.because
        assert row.apart < 0.05


def test_a_plain_loop_may_step_over_a_jump_of_a_force() -> None:
    """A stage of RK4 sees it or not: of first order."""
    (row,) = rows(CASES["pushed_cart.pulse"], [TUNED["mujoco"]], replace(FEW, steps=200))
    assert row.samples
    assert 1e-6 < row.apart < 0.05


HEAVIER = 1.001
LOOSER = 0.9


def heavier(scene: Scene) -> Scene:
    x, y = scene.gravity
    return replace(scene, gravity=(x, HEAVIER * y))


def looser(scene: Scene) -> Scene:
    guide = scene.joints["guide"]
    assert guide.dry_friction
    static = Bounds(*(LOOSER * bound for bound in (guide.dry_friction.static.forward,) * 2))
    dry = replace(guide.dry_friction, static=static)
    return replace(scene, joints={"guide": replace(guide, dry_friction=dry)})


def with_plain_loop(patch: pytest.MonkeyPatch, name: str, other: Callable[[Scene], Scene]) -> None:
    """Lets the plain loop of an engine be of another scene."""
    loop = LOOPS[name]

    def plain(engine: Engine, scene: Scene, start: Start, step: float, plan: Plan) -> Begin | None:
        changed = other(scene)
        return loop(engine, changed, start, step, planned(engine, changed, start, plan.realised))

    patch.setitem(LOOPS, name, plain)


@pytest.mark.mutant("plain loop of {name} with another gravity")
@pytest.mark.parametrize("name", TUNED)
def test_another_motion_is_not_compared(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with_plain_loop(monkeypatch, name, heavier)
    (row,) = rows(briefly("four_bar", 0.2), [TUNED[name]], FEW)
    assert row.differs
    assert row.because == "the plain loop makes another motion"
    assert row.apart > 1e-6
    assert row.samples is None


@pytest.mark.slow
@pytest.mark.mutant("plain loop of {name} with another stiction")
@pytest.mark.parametrize("name", TUNED)
def test_nor_is_another_law(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It breaks loose earlier, at any step."""
    with_plain_loop(monkeypatch, name, looser)
    found = rows(CASES["growing_force"], [TUNED[name]], replace(FEW, steps=200))
    told = [row for row in found if row.realised != "native"]
    assert told
    assert all(row.differs for row in told)


@pytest.mark.parametrize(
    ("name", "way"), [("dynamometer_smooth", "law"), ("compass_walker", "driver")]
)
def test_what_has_no_plain_loop_says_so(name: str, way: str) -> None:
    """A law that no line says, and steps that are cut, which the script's are not."""
    found = list(rows(briefly(name, 0.1), [TUNED["pymunk"]], FEW))
    unwritten = [r.realised for r in found if r.because and "refused" not in r.because]
    assert unwritten == [way]
    assert not any(row.differs for row in found)


class Refusing:
    """An engine that cannot."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine

    def __getattr__(self, name: str) -> Any:
        return getattr(self.engine, name)

    def plans(self, scene: Scene, start: Start) -> Any:
        return [Refusal("native", "engine: no joints")]


class Torn(Refusing):
    """An engine that flies apart."""

    def plans(self, scene: Scene, start: Start) -> Any:
        return self.engine.plans(scene, start)

    def run(self, *given: Any, **named: Any) -> Trajectory:
        raise Diverged("not finite from t = 0.1 s on")


@pytest.mark.parametrize(
    ("kind", "said"),
    [(Refusing, "refused: engine: no joints"), (Torn, "not finite from t = 0.1 s on")],
)
def test_what_cannot_be_run_is_a_row_that_says_so(kind: type[Refusing], said: str) -> None:
    engine: Any = kind(SHIPPED["pymunk"])
    (row,) = rows(briefly("four_bar", 0.2), [engine], FEW)
    assert row.because == said
    assert not row.differs


@pytest.mark.parametrize("name", ["four_bar", "growing_force"])  # with gravity, and without
def test_no_round_finds_its_scene_built(name: str) -> None:
    case, engine = CASES[name], SHIPPED["mujoco"]
    pair = Pair(case, {}, engine, Plan("native", held=(1,)), FEW)
    seen = [pair.unseen(k).gravity for k in range(5)]
    assert len({case.scene.gravity, *seen}) == 6
    for x, y in seen:
        assert (x, y) == pytest.approx(case.scene.gravity, rel=1e-14, abs=1e-200)


@pytest.mark.slow
def test_every_shipped_file_is_measured_once() -> None:
    files = [case.source.file for case in one_of_each_file()]
    assert len(files) == len(set(files))
    assert set(files) == {case.source.file for case in EVERY.values()}
