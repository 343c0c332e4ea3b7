"""A user's own options: which there are, and which values MuJoCo takes."""

from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

import mujoco

from ...plain_shapes import SHAPES
from ...step_scaled import FORMS, at, tied
from ..callbacks.signal import installed, listening
from ..model.contact import RECIPES
from ..model.number_text import EACH, of_one
from .groups import GROUPS, SOFT

_WORDS = {
    "integrator": ("Euler", "RK4", "implicit", "implicitfast", "discrete"),
    "cone": ("pyramidal", "elliptic"),
    "jacobian": ("dense", "sparse", "auto"),
    "solver": ("PGS", "CG", "Newton"),
    "contacts": (*dict.fromkeys(word for recipes in RECIPES.values() for word in recipes), "scene"),
    "shapes": SHAPES,
}
_WHOLE = ("iterations", "ls_iterations", "noslip_iterations")
_REAL = ("tolerance", "ls_tolerance", "noslip_tolerance", "impratio")
FLAGS = ("diagexact",)
PROTOCOL = ("step", "contacts", "settled", "shapes")  # what stands nowhere in the file
ELEMENTS: dict[str, dict[str, tuple[int, ...]]] = {}
"""The elements of which a user sets numbers, with how many each of their attributes takes."""
for _group in GROUPS.values():
    ELEMENTS.setdefault(_group.option, {}).update(_group.sizes)
_SINGLE = [group for group in GROUPS.values() if group.single]
_ALONE = {name: size for group in _SINGLE for name, size in group.sizes.items()}
_NAMES = ("step", *_WORDS, *_WHOLE, *_REAL, *SOFT, *ELEMENTS, *FLAGS, EACH, "settled")
_MOST = 2**31 - 1  # MuJoCo's int


def check(options: Mapping[str, Any]) -> None:
    """Raises ValueError with all mistakes: unknown names with the nearest right one, and values."""
    found = [mistake for name, value in options.items() for mistake in _mistakes(name, value)]
    mistakes = found or [line for one in _tried(options) for line in _refused(one)]
    if mistakes:
        raise ValueError("\n".join(mistakes))


def as_written(name: str, value: Any) -> Any:
    """The value as it stands in the file: MuJoCo reads no 50.0 where it wants a whole number."""
    return int(value) if name in _WHOLE else value


def _mistakes(name: str, value: Any) -> Iterator[str]:
    if name not in _NAMES:
        yield f"mujoco.{name}: unknown option; {_nearest(name, _NAMES)}"
    elif name in ELEMENTS:
        yield from _in_group(name, value, ELEMENTS[name])
    elif name == EACH:
        yield from _of_each(value)
    elif name in (*FLAGS, "settled"):
        if not isinstance(value, bool):
            yield f"mujoco.{name}: should be true or false, is {value!r}"
    elif name in _WORDS:
        if value not in _WORDS[name]:
            close = get_close_matches(str(value), _WORDS[name], n=1)
            hint = f"; did you mean {close[0]!r}?" if close else ""
            words = ", ".join(_WORDS[name])
            yield f"mujoco.{name}: should be one of {words}, is {value!r}{hint}"
    else:
        right, what = _listed(name, value, SOFT[name]) if name in SOFT else _number(name, value)
        if not right:
            yield f"mujoco.{name}: should be {what}, is {value!r}"


def _of_each(value: Any) -> Iterator[str]:
    if not isinstance(value, Mapping):
        yield f"mujoco.{EACH}: should be a map of contacts and stops, by their names, is {value!r}"
        return
    for element, numbers in value.items():
        if all(part.isidentifier() for part in str(element).split(".")):
            yield from _in_group(of_one(element), numbers, _ALONE)
        else:
            yield f"mujoco.{EACH}: {element!r} can be the name of no contact and no joint"


def _in_group(group: str, value: Any, sizes: Mapping[str, tuple[int, ...]]) -> Iterator[str]:
    if not isinstance(value, Mapping):
        yield f"mujoco.{group}: should be a map of {', '.join(sizes)}, is {value!r}"
        return
    for name, numbers in value.items():
        where = f"mujoco.{group}.{name}"
        if name not in sizes:
            yield f"{where}: unknown option; {_nearest(name, (*sizes,))}"
            continue
        right, what = _listed(name, numbers, sizes[name])
        if not right:
            yield f"{where}: should be {what}, is {numbers!r}"


