"""The base of every part of a case file: a map with certain keys and mistakes in plain words."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, ClassVar, Self, Union

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Discriminator,
    GetCoreSchemaHandler,
    ModelWrapValidatorHandler,
    Tag,
    ValidationError,
    model_validator,
)
from pydantic_core import CoreSchema, core_schema

from .field import In
from .text import IDENTIFIER, Text, name, reference
from .words import in_words, wrong

Mass = Annotated[float, In("kg", above=0)]
Length = Annotated[float, In("m", above=0)]
Angle = Annotated[float, In("rad")]
Name = Annotated[str, Text(name, f"^{IDENTIFIER}$")]
Point = Annotated[str, Text(reference, rf"^{IDENTIFIER}\.{IDENTIFIER}$", "body.point")]
Pair = tuple[Point, Point]
Position = tuple[Annotated[float, In("m")], Annotated[float, In("m")]]


def unit(value: tuple[float, ...]) -> tuple[float, ...]:
    """The vector of length 1 that points the same way."""
    length = math.hypot(*value)
    if length == 0:
        raise wrong(f"should be a direction, is [{', '.join('0' for _ in value)}]")
    return tuple(x / length for x in value)


Direction = Annotated[
    tuple[Annotated[float, In("1")], Annotated[float, In("1")]], AfterValidator(unit)
]


class Part(BaseModel):
    """A map with exactly these keys."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, defer_build=True)
    elsewhere: ClassVar[Mapping[str, str]] = {}
    """For keys that are none here, but stand in other places: what to say of each."""

    @model_validator(mode="wrap")
    @classmethod
    def _in_words(cls, value: object, check: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return check(value)
        except ValidationError as error:
            raise in_words(error, tuple(written(cls)), value, cls.elsewhere) from None


def written(model: type[BaseModel]) -> dict[str, str]:
    """The keys of a model as a case file writes them, with the names of their fields."""
    return {field.alias or name: name for name, field in model.model_fields.items()}


def plain_or_map() -> Discriminator:
    """Picks between a value tagged `<plain>` and a map of keys tagged `<map>`."""
    return Discriminator(lambda value: "<map>" if isinstance(value, dict) else "<plain>")


def plain_or_list() -> Discriminator:
    """Picks between a value tagged `<plain>` and a list tagged `<list>`."""
    return Discriminator(lambda value: "<list>" if isinstance(value, tuple) else "<plain>")


@dataclass(frozen=True, eq=False)
class Made:
    """Marks a noun that is written as something plainer, from which it is made."""

    of: Any
    by: Callable[[Any], object]

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        written = handler.generate_schema(self.of)
        return core_schema.no_info_after_validator_function(self.by, written)


@dataclass(frozen=True, eq=False)
class OneOf:
    """Marks what is written as one of some models, told apart by the word that each has alone.

    elsewhere: what to say of words that have no model here, but in other scenes.
    """

    kind: str
    models: Mapping[str, type[Part]]
    elsewhere: Mapping[str, str] = field(default_factory=dict)

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        tagged: Any = [Annotated[model, Tag(f"<{word}>")] for word, model in self.models.items()]
        return handler.generate_schema(
            Annotated[Union[tuple(tagged)], _by_key(self)]  # noqa: UP007
        )


def _by_key(choice: OneOf) -> Discriminator:
    """Choose the model by the key that only it has, so that mistakes are about that model."""
    words = list(choice.models)

    def tag(value: object) -> str | None:
        present = [word for word in words if isinstance(value, dict) and word in value]
        return f"<{present[0]}>" if len(present) == 1 else None

    context: dict[str, Any] = {"kind": choice.kind, "words": words, "elsewhere": choice.elsewhere}
    return Discriminator(tag, "choice", "one of {words}", context)
