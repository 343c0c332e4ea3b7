"""How bodies and joints start, as a case file writes it, and guesses of where they are.

In space the keys and units depend on what it is of: check/start.py says so.
"""

from functools import reduce
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, ConfigDict, Field, Tag

from ...fields.field import AnyUnit, In
from ...fields.number import Amount, shown
from ...fields.part import Angle, Made, Name, Part, Point, Position, plain_or_list, written
from ...fields.vector import Direction
from ...fields.words import wrong
from ...scene.rotation import Quaternion, Vector3, about, product

POLAR = ("from_", "length", "direction")  # how a start gives a place by a distance


class Near(Part):
    """A guess: of a body its coordinates or the places of its points; of a joint what it leaves."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Position] = Field(init=False)  # type: ignore[assignment]

    x: Annotated[float, In("m")] | None = None
    y: Annotated[float, In("m")] | None = None
    angle: Angle | None = None
    shift: Annotated[float, In("m")] | None = Field(None, description="of a joint, along its line")

    @property
    def places(self) -> dict[str, tuple[float, float]]:
        """Where points of the body are."""
        return self.__pydantic_extra__

    @property
    def given(self) -> dict[str, float]:
        """Coordinates and rates by name."""
        numbers = {key: getattr(self, key) for key in type(self).model_fields if key not in POLAR}
        return {key: number for key, number in numbers.items() if isinstance(number, float)}

    @property
    def keys(self) -> set[str]:
        """The keys that are given, as they are written."""
        fields = written(type(self)).items()
        return {key for key, name in fields if name in self.model_fields_set} | {*self.places}

    @property
    def polar(self) -> tuple[str, float, float] | None:
        """A point of the ground, and how far [m] and in which direction [rad] the centre is."""
        return None

    @property
    def attitude(self) -> None:
        """None in the plane, where a body has an angle."""

    @property
    def stands_on(self) -> tuple[str, ...]:
        """The points that stand on their planes: only a start has any."""
        return ()


class Initial(Near):
    """How a body starts: coordinates and rates, or places of its points; or an edge, or a joint."""

    from_: Point | None = Field(None, alias="from", description="a point of the ground")
    length: Annotated[float, In("m", above=0)] | None = Field(
        None, description="how far from that point the centre is"
    )
    direction: Angle | None = Field(None, description="in which direction from it, from x")

    vx: Annotated[float, In("m/s")] | None = None
    vy: Annotated[float, In("m/s")] | None = None
    omega: Annotated[float, In("rad/s")] | None = None
    speed: Annotated[float, In("m/s")] | None = Field(
        None, description="of an edge or a joint, along it"
    )
    on: (
        Annotated[
            Annotated[Name, Tag("<plain>")] | Annotated[tuple[Name, Name], Tag("<list>")],
            plain_or_list(),
        ]
        | None
    ) = Field(None, description="the point of the body that stands on its plane, or two")

    @property
    def stands_on(self) -> tuple[str, ...]:
        return (self.on,) if isinstance(self.on, str) else self.on or ()

    @property
    def polar(self) -> tuple[str, float, float] | None:
        """Where all three are given."""
        if self.from_ is None or self.length is None or self.direction is None:
            return None
        return self.from_, self.length, self.direction


# In space: numbers and lists of any unit, and an attitude.


_Amount = Annotated[Amount, AnyUnit()]
Vector = tuple[Amount, Amount, Amount]


Entry = Annotated[
    Annotated[Amount, AnyUnit(), Tag("<plain>")]
    | Annotated[tuple[_Amount, _Amount, _Amount], Tag("<list>")],
    plain_or_list(),
]


class Turn(Part):
    """A turn about an axis."""

    axis: Direction
    angle: Angle


def _attitude(turns: tuple[Any, ...]) -> Quaternion:
    """Unit quaternion of successive turns, each about an axis in the axes left by those before."""
    q = reduce(product, [np.array(about(turn.axis, turn.angle)) for turn in turns])
    w, x, y, z = (float(entry) for entry in q)
    return w, x, y, z


def _turns(value: Any) -> Any:
    each = value if isinstance(value, tuple) and value else (value,)
    if all(isinstance(turn, dict) for turn in each):
        return value
    raise wrong(f"should be {{axis: [x, y, z], angle: …}} or a list of them, is {shown(value)}")


Attitude = Annotated[
    Annotated[Quaternion, Made(Turn, lambda turn: _attitude((turn,))), Tag("<plain>")]
    | Annotated[Quaternion, Made(tuple[Turn, ...], _attitude), Tag("<list>")],
    plain_or_list(),
    BeforeValidator(_turns),
]


class SpatialStart(Part):
    """Coordinates and rates, the places of points [x, y, z], and an attitude."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Entry] = Field(init=False)  # type: ignore[assignment]

    attitude: Attitude | None = Field(
        None, description="a turn, or a list of turns, each in the axes that those before it leave"
    )

    @property
    def entries(self) -> dict[str, Amount | Vector]:
        """Every entry but the attitude, as written."""
        return self.__pydantic_extra__

    @property
    def stands_on(self) -> tuple[str, ...]:
        """None in space, where a start is given by joints and attitudes."""
        return ()

    @property
    def given(self) -> dict[str, float]:
        """Coordinates and rates by name; of a vector ω omega_1, omega_2, omega_3."""
        numbers = {k: v.value for k, v in self.entries.items() if isinstance(v, Amount)}
        omega = self.entries.get("omega")
        if isinstance(omega, tuple):
            numbers |= {f"omega_{i}": x.value for i, x in enumerate(omega, start=1)}
        return numbers

    @property
    def polar(self) -> None:
        """None: in space a place is given by its coordinates."""

    @property
    def places(self) -> dict[str, Vector3]:
        """Where points of the body are."""
        return {
            key: (entry[0].value, entry[1].value, entry[2].value)
            for key, entry in self.entries.items()
            if isinstance(entry, tuple) and key != "omega"
        }
