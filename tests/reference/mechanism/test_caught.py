"""What a rope or a wall catches, and what then rests: blows of rounding are none."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.refused import refused

from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.mode_selection import Undetermined
from textmech.reference.motion.follow import follow
from textmech.reference.refusal import refusals
from textmech.reference.solve import solve

G, CAUGHT, ROCKS = 9.80665, scenes.tail(1.0, 26), scenes.tail(3.0, 51)

ON_A_ROPE = """\
scene:
  incline: 25 deg
  points: {O: [-2, 0.2]}
  bodies: {lo: {block: {mass: 10, width: 1.5, height: 0.4}}}
  contacts:
    a: {between: [lo.lower_left, ground.floor], friction: MU}
    b: {between: [lo.lower_right, ground.floor], friction: MU}
  forces: {r: {rope: [ground.O, lo.center], length: 2.2}}
initial: {lo: {x: 0, y: 0.2, angle: 0}}
events: {taut: {r.gap: falls to zero}}
allow: {lo.x: 1.0e-3}
"""
AT_A_WALL = """\
scene:
  incline: 10 deg
  planes: {wall: {at: [2, 0], normal: [-1, 0]}}
  bodies: {w: {block: {mass: 3, width: 0.4, height: 0.2}}}
  contacts:
    t: {between: [w.lower_left, ground.floor], friction: 0}
    u: {between: [w.lower_right, ground.floor], friction: 0}
    v: {between: [w.lower_right, ground.wall], friction: 0}
initial: {w: {x: 0, y: 0.1, angle: 0}}
events: {hits: {v.gap: falls to zero}}
allow: {w.x: 1.0e-2}
"""
LAID_DOWN = """\
scene:
  points: {O: [0, 0]}
  bodies: {ball: {particle: {mass: 2}}}
  contacts: {floor: {between: [ball, ground.floor], friction: 0.3}}
  forces: {cord: {rope: [ground.O, ball.center], length: 0.8}}
initial: {ball: {x: 0.48, y: 0.64, vx: 3.2, vy: -2.4}}
events: {lands: {floor.gap: falls to zero}}
allow: {ball.x: 1.0e-2}
"""


@pytest.mark.slow
def test_a_block_on_a_slope_hangs_by_its_rope(tmp_path: Path) -> None:
    """½ g sin β t² = 0.2 m; then F = m g sin β, and each corner has half of m g cos β."""
    case = scenes.typed(tmp_path, ON_A_ROPE.replace("MU", "0"), tail=CAUGHT)
    found = solve(case)
    assert found.holds
    down, across = 10 * G * math.sin(math.radians(25)), 10 * G * math.cos(math.radians(25))
    known = math.sqrt(0.4 * 10 / down)
    assert found.trajectory.switches.tolist() == pytest.approx([known], abs=1e-13)
    last = {name: force[-1] for name, force in found.trajectory.reactions.items()}
    assert last["r.force"] == pytest.approx(down, abs=1e-11)
    assert [last["a.normal"], last["b.normal"]] == pytest.approx([across / 2] * 2, abs=1e-11)
    np.testing.assert_allclose(found.trajectory.states["lo"][-1, 3:], 0.0, atol=1e-14)


@pytest.mark.slow
def test_a_block_rocks_itself_to_rest_at_a_wall(tmp_path: Path) -> None:
    """About its corner r² = 0.05, ω = 0.1 v / (r² + 0.2/12); back on its side it leaves with 0.1 ω.

    In between it turns and slides without loss, so each blow has 0.15 of the one before.
    """
    case = scenes.typed(tmp_path, AT_A_WALL, tail=ROCKS)
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
    assert last["u.normal"] - last["t.normal"] == pytest.approx(2 * lever, abs=1e-11)


@pytest.mark.slow
def test_what_rope_and_friction_hold_together_rests_and_is_not_divided(tmp_path: Path) -> None:
    """It rests, but how much of its weight the rope has depends on what came before."""
    text = ON_A_ROPE.replace("MU", "0.1")
    assert solve(scenes.typed(tmp_path, text, tail=CAUGHT)).holds
    asked = text.replace("1.0e-3}", "1.0e-3, r.force: 1.0e-1}")
    mistake = refused(scenes.typed(tmp_path, asked, tail=CAUGHT))
    assert mistake.where == "allow.r.force"
    down, across = 10 * G * math.sin(math.radians(25)), 10 * G * math.cos(math.radians(25))
    low, high = down - 0.1 * across, down + 0.1 * across
    assert f"r.force: anything from {low:.4g} to {high:.4g} N" in mistake.what


def test_a_rope_is_no_joint(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, ON_A_ROPE.replace("MU", "0"), tail=CAUGHT)
    with pytest.raises(CaseError) as told, refusals(case, scenes.mechanism(case)):
        raise Undetermined("r", "no impulse satisfies the friction law", 0.3)
    (mistake,) = told.value.mistakes
    assert mistake.where == "scene.forces.r"


@pytest.mark.slow
@pytest.mark.mutant("what a blow leaves at no speed taken for thrown up")
def test_what_is_not_thrown_up_taken_for_it_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The corner b would lift off and land in the instant in which the rope tightens."""
    case = scenes.typed(tmp_path, ON_A_ROPE.replace("MU", "0"), tail=CAUGHT)
    sound = landing.impact

    def without_b(M: Any, joints: Any, met: Any, v: Any) -> Any:
        """The same velocities, by a way in which b takes no part."""
        after, states = sound(M, joints, met, v)
        pairs = zip(met, states, strict=True)
        return after, tuple("open" if m.element.name == "b" else s for m, s in pairs)

    monkeypatch.setattr(landing, "impact", without_b)
    assert [e.name for e in follow(scenes.mechanism(case), case.times).events] == ["r tightens"]
    monkeypatch.setattr(landing, "STILL", -1e-9)
    assert len(follow(scenes.mechanism(case), case.times).events) > 1


@pytest.mark.slow
def test_a_rope_that_is_not_pulled_pulls_nothing(tmp_path: Path) -> None:
    """Swung over to the floor: the rope is then just taut along it, and the ball rests."""
    case = scenes.typed(tmp_path, LAID_DOWN, tail=CAUGHT)
    found = solve(case)
    assert found.holds
    assert found.trajectory.reactions["cord.force"][-1] == 0.0
    assert found.trajectory.reactions["floor.normal"][-1] == pytest.approx(2 * G, abs=1e-12)
    assert found.trajectory.states["ball"][-1].tolist() == pytest.approx([0.8, 0, 0, 0, 0, 0])
