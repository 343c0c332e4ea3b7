"""MuJoCo's knobs for a scene: a closed list, each value measured in some case.

A group's solref, solimp and solreffriction are one knob: they spoil each other alone.
"""

from collections.abc import Sequence
from typing import Any

from ....cases.scene import Scene
from ...engine import Start
from ...knobs import Knob, Options, Value, short_value
from ..model.contact import HARDEST, closed, recipes, worth
from ..model.number_text import EACH
from ..model.planes import met
from .groups import Group, groups
from .options import as_options
from .settings import best

STEPS = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1e-4)  # s
STAGES = {"RK4": 4}  # evaluations of the dynamics in a step; every other integrator takes one
INTEGRATORS = ("implicitfast", "implicit", "discrete", "RK4")
# What only touches would fall freely for one step: MuJoCo knows a contact from below its margin on.
MARGIN = Value("a margin of 1e-9 m", {"pair": {"margin": 1e-9}})
_HARD, _MIDDLE = HARDEST, 0.99  # of d
_STIFF = ("2h", "4h", "10h")  # time constants


def knobs(scene: Scene, start: Start) -> list[Knob]:
    """The knobs that matter for the scene."""
    lies, bundles = closed(scene, start), worth(scene)
    tuned = as_options(best(scene, start), settled=lies)
    every = [_knob("integrator", INTEGRATORS, tuned)]
    every += [_softness(group, tuned) for group in groups(scene)]
    if any(contact.friction for contact in met(scene)):  # the pyramid's friction and its creep
        every.append(_knob("cone", ["elliptic"], tuned))
        every.append(_knob("impratio", [10.0, 100.0, 1e4, 1e6], tuned))
    if "noslip_iterations" in tuned or bundles:
        every.append(_knob("noslip_iterations", [5], tuned))
    if "diagexact" in tuned:
        every.append(_knob("diagexact", [True], tuned))
    if lies:
        settled = Value("a settled start", {"settled": True})
        every.append(Knob("start", (settled,), settled, "ours"))
        every.append(Knob("margin", (MARGIN,)))
    if bundles:
        numbers = {word: as_options(recipes(scene)[word](scene)) for word in bundles}
        values = (Value(f"the recipe for contacts that {w}", x) for w, x in numbers.items())
        every.append(Knob("contacts", tuple(values), kind="bundle"))
    return every


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
    tuned_value = value(**numbers) if numbers else None
    alone = tuned.get(EACH, {}).items() if group.single else ()  # of one contact or joint's stops
    own = {element: numbers for element, numbers in alone if pushes in numbers}
    if tuned_value and own:
        words = f"{tuned_value.words}, {' and '.join(own)} otherwise"
        tuned_value = Value(words, {**tuned_value.options, EACH: own})
    if tuned_value and tuned_value.options not in [known.options for known in values]:
        values.append(tuned_value)
    return Knob(f"softness of {whose}", tuple(values), tuned_value)


def cost(options: Options, step: float) -> float:
    """Evaluations of the dynamics in a simulated second."""
    return STAGES.get(options.get("integrator", ""), 1) / step
