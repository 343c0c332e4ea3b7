"""Options as lines of Python, to paste after what builds the scene.

It has `space`, `bodies`, `wheels`, `joints` and `limits`, as the script of `show` calls them.
"""

from collections.abc import Iterator, Sequence

from ..engine import Choice, Start
from .contact import closed
from .run import COLD
from .script import SHIFT, seeds
from .settings import defaults
from .world import World
from .written import written


def snippet(world: World, start: Start, choices: Sequence[Choice], step: float) -> str:
    """What is not as pymunk has it by itself, in words where it is no line."""
    before = defaults()
    changed = {c.name: c.value for c in choices if before.get(c.name) != c.value}
    lines = [f"h = {step!r}  # s, for space.step(h)"]
    lines += [f"{n} = {written(x)}" for n, x in changed.items() if n.startswith("space.")]
    joints = [(n, x) for n, x in changed.items() if n.startswith("constraint.")]
    if joints:
        lines.append("for joint in joints:")
        lines += [f"    joint.{n.partition('.')[2]} = {written(x)}" for n, x in joints]
    if (eases := changed.get("limit.error_bias")) is not None:
        lines.append("for joint in limits:  # ropes and stops")
        lines.append(f"    joint.error_bias = {written(eases)}")
    if (seed := changed.get("start.seed")) and closed(world.scene, start):
        lines += seeds(world, start, seed)
    if changed.get("time.midpoint"):
        lines += [SHIFT, "# read body.position + h / 2 * body.velocity, and angles likewise"]
    return "\n".join([*lines, *_said(changed)]).strip() + "\n"


def _said(changed: dict[str, object]) -> Iterator[str]:
    """What takes more than a line: the script of `show` has it."""
    cold = changed.get("start.iterations")
    if cold and cold != changed.get("space.iterations"):
        yield f"# in the first {COLD} steps: space.iterations = {cold}"
    if changed.get("contact.reflects"):
        yield "# a tip on the floor gets elasticity 1 before each step: see `stays` in the script"
    if changed.get("slot.across"):
        yield "# slots beside a centre are pin joints, carried along: see `carried` in the script"
