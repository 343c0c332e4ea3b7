"""Knobs of an engine: a closed list of what to turn for each scene, as the user's own options."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

Options = Mapping[str, Any]
"""As in a file of settings, under the engine's name: plain data."""


Kind = Literal["option", "protocol", "ours", "bundle"]


@dataclass(frozen=True)
class Value:
    """One value of a knob: how a sentence calls it, and the options that it is."""

    words: str
    options: Options


@dataclass(frozen=True)
class Knob:
    """One thing that matters for a scene, and that is turned as a whole.

    values: what is worth trying beside the shipped one, the mildest first; none where it is of use
    beside others alone. tuned: the tuned setting's; None: it leaves the shipped one.
    kind: a `protocol` is what is done to start and readout; `ours` is what nobody can do who has
    not our adapter: it explains, and is advised to no one; a `bundle` is a whole recipe, which
    turns several knobs at once.
    """

    name: str
    values: tuple[Value, ...]
    tuned: Value | None = None
    kind: Kind = "option"


def merged(*options: Options) -> dict[str, Any]:
    """One mapping of all options; where two have the same name the later wins, in groups too."""
    both: dict[str, Any] = {}
    for some in options:
        for name, value in some.items():
            inner = [both.get(name), value]
            both[name] = merged(*inner) if all(isinstance(x, Mapping) for x in inner) else value
    return both


def short_value(value: Any) -> str:
    """A number, or several, in the shortest words: 1e6, `-0.04/h2 0`."""
    if isinstance(value, list | tuple):
        return " ".join(map(short_value, value))
    text = f"{value:g}" if isinstance(value, float) else str(value)
    return text.replace("e+0", "e").replace("e-0", "e-").replace("e+", "e")


def as_text(options: Options) -> str:
    """Options as YAML on one line, ready to paste into a file of settings."""
    return "{" + ", ".join(f"{name}: {_text(value)}" for name, value in options.items()) + "}"


def _text(value: Any) -> str:
    if isinstance(value, Mapping):
        return as_text(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_text, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    return _number(value) if isinstance(value, float) else str(value)


def _number(value: float) -> str:
    """With a point, without which YAML 1.1 reads 1e-9 as a word."""
    text = repr(value)
    if "inf" in text:
        return text.replace("inf", ".inf")
    mantissa, e, exponent = text.partition("e")
    return text if "." in mantissa or not e else f"{mantissa}.0e{exponent}"
