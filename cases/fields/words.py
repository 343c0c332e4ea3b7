"""pydantic's errors in plain words, at the place in the file that a person has to look at."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from pydantic import ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

from ..mistake import NO_VALUE, SHOWN, list_hint, nearest
from .number import shown

_SHAPES = {
    "tuple_type": "a list",
    "dict_type": "a map of names",
    "model_type": "a map of keys",
    "model_attributes_type": "a map of keys",
    "int_type": "a whole number",
    "bool_type": "true or false",
}


def wrong(what: str, *, number: bool = False) -> PydanticCustomError:
    """A mistake already in plain words; number: of one number, beside which all else is sound."""
    return PydanticCustomError("plain", "{what}", {"what": what, "number": number})


def in_words(
    error: ValidationError, keys: Sequence[str], given: object, elsewhere: Mapping[str, str]
) -> ValidationError:
    """The error of a model with these keys, in plain words; `given` is what it was given.

    elsewhere: what to say of keys that stand in other places.
    """
    present = given if isinstance(given, Mapping) else {}
    absent = [key for key in keys if key not in present]  # no misspelt key means one that is there
    errors: list[dict[str, Any]] = [dict(e) for e in error.errors(include_url=False)]
    unknown = [e["loc"][0] for e in errors if _unknown(e, keys)]
    hints = {key: nearest(key, absent) for key in unknown[:SHOWN]}  # of more nobody reads them
    misspelt = {hint.split("'")[1] for hint in hints.values() if "did you mean" in hint}
    lengths: dict[Any, int] = {}  # of fixed lists that are too short: each missing entry is told
    for e in errors:
        if e["type"] == "missing" and isinstance(e["loc"][-1], int):
            lengths[e["loc"][:-1]] = max(lengths.get(e["loc"][:-1], 0), e["loc"][-1] + 1)
    details = [
        InitErrorDetails(
            type=wrong(what, number=e.get("ctx", {}).get("number", False)),
            loc=loc,
            input=e["input"],
        )
        for e in errors
        if not (e["type"] == "missing" and e["loc"][-1] in misspelt)
        for loc, what in _translate(e, keys, hints, lengths, elsewhere)
    ]
    return ValidationError.from_exception_data(error.title, details)


def _unknown(error: Mapping[str, Any], keys: Sequence[str]) -> bool:
    """Whether a key is unknown; one that may name a point is, unless it has a place [x, y]."""
    loc = error["loc"]
    if len(loc) != 1 or loc[0] in keys:
        return False
    return error["type"] in ("extra_forbidden", "tuple_type")


def _translate(
    error: Mapping[str, Any],
    keys: Sequence[str],
    hints: Mapping[Any, str],
    lengths: Mapping[Any, int],
    elsewhere: Mapping[str, str],
) -> Iterator[tuple[Any, str]]:
    value: Any = error["input"]
    loc, kind = error["loc"], error["type"]
    context = error.get("ctx", {})
    if value is None and kind != "missing":
        yield loc, NO_VALUE
    elif kind == "plain":
        yield loc, context["what"]
    elif _unknown(error, keys) and loc[0] in elsewhere:
        yield loc, f"unknown key {loc[0]!r}; {elsewhere[loc[0]]}"
    elif _unknown(error, keys):
        close = hints.get(loc[0], "")
        yield loc, f"unknown key {loc[0]!r}{close if 'did you mean' in close else list_hint(keys)}"
    elif kind == "choice":
        yield from _choice(loc, value, **context)
    elif kind == "missing":
        last = loc[-1]
        if isinstance(last, str):
            yield loc, f"missing key {last!r}"
        else:
            yield loc[:-1], f"should be a list of {lengths[loc[:-1]]}, has {len(value or ())}"
    elif kind == "too_short":
        yield loc, "should not be empty"
    elif kind == "too_long":
        yield loc, f"should be a list of {context['max_length']}, has {context['actual_length']}"
    elif kind in _SHAPES:
        yield loc, f"should be {_SHAPES[kind]}, is {shown(value)}"
    elif kind == "greater_than_equal":
        yield loc, f"must be at least {context['ge']}, is {value}"
    else:  # nothing else is left in the grammar, but a message is better than none
        yield loc, error["msg"]


def _choice(
    loc: tuple[Any, ...],
    value: object,
    kind: str,
    words: list[str],
    elsewhere: Mapping[str, str],
) -> Iterator[tuple[Any, str]]:
    if not isinstance(value, dict):
        yield loc, f"should be a map with one of {', '.join(words)}, is {shown(value)}"
        return
    present = [word for word in words if word in value]
    close = [key for key in value if "did you mean" in nearest(key, words)]
    if present:
        yield loc, f"has two kinds of {kind}: {' and '.join(present)}"
    elif not value:
        yield loc, f"is empty; a {kind} is one of {', '.join(words)}"
    elif foreign := [key for key in value if key in elsewhere]:
        yield (*loc, foreign[0]), f"unknown {kind} {foreign[0]!r}; {elsewhere[foreign[0]]}"
    else:
        key = close[0] if close else next(iter(value))
        known = f" There are {', '.join(words)}" if close else ""
        yield (*loc, key), f"unknown {kind} {key!r}{nearest(key, words)}{known}"
