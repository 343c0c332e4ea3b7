"""What lands, stands on its end or is caught: the impact law against its terms, and Painlevé."""

import math
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Contact, Scene, shape
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.mode_selection import Undetermined
from textmech.reference.motion.follow import follow
from textmech.reference.refusal import refusals
from textmech.reference.solve import solve

G = 9.80665


def rod(**changed: float) -> Case:
    """A bar that stands on its end, or falls on it, which is announced."""
    falls = "events: {lands: {tip.gap: falls to zero}}" if changed.get("y", 0) > 0 else ""
    return scenes.scene("standing_bar", falls, **changed)


def test_an_elastic_impact_without_friction_keeps_the_energy() -> None:
    """ω⁺ from v_n⁺ = −e v_n⁻: impulse −2 v_n / (1/m + d_x²/J)."""
    solution = solve(rod(y=0.05, e=1))
    record = solution.trajectory.record
    assert record is not None
    assert record.phase is not None
    i = int(np.flatnonzero(np.diff(record.phase))[0])
    v, J, d = math.sqrt(2 * G * 0.05), 1 / 12, -0.25
    impulse = 2 * v / (1 + d * d / J)
    assert record.states["rod"][i + 1, 4] == pytest.approx(impulse - v, abs=1e-12)
    assert record.states["rod"][i + 1, 5] == pytest.approx(d * impulse / J, abs=1e-11)


def test_a_disk_that_lands_turning_rolls_or_slides_by_the_cone() -> None:
    """Coulomb's impulse: it rolls if m |slip| / 3 ≤ μ m |v_n|, else v_x jumps by μ |v_n|."""
    for mu, rolls in ((0.4, True), (0.1, False)):
        disk = shape.disk(name="wheel", mass=1.3, radius=0.25, points={})
        touch = Contact("touch", Anchor("wheel", "center"), mu, mu)
        scene = Scene((0.0, -9.80665), {}, {"wheel": disk}, {}, {"touch": touch}, {})
        start = np.array([0.0, 1.25, 0.0]), np.array([1.0, 0.0, 4.0])
        followed = follow(PlanarMechanism(scene, start, 0.25), np.linspace(0.0, 0.46, 3))
        land = followed.changes[0]
        v_n, slip = math.sqrt(2 * 9.80665), 1.0 + 0.25 * 4.0
        jump = -slip / 3 if rolls else -mu * v_n
        assert land.after[3] - land.before[3] == pytest.approx(jump, abs=1e-12)
        assert land.mode_after == ("touch sticks" if rolls else "touch slides +")


@pytest.mark.slow
def test_painleve_is_refused() -> None:
    """1 + 3 cos² − 3 μ sin cos < 0 from μ = 1.35 on, pushed into the floor: no motion at all."""
    solve(rod(mu=1.3, vx=-1))
    mistake = refused(rod(mu=2, vx=-1))
    assert mistake.where == "scene.contacts.tip.friction"
    assert "no motion satisfies the law (Painlevé's paradox)" in mistake.what


def test_starts_that_are_refused() -> None:
    assert "tip starts 3 mm in the floor" in refused(rod(y=-0.003)).what
    assert "tip starts into the floor, with 1 m/s" in refused(rod(vy=-1)).what


FLOOR = """
scene:
  gravity: 9.80665
  contacts: {floor: {between: [ball, ground.floor], friction: FRICTION}}
events: {lands: {floor.gap: falls to zero}}
"""


@pytest.mark.parametrize("share", [0.05, 0.5])
def test_an_impulse_sticks_by_the_kinetic_cone(share: float):
    """(2.87) v_x loses μ v_y in the impact, not all that the static friction 0.9 would hold."""
    down = np.sqrt(9.80665)
    floor = FLOOR.replace("FRICTION", "{static: 0.9, kinetic: 0.1}")
    case = scenes.scene("free_particle", floor, y=0.5, vx=float(share * down))
    [landing, *_] = follow(scenes.mechanism(case), case.times).changes
    left = max(share - 0.1, 0.0) * down
    np.testing.assert_allclose(landing.after[2], left, atol=1e-12)
    assert landing.mode_after == ("floor slides +" if left else "floor sticks")


def test_an_impact_that_would_create_energy_is_refused() -> None:
    """v_n⁺ = −v_n⁻ and a tip that friction stops: what turns the bar to do so is work of nobody."""
    mistake = refused(rod(y=0.05, e=1, mu=3, vx=0.3))
    assert mistake.where == "scene.contacts.tip.friction"
    assert mistake.what.endswith("s the impact would create energy")


ON_A_ROPE = """
scene:
  incline: 25 deg
  points: {O: [-2, 0.2]}
  forces: {cord: {rope: [ground.O, b.center], length: 2.2}}
events: {taut: {cord.gap: falls to zero}}
allow:
  b.y: null
  b.x: 1.0e-3
"""
AT_A_WALL = f"""
scene:
  incline: 10 deg
  planes: {{wall: {{at: [2, 0], normal: [-1, 0]}}}}
  contacts: {{v: {{between: [b.lower_right, ground.wall], friction: 0}}}}
events: {{hits: {{v.gap: falls to zero}}}}
allow: {{b.y: null, b.x: 1.0e-2}}
{scenes.tail(3.0, 51)}
"""


