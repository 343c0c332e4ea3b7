"""What an older release lacks is asked for in one place, and is there what a plain model has."""

import re
from pathlib import Path

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.engines.own_model import numbers, release
from textmech.engines.own_model.model import compiled_text

PLAIN = """\
<mujoco><worldbody><body><joint name="a" axis="0 1 0" stiffness="1" damping="2"/>
<geom size=".1"/></body></worldbody>
<tendon><fixed name="t" stiffness="1"><joint joint="a" coef="1"/></fixed></tendon>
<actuator><motor joint="a"/><position tendon="t" kp="3"/></actuator></mujoco>"""


@pytest.mark.mutant("an old release in which the springs of joints yield")
@pytest.mark.parametrize("name", release.ABSENT)
def test_a_column_that_lacks_is_what_a_plain_model_has(name: str) -> None:
    model = compiled_text(PLAIN).model
    here, absent = release.column(model, name), release.ABSENT[name](model)
    assert here.shape[:1] == absent.shape[:1]
    assert np.all(here == absent)
    old = otherwise(release, '"jnt_plasticadr": _filled("njnt", -1)', '"jnt_plasticadr": _indices')
    if name == "jnt_plasticadr":
        assert old.ABSENT[name](model).tolist() != here.tolist()


@pytest.mark.mutant("an old release whose actuators have all one control")
def test_a_release_that_has_a_column_is_asked() -> None:
    model = compiled_text(PLAIN).model
    old = otherwise(release, '"actuator_ctrladr": _indices', '"actuator_ctrladr": _filled("nu", 0)')
    assert old.ABSENT["actuator_ctrladr"](model).tolist() != [0, 1]
    assert old.column(model, "actuator_ctrladr").tolist() == [0, 1]


def direct(text: str) -> list[str]:
    """The columns that a source reads of the model itself."""
    return re.findall(rf"\.({'|'.join([*release.ABSENT, 'nactuator', 'mj_fullM'])})\b", text)


@pytest.mark.mutant("a column that 3.3.7 lacks is read of the model")
def test_no_other_file_reads_what_a_release_may_lack() -> None:
    room = Path(str(release.__file__)).parent
    sources = {file.name: direct(file.read_text()) for file in room.glob("*.py")}
    del sources["release.py"]
    assert not any(sources.values()), sources
    source = Path(str(numbers.__file__)).read_text()
    assert direct(source.replace("actuators(m)", "m.nactuator")) == ["nactuator"] * 2
