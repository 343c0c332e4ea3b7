"""Options as elements of an MJCF file, ready to paste between `<mujoco>` and `</mujoco>`."""

from collections.abc import Sequence
from xml.etree import ElementTree as ET

from ..engine import Choice
from ..knobs import Options
from .script import commented
from .written import EACH, attributes, written

_ELEMENTS = {
    "connect": "equality", "pair": "pair", "slide": "joint", "rope": "tendon", "stop": "joint",
    "rod": "equality",
}  # fmt: skip
"""What stands in <default> for a group of soft constraints."""


def snippet(
    choices: Sequence[Choice], shipped: Sequence[Choice], step: float, notes: Sequence[str]
) -> str:
    """What is not as MuJoCo has it by itself; notes: what no element says."""
    before = {choice.name: choice.value for choice in shipped}
    changed = {c.name: c.value for c in choices if before.get(c.name) != c.value}
    option = ET.Element("option", {"timestep": written(step)} | attributes(changed, "option"))
    if flags := attributes(changed, "flag"):
        ET.SubElement(option, "flag", flags)
    default = ET.Element("default")
    beside: list[str] = []
    for group, element in _ELEMENTS.items():
        if given := attributes(changed, group):
            found = default.find(element)
            place = ET.SubElement(default, element) if found is None else found
            if any(place.get(name, value) != value for name, value in given.items()):
                numbers = ", ".join(f"{name}={value!r}" for name, value in given.items())
                beside.append(f"each {element} of a {group} has {numbers} instead")
            else:
                place.attrib.update(given)
    for name, value in changed.items():
        where, _, attribute = name.rpartition(".")
        if where.startswith(f"{EACH}."):
            beside.append(f"{where.partition('.')[2]} alone has {attribute}={written(value)!r}")
    return "".join(
        [commented([*notes, *beside]), _text(option), _text(default) if len(default) else ""]
    )


def said(options: Options, *, contacts: bool, plane: bool) -> list[str]:
    """What of the options no element says."""
    notes = []
    if contacts and options.get("settled"):
        notes.append("starts as deep in the floor as it is carried there: the keyframe of `show`")
    if contacts and plane and options.get("noslip_iterations"):
        notes.append("noslip does nothing for a body that has no freedom along the third axis")
    return notes


def _text(element: ET.Element) -> str:
    ET.indent(element)
    return ET.tostring(element, encoding="unicode") + "\n"
