"""Cases that switch: certified against hand-written systems, closed forms, and mutants by name."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes, sliding_scenes

from textmech.cases.case import Case, Event
from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.generated import choosing, impact, landing, mechanism
from textmech.reference.generated import element as contact_modes
from textmech.reference.generated.contact import Coulomb
from textmech.reference.generated.element import State, Touching, sign
from textmech.reference.motion.follow import follow
from textmech.reference.solve import Solution, solve
from textmech.reference.system import Only
from textmech.reference.systems.smooth_friction import SmoothGrowingForce

G = 9.80665
ROD = """\
scene:
  bodies: {{rod: {{bar: {{mass: 1, length: 1}}}}}}
  contacts: {{tip: {{between: [rod.start, ground.floor], friction: {mu}, restitution: {e}}}}}
initial: {{rod: {{start: [0, {y}], angle: 60 deg, vx: {vx}, vy: {vy}, omega: 0}}}}
allow: {{rod.y: 1.0e-3, rod.angle: 1.0e-3}}
"""
WITHOUT_CHANGES = ("too steep", "example 2.3 smooth", "example 2.4 smooth")
SLIP = {"slips": Event("guide.slip", "leaves zero")}  # a record is kept where there are events
FALLS = "events: {lands: {tip.gap: falls to zero}}\n"


def case(tmp_path: Path, name: str) -> Case:
    text, end = sliding_scenes.written(name)
    return scenes.typed(tmp_path, text, tail=end)


def generated(tmp_path: Path, name: str) -> Solution:
    """The same scene answered by the generated mechanism alone."""
    text, end = sliding_scenes.written(name)
    text = text.split("\n", 1)[1].replace("drops_out: [m]\n", "")
    typed = scenes.typed(tmp_path, text, tail=end)
    return solve(replace(typed, events=typed.events or SLIP))


def rod(tmp_path: Path, **changed: float) -> Case:
    text = ROD.format(**{"mu": 0, "e": 0, "y": 0, "vx": 0, "vy": 0, **changed})
    text += FALLS if changed.get("y", 0) > 0 else ""
    return scenes.typed(tmp_path, text, tail=sliding_scenes.tail(0.15, 16))


def refused(wrong: Case) -> Mistake:
    with pytest.raises(CaseError) as error:
        solve(wrong)
    (mistake,) = error.value.mistakes
    return mistake


def boundaries(solution: Solution) -> np.ndarray:
    """Times at which the phases of the record meet."""
    record = solution.trajectory.record
    assert record is not None
    assert record.phase is not None
    return record.times[np.flatnonzero(np.diff(record.phase))]


@pytest.mark.parametrize("name", sliding_scenes.WRITTEN)
def test_hand_written_and_generated_answers_agree(tmp_path: Path, name: str) -> None:
    solution = solve(case(tmp_path, name))
    assert [check for check in solution.checks if not check.holds] == []
    names = {check.name for check in solution.checks}
    assert "generated motion" in names
    assert ("generated events" in names) == (name not in WITHOUT_CHANGES)


def test_braking_by_its_closed_form(tmp_path: Path) -> None:
    """(2.87) v₀/(μ g) and v₀²/(2 μ g); stiction above friction changes nothing."""
    solution = generated(tmp_path, "braking")
    assert boundaries(solution) == pytest.approx([3 / (0.3 * G)], abs=1e-12)
    x = solution.trajectory.states["block"][-1, 0]
    assert x == pytest.approx(9 / (2 * 0.3 * G), abs=1e-12)
    assert abs(solution.trajectory.states["block"][-1, 3]) < 1e-15


def test_backspin_by_its_closed_form(tmp_path: Path) -> None:
    """Slip v₀ + R ω₀ falls by 3 μ g: rolling starts with v = (2 v₀ − R ω₀)/3."""
    solution = generated(tmp_path, "backspin")
    v, omega = 3.0, 40.0  # counter-clockwise: it comes back
    assert boundaries(solution) == pytest.approx([(v + 0.25 * omega) / (3 * 0.4 * G)], abs=1e-12)
    assert solution.trajectory.states["wheel"][-1, 3] == pytest.approx((2 * v - 10) / 3, abs=1e-12)


def test_published_times_of_example_2_4(tmp_path: Path) -> None:
    """Six digits: slip, stick, slip, stick."""
    times = boundaries(generated(tmp_path, "example 2.4"))
    assert times == pytest.approx([1.5, 4.790544, 6.290544, 9.581087], abs=1e-6)


def test_events_stand_twice_in_the_record(tmp_path: Path) -> None:
    solution = generated(tmp_path, "elastic")
    record = solution.trajectory.record
    assert record is not None
    assert record.phase is not None
    i = int(np.flatnonzero(np.diff(record.phase))[0])
    assert record.times[i] == record.times[i + 1] == pytest.approx(math.sqrt(2 / G), abs=1e-12)
    before, after = record.states["wheel"][i : i + 2]
    assert after[4] == pytest.approx(-before[4])
    assert before[:3] == pytest.approx(after[:3])


@pytest.mark.parametrize(
    "changed",
    [
        {"mu": 0.6},  # it sticks
        {"mu": 0.1},  # it slips
        {"y": 0.05, "e": 0.7, "mu": 0.3},
        {"y": 0.05, "e": 1},
        {"y": 0.05, "mu": 0.5},
    ],
)
def test_a_bar_on_its_end_is_certified(tmp_path: Path, changed: dict[str, float]) -> None:
    solution = solve(rod(tmp_path, **changed))
    assert [check for check in solution.checks if not check.holds] == []


def test_an_elastic_impact_without_friction_keeps_the_energy(tmp_path: Path) -> None:
    """ω⁺ from v_n⁺ = −e v_n⁻: impulse −2 v_n / (1/m + d_x²/J)."""
    solution = solve(rod(tmp_path, y=0.05, e=1))
    record = solution.trajectory.record
    assert record is not None
    assert record.phase is not None
    i = int(np.flatnonzero(np.diff(record.phase))[0])
    v, J, d = math.sqrt(2 * G * 0.05), 1 / 12, -0.25
    impulse = 2 * v / (1 + d * d / J)
    assert record.states["rod"][i + 1, 4] == pytest.approx(impulse - v, abs=1e-12)
    assert record.states["rod"][i + 1, 5] == pytest.approx(d * impulse / J, abs=1e-11)


def test_painleve_is_refused(tmp_path: Path) -> None:
    """1 + 3 cos² − 3 μ sin cos < 0 from μ = 1.35 on, pushed into the floor: no motion at all."""
    solve(rod(tmp_path, mu=1.3, vx=-1))
    mistake = refused(rod(tmp_path, mu=2, vx=-1))
    assert mistake.where == "scene.contacts.tip.friction"
    assert "no motion satisfies the law (Painlevé's paradox)" in mistake.what


def test_starts_that_are_refused(tmp_path: Path) -> None:
    assert "tip starts 3 mm in the floor" in refused(rod(tmp_path, y=-0.003)).what


def test_a_contact_above_the_floor_has_to_say_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(globals(), "FALLS", "")
    mistake = refused(rod(tmp_path, y=0.01))
    assert mistake.where == "scene.contacts.tip"
    assert "starts 0.01 m above the floor" in mistake.what
    assert "tip starts into the floor, with 1 m/s" in refused(rod(tmp_path, vy=-1)).what
    solve(rod(tmp_path, y=1e-10, mu=0.5))


def test_a_zeno_sequence_ends_with_a_message(tmp_path: Path) -> None:
    text, end = sliding_scenes.written("elastic")
    mistake = refused(scenes.typed(tmp_path, text.replace("e: 1", "e: 0.5"), tail=end))
    assert "Zeno" in mistake.what
    assert mistake.where == "duration"


def failing(tmp_path: Path, name: str) -> set[str]:
    """The checks that do not hold, or `refused`."""
    try:
        return {check.name for check in solve(case(tmp_path, name)).checks if not check.holds}
    except CaseError:
        return {"refused"}


def _coulomb(
    coefficient: Callable[[Touching], float],
) -> Callable[[Touching, State], list[Coulomb]]:
    def coulomb(self: Touching, state: State) -> list[Coulomb]:
        s = sign(state)
        assert self.normal is not None
        return [Coulomb(self.normal, self.tangent, coefficient(self) * s)] if s else []

    return coulomb


def test_mutant_static_for_kinetic(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touching, "coulomb", _coulomb(lambda touch: -touch.static))
    assert {"generated motion", "generated events"} <= failing(tmp_path, "braking")


def test_mutant_sign_of_kinetic_friction(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touching, "coulomb", _coulomb(lambda touch: touch.kinetic))
    assert {"generated motion", "generated events"} <= failing(tmp_path, "braking")


def test_mutant_without_sticking(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (choosing, mechanism):
        monkeypatch.setattr(module, "REST", ("slides +", "slides -"))
    assert failing(tmp_path, "braking")
    assert failing(tmp_path, "backspin")


def test_mutant_restitution_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Dead(impact.Meeting):
        def __init__(self, element, normal, tangent, after, strikes) -> None:  # type: ignore[no-untyped-def]
            super().__init__(element, normal, tangent, 0.0, strikes)

    monkeypatch.setattr(landing, "Meeting", Dead)
    assert {"generated motion", "generated events"} <= failing(tmp_path, "elastic")


def test_mutant_cone_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk on a slope too steep for rolling would roll."""
    monkeypatch.setattr(Touching, "margins", lambda self, forces: (1.0, 1.0))
    assert "generated motion" in failing(tmp_path, "too steep")


