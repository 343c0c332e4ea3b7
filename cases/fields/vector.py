"""Lists of three numbers, as a scene in space writes them."""

from typing import Annotated

from pydantic import AfterValidator, Tag

from .field import In
from .gravity import Acceleration, Strength
from .part import plain_or_list, unit

_Metres = Annotated[float, In("m")]
_Speed = Annotated[float, In("m/s")]
_Entry = Annotated[float, In("1")]

Position = tuple[_Metres, _Metres, _Metres]
Velocity = tuple[_Speed, _Speed, _Speed]
Gravity = Annotated[
    Annotated[float, Strength(), Tag("<plain>")]
    | Annotated[tuple[Acceleration, Acceleration, Acceleration], Tag("<list>")],
    plain_or_list(),
]
Direction = Annotated[tuple[_Entry, _Entry, _Entry], AfterValidator(unit)]
