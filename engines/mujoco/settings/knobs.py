"""MuJoCo's knobs for a scene: a closed list, each value measured in some case.

A group's solref, solimp and solreffriction are one knob: they spoil each other alone.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...engine import Choice
from ...knobs import Knob, Options, Value, short_value
from ..model.contact import HARDEST
from ..model.number_text import EACH
from .groups import Group
from .options import as_options

STEPS = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1e-4)  # s
STAGES = {"RK4": 4}  # evaluations of the dynamics in a step; every other integrator takes one
INTEGRATORS = ("implicitfast", "implicit", "discrete", "RK4")
# What only touches would fall freely for one step: MuJoCo knows a contact from below its margin on.
MARGIN = Value("a margin of 1e-9 m", {"pair": {"margin": 1e-9}})
_HARD, _MIDDLE = HARDEST, 0.99  # of d
_STIFF = ("2h", "4h", "10h")  # time constants


def knobs(
    best: Sequence[Choice],
    soft: Sequence[Group],
    bundles: Mapping[str, Sequence[Choice]],
    *,
    lies: bool,
    rubs: bool,
) -> list[Knob]:
    """The knobs that matter for the scene. best: the tuned recipe; soft: its groups.

    bundles: the recipes for contacts that fit it. lies: whether something starts on the floor;
    rubs: whether what touches has friction.
    """
    tuned = as_options(best, settled=lies)
    found = [
        Knob(
            "integrator",
            tuple(_of("integrator", word) for word in INTEGRATORS),
            _of("integrator", tuned["integrator"]),
        ),
        *(_softness(group, tuned) for group in soft),
    ]
    if rubs:
        found += _contacts(tuned)
    if "noslip_iterations" in tuned or bundles:
        found.append(_knob("noslip_iterations", [5], tuned))
    if "diagexact" in tuned:
        found.append(_knob("diagexact", [True], tuned))
    if lies:
        start = Value("a settled start", {"settled": True})
        found.append(Knob("start", (start,), start, "ours"))
        found.append(Knob("margin", (MARGIN,)))
    if bundles:
        recipes = tuple(
            Value(f"the recipe for contacts that {word}", as_options(choices, settled=False))
            for word, choices in bundles.items()
        )
        found.append(Knob("contacts", recipes, kind="bundle"))
    return found


def _contacts(tuned: Options) -> Iterator[Knob]:
    """The pyramid's friction and its creep."""
    yield _knob("cone", ["elliptic"], tuned)
    yield _knob("impratio", [10.0, 100.0, 1e4, 1e6], tuned)


def _knob(name: str, values: Sequence[Any], tuned: Options) -> Knob:
    best = _of(name, tuned[name]) if name in tuned else None
    return Knob(name, tuple(_of(name, value) for value in values), best)


def _of(name: str, value: Any) -> Value:
    if value is True or name == "noslip_iterations":
        return Value(name.partition("_")[0], {name: value})
    if isinstance(value, str):
        return Value(value if name == "integrator" else f"{value} {name}", {name: value})
    return Value(f"{name} {short_value(value)}", {name: value})


def _softness(group: Group, tuned: Options) -> Knob:
    """The time constant, how hard it is, both, and what the tuned recipe has."""
    pushes, holds = group.attribute("solref"), group.attribute("solimp")
    whose, element = group.whose, group.option

    def value(**numbers: Any) -> Value:
        words = (
            f"d = {n[0]:g}" if k == holds else f"{k} {short_value(n)}" for k, n in numbers.items()
        )
        return Value(f"{whose}: {', '.join(words)}", {element: numbers})

    springs = [*([text, 1.0] for text in _STIFF), *group.springs]
    hardness = [[d, d, 0.001] for d in (_HARD, _MIDDLE, *group.hardness)]
    values = [
        *(value(**{pushes: spring}) for spring in springs),
        *(value(**{holds: hard}) for hard in hardness),
        *(value(**{pushes: spring, holds: hardness[0]}) for spring in springs[:2]),
    ]
    numbers = {name: x for name, x in tuned.get(element, {}).items() if name in group.attributes}
    best = value(**numbers) if numbers else None
    if best and (own := _own(tuned, group)):
        best = Value(f"{best.words}, {' and '.join(own)} otherwise", {**best.options, EACH: own})
    if best and best.options not in [one.options for one in values]:
        values.append(best)
    return Knob(f"softness of {whose}", tuple(values), best)


def _own(tuned: Options, group: Group) -> dict[str, Any]:
    """By name, the numbers that the tuned recipe gives one contact, or one joint's stops, alone."""
    given = tuned.get(EACH, {}).items() if group.single else ()
    pushes = group.attribute("solref")
    return {element: numbers for element, numbers in given if pushes in numbers}


def cost(options: Options, step: float) -> float:
    """Evaluations of the dynamics in a simulated second."""
    return STAGES.get(options.get("integrator", ""), 1) / step
