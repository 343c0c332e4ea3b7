"""A claim about states: unrelated places, rates and accelerations of every coordinate, at random.

Its quantities are those of bodies and points, what moves them, and how they resist: nothing moves
from one state to the next.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

import numpy as np

from ..fields.kind import WORK, Fields, Kind
from ..trajectory import Array
from . import Scene
from .frame import SPACE
from .point import CENTER
from .quantity import Quantity, table

Span = tuple[float, float]

MASS_MATRIX = "mass_matrix"
_OF_STATES: tuple[Kind, ...] = ("coordinate", "velocity", "energy", "momentum")


@dataclass(frozen=True)
class States:
    """So many states, each of whose numbers is drawn evenly from its span [SI]."""

    random: int
    seed: int
    q: Span
    q_dot: Span
    q_ddot: Span

    def drawn(self, scene: Scene) -> dict[str, Array]:
        """(N, 3) by coordinate: its places, rates and accelerations.

        By Python's generator, whose numbers no version changes. Each coordinate has one of its own,
        begun by its name: where it stands in the file, and what else does, is no part of them.
        """
        low, high = np.transpose([self.q, self.q_dot, self.q_ddot])
        return {name: low + (high - low) * self._parts(name) for name in coordinates(scene)}

    def _parts(self, name: str) -> Array:
        """(N, 3) numbers from 0 to 1."""
        random = Random(f"{self.seed} {name}")
        return np.array([random.random() for _ in range(3 * self.random)]).reshape(-1, 3)


def coordinates(scene: Scene) -> dict[str, str]:
    """The unit of each coordinate: x, y and angle of the plane's bodies, freedoms of joints."""
    if scene.frame is SPACE:
        return {
            f"{joint.name}.{freedom.name}": freedom.unit
            for joint in scene.joints.values()
            for freedom in joint.freedoms
        }
    units = {"x": "m", "y": "m", "angle": "rad"}
    return {
        f"{body.name}.{name}": unit
        for body in scene.bodies.values()
        for name, unit in units.items()
        if body.turns or unit == "m"
    }


def claimable(scene: Scene) -> dict[str, Quantity]:
    """Every quantity that can be bounded in a claim about states, in the scene's order.

    What is drawn itself is no claim: coordinates of joints, and of the plane's bodies.
    """
    known = {
        name: quantity
        for name, quantity in table(scene).items()
        if _claimable(scene, quantity) and not _drawn(scene, quantity)
    }
    for part, fields in _more(scene):
        for field, (unit, kind) in fields.items():
            known[f"{part}.{field}"] = Quantity(f"{part}.{field}", part, field, unit, kind)
    units = set(coordinates(scene).values())
    # Of metres and radians together its entries have no common unit.
    if scene.frame is SPACE and len(units) == 1:
        unit = "kg m²" if units == {"rad"} else "kg"
        known[MASS_MATRIX] = Quantity(MASS_MATRIX, MASS_MATRIX, "", unit, "inertia")
    return known


def _claimable(scene: Scene, quantity: Quantity) -> bool:
    if quantity.field in WORK:  # a state has no time in which any would be done
        return False
    return quantity.kind in _OF_STATES or quantity.part in scene.forces


def _drawn(scene: Scene, quantity: Quantity) -> bool:
    if quantity.part in scene.joints:
        return True
    own = quantity.part in scene.bodies or quantity.part.endswith(f".{CENTER}")
    return scene.frame.dimension == 2 and own and quantity.field != "speed"


def _more(scene: Scene) -> Iterator[tuple[str, Fields]]:
    """Yields the fields that only states have: accelerations, inertias, and efforts for them."""
    linear: Fields = {f"a{axis}": ("m/s²", "acceleration") for axis in scene.frame.axes}
    spatial = scene.frame.dimension == 3
    for body in scene.bodies.values():
        yield body.name, {**(linear if spatial else {}), **(_turning(scene) if body.turns else {})}
        points = (point for point in body.points if spatial or point != CENTER)
        yield from ((f"{body.name}.{point}", linear) for point in points)
    if scene.frame is SPACE:
        for joint in scene.joints.values():
            yield joint.name, {k: v for f in joint.named for k, v in f.exerted.items()}


def _turning(scene: Scene) -> Fields:
    """In space α = ω̇ in ground axes, and the moments of inertia."""
    spatial = scene.frame.dimension == 3
    alpha = [f"alpha_{axis}" for axis in "xyz"] if spatial else []
    ends = ("_11", "_22", "_33", "_12", "_13", "_23") if spatial else ("",)
    fields: dict[str, tuple[str, Kind]] = dict.fromkeys(alpha, ("rad/s²", "acceleration"))
    return fields | dict.fromkeys((f"inertia{end}" for end in ends), ("kg m²", "inertia"))
