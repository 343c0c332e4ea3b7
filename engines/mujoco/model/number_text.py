"""Numbers and sections as MJCF writes them."""

from collections.abc import Iterable, Mapping
from xml.etree import ElementTree as ET

from ....cases.scene.rotation import Vector3

Softness = Mapping[str, str]
"""The attributes of one soft constraint, as a setting has them."""


def written(*values: object) -> str:
    """Numbers so that they come back bit for bit; lists separated by blanks."""
    flat = [x for value in values for x in (value if isinstance(value, list | tuple) else [value])]
    return " ".join(repr(float(x)) if isinstance(x, float) else str(x) for x in flat)


def lifted(vector: Iterable[float]) -> Vector3:
    """A vector of the plane in MuJoCo's space, whose xy plane that is; one of space as it is."""
    x, y, *z = vector
    return x, y, z[0] if z else 0.0


def attributes(numbers: Mapping[str, object], group: str) -> dict[str, str]:
    """Attributes of one element: of `connect.solref` the `solref`, if the group is `connect`."""
    parts = ((name.rpartition("."), value) for name, value in numbers.items())
    return {
        name: value if isinstance(value, str) else written(value)
        for (where, _, name), value in parts
        if where == group
    }


def soft(numbers: Mapping[str, object], group: str, element: str) -> dict[str, str]:
    """The softness of one element: its group's numbers, and those that it has instead."""
    return attributes(numbers, group) | attributes(numbers, of_one(element))


def of_one(element: str) -> str:
    """The group of what is one contact's or one joint's stops' alone."""
    return f"{EACH}.{element}"


def section(root: ET.Element, name: str) -> ET.Element:
    """The element's section of that name, made where it has none."""
    known = root.find(name)
    return ET.SubElement(root, name) if known is None else known


EACH = "each"
