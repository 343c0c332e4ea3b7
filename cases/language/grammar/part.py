"""What every part of a case file is: a map with certain keys, whose mistakes speak plainly."""

from typing import Annotated, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Discriminator,
    ModelWrapValidatorHandler,
    ValidationError,
    model_validator,
)

from .field import In
from .text import IDENTIFIER, Text, name, reference
from .words import in_words

Mass = Annotated[float, In("kg", above=0)]
Length = Annotated[float, In("m", above=0)]
Angle = Annotated[float, In("rad")]
Name = Annotated[str, Text(name, f"^{IDENTIFIER}$")]
Point = Annotated[str, Text(reference, rf"^{IDENTIFIER}\.{IDENTIFIER}$", "body.point")]
Pair = tuple[Point, Point]
Position = tuple[Annotated[float, In("m")], Annotated[float, In("m")]]


class Part(BaseModel):
    """A map with exactly these keys."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    @model_validator(mode="wrap")
    @classmethod
    def _in_words(cls, value: object, check: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return check(value)
        except ValidationError as error:
            raise in_words(error, tuple(cls.model_fields)) from None


def plain_or_map() -> Discriminator:
    """Picks between a value tagged `<plain>` and a map of keys tagged `<map>`."""
    return Discriminator(lambda value: "<map>" if isinstance(value, dict) else "<plain>")


def by_key(kind: str, *words: str) -> Discriminator:
    """Picks the model by the one key that says what a part is, so that mistakes stay sharp."""

    def tag(value: object) -> str | None:
        present = [word for word in words if isinstance(value, dict) and word in value]
        return f"<{present[0]}>" if len(present) == 1 else None

    choice = {"kind": kind, "words": list(words)}
    return Discriminator(tag, "choice", "one of {words}", choice)
