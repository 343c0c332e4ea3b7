"""What a run of a model's own steps shows: shakes, forces at their limits, energy."""

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.engines.own_model import signs as module
from textmech.engines.own_model.limit import limit
from textmech.engines.own_model.model import compiled_text
from textmech.engines.own_model.signs import Signs, signs

TIMES = np.linspace(0.0, 1.0, 26)

SERVO = """\
<mujoco><option timestep="0.002" integrator="implicitfast"/><worldbody><body>
<joint name="wrist" axis="0 1 0" damping="1"/><geom size=".02" pos=".05 0 0" mass=".02"/>
</body></worldbody>
<actuator><position name="servo" joint="wrist" kp="1000" kv="100" forcerange="-20 20"/></actuator>
<keyframe><key qpos="0" ctrl=".3"/></keyframe></mujoco>"""
"""M_eff is 5e-5 kg m² and kv h / M_eff 4000: explicit at its force limit, it never arrives."""

SWINGING = """\
<mujoco><option timestep="0.002"/><worldbody><body><joint name="swings" axis="0 1 0"/>
<geom size=".1" pos=".5 0 0" mass="1"/></body></worldbody>
<keyframe><key qpos="0"/></keyframe></mujoco>"""

SLIDING = """\
<mujoco><option timestep="0.002" gravity="0 0 0"/><worldbody><body>
<joint name="slides" type="slide" axis="1 0 0"{joint}/><geom size=".1" mass="1"/></body></worldbody>
<tendon><fixed name="string"{tendon}><joint joint="slides" coef="1"/></fixed></tendon>
<actuator><{actuator}/></actuator><keyframe><key qpos="0" ctrl="5"/></keyframe></mujoco>"""


def seen(text: str, by: object = module) -> Signs:
    own = compiled_text(text)
    result = by.signs(own, limit(own, TIMES), 1.0, np.full(own.model.nv, 1e-3))  # type: ignore[attr-defined]
    assert result is not None
    return result


def test_a_servo_at_its_force_limit_shakes() -> None:
    shown = seen(SERVO)
    assert list(shown.shakes) == [0]
    assert shown.shakes[0].rate > 1.0
    assert shown.at_limit["servo"] > 0.9
    calm = seen(SERVO.replace("<joint ", '<joint armature=".01" '))
    assert not calm.shakes
    assert calm.at_limit["servo"] < 0.2


MOTOR = 'motor name="motor" joint="slides"'
PULL = 'motor name="pull" tendon="string"'


@pytest.mark.parametrize(
    ("joint", "tendon", "actuator", "name", "share"),
    [
        ("", "", f'{MOTOR} forcerange="-3 3"', "motor", 1.0),
        ("", "", f'{MOTOR} forcerange="-3 6"', "motor", None),
        (' actuatorfrcrange="-3 3"', "", MOTOR, "slides", 1.0),
        (' actuatorfrcrange="-6 6"', "", MOTOR, "slides", None),
        ("", ' actuatorfrcrange="-3 3"', PULL, "string", 1.0),
        ("", ' actuatorfrcrange="-6 6"', PULL, "string", None),
        ("", "", f'{MOTOR} ctrllimited="true" ctrlrange="-1 0" forcerange="0 3"', "motor", None),
    ],
)
def test_a_force_is_at_its_limit(
    joint: str, tendon: str, actuator: str, name: str, share: float | None
) -> None:
    """Of an actuator, of all those of a joint, and of a tendon; what rests at 0 is at no limit."""
    shown = seen(SLIDING.format(joint=joint, tendon=tendon, actuator=actuator))
    assert shown.at_limit.get(name) == share
    assert not shown.shakes


@pytest.mark.mutant("an energy against the wrong motion")
def test_energy_is_lost_by_the_step() -> None:
    """A pendulum that falls by half a metre and swings up again; Euler's loss is of order 1."""
    lost = seen(SWINGING).lost
    assert lost.kinetic == pytest.approx(9.81 * 0.5, rel=0.01)
    assert lost.by[0] == 0.0
    assert 1e-4 < np.abs(lost.by).max() < 0.05
    finer = seen(SWINGING.replace("0.002", "0.0005")).lost
    assert np.abs(finer.by).max() == pytest.approx(np.abs(lost.by).max() / 4, rel=0.1)
    same = otherwise(module, "for each in (exact, y))", "for each in (exact, exact))")
    assert not np.any(seen(SWINGING, same).lost.by)


def test_what_diverges_shows_nothing() -> None:
    own = compiled_text(SERVO.replace("implicitfast", "Euler").replace(' forcerange="-20 20"', ""))
    assert signs(own, limit(own, TIMES), 1.0, np.full(1, 1e-3)) is None
