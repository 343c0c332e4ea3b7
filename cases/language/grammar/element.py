"""The models of elements, made from their nouns: a number and its unit are declared there, once.

An element is written as its word with what it refers to, and its numbers beside that:
`{spring: [rod.end, ground.O], stiffness: c, rest_length: l0}`.
"""

from collections.abc import Callable, Collection, Mapping
from inspect import Parameter, signature
from typing import Any, ClassVar, get_type_hints

from pydantic import create_model

from ...fields.part import Name, Pair, Part, Point
from ...fields.signal_grammar import Following, signal_fields
from ...scene.point import anchor

REFERS = ("a", "b", "at", "body", "first", "second", "joint")
"""Fields by which nouns refer: to two points, a point, a body, two bodies or a joint."""
BY_NAME = ("body", "first", "second", "joint")


class Element(Part):
    """An element as a case file writes it, before the key above it names it."""

    word: ClassVar[str]
    makes: ClassVar[Callable[..., Any]]

    def named(self, name: str) -> Any:
        """The element itself."""
        parameters = signature(type(self).makes).parameters
        numbers = {key: getattr(self, key) for key in parameters if hasattr(self, key)}
        return type(self).makes(**numbers | self.referred() | {"name": name})

    def referred(self) -> dict[str, Any]:
        """The points, the bodies or the joint to which the noun refers, by its fields."""
        fields = [key for key in signature(type(self).makes).parameters if key in REFERS]
        given = getattr(self, self.word)
        words = given if isinstance(given, tuple) else (given,)
        return {
            field: word if field in BY_NAME else anchor(word)
            for field, word in zip(fields, words, strict=True)
        }


class InTime(Element, Following):
    """A force that follows a law in time."""


def element(
    word: str,
    makes: Callable[..., Any],
    *,
    base: type[Element] = Element,
    without: Collection[str] = (),
    needs: Collection[str] = (),
    axes: int | None = None,
    typed: Mapping[str, Any] | None = None,
) -> type[Element]:
    """The model of what `makes` makes, written under `word`.

    It has no keys `without`, and no default for what it `needs`. axes: along how many its law in
    time acts, if not as in the plane. typed: what a key is, where only the word tells.
    """
    parameters, title = keys(makes), f"{word.capitalize()}{axes or ''}"
    parameters |= {key: (kind, parameters[key][1]) for key, kind in (typed or {}).items()}
    parameters |= {key: (parameters[key][0], ...) for key in needs}
    refers = Pair if "b" in parameters else Point if "at" in parameters else Name
    refers = tuple[Name, Name] if "second" in parameters else refers
    refers = parameters["joint"][0] if "joint" in parameters else refers
    fields = {key: parameters[key] for key in parameters if key not in (*REFERS, "name", *without)}
    if "signal" in fields:
        base, fields = InTime, fields | signal_fields(title, fields.pop("signal")[0], axes)
    model_fields: dict[str, Any] = {word: (refers, ...), **fields}
    model = create_model(title, __base__=base, __doc__=_summary(makes), **model_fields)
    model.word, model.makes = word, makes
    return model


def numbers(
    makes: Callable[..., Any], *, without: Collection[str] = (), prefix: str = ""
) -> type[Part]:
    """The model of a map with all that `makes` asks for, but for `without`."""
    fields: dict[str, Any] = {k: field for k, field in keys(makes).items() if k not in without}
    name = prefix + makes.__name__.capitalize()
    return create_model(name, __base__=Part, __doc__=_summary(makes), **fields)


def _summary(makes: Callable[..., Any]) -> str:
    return (makes.__doc__ or "").partition("\n")[0]


def keys(makes: Callable[..., Any]) -> dict[str, Any]:
    """Fields of a model for all that `makes` asks for: type and default by name."""
    hints = get_type_hints(makes, include_extras=True)
    return {
        key: (hints[key], ... if parameter.default is Parameter.empty else parameter.default)
        for key, parameter in signature(makes).parameters.items()
    }
