"""The mean force of a dry friction law (2.89) over one step.

pymunk takes one force for the whole step. A part that stops or breaks loose within the step feels
several; with their mean its velocity at the end of the step is right to h², and no event costs a
whole step.
"""

from collections.abc import Callable

from ....cases.scene import DryFriction, Smooth
from ...law import braking, dry_friction, smooth_under

Applied = Callable[[float], float]
"""What else acts along the friction [N], so many seconds after the step's start."""
AT_REST = 1e-9
"""Below this share of what friction can stop in one step a speed is the solver's rounding."""


def bound(
    friction: DryFriction, speed: float, mass: float, applied: Applied, step: float
) -> tuple[float, float]:
    """The largest friction force [N] in the step, and the force [N] that must push in its place.

    pymunk uses as much of the bound as would stop the part: with the static bound where the law
    holds it, and the law's mean where it brakes. Only in a step that turns back without a rest
    may the mean push on, which no bound can.
    """
    middle = applied(step / 2)
    force = _mean(friction, speed, mass, middle, applied, step)
    stopping = -(middle + mass * speed / step)
    static = friction.static.forward if stopping < 0 else friction.static.backward
    if abs(force - stopping) <= AT_REST * static:
        return static, 0.0
    within = 0 <= force <= stopping or stopping <= force <= 0
    return (abs(force), 0.0) if within else (0.0, force)


def mean_friction(
    friction: DryFriction, speed: float, mass: float, applied: Applied, step: float
) -> float:
    """The mean friction force [N] over the step, for what else acts in its middle or at its end.

    A part that stops goes on, or stays, by the force in the middle of the step.
    """
    return _mean(friction, speed, mass, applied(step / 2), applied, step)


def _mean(
    friction: DryFriction, speed: float, mass: float, middle: float, applied: Applied, step: float
) -> float:
    """Mean friction force [N] over the step, for a force in its middle that is known already."""
    holding = max(friction.static.forward, friction.static.backward)
    if abs(speed) * mass <= AT_REST * holding * step:
        return _from_rest(friction, middle, applied(step))
    brakes = dry_friction(friction, speed, middle)
    after = speed + (middle + brakes) * step / mass
    if friction.stribeck:  # it changes with the speed: that in the middle of the motion
        half = (speed + after) / 2 if after * speed > 0 else speed / 2
        brakes = dry_friction(friction, half, middle)
        after = speed + (middle + brakes) * step / mass
    if after * speed > 0:
        return brakes
    moving = mass * speed / (-(middle + brakes) * step)  # the share of the step before it stops
    beyond = dry_friction(friction, 0.0, middle)
    if beyond == -middle:
        return -middle - mass * speed / step  # it stops and stays
    return moving * brakes + (1 - moving) * beyond


def _from_rest(friction: DryFriction, middle: float, end: float) -> float:
    """The mean friction force [N] over a step that begins at rest.

    What else acts grows from 2 middle − end to `end`; it slips from where it passes the bound.

    Over the slipping share s of the step the mean of the force left over is
    s (static − kinetic) + s² |end − middle|.
    """
    if dry_friction(friction, 0.0, end) == -end:
        return -middle
    static, kinetic = _ahead(friction, end)
    grown = abs(end - middle)  # in half a step
    slipping = (abs(end) - static) / (2 * grown) if grown else 1.0
    if slipping >= 1:  # beyond the bound from the start
        return dry_friction(friction, 0.0, end)
    left = slipping * (static - kinetic) + slipping**2 * grown
    return -middle + (left if end > 0 else -left)


def _ahead(friction: DryFriction, applied: float) -> tuple[float, float]:
    """Static and first kinetic friction [N] of the direction in which it is pushed."""
    static, sense = friction.static, 1 if applied > 0 else -1
    return static.forward if applied > 0 else static.backward, braking(friction, sense, 0.0)


def smooth_mean(
    friction: DryFriction,
    smooth: Smooth,
    speed: float,
    mass: float,
    applied: float,
    step: float,
) -> float:
    """(2.95) by the implicit midpoint rule [N]: explicitly, A F h / m = 30 is unstable.

    The solution of m (v − v₀) = h (F_a + F_fr((v₀ + v)/2, F_a)) nearest to the present speed.
    """
    force = smooth_under(friction, smooth, applied)

    def left(mean: float) -> float:
        return 2 * mass * (mean - speed) - step * (applied + force(mean))

    return force(_root(left, speed, slope=2 * mass, close=1e-9 * smooth.band))


def _root(left: Callable[[float], float], near: float, *, slope: float, close: float) -> float:
    """A zero of `left`, which is negative far below and positive far above, beside `near`.

    Illinois' regula falsi needs no derivative and never leaves the bracket; the bracket ends a
    little beyond where `left` would be zero if it only had that slope.
    """
    here = left(near)
    reach = -1.001 * here / slope
    far = near + reach
    while (there := left(far)) * here > 0:
        near, here, reach = far, there, 2 * reach
        far += reach
    while here and there and abs(far - near) > close:
        middle = (near * there - far * here) / (there - here)
        now = left(middle)
        if now * there < 0:
            near, here = far, there
        else:
            here /= 2
        far, there = middle, now
    return near if not here else far
