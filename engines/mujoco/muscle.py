"""The inner state of a muscle, as the activation of an actuator that does nothing else."""

from collections.abc import Mapping
from xml.etree import ElementTree as ET

from ...cases.fields.signal import Signal
from ...cases.scene import GROUND
from ...cases.scene.forces.muscle import Contracting

# Set up as near to it as can be, it has a load that it lifts by 84 mm up to 10 mm elsewhere.
ANOTHER = (
    "engine: MuJoCo's muscle is another law: without an element in series, its force falls as a "
    "parabola of its speed"
)
NOTHING = Signal("constant", (0.0,))


def write_muscle(sections: Mapping[str, ET.Element], force: Contracting) -> None:
    """An actuator without gain, whose activation has the rate that our callback gives."""
    ET.SubElement(
        sections["actuator"], "general", name=force.name, site=GROUND, gear="0 0 0 0 0 0",
        dyntype="user", actdim="1", gainprm="0",
    )  # fmt: skip