def hung(mu: float, asked: str = "") -> Case:
    """A block that slides down a slope until a rope catches it."""
    return scenes.scene("block_over_floor", ON_A_ROPE + asked, m=10, w=1.5, h=0.4, y=0.2, mu=mu)


@pytest.mark.slow
def test_a_block_on_a_slope_hangs_by_its_rope() -> None:
    """½ g sin β t² = 0.2 m; then F = m g sin β, and each corner has half of m g cos β."""
    found = solve(hung(0))
    assert found.holds
    down, across = 10 * G * math.sin(math.radians(25)), 10 * G * math.cos(math.radians(25))
    known = math.sqrt(0.4 * 10 / down)
    assert found.trajectory.switches.tolist() == pytest.approx([known], abs=1e-13)
    last = {name: force[-1] for name, force in found.trajectory.reactions.items()}
    assert last["cord.force"] == pytest.approx(down, abs=1e-11)
    assert [last["l.normal"], last["r.normal"]] == pytest.approx([across / 2] * 2, abs=1e-11)
    np.testing.assert_allclose(found.trajectory.states["b"][-1, 3:], 0.0, atol=1e-14)


@pytest.mark.slow
def test_a_block_rocks_itself_to_rest_at_a_wall() -> None:
    """About its corner r² = 0.05, ω = 0.1 v / (r² + 0.2/12); back on its side it leaves with 0.1 ω.

    In between it turns and slides without loss, so each blow has 0.15 of the one before.
    """
    case = scenes.scene("block_over_floor", AT_A_WALL, m=3, w=0.4)
    found = solve(case)
    assert found.holds
    hits = [e for e in follow(scenes.mechanism(case), case.times).events if e.name == "v lands"]
    down = G * math.sin(math.radians(10))
    assert hits[0].time == pytest.approx(math.sqrt(2 * 1.8 / down), abs=1e-12)
    speeds = np.array([e.before[3] for e in hits])
    assert len(speeds) > 5
    falls = 0.1 * 0.1 / (0.05 + 0.2 / 12)
    known = math.sqrt(2 * 1.8 * down) * falls ** np.arange(len(speeds))
    np.testing.assert_allclose(speeds, known, rtol=1e-9, atol=1e-11)
    last = {name: force[-1] for name, force in found.trajectory.reactions.items()}
    assert last["v.normal"] == pytest.approx(3 * down, abs=1e-11)
    lever = 3 * down * 0.1 / 0.4  # the wall pushes at the height of the floor
    assert last["r.normal"] - last["l.normal"] == pytest.approx(2 * lever, abs=1e-11)


@pytest.mark.slow
def test_what_rope_and_friction_hold_together_rests_and_is_not_divided() -> None:
    """It rests, but how much of its weight the rope has depends on what came before."""
    assert solve(hung(0.1)).holds
    mistake = refused(hung(0.1, "  cord.force: 1.0e-1\n"))
    assert mistake.where == "allow.cord.force"
    down, across = 10 * G * math.sin(math.radians(25)), 10 * G * math.cos(math.radians(25))
    low, high = down - 0.1 * across, down + 0.1 * across
    assert f"cord.force: anything from {low:.4g} to {high:.4g} N" in mistake.what


def test_a_rope_is_no_joint() -> None:
    case = hung(0)
    with pytest.raises(CaseError) as told, refusals(case, scenes.mechanism(case)):
        raise Undetermined("cord", "no impulse satisfies the friction law", 0.3)
    (mistake,) = told.value.mistakes
    assert mistake.where == "scene.forces.cord"


@pytest.mark.slow
@pytest.mark.mutant("what a blow leaves at no speed taken for thrown up")
def test_what_is_not_thrown_up_taken_for_it_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The right corner would lift off and land in the instant in which the rope tightens."""
    case = hung(0)
    sound = landing.impact

    def without_it(M: Any, joints: Any, met: Any, v: Any) -> Any:
        """The same velocities, by a way in which that takes no part."""
        after, states = sound(M, joints, met, v)
        pairs = zip(met, states, strict=True)
        return after, tuple("open" if m.element.name == "r" else s for m, s in pairs)

    monkeypatch.setattr(landing, "impact", without_it)
    assert [e.name for e in follow(scenes.mechanism(case), case.times).events] == ["cord tightens"]
    monkeypatch.setattr(landing, "STILL", -1e-9)
    assert len(follow(scenes.mechanism(case), case.times).events) > 1


@pytest.mark.slow
def test_a_rope_that_is_not_pulled_pulls_nothing() -> None:
    """Swung over to the floor: the rope is then just taut along it, and the ball rests."""
    rope = "scene:\n  forces: {cord: {rope: [ground.O, ball.center], length: 0.8}}"
    floor = FLOOR.replace("FRICTION", "0.3").replace("scene:", rope)
    case = scenes.scene("free_particle", floor, m=2, x=0.48, y=0.64, vx=3.2, vy=-2.4)
    found = solve(case)
    assert found.holds
    assert found.trajectory.reactions["cord.force"][-1] == 0.0
    assert found.trajectory.reactions["floor.normal"][-1] == pytest.approx(2 * G, abs=1e-12)
    assert found.trajectory.states["ball"][-1].tolist() == pytest.approx([0.8, 0, 0, 0, 0, 0])
