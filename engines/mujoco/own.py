"""A user's own options as choices of the MJCF file, and choices as such options."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ..engine import Choice
from .options import FLAGS, GROUPS, PROTOCOL, SOFT, as_written

_BECAUSE = "your own option"


def key(group: str, name: str) -> str:
    """As MJCF spells it: a joint's own friction has names of its own."""
    return f"slide.{name}friction" if group == "slide" else f"{group}.{name}"


def overlaid(
    under: Sequence[Choice],
    options: Mapping[str, Any],
    soft: Sequence[str],
    contacts: Sequence[Choice],
) -> list[Choice]:
    """Choices with the user's own options on top.

    contacts: the recipe that they name, which stands between what is for all groups and the rest.
    """
    choices = {choice.name: choice for choice in under}
    for name in SOFT:
        for group in soft if name in options else ():
            named = key(group, name)
            choices[named] = Choice(named, as_written(name, options[name]), _BECAUSE)
    choices |= {choice.name: choice for choice in contacts}
    choices |= {choice.name: choice for choice in _written(options, soft)}
    return list(choices.values())


def _written(options: Mapping[str, Any], soft: Sequence[str]) -> Iterator[Choice]:
    """What stands in one place only."""
    for name, value in options.items():
        if name in GROUPS:
            group = _ELEMENTS[name]
            yield from (
                Choice(f"{group}.{attribute}", given, _BECAUSE)
                for attribute, given in value.items()
                if group in soft
            )
        elif name in FLAGS:
            yield Choice(f"flag.{name}", "enable" if value else "disable", _BECAUSE)
        elif name not in (*SOFT, *PROTOCOL):
            yield Choice(f"option.{name}", as_written(name, value), _BECAUSE)


_ELEMENTS = {"connect": "connect", "pair": "pair", "joint": "slide"}
"""Our groups of soft constraints, by the elements that MJCF has for them."""


def as_options(choices: Sequence[Choice], *, settled: bool) -> dict[str, Any]:
    """Choices in terms of h as own options; settled: started as the floor carries what touches."""
    elements = {group: element for element, group in _ELEMENTS.items()}
    found: dict[str, Any] = {}
    for choice in choices:
        where, _, name = choice.name.partition(".")
        if where in elements:
            found.setdefault(elements[where], {})[name] = choice.value
        else:
            found[name] = choice.value == "enable" if where == "flag" else choice.value
    return found | ({"settled": True} if settled else {})


def unfit(options: Mapping[str, Any], recipes: Sequence[str], worth: Sequence[str]) -> str | None:
    """Why the recipe that is named for contacts has nothing to do with the scene's.

    recipes: all that there are; worth: which may do something for the scene, none without contacts.
    """
    word = options.get("contacts")
    if word in (None, "scene") or not worth:
        return None
    if word not in recipes:
        known = ", ".join(recipes)
        return f"adapter: contacts: {word} is no recipe for this scene's; known: {known}, scene"
    if word == "bounce" and word not in worth:
        return "adapter: contacts: bounce, and no contact of this scene throws anything back"
    return None
