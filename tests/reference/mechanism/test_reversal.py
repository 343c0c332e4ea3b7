"""Oil by a root of the speed, where the motion turns back: the slope of its force is infinite."""

from pathlib import Path

import pytest
from given import scenes
from scipy.integrate import quad

from textmech.reference.solve import solve

G, D, M, V = 9.80665, 0.6, 0.5, 3.0
# A bead that is thrown up a rail, and comes back.
THROWN = f"""\
scene:
  points: {{O: [0, 0]}}
  bodies: {{bead: {{particle: {{mass: {M}}}}}}}
  joints: {{guide: {{slide: [ground.O, bead.center], along: [0, 1]}}}}
  forces: {{oil: {{viscous: guide, coefficient: {D}, exponent: EXPONENT}}}}
initial: {{bead: {{y: 0, vy: {V}}}}}
TOPallow: {{bead.y: 1.0e-3}}
"""
TOP = "events: {top: {bead.vy: falls to zero}}\n"


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [0.5, 0.7])
@pytest.mark.parametrize("named", [TOP, ""], ids=["the top is an event", "it is none"])
def test_it_turns_back_where_it_should(exponent: float, named: str, tmp_path: Path) -> None:
    """By separation of variables: dt = −dv/(g + d v^α/m), dy = v dt, and the sign turned below."""
    text = THROWN.replace("EXPONENT", str(exponent)).replace("TOP", named)
    solution = solve(scenes.typed(tmp_path, text, tail=scenes.tail(1.0, 26)))
    assert solution.holds
    rises, _ = quad(lambda v: 1 / (G + D / M * v**exponent), 0, V, epsabs=1e-13)
    height, _ = quad(lambda v: v / (G + D / M * v**exponent), 0, V, epsabs=1e-13)
    motion = solution.trajectory
    if named:
        assert motion.switches == pytest.approx([rises], abs=1e-9)
    y, v = motion.states["bead"][-1, [1, 4]]
    falls, _ = quad(lambda w: 1 / (G - D / M * w**exponent), 0, -v, epsabs=1e-13)
    down, _ = quad(lambda w: w / (G - D / M * w**exponent), 0, -v, epsabs=1e-13)
    assert rises + falls == pytest.approx(1.0, abs=1e-8)
    assert height - down == pytest.approx(y, abs=1e-8)
