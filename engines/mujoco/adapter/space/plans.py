"""Plans of MuJoCo's settings for a scene in space: exponents, and the protocol's words."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from .....cases.scene import Scene
from ....engine import Choice, Plan, Realised, Start
from ...model.scene import HEAVY, LEAST
from ...model.tree import driven
from ..compilation import NOMINAL
from ..plans import follows
from .compilation import placed

Numbers = Callable[[float], Sequence[Choice]]


def ways(scene: Scene, start: Start, *, tuned: bool) -> tuple[Realised, ...]:
    """MuJoCo's own elements, and edges by our law."""
    return ("law",) if scene.constraints else ("native",)


def plan(
    scene: Scene,
    start: Start,
    realised: Realised,
    numbers: Numbers,
    *,
    settles: bool,
    tuned: bool,
) -> Plan:
    """One way's plan. Nothing is withheld: all reactions can be read.

    Exponents: Euler and contacts 1, 2; RK4 4, 5; soft constraints that follow the step, and
    steps with the mean of a force that jumps, 2, 3.
    """
    integrator = {choice.name: choice.value for choice in numbers(NOMINAL)}["option.integrator"]
    jumps = any(law.corners for law in scene.laws())
    first = integrator != "RK4" or bool(scene.contacts)
    following = (1, 2) if first else (2, 3)
    bare = Plan(
        realised,
        held=(1, 2) if first else (2, 3) if jumps else (4, 5),
        following=following if follows(numbers) else None,
        numbers=numbers,
    )
    return replace(bare, protocol=partial(_words, scene, start, bare, settles))


def _words(scene: Scene, start: Start, plan: Plan, settles: bool, step: float) -> str:
    """The protocol in words: what is heavy, what is light, and how what rolls is started."""
    words = []
    if any(driven(scene)):
        words.append(f"driven points are masses of {HEAVY:g} kg")
    if scene.drives:
        words.append(f"prescribed rates are armatures of {HEAVY:g} kg m² (kg of a slide)")
    if scene.constraints:
        words.append(f"{', '.join(scene.constraints)} held by our law at every stage")
    slender = [
        name for name, body in scene.bodies.items() if body.turns and min(body.inertia[:3]) == 0.0
    ]
    words += [f"{name} has {LEAST:g} kg m² about its own axis" for name in slender]
    if settles and scene.contacts:
        *_, begun = placed(scene, start, step, plan, settles=True)
        words += [
            f"{name} started {depth:.1e} m in the floor, creeping {creep:.1e} m/s"
            for name, (depth, creep) in begun.items()
            if depth
        ]
    return "; ".join(words)
