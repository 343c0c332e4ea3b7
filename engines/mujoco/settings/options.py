"""MuJoCo's options: which there are, which values it takes, and how they are its file's numbers."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import mujoco

from ...engine import Choice
from ...options import STEP, SWITCH, Check, mistakes_in, number, word
from ...plain_shapes import SHAPES
from ...step_scaled import at
from ..callbacks.signal import installed, listening
from ..model.contact import RECIPES
from ..model.number_text import EACH, attributes, of_one
from .groups import GROUPS, SOFT, Group

OWN = "your own option"
_WHOLE = ("iterations", "ls_iterations", "noslip_iterations")
_REAL = ("tolerance", "ls_tolerance", "noslip_tolerance", "impratio")
_FLAGS = ("diagexact",)
_PROTOCOL = ("step", "contacts", "settled", "shapes")  # what stands nowhere in the file
ELEMENTS: dict[str, dict[str, Check]] = {}
"""The elements of which a user sets numbers, with the attributes of each."""
for _group in GROUPS.values():
    ELEMENTS.setdefault(_group.option, {}).update(_group.attributes)
_SINGLE = [group for group in GROUPS.values() if group.single]
_of_one = mistakes_in(
    {name: check for group in _SINGLE for name, check in group.attributes.items()}
)


def _of_each(where: str, value: Any) -> Iterator[str]:
    if not isinstance(value, Mapping):
        yield f"{where}: should be a map of contacts and stops, by their names, is {value!r}"
        return
    for element, numbers in value.items():
        if all(part.isidentifier() for part in str(element).split(".")):
            yield from _of_one(f"{where}.{element}", numbers)
        else:
            yield f"{where}: {element!r} can be the name of no contact and no joint"


_mistakes = mistakes_in(
    {
        "step": STEP,
        "integrator": word("Euler", "RK4", "implicit", "implicitfast", "discrete"),
        "cone": word("pyramidal", "elliptic"),
        "jacobian": word("dense", "sparse", "auto"),
        "solver": word("PGS", "CG", "Newton"),
        "contacts": word(*{name: 0 for known in RECIPES.values() for name in known}, "scene"),
        "shapes": word(*SHAPES),
        **dict.fromkeys(_WHOLE, number(0, 2**31 - 1, whole=(int, float))),  # MuJoCo's int
        **dict.fromkeys(_REAL, number()),
        **SOFT,
        **{element: mistakes_in(known) for element, known in ELEMENTS.items()},
        **dict.fromkeys(_FLAGS, SWITCH),
        EACH: _of_each,
        "settled": SWITCH,
    }
)


def check(options: Mapping[str, Any]) -> None:
    """Raises ValueError with all mistakes: unknown names with the nearest right one, and values."""
    mistakes = [*_mistakes("mujoco", options)]
    mistakes = mistakes or [line for trial in _trials(options) for line in _refused(trial)]
    if mistakes:
        raise ValueError("\n".join(mistakes))


def _trials(options: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """The options, and what is of one contact or stop alone as if it were of all of them."""
    usual = {name: value for name, value in options.items() if name != EACH}
    if usual:
        yield usual
    for numbers in options.get(EACH, {}).values():
        yield {
            group.option: {
                name: value for name, value in numbers.items() if name in group.attributes
            }
            for group in _SINGLE
        }


def _refused(options: Mapping[str, Any]) -> list[str]:
    """MuJoCo's own objections to the values, when a pin, a contact and a slide step with them."""
    with listening() as warnings, installed(None):
        try:
            model = mujoco.MjModel.from_xml_string(_trial_mjcf(options))
            mujoco.mj_step(model, mujoco.MjData(model))
        except ValueError as refusal:
            return [f"mujoco: {' '.join(str(refusal).split())}"]
    return [f"mujoco: {' '.join(warning.split())}" for warning in dict.fromkeys(warnings)]


