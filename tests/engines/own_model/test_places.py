"""At which line of its file an element stands: never at a wrong one."""

from pathlib import Path

import pytest
from given.otherwise import otherwise

from textmech.engines.own_model import places as module
from textmech.engines.own_model.model import compiled, compiled_text
from textmech.engines.own_model.places import OBJECT
from textmech.engines.own_model.step_law import with_step

MIXED = """\
<mujoco>
<default><joint armature=".1"/></default>
<worldbody>
<body>
  <body name="hand">
    <joint axis="0 0 1"/>
    <frame><geom size=".1"/></frame>
  </body>
  <joint
     name="elbow" axis="0 1 0"/>
  <geom size=".2"/>
</body>
</worldbody>
<tendon><fixed name="elbow">
  <joint joint="elbow" coef="1"/></fixed></tendon>
<actuator>
  <motor joint="elbow"/>
  <motor name="&lt;b>&#233;" joint="elbow"/>
</actuator></mujoco>"""
FOUND = {
    (OBJECT.mjOBJ_BODY, 1): 4, (OBJECT.mjOBJ_BODY, 2): 5, (OBJECT.mjOBJ_JOINT, 0): 9,
    (OBJECT.mjOBJ_JOINT, 1): 6, (OBJECT.mjOBJ_GEOM, 0): 11, (OBJECT.mjOBJ_GEOM, 1): 7,
    (OBJECT.mjOBJ_TENDON, 0): 14, (OBJECT.mjOBJ_ACTUATOR, 0): 17, (OBJECT.mjOBJ_ACTUATOR, 1): 18,
}  # fmt: skip


def test_elements_with_and_without_names_have_their_lines() -> None:
    """A joint that stands below its body's child is compiled before the child's."""
    own = compiled_text(MIXED)
    assert own.model.jnt_axis.tolist() == [[0, 1, 0], [0, 0, 1]]
    assert own.places.lines == FOUND
    assert own.places.after("x", (OBJECT.mjOBJ_JOINT, 1)) == "x (MJCF:6)"
    assert own.places.after("x", (OBJECT.mjOBJ_JOINT, 2)) == "x"


@pytest.mark.mutant("elements numbered as they stand in the file")
def test_elements_are_numbered_as_the_compiler_does() -> None:
    wrong = otherwise(module, "sorted(elements, key=lambda element: element[0])", "elements")
    own = compiled_text(MIXED)
    assert own.places.lines[OBJECT.mjOBJ_GEOM, 0] == 11
    assert wrong.places(own.model, own.xml, "").lines[OBJECT.mjOBJ_GEOM, 0] == 7


@pytest.mark.parametrize(
    ("was", "now"),
    [
        ("<frame><geom", '<replicate count="1"><geom'),
        ("<worldbody>", '<worldbody><include file="more.xml"/>'),
    ],
)
def test_what_is_made_leaves_only_names(tmp_path: Path, was: str, now: str) -> None:
    (tmp_path / "more.xml").write_text('<mujoco><geom size=".3"/></mujoco>')
    text = MIXED.replace(was, now)
    text = text.replace("</frame>", "</replicate>") if "replicate" in now else text
    file = tmp_path / "robot.xml"
    file.write_text(text)
    lines = compiled(str(file)).places.lines
    named = {OBJECT.mjOBJ_BODY: 2, OBJECT.mjOBJ_JOINT: 0, OBJECT.mjOBJ_TENDON: 0}
    expected = {key: FOUND[key] for key in named.items()}
    assert lines == expected | {(OBJECT.mjOBJ_ACTUATOR, 1): 18}


@pytest.mark.mutant("a line of what another file holds")
def test_a_file_that_includes_gives_the_nameless_no_line(tmp_path: Path) -> None:
    """Each file holds one joint, and the compiled model two: both from files, one from here."""
    (tmp_path / "more.xml").write_text(
        "<mujoco><worldbody><body><joint/><geom size='1'/></body></worldbody></mujoco>"
    )
    file = tmp_path / "robot.xml"
    file.write_text('<mujoco>\n<include file="more.xml"/>\n<default><joint/></default></mujoco>')
    assert compiled(str(file)).places.lines == {}


def test_a_urdf_is_known_by_its_names(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text("""<robot name="arm"><link name="base"/>
<link name="hand"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="turn" type="continuous"><parent link="base"/><child link="hand"/>
</joint><transmission name="t"><joint name="turn"/></transmission></robot>""")
    lines = compiled(str(file)).places.lines
    assert lines[OBJECT.mjOBJ_JOINT, 0] == 4
    assert lines[OBJECT.mjOBJ_BODY, 1] == 2


def test_options_that_stand_once_have_their_line() -> None:
    option = '<option density="1"/>\n<option viscosity="1">\n<flag sleep="enable"/></option>'
    own = compiled_text(MIXED.replace("<default>", f"{option}<default>", 1))
    assert (own.places.lines["density"], own.places.lines["viscosity"]) == (2, 3)
    assert with_step(own) == ["bodies that sleep have the step in their law: option (MJCF:4)"]
    twice = compiled_text(MIXED.replace("<default>", f'{option}<option density="2"/><default>', 1))
    assert "density" not in twice.places.lines


@pytest.mark.parametrize("text", ["<mujoco a='1' a='2'/>", "<mujoco><!-- -- --></mujoco>"])
def test_what_is_no_xml_has_no_lines(text: str) -> None:
    """MuJoCo's own reader takes it."""
    model = compiled_text("<mujoco/>").model
    assert module.places(model, text, "x").lines == {}
    assert module.places(model, None, "x").lines == {}
    assert module.places(model, Path("nowhere.xml"), "x").lines == {}


def test_what_hangs_on_the_step_is_named_with_its_line() -> None:
    text = MIXED.replace('<motor joint="elbow"/>', '<motor joint="elbow" delay=".01" nsample="3"/>')
    assert with_step(compiled_text(text)) == [
        "a delay or history is counted in steps: actuator #0 (MJCF:17)"
    ]
