"""What an impact must not do: stick by the static cone, or create energy."""

import numpy as np
import pytest
from given import scenes
from given.refused import refused
from given.rod import rod

from textmech.reference.motion.follow import follow

THROWN = """\
scene:
  bodies: {{dot: {{particle: {{mass: 1}}}}}}
  contacts: {{touch: {{between: [dot, ground.floor], friction: {{static: 0.9, kinetic: 0.1}}}}}}
initial: {{dot: {{x: 0, y: 0.5, vx: {vx}, vy: 0}}}}
events: {{lands: {{touch.gap: falls to zero}}}}
allow: {{dot.x: 1.0e-3}}
"""


@pytest.mark.parametrize("share", [0.05, 0.5, 0.85])
def test_an_impulse_sticks_by_the_kinetic_cone(tmp_path, share: float):
    """(2.87) v_x loses μ v_y in the impact, not all that the static friction 0.9 would hold."""
    down = np.sqrt(9.80665)
    case = scenes.typed(tmp_path, THROWN.format(vx=share * down))
    [landing, *_] = follow(scenes.mechanism(case), case.times).changes
    left = max(share - 0.1, 0.0) * down
    np.testing.assert_allclose(landing.after[2], left, atol=1e-12)
    assert landing.mode_after == ("touch slides +" if left else "touch sticks")


@pytest.mark.parametrize("vx", [0.3, 0.6])
def test_an_impact_that_would_create_energy_is_refused(tmp_path, vx: float):
    """v_n⁺ = −v_n⁻ and a tip that friction stops: what turns the bar to do so is work of nobody."""
    mistake = refused(rod(tmp_path, y=0.05, e=1, mu=3, vx=vx))
    assert mistake.where == "scene.contacts.tip.friction"
    assert mistake.what.endswith("s the impact would create energy")
