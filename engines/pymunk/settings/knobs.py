"""pymunk's knobs for a scene: a closed list, each value measured in some case.

Left out are collision_persistence, max_bias and damping: inert, or another physics.
"""

from functools import cache

from ....cases.scene import Scene
from ...engine import Cost, Start
from ...knobs import Kind, Knob, Options, Value, short_value
from ..stepping.scene import build
from .options import BY_THE_SCENE, defaults, own
from .recipe import as_options

STEPS = (0.02, 0.01, 5e-3, 2.5e-3, 1e-3, 5e-4, 2.5e-4)  # s; a finer one costs 100 times pymunk's
_WORDS: dict[str, tuple[str, Kind]] = {
    "midpoint": ("midpoint", "protocol"),
    "error_bias": ("error_bias {}", "option"),
    "iterations": ("iterations {}", "option"),
    "limit_bias": ("limit_bias {}", "option"),
    "seed": ("a seed of {} m", "protocol"),
    "collision_slop": ("collision_slop {}", "option"),
    "collision_bias": ("collision_bias {}", "option"),
    "reflects": ("tips that reflect", "ours"),
    "across": ("pin joints across slots", "ours"),
}


def knobs(scene: Scene, start: Start) -> list[Knob]:
    """The knobs that matter for the scene."""
    tuned, known = as_options(scene, start), list[Knob]()
    for name, (words, kind) in _WORDS.items():
        if name not in tuned:
            continue
        number = tuned[name]
        size = "by the scene" if number == BY_THE_SCENE else short_value(number)
        together = (name, "start_iterations") if name == "iterations" else (name,)
        best = Value(words.format(size), {each: tuned[each] for each in together})
        tried: dict[str, list[Value]] = {
            "error_bias": [Value("error_bias 0", {name: 0.0})],
            "iterations": [*(Value(f"{n} iterations", {name: n}) for n in (30, 100)), best],
            "collision_slop": [],  # of use beside others only
            "collision_bias": [],
        }
        known.append(Knob(name, tuple(tried.get(name, [best])), best, kind))
    return known


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
        given = options.get("iterations", shipped)
        sweeps = needed() if given == BY_THE_SCENE else given
        return (still + sweeps * swept) / (still + shipped * swept) / step

    return of
