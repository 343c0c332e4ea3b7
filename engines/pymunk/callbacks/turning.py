"""Torques between the two parts of a joint, ahead of the step in which they act."""

from collections.abc import Callable, Iterator
from functools import partial

from pymunk.body import Body

from ....cases.scene.forces.turning import Motor, Turning
from ...law import TORQUES
from ...signal import acting, in_time
from ..model.chipmunk_state import State, spinning
from ..model.chipmunk_state import turning as twisting
from ..model.world import World
from .line_forces import Exerted, Load


def twist(world: World, force: Turning, name: str) -> Exerted:
    """The load of a torsion spring or damper on the body `name`, which is the second part.

    Friction by law knows loads of what one joint alone holds, to the ground.
    """
    a, b = _parts(world, force)
    assert b is world.bodies[name]
    read_a, law = spinning(a), partial(TORQUES[type(force)], force)

    def exerted(t: float, drift: float, state: State) -> Load:
        (angle_a, omega_a), (_, _, angle_b, _, _, omega_b) = read_a(), state
        rate = omega_b - omega_a
        return 0.0, 0.0, law(angle_b - angle_a + drift * rate, rate)

    return exerted


def twisted(world: World, force: Turning, step: float) -> Callable[[float], None]:
    """Its torque at the midpoint, with the rate extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints, as `told` is of lines.
    """
    a, b = _parts(world, force)
    before = b.angular_velocity - a.angular_velocity  # there is no step before the first
    read_a, read_b, law = spinning(a), spinning(b), partial(TORQUES[type(force)], force)
    couple = _couple(a, b)

    def apply(t: float) -> None:
        nonlocal before
        (angle_a, omega_a), (angle_b, omega_b) = read_a(), read_b()
        rate = omega_b - omega_a
        angle = angle_b - angle_a + step * rate
        couple(law(angle, 1.5 * rate - 0.5 * before))
        before = rate

    return apply


def motor(world: World, force: Motor, step: float, drift: float) -> Callable[[float], None]:
    """Its torque in the middle of the step, or at its start."""
    couple, torque = _couple(*_parts(world, force)), acting(force.signal, drift)
    return lambda t: couple(torque(t)[0])


def motor_load(world: World, force: Motor, name: str) -> Exerted:
    """The load of a motor on the body `name`, the second part as in `twist`."""
    assert _parts(world, force)[1] is world.bodies[name]
    torque = in_time(force.signal)
    return lambda t, drift, state: (0.0, 0.0, torque(t)[0])


def couple_as_text(
    world: World, force: Turning, of: Callable[[Body], str], torque: str
) -> Iterator[str]:
    """Lines of Python; the ground is not told."""
    for part, sign in zip(_parts(world, force), "-+", strict=True):
        if part is not world.space.static_body:
            yield f"    {of(part)}.torque {sign}= {torque}"


def _parts(world: World, force: Turning) -> tuple[Body, Body]:
    a, b = (world.body(at) for at in world.scene.ends(force))
    return a, b


def _couple(a: Body, b: Body) -> Callable[[float], None]:
    """Turns b, and a the other way; of the ground it is nothing."""
    twist_a, twist_b = twisting(a), twisting(b)

    def couple(torque: float) -> None:
        twist_a(-torque)
        twist_b(torque)

    return couple
