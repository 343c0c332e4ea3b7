"""Why a motion is refused, as a mistake at the place in the case that causes it.

What stops a motion (a line without direction, constraints that come to depend on each other) is
asked only after the integrators have failed, to say why.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

from numpy.linalg import LinAlgError

from ..cases.case import Case
from ..cases.language.check.work import GO_ON, LIMIT
from ..cases.mistake import CaseError, Mistake
from ..cases.scene.forces.force import Force
from ..cases.scene.frame import SPACE
from ..cases.scene.joint import Joint
from .integrators.budget import Endless, budget
from .laws.rotation import axes
from .mechanism.forces.action import NoDirection
from .mechanism.modes.impact_transition import OneInstant
from .mechanism.modes.mechanism import BadStart, Mechanism
from .mechanism.modes.mode_selection import Undetermined
from .motion.stuck import Stuck
from .motion.zeno import ZenoError
from .start.assembly import closure_of, size_of
from .system import Array, Pose

STEEP = 1e-2  # of a blade's length: steps give up well before its shadow is gone
SHORT = 1e-3  # of the mechanism's size: steps give up well before the length is zero
SHARP = 1e7  # sharpness times static friction: 6e5 of the book's can be followed, 6e7 not always
UNEVEN = 1e4  # of two masses: the lighter one's equations then have lost four digits of sixteen
FAST = 1e3  # swings in the duration: an integrator of order 8 takes a dozen steps for each
NAMED = 6  # of the elements in a message: the others are like these
DEPENDENT = 1e-2  # singular values below this part of the largest: the same, for constraints


@contextmanager
def bounded(case: Case) -> Iterator[None]:
    """Turns what takes too long or too much memory, or leaves the doubles, into CaseError."""
    try:
        with budget(math.inf if case.long else LIMIT):
            yield
    except Endless as endless:
        what = f"the reference {endless}, and that is the limit: "
        place = ("duration",) if case.states is None else ("states", "random")
        mistake = case.mistake(place, what + GO_ON)
        if endless.among:
            mistake = case.mistake(_where(case, endless.among), what + _advice(endless.among))
        raise CaseError([mistake]) from endless
    except MemoryError as error:
        more = f" ({error})" if str(error) else ""
        what = (
            f"the reference of {len(case.scene.bodies)} bodies and {len(case.scene.joints)} joints "
            f"needs more memory than its process may take{more}; give fewer, or more memory, as by "
            "TEXTMECH_MEMORY_LIMIT [GiB]"
        )
        raise CaseError([case.mistake(("scene",), what)]) from None  # its frames hold the arrays
    except (ArithmeticError, LinAlgError) as error:
        what = f"the numbers of this scene cannot be computed with ({error}); are the units right?"
        raise CaseError([case.mistake(("scene",), what)]) from error


@contextmanager
def refusals(case: Case, generated: Mechanism) -> Iterator[None]:
    """Turns what stops the motion into CaseError."""
    try:
        yield
    except (BadStart, Undetermined, ZenoError, Stuck) as failure:
        raise CaseError([_mistake(case, generated, failure)]) from failure
    except NoDirection as short:
        what = "has no length at the start, and so no direction; start it elsewhere"
        raise CaseError([case.mistake(("scene", "forces", str(short)), what)]) from short


def unreached(case: Case, joint: str, t: float) -> CaseError:
    """Three turns about skew axes that cannot make the attitude to which the motion leads."""
    names = ", ".join(repr(turn.name) for turn in case.scene.joints[joint].turns)
    what = (
        f"the turns {names} cannot make the attitude at t = {t:.4g} s: their axes are skew, and "
        "leave some out; write a ball, or axes of which each is at right angles to the one before"
    )
    return CaseError([case.mistake(("scene", "joints", joint), what)])


def _where(case: Case, among: Sequence[str]) -> tuple[str, ...]:
    """Where the file has most of what may go on in very many ways."""
    sections = ("contacts", "joints", "forces")
    contacts = {*case.scene.contacts, *case.scene.pairs, *case.scene.touching}
    counts = {
        section: sum(name.partition(".")[0] in known for name in among)
        for section, known in zip(
            sections, (contacts, case.scene.joints, case.scene.forces), strict=True
        )
    }
    return "scene", max(sections, key=counts.__getitem__)


def _advice(among: Sequence[str]) -> str:
    """Advice to a person with very many ways, as the end of a sentence."""
    more = len(among) - NAMED
    names = ", ".join(among[:NAMED]) + (f" and {more} more" if more > 0 else "")
    return (
        f"{len(among)} elements of bodies that hang together may each stick, slide or open there "
        f"({names}), and each multiplies the ways; give fewer, some of them `friction: 0`, or take "
        f"apart what need not be joined; {GO_ON}"
    )


def _mistake(case: Case, generated: Mechanism, failure: Exception) -> Mistake:
    place: tuple[str, ...] = ("duration",)
    match failure:
        case BadStart():
            return case.mistake(("initial",), str(failure))
        case OneInstant(part=part) if (name := part.partition(".")[0]) in case.scene.forces:
            return case.mistake(("scene", "forces", name), str(failure))
        case OneInstant(part=part):
            return case.mistake(("scene", "contacts", part), str(failure))
        case Undetermined(part=part) if (name := part.partition(".")[0]) in _touching(case):
            return case.mistake(("scene", "contacts", name, "friction"), str(failure))
        case Undetermined(part=part) if (name := part.partition(".")[0]) in case.scene.forces:
            return case.mistake(("scene", "forces", name), str(failure))
        case Undetermined(part=part):
            return case.mistake(("scene", "joints", part, "dry_friction"), str(failure))
        case ZenoError(event=event, time=time):
            why = f"{event!r} happens thousands of times or without end (a Zeno sequence)"
        case Stuck(time=time):
            poses = failure.mode.poses(time, failure.q, failure.v)
            q, _ = generated.base.place(poses)
            why = _upright(case, poses) or _line(case, generated, time, q) or _constraint(case, q)
            if why is None:
                why = str(failure).partition(" at t = ")[0]
                if (joint := _sharpest(case)) is not None:
                    place = ("scene", "joints", joint.name, "dry_friction", "smooth", "sharpness")
                    why += _smoother(joint)
                else:
                    why += _uneven(case)
        case _:
            raise failure
    what = f"the motion cannot be followed beyond t = {time:.4g} s: {why}"
    return case.mistake(place, what)


def _touching(case: Case) -> set[str]:
    return {*case.scene.contacts, *case.scene.pairs}


def _upright(case: Case, poses: Mapping[str, Pose]) -> str | None:
    """Which blade in space stands upright, and so has no heading."""
    for edge in case.scene.constraints.values() if case.scene.frame is SPACE else ():
        x, y, z = edge.along @ axes(poses[edge.at.body][SPACE.attitude])
        if math.hypot(x, y) < STEEP:
            where = "down" if z < 0 else "up"
            falls = f": {edge.at.body} falls on its nose" if z < 0 and not edge.kept else ""
            return f"{edge.name} points straight {where} there and has no heading{falls}"
    return None


def _line(case: Case, generated: Mechanism, t: float, q: Array) -> str | None:
    name = generated.base.without_direction(t, q, SHORT * size_of(case))
    return None if name is None else f"{name} has no length there, and so no direction"


def _constraint(case: Case, q: Array) -> str | None:
    part = _dependent(case, q)
    return part and (
        f"in this position what {part} holds is held by the others already, so that "
        "neither its reaction nor the way on is determined"
    )


def _dependent(case: Case, q: Array) -> str | None:
    """The first part that holds what others nearly hold already."""
    return closure_of(case).dependent(q, DEPENDENT)


def _sharpest(case: Case) -> Joint | None:
    """The joint whose smooth law of friction is the sharpest, if steps may not resolve it."""
    joints = [joint for joint in case.scene.joints.values() if _sharpness(joint) > SHARP]
    return max(joints, key=_sharpness, default=None)


def _sharpness(joint: Joint) -> float:
    """A F_s, how sharply (2.95) switches between rest and motion; 0 of any other law."""
    dry = joint.dry_friction
    if dry is None or dry.smooth is None:
        return 0.0
    return dry.smooth.sharpness * max(dry.static.forward, dry.static.backward)


def _smoother(joint: Joint) -> str:
    """Advice to a person with too sharp a law of friction, as the end of a sentence."""
    return (
        "; the sharpness A of (2.95) counts forces as it counts speeds, and the law switches "
        f"within {1 / _sharpness(joint):.0e} of the static friction of {joint.name}: give a "
        "smaller `sharpness` and as much larger a `band`, or leave out `smooth` for the exact law"
    )


def _uneven(case: Case) -> str:
    """Advice to a person with numbers that lie far apart, as the end of a sentence."""
    bodies = sorted(case.scene.bodies.values(), key=lambda body: body.mass)
    light, heavy = bodies[0], bodies[-1]
    if heavy.mass > UNEVEN * light.mass:
        return (
            f"; {heavy.name} is {heavy.mass / light.mass:.0e} times as heavy as {light.name}: give "
            f"{light.name} more mass, or leave it out"
        )
    stiffness = max((c for f in case.scene.forces.values() for c in _stiffness(f)), default=0.0)
    swings = case.duration * math.sqrt(stiffness / light.mass) / math.tau
    if swings > FAST:
        return (
            f"; a spring of {stiffness:.0e} N/m swings {swings:.0e} times in {case.duration:g} s: "
            "make it softer, or a joint"
        )
    return "; shorten the duration, or change what is about to jump or to meet there"


def _stiffness(force: Force) -> Iterator[float]:
    """[N/m] of a spring."""
    if "stiffness" in (numbers := force.numbers()):
        yield numbers["stiffness"]
