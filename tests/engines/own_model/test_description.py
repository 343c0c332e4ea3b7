"""What a model is, in tables: by its own numbers, whatever its names are and whatever it lacks."""

import pytest
from given.otherwise import otherwise

from textmech.engines.own_model import description as module
from textmech.engines.own_model.description import constraints, identity, joints, motors, options
from textmech.engines.own_model.model import compiled_text

ARM = """\
<mujoco model="arm"><option iterations="7" noslip_iterations="2"><flag gravity="disable"
  energy="enable"/></option>
<worldbody><geom type="plane" size="1 1 1"/>
<body name="base" mocap="true"><geom size=".1" mass="0" contype="0" conaffinity="0"/></body>
<body name="arm"><joint name="arm" axis="0 1 0" range="-90 45" stiffness="3" springref="30"
  actuatorfrcrange="-7 8"/><geom size=".1" mass="1"/>
<body><joint type="slide" axis="1 0 0" range="-.1 .2" damping="2"/><geom size=".1" mass="2"/>
<body name="-1+1"><joint name="b" type="ball" range="0 60" armature=".1" frictionloss=".3"/>
  <geom size=".1" mass="3"/></body></body></body></worldbody>
<tendon><fixed name="arm"><joint joint="arm" coef="1"/></fixed></tendon>
<actuator><position name="arm" joint="arm" kp="20" kv="2" ctrlrange="-1 2" forcerange="-5 5"/>
<velocity joint="arm" kv="3"/><motor tendon="arm" gear="50"/>
<general name="g" body="arm" gainprm="2" biastype="affine" biasprm="1 -2 0"/>
<general name="f" joint="arm" dyntype="filter" dynprm=".1" gainprm="4"/></actuator>
<equality><joint joint1="arm"/></equality>
<keyframe><key name="home" qpos=".5 .1 1 0 0 0" qvel="0 .3 0 0 0" ctrl="1 0 0 0 0"/></keyframe>
</mujoco>"""
JOINTS = [
    ["joint", "kind", "body", "range", "damping", "armature", "frictionloss", "spring",
     "motors' force", "start", "rate"],
    ["arm", "hinge", "arm", "-1.571 to 0.7854 rad", "", "", "", "3 about 0.5236 rad", "-7 to 8",
     "0.5 rad", "0"],
    ["joint 1", "slide", "body 3", "-0.1 to 0.2 m", "2", "", "", "", "", "0.1 m", "0.3"],
    ["b", "ball", "'-1+1'", "0 to 1.047 rad", "", "0.1", "0.3", "", "", "1 0 0 0", "0 0 0"],
]  # fmt: skip
MOTORS = [
    ["actuator", "drives", "law", "gear", "control range", "force range", "control"],
    ["arm", "joint arm", "kp 20, kv 2", "", "-1 to 2", "-5 to 5", "1"],
    ["actuator 1", "joint arm", "kv 3", "", "", "", "0"],
    ["actuator 2", "tendon arm", "motor", "50", "", "", "0"],
    ["g", "body arm", "gain 2, bias 1 -2 0", "", "", "", "0"],
    ["f", "joint arm", "gain 4, filter dynamics", "", "", "", "0"],
]


def test_a_model_is_described_by_its_numbers() -> None:
    own = compiled_text(ARM)
    assert joints(own) == JOINTS
    assert motors(own) == MOTORS
    assert options(own.model) == [
        "timestep 0.002", "integrator Euler", "cone pyramidal", "solver Newton", "iterations 7",
        "tolerance 1e-08", "gravity disabled", "energy enabled", "noslip_iterations 2",
    ]  # fmt: skip
    assert identity(own.model) == [
        "'arm'", "6 kg", "geoms: 5 (4 may touch)", "equalities: 1 (1 joint)",
        "tendons: 1 (1 fixed)", "mocap bodies: 1", "keyframes: 1",
    ]  # fmt: skip
    assert constraints(own.model) == ["contacts", "limits", "friction losses", "equalities"]


@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize(
    ("mistake", "was", "now"),
    [
        ("the range of another joint", "m.jnt_range[j]", "m.jnt_range[j - 1]"),
        ("a range in degrees", "m.jnt_range[j]", "np.degrees(m.jnt_range[j])"),
        ("the damping of another joint", "values[v:v_end]", "values[v + 1 : v_end + 1]"),
        ("the start of another joint", "start.qpos[q:q_end]", "start.qpos[j : j + 1]"),
    ],
)
def test_a_number_of_another_is_seen(mistake: str, was: str, now: str) -> None:
    assert otherwise(module, was, now).joints(compiled_text(ARM)) != JOINTS


def test_what_has_nothing_has_no_table() -> None:
    own = compiled_text("<mujoco/>")
    assert joints(own) == motors(own) == [[]]
    assert constraints(own.model) == []
    assert identity(own.model) == ["'MuJoCo Model'", "0 kg"]


def test_a_free_joint_has_all_its_numbers() -> None:
    free = '<mujoco><worldbody><body pos="1 2 3"><freejoint/><geom size="1"/></body></worldbody>'
    own = compiled_text(f'{free}<keyframe><key qvel="0 0 0 0 0 .5"/></keyframe></mujoco>')
    head, row = joints(own)
    assert dict(zip(head, row, strict=True)) == {
        "joint": "joint 0", "kind": "free", "body": "body 1", "start": "1 2 3 1 0 0 0",
        "rate": "0 0 0 0 0 0.5",
    }  # fmt: skip


def test_what_is_disabled_constrains_nothing() -> None:
    for flag, word in (("contact", "contacts"), ("equality", "equalities"), ("limit", "limits")):
        text = ARM.replace('gravity="disable"', f'{flag}="disable"')
        assert word not in constraints(compiled_text(text).model)
    text = ARM.replace('gravity="disable"', 'constraint="disable"')
    assert constraints(compiled_text(text).model) == []
