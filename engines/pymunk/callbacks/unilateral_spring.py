"""Springs that only press or only pull: pymunk's own act both ways, and take a function instead.

It is called in every step with the length at which pymunk's own spring would act.
"""

from collections.abc import Callable

from pymunk.constraints import DampedSpring

from ....cases.scene.forces.force import Spring
from ...law import tension

NO_SIDE = "engine: a spring of pymunk's own acts both ways"


def pushed(spring: Spring) -> Callable[[DampedSpring, float], float] | None:
    """Its force by the length, positive where it presses its ends apart; None: as pymunk has it."""
    return (lambda line, length: -tension(spring, length, 0.0)) if spring.only else None


def numbers(line: DampedSpring) -> dict[str, float]:
    """The numbers of a spring, and on which sides it acts.

    On both by pymunk's own function, which cannot be called.
    """
    rest, force = line.rest_length, getattr(line, "force_func", None)
    held = {"stiffness": line.stiffness, "rest_length": rest}
    if force is None:  # before 7.2 it takes a function, and does not tell it
        return held
    own = force is DampedSpring.spring_force
    sides = {
        "pulls": own or force(line, rest + 1.0) < 0,
        "pushes": own or force(line, rest / 2) > 0,
    }
    return held | {side: float(acts) for side, acts in sides.items()}


def as_text(spring: Spring, line: str) -> str:
    """The function as a line of Python."""
    least = {"compression": f"max(0.0, {spring.rest_length!r} - length)"}
    side = least.get(spring.only or "", f"min(0.0, {spring.rest_length!r} - length)")
    return f"{line}.force_func = lambda line, length: {spring.stiffness!r} * {side}"