def _trial_mjcf(options: Mapping[str, Any]) -> str:
    """A ball that touches a floor, pinned at its centre, and one that slides with friction.

    It hardly touches: what throws out a deep one is no mistake of the options.
    """
    choices = overlaid([], options, [*GROUPS.values()])
    numbers = {choice.name: at(choice.value, options.get("step", 2e-3)) for choice in choices}

    def text(*words: str) -> str:
        parts = (attributes(numbers, where).items() for where in words)
        return " ".join(f'{name}="{value}"' for part in parts for name, value in part)

    return f"""<mujoco><option {text("option")}><flag {text("flag")}/></option>
<worldbody><geom name="floor" type="plane" size="0 0 1" pos="0 0 -0.0999"/><site name="O"/>
<body name="b"><freejoint/><geom name="g" size="0.1"/><site name="s"/></body>
<body name="c"><joint type="slide" frictionloss="1" range="-1 1" {text("slide", "stop")}/>
<geom size="0.1" contype="0" conaffinity="0"/></body></worldbody>
<contact><pair geom1="floor" geom2="g" {text("pair")}/></contact>
<equality><connect site1="O" site2="s" {text("connect")}/></equality>
<tendon><spatial range="0 1" {text("rope")}><site site="O"/><site site="s"/></spatial></tendon>
</mujoco>"""


def overlaid(
    under: Sequence[Choice],
    options: Mapping[str, Any],
    groups: Sequence[Group],
    contacts: Sequence[Choice] = (),
    single: Mapping[str, Group] | None = None,
    because: str = OWN,
) -> list[Choice]:
    """Choices with other options on top.

    contacts: the recipe that they name, which stands between what is for all groups and the rest.
    single: what may have numbers of its own, by its name: of which group it is. because: why they
    are on top.
    """
    common = {
        group.key(name): options[name] for name in SOFT if name in options for group in groups
    }
    own = dict(_by_choice_name(options, groups)) | dict(_alone(options.get(EACH, {}), single or {}))
    first, last = (
        [Choice(name, value, because) for name, value in part.items()] for part in (common, own)
    )
    return list({choice.name: choice for choice in (*under, *first, *contacts, *last)}.values())


def _alone(
    given: Mapping[str, Mapping[str, Any]], single: Mapping[str, Group]
) -> Iterator[tuple[str, Any]]:
    """Yields the options of one contact or one joint's stops alone, as far as a scene has them."""
    for element, numbers in given.items():
        if group := single.get(element):
            for name, value in numbers.items():
                if name in group.attributes:
                    yield f"{of_one(element)}.{name}", value


def _by_choice_name(
    options: Mapping[str, Any], groups: Sequence[Group]
) -> Iterator[tuple[str, Any]]:
    """Yields the options that stand in one place only."""
    for name, value in options.items():
        if name in ELEMENTS:
            yield from (
                (f"{group.word}.{attribute}", numbers)
                for attribute, numbers in value.items()
                for group in groups
                if group.option == name and attribute in group.attributes
            )
        elif name in _FLAGS:
            yield f"flag.{name}", "enable" if value else "disable"
        elif name not in (*SOFT, *_PROTOCOL, EACH):
            # MuJoCo reads no 50.0 where it wants a whole number
            yield f"option.{name}", int(value) if name in _WHOLE else value


def as_options(choices: Sequence[Choice], *, settled: bool = False) -> dict[str, Any]:
    """Choices in terms of h as own options; settled: started as the floor carries what touches."""
    options: dict[str, Any] = {}
    for choice in choices:
        where, _, name = choice.name.rpartition(".")
        group, _, element = where.partition(".")
        if group == EACH:
            options.setdefault(EACH, {}).setdefault(element, {})[name] = choice.value
        elif where in GROUPS:
            options.setdefault(GROUPS[where].option, {})[name] = choice.value
        else:
            options[name] = choice.value == "enable" if where == "flag" else choice.value
    return options | ({"settled": True} if settled else {})


def why_recipe_unfit(
    options: Mapping[str, Any], recipes: Sequence[str], worth: Sequence[str]
) -> str | None:
    """Why the recipe that is named for contacts has nothing to do with the scene's.

    recipes: all that there are; worth: which may do something for the scene, none without contacts.
    """
    word = options.get("contacts")
    if word in (None, "scene") or not worth:
        return None
    if word not in recipes:
        known = f"known: {', '.join(recipes)}, scene"
        return f"adapter: contacts: {word} is no recipe for this scene's; {known}"
    if word == "bounce" and word not in worth:
        return "adapter: contacts: bounce, and no contact of this scene throws anything back"
    return None
