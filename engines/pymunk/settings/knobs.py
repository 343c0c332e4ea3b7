"""pymunk's knobs for a scene: a closed list, each value measured in some case.

Left out are collision_persistence, max_bias and damping: inert, or another physics.
"""

from collections.abc import Iterator
from functools import cache
from typing import Any

from ....cases.scene import Scene
from ...engine import Cost, Start
from ...knobs import Knob, Options, Value, short_value
from ..stepping.scene import build
from .options import BY_THE_SCENE
from .settings import defaults
from .user_options import as_options, own

STEPS = (
    0.02,
    0.01,
    5e-3,
    2.5e-3,
    1e-3,
    5e-4,
    2.5e-4,
)  # s; a finer one costs 100 times pymunk's own


def knobs(scene: Scene, start: Start) -> list[Knob]:
    """The knobs that matter for the scene."""
    tuned = as_options(scene, start)
    found = [Knob("midpoint", (_ON["midpoint"],), _ON["midpoint"], "protocol")]
    if "error_bias" in tuned:
        closed = Value("error_bias 0", {"error_bias": 0.0})
        share = Value("error_bias by the scene", {"error_bias": BY_THE_SCENE})
        best = share if tuned["error_bias"] == BY_THE_SCENE else closed
        found.append(Knob("error_bias", (closed,), best))
    if "iterations" in tuned:
        found.append(_sweeps(tuned))
    if "limit_bias" in tuned:
        eases = Value("limit_bias by the scene", {"limit_bias": tuned["limit_bias"]})
        found.append(Knob("limit_bias", (eases,), eases))
    return [*found, *_contacts(tuned), *_slots(tuned)]


_ON = {
    "midpoint": Value("midpoint", {"midpoint": True}),
    "across": Value("pin joints across slots", {"across": True}),
    "reflects": Value("tips that reflect", {"reflects": True}),
}


def _sweeps(tuned: Options) -> Knob:
    names = ("iterations", "start_iterations")
    numbers = (Value(f"{n} iterations", {"iterations": n}) for n in (30, 100))
    best = Value("iterations by the scene", {name: tuned[name] for name in names})
    return Knob("iterations", (*numbers, best), best)


def _contacts(tuned: Options) -> Iterator[Knob]:
    """The seed, and what helps beside others only."""
    if "seed" in tuned:
        seed = Value(f"a seed of {short_value(tuned['seed'])} m", {"seed": tuned["seed"]})
        yield Knob("seed", (seed,), seed, "protocol")
    for name in ("collision_slop", "collision_bias"):
        if name in tuned:
            yield Knob(name, (), _number(name, tuned[name]))
    if "reflects" in tuned:
        yield Knob("reflects", (_ON["reflects"],), _ON["reflects"], "ours")


def _slots(tuned: Options) -> Iterator[Knob]:
    if "across" in tuned:
        yield Knob("across", (_ON["across"],), _ON["across"], "ours")


def _number(name: str, value: Any) -> Value:
    return Value(f"{name} {short_value(value)}", {name: value})


# Measured in scenes of 0 to 40 bodies, in sweeps over one joint (19 ns on the common machine).
CALL, BODY, TOUCH = 100, 6, 2  # a step of an empty space; a body in it; a sweep over a contact


def cost(scene: Scene, start: Start) -> Cost:
    """Steps in a simulated second, each as dear as its sweeps make it: with pymunk's own ten, 1.

    What first steps sweep more is paid once, and no second dearer for it.
    """
    space = build(scene, start, {}, "native").space
    swept = len(space.constraints) + TOUCH * (len(scene.touching) + len(scene.pairs))
    still = CALL + BODY * len(space.bodies)
    shipped = defaults()["space.iterations"]

    @cache
    def needed() -> int:  # whatever the step is
        choices = own({"iterations": BY_THE_SCENE}, scene, start)(STEPS[0])
        return next(choice.value for choice in choices if choice.name == "space.iterations")

    def of(options: Options, step: float) -> float:
        told = options.get("iterations", shipped)
        sweeps = needed() if told == BY_THE_SCENE else told
        return (still + sweeps * swept) / (still + shipped * swept) / step

    return of
