"""What begins on a sample, or just before one: there is no size yet, and no step leads there."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.reference.motion import follow as following
from textmech.reference.motion.follow import follow
from textmech.reference.motion.stuck import Stuck
from textmech.reference.solve import mechanism, solve

G, RAMP = 9.80665, 1.0  # m/s², N/s
SCENE = """\
title: A block that a ramp sets off on a sample
scene:
  bodies: {{block: {{particle: {{mass: 1}}}}}}
  contacts: {{foot: {{between: [block, ground.floor], friction: {mu!r}}}}}
  forces: {{pull: {{push: block.center, ramp: [{ramp}, 0]}}}}
initial: {{block: {{x: 0, y: 0}}}}
duration: 6
samples: {samples}
allow: {{block.x: 0.01, block.vx: 0.01}}
"""


def block(tmp_path: Path, early: float, samples: int, ramp: float = -RAMP) -> Case:
    """It is set off at 3 s, or so much earlier [s]."""
    text = SCENE.format(mu=(3.0 - early) * RAMP / G, ramp=ramp, samples=samples)
    path = tmp_path / "block.yaml"
    path.write_text(text)
    (case,) = scenes.load(path)
    return case


@pytest.mark.slow
@pytest.mark.parametrize("early", [0.0, 6.7e-16, 6e-15, 3e-14, 2e-13, -2e-13, 1e-11, 6e-10, 1e-7])
@pytest.mark.parametrize(("samples", "ramp"), [(61, -1.0), (5, 1.0)])
def test_a_block_that_is_set_off_at_a_sample(
    early: float, samples: int, ramp: float, tmp_path: Path
) -> None:
    """(2.88) v̇ = b (t − t₀) − μ g + b t₀: x = b (t − t₀)³/6."""
    case = block(tmp_path, early, samples, ramp)
    found = solve(case)
    assert found.holds
    after = np.maximum(0.0, case.times - (3.0 - early))
    x, v = ramp * after**3 / 6, ramp * after**2 / 2
    block_x, *_, vx, _, _ = found.trajectory.states["block"].T
    np.testing.assert_allclose(block_x, x, atol=1e-12)
    np.testing.assert_allclose(vx, v, atol=1e-12)


@pytest.mark.mutant("a step from an event to the sample that comes at once")
def test_a_step_of_rounding_is_no_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = block(tmp_path, 3e-14, 5)
    monkeypatch.setattr(following, "on_sample", lambda t, samples: t)
    with pytest.raises(Stuck):
        follow(mechanism(case), case.times)
