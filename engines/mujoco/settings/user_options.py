"""A user's own options as choices of the MJCF file, and choices as such options."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...engine import Choice
from ..model.number_text import EACH, of_one
from .groups import GROUPS, SOFT, Group
from .options import ELEMENTS, FLAGS, PROTOCOL, as_written

OWN = "your own option"


def overlaid(
    under: Sequence[Choice],
    options: Mapping[str, Any],
    groups: Sequence[Group],
    contacts: Sequence[Choice],
    *,
    single: Mapping[str, Group],
    because: str,
) -> list[Choice]:
    """Choices with other options on top.

    contacts: the recipe that they name, which stands between what is for all groups and the rest.
    single: what may have numbers of its own, by its name: of which group it is. because: why they
    are on top.
    """
    choices = {choice.name: choice for choice in under}
    for name in SOFT:
        for group in groups if name in options else ():
            named = group.key(name)
            choices[named] = Choice(named, as_written(name, options[name]), because)
    choices |= {choice.name: choice for choice in contacts}
    choices |= {choice.name: choice for choice in _written(options, groups, because)}
    choices |= {choice.name: choice for choice in _alone(options.get(EACH, {}), single, because)}
    return list(choices.values())


def _alone(
    given: Mapping[str, Mapping[str, Any]], single: Mapping[str, Group], because: str
) -> Iterator[Choice]:
    """The choices for one contact or one joint's stops alone, as far as the scene has it."""
    for element, numbers in given.items():
        if group := single.get(element):
            yield from (
                Choice(f"{of_one(element)}.{attribute}", value, because)
                for attribute, value in numbers.items()
                if attribute in group.sizes
            )


def _written(options: Mapping[str, Any], groups: Sequence[Group], because: str) -> Iterator[Choice]:
    """The choices for options that stand in one place only."""
    for name, value in options.items():
        if name in ELEMENTS:
            yield from (
                Choice(f"{group.word}.{attribute}", given, because)
                for attribute, given in value.items()
                for group in groups
                if group.option == name and attribute in group.sizes
            )
        elif name in FLAGS:
            yield Choice(f"flag.{name}", "enable" if value else "disable", because)
        elif name not in (*SOFT, *PROTOCOL, EACH):
            yield Choice(f"option.{name}", as_written(name, value), because)


def as_options(choices: Sequence[Choice], *, settled: bool) -> dict[str, Any]:
    """Choices in terms of h as own options; settled: started as the floor carries what touches."""
    found: dict[str, Any] = {}
    for choice in choices:
        where, _, name = choice.name.rpartition(".")
        group, _, element = where.partition(".")
        if group == EACH:
            found.setdefault(EACH, {}).setdefault(element, {})[name] = choice.value
        elif where in GROUPS:
            found.setdefault(GROUPS[where].option, {})[name] = choice.value
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