def test_mutant_forward_for_backward(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A sign in (2.89): seen where the two bounds differ, not in Example 2.4."""
    margins = contact_modes.Sliding.margins
    monkeypatch.setattr(
        contact_modes.Sliding, "margins", lambda self, forces: margins(self, forces)[::-1]
    )
    assert failing(tmp_path, "drift")


BESIDE = """\
scene:
  points: {O: [0, 0]}
  bodies: {wheel: {disk: {mass: 1.3, radius: 0.25}}, block: {particle: {mass: 1}}}
  joints: {guide: {slide: [ground.O, block.center], along: [1, 0], dry_friction: FRICTION}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.4}}
  forces: {pull: {push: block.center, ramp: [-20.0, 0]}}
initial: {wheel: {x: 0, y: 0.25, angle: 0, vx: -3, omega: -20}, block: {x: 0}}
events: {rolls: {touch.slip: stays zero}}
allow: {wheel.x: 1.0e-3, block.x: 1.0e-3}
"""
SMOOTH = "{static: 6, kinetic: 3, smooth: {band: 5.0e-4, sharpness: 1.0e5}}"


def test_smooth_friction_may_stand_beside_a_contact(tmp_path: Path) -> None:
    """Two bodies that know nothing of each other move as each would alone.

    The disk by its closed form: slip v₀ + R ω₀ = −8 m/s ends after 8/(3 μ g), at −1/3 m/s.
    """
    text = BESIDE.replace("FRICTION", SMOOTH)
    solution = solve(scenes.typed(tmp_path, text, tail=sliding_scenes.tail(1.0, 26)))
    assert [check for check in solution.checks if not check.holds] == []
    assert boundaries(solution) == pytest.approx([8 / (3 * 0.4 * G)], abs=1e-10)
    v = (2 * -3 + 0.25 * 20) / 3
    assert solution.trajectory.states["wheel"][-1, 3] == pytest.approx(v, abs=1e-9)
    alone = SmoothGrowingForce(1.0, 20.0, 3.0, 3.0, 6.0, 6.0, 5e-4, 1e5)
    exact = follow(Only(alone), solution.trajectory.times).y
    assert solution.trajectory.states["block"][:, 0] == pytest.approx(exact[:, 0], abs=1e-9)


AIMED = """\
scene:
  bodies: {ball: {particle: {mass: 1}}}
  contacts: {touch: {between: [ball, ground.floor], friction: 0.3}}
initial: {ball: {x: 0, y: HEIGHT, vx: 1}}
allow: {ball.y: 1.0e-3}
"""


@pytest.mark.parametrize(("height", "lands"), [(2.0, True), (20.0, False)])
def test_a_contact_that_has_not_landed_by_the_end_is_no_mistake(
    tmp_path: Path, height: float, lands: bool
) -> None:
    """It falls 4.9 m in the second that is followed."""
    typed = scenes.typed(tmp_path, AIMED.replace("HEIGHT", repr(height)))
    if lands:
        assert "starts 2 m above the floor" in refused(typed).what
    else:
        assert solve(typed).holds
