"""The plainest loop that a user of pymunk would write: the yardstick of `textmech bench`.

Natively it is the script that `show` prints, run as it is. Of a law it is that script with the
force of the present instant, which is of first order.
"""

from collections.abc import Callable, Mapping
from typing import Any

from pymunk.space import Space

from ...cases.scene import Scene
from ..engine import Plain, Plan, Start
from .law.cut import cuts
from .law.present import acts, sayable
from .plans import named
from .run import COLD
from .scene import build
from .script import before_each, building


def plain(scene: Scene, start: Start, step: float, plan: Plan) -> Callable[[float], Plain] | None:
    """See `Loop.plain`: pymunk cannot go back to a start, so every step builds its own space."""
    law = plan.realised == "law"
    if law and not sayable(scene):
        return None
    if plan.realised == "driver" and cuts(scene):
        return None  # the script cuts no step
    numbers = named(plan.choices(step))
    world = build(scene, start, numbers, plan.realised)
    if law:
        world.brakes.clear()  # the law's force is all the friction there is
    lines = [
        "import math",
        "import pymunk",
        *building(world, start, numbers),
        "def take(first, last):",
        "    for n in range(first, last):",
        *(f"    {line}" for line in before_each(world, numbers)),
        *(["        for act in acts:", "            act()"] if law else []),
        "        space.step(h)",
    ]
    script = compile("\n".join(lines), "<plain>", "exec")
    cold = numbers.get("start.iterations")

    def begin(h: float) -> Plain:
        names: dict[str, Any] = {"h": h}
        exec(script, names)
        if law:
            names["acts"] = list(acts(scene, names["space"], names["bodies"]))
        take = _warming(names["take"], names["space"], cold) if cold else names["take"]
        return Plain(_counting(take), lambda: _states(scene, names, numbers))

    return begin


Take = Callable[[int, int], None]
"""From one step to another."""


def _warming(take: Take, space: Space, cold: int) -> Take:
    """With more sweeps in the first steps; the script asks before each, which costs more."""
    usual = space.iterations

    def taken(first: int, last: int) -> None:
        middle = max(first, min(COLD, last))
        space.iterations = cold
        take(first, middle)
        space.iterations = usual
        take(middle, last)

    return taken


def _counting(take: Take) -> Callable[[int], None]:
    done = 0

    def counted(n: int) -> None:
        nonlocal done
        first, done = done, done + n
        take(first, done)

    return counted


def _states(scene: Scene, names: Mapping[str, Any], numbers: Mapping[str, Any]) -> Start:
    ahead = names["h"] / 2 if numbers.get("time.midpoint") else 0.0
    found = {}
    for name in scene.bodies:
        body = names["bodies"][name]
        (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
        found[name] = (x + ahead * vx, y + ahead * vy, body.angle + ahead * omega, vx, vy, omega)
    return found
