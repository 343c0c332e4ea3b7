"""Options as lines of Python for a script as users write it, which has a `space` and steps it."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...engine import Choice
from ..model.number_text import written
from ..stepping.run import COLD
from .options import defaults

_SWEEPS = "space.iterations"
_GIVE_WAY = "(pymunk.SlideJoint, pymunk.RotaryLimitJoint)"
_SHIFTED = """\
# pymunk drifts, then kicks: start h/2 back, so that forces act in the middle of a step
for body in space.bodies:
    body.position -= h / 2 * body.velocity
    body.angle -= h / 2 * body.angular_velocity
# read body.position + h / 2 * body.velocity, and body.angle + h / 2 * body.angular_velocity"""
_IN_THE_MIDDLE = """\
# what follows a law in time has in step n the law's value at t = n * h + h / 2, and where the law
# jumps or bends within the step its mean over it: as `show` writes it"""
_SEEDED = """\
# what only touches would fall freely for one step
for body in space.bodies:
    for shape in body.shapes:
        shape.unsafe_set_radius(shape.radius + {seed!r})"""
_COLD = """\
space.iterations = {first}  # of the first {cold} steps, which have no impulses to begin with
# after them: space.iterations = {usual}"""


def snippet(choices: Sequence[Choice], step: float, *, timed: bool) -> str:
    """Lines for choices that differ from pymunk's own, to stand between building and stepping.

    timed: whether something in the scene follows a law in time.
    """
    before = defaults()
    changed = {c.name: c.value for c in choices if before.get(c.name) != c.value}
    sweeps = int(changed.get(_SWEEPS, before[_SWEEPS]))
    lines = [f"h = {step!r}  # s, for space.step(h)", *_lines(changed, sweeps, timed)]
    return "\n".join(lines) + "\n"


def _lines(changed: Mapping[str, Any], sweeps: int, timed: bool) -> Iterator[str]:
    yield from (f"{n} = {written(x)}" for n, x in changed.items() if n.startswith("space."))
    joints = {n.partition(".")[2]: x for n, x in changed.items() if n.startswith("constraint.")}
    if joints:
        yield "for joint in space.constraints:"
        for name, x in joints.items():
            if name == "max_bias":
                yield "    if joint.max_bias:  # 0: a joint that rubs corrects no position"
            yield f"    {'    ' * (name == 'max_bias')}joint.{name} = {written(x)}"
    if (eases := changed.get("limit.error_bias")) is not None:
        yield "for joint in space.constraints:  # ropes and stops"
        yield f"    if isinstance(joint, {_GIVE_WAY}):"
        yield f"        joint.error_bias = {written(eases)}"
    if seed := changed.get("start.seed"):
        yield _SEEDED.format(seed=seed)
    if changed.get("time.midpoint"):
        yield _SHIFTED
        if timed:
            yield _IN_THE_MIDDLE
    if (first := changed.get("start.iterations", sweeps)) != sweeps:
        yield _COLD.format(cold=COLD, first=first, usual=sweeps)
    yield from _said(changed)


def _said(changed: Mapping[str, Any]) -> Iterator[str]:
    """Comments on options that take more than a line: the script of `show` has them."""
    if changed.get("contact.reflects"):
        yield "# a tip on the floor gets elasticity 1 before each step: see `stays` in the script"
    if changed.get("slot.across"):
        yield "# slots beside a centre are pin joints, carried along: see `carried` in the script"
