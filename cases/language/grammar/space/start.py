"""How a body or a joint in space starts, as a case file writes it.

Which keys it may have and in which units depends on what it is of: check/placed.py says so.
"""

from functools import reduce
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, ConfigDict, Field, Tag

from ....fields.field import AnyUnit
from ....fields.number import Amount, shown
from ....fields.part import Angle, Made, Part, plain_or_list
from ....fields.vector import Direction
from ....fields.words import wrong
from ....scene.rotation import Quaternion, Vector3, about, product

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


class Start(Part):
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
