"""Forces as a case file writes them: lines between two points, and named laws in time."""

from typing import Annotated, ClassVar

from pydantic import ConfigDict, Tag

from .field import In
from .part import Angle, Name, Pair, Part, Point, by_key
from .words import wrong

Frequency = Annotated[float, In("rad/s", above=0)]
Newtons = tuple[Annotated[float, In("N")], Annotated[float, In("N")]]
NewtonsPerSecond = tuple[Annotated[float, In("N/s")], Annotated[float, In("N/s")]]


class Spring(Part):
    spring: Pair
    stiffness: Annotated[float, In("N/m", above=0)]
    rest_length: Annotated[float, In("m", least=0)]


class Damper(Part):
    damper: Pair
    damping: Annotated[float, In("N s/m", least=0)]


class PushSine(Part):
    amplitude: Newtons
    angular_frequency: Frequency
    phase: Angle = 0.0


class TorqueSine(Part):
    amplitude: Annotated[float, In("N m")]
    angular_frequency: Frequency
    phase: Angle = 0.0


class _InTime(Part):
    """A force that follows exactly one law in time."""

    laws: ClassVar[tuple[str, ...]] = ("constant", "ramp", "sine")
    model_config = ConfigDict(
        json_schema_extra={"oneOf": [{"required": [law]} for law in ("constant", "ramp", "sine")]}
    )

    def model_post_init(self, context: object) -> None:
        given = [law for law in self.laws if getattr(self, law) is not None]
        if len(given) != 1:
            has = f"has {' and '.join(given)}" if given else "has none"
            raise wrong(f"needs exactly one of constant, ramp, sine; {has}")


class Push(_InTime):
    push: Point
    constant: Newtons | None = None
    ramp: NewtonsPerSecond | None = None
    sine: PushSine | None = None


class Torque(_InTime):
    torque: Name
    constant: Annotated[float, In("N m")] | None = None
    ramp: Annotated[float, In("N m/s")] | None = None
    sine: TorqueSine | None = None


Force = Annotated[
    Annotated[Spring, Tag("<spring>")]
    | Annotated[Damper, Tag("<damper>")]
    | Annotated[Push, Tag("<push>")]
    | Annotated[Torque, Tag("<torque>")],
    by_key("force", "spring", "damper", "push", "torque"),
]