def _nearest(name: Any, names: Sequence[str]) -> str:
    close = get_close_matches(str(name), names, n=1)
    return f"did you mean {close[0]!r}?" if close else f"known: {', '.join(names)}"


def _listed(name: str, value: Any, sizes: tuple[int, ...]) -> tuple[bool, str]:
    """Whether a number, or a list, is right, and what it should be. What pushes may follow h."""
    if sizes == (1,):
        return _number(name, value)
    follows = name.startswith("solref")
    count = " or ".join(map(str, sizes))
    what = f"a list of {count} finite numbers" + (f", or texts {FORMS}" if follows else "")
    right = isinstance(value, list | tuple) and len(value) in sizes
    return right and all(_finite(x) or (follows and tied(x)) for x in value), what


def _number(name: str, value: Any) -> tuple[bool, str]:
    """Whether the value is right, and what it should be."""
    if name in _WHOLE:
        right = _finite(value) and value == int(value) and 0 <= value <= _MOST
        return right, f"a whole number from 0 to {_MOST}"
    if name == "step":
        return _finite(value) and value > 0, "a positive number of seconds"
    return _finite(value) and value >= 0, "a number of at least 0"


def _finite(value: Any) -> bool:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return number and abs(value) <= mujoco.mjMAXVAL**30  # 1e300: an int can exceed every float


def _tried(options: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """The options, and what is of one contact or stop alone as if it were of all of them."""
    usual = {name: value for name, value in options.items() if name != EACH}
    if usual:
        yield usual
    for numbers in options.get(EACH, {}).values():
        yield {
            group.option: {name: value for name, value in numbers.items() if name in group.sizes}
            for group in _SINGLE
        }


def _refused(options: Mapping[str, Any]) -> list[str]:
    """MuJoCo's own objections to the values, when a pin, a contact and a slide step with them."""
    with listening() as warnings, installed(None):
        try:
            model = mujoco.MjModel.from_xml_string(_trial(options))
            mujoco.mj_step(model, mujoco.MjData(model))
        except ValueError as refusal:
            return [f"mujoco: {' '.join(str(refusal).split())}"]
    return [f"mujoco: {' '.join(warning.split())}" for warning in dict.fromkeys(warnings)]


def _trial(options: Mapping[str, Any]) -> str:
    """A ball that touches a floor, pinned at its centre, and one that slides with friction.

    It hardly touches: what throws out a deep one is no mistake of the options.
    """
    step = options.get("step", 2e-3)

    def text(name: str, value: Any) -> str:
        value = at(as_written(name, value), step)
        words = value if isinstance(value, list | tuple) else [value]
        return f'{"timestep" if name == "step" else name}="{" ".join(map(str, words))}"'

    def soft(element: str) -> str:
        common = {name: options[name] for name in SOFT if name in options}
        mine = [group for group in GROUPS.values() if group.option == element]
        own = {group.attribute(name): common[name] for name in common for group in mine}
        given = own | options.get(element, {})
        return " ".join(text(name, value) for name, value in given.items())

    named = [n for n in PROTOCOL if n != "step"]
    plain = [n for n in options if n not in (*SOFT, *ELEMENTS, *FLAGS, *named)]
    option = " ".join(text(name, options[name]) for name in plain)
    flag = 'diagexact="enable"' if options.get("diagexact") else ""
    return f"""<mujoco><option {option}><flag {flag}/></option>
<worldbody><geom name="floor" type="plane" size="0 0 1" pos="0 0 -0.0999"/><site name="O"/>
<body name="b"><freejoint/><geom name="g" size="0.1"/><site name="s"/></body>
<body name="c"><joint type="slide" frictionloss="1" range="-1 1" {soft("joint")}/><geom size="0.1"
contype="0" conaffinity="0"/></body></worldbody>
<contact><pair geom1="floor" geom2="g" {soft("pair")}/></contact>
<equality><connect site1="O" site2="s" {soft("connect")}/></equality>
<tendon><spatial range="0 1" {soft("tendon")}><site site="O"/><site site="s"/></spatial></tendon>
</mujoco>"""
