"""Why a start is refused, in words, at their places in the file."""

import math
from collections.abc import Mapping

from ...cases.case import Case
from ...cases.mistake import CaseError
from ...cases.scene.frame import SPACE
from ...cases.scene.joint import Joint

DEGREES = 180 / math.pi


def initial(case: Case, what: str) -> CaseError:
    """A mistake in what is given of the start."""
    return CaseError([case.mistake(("initial",), what)])


def stays_open(
    case: Case, why: str, part: str, gap: float, unit: float, *, turns: bool
) -> CaseError:
    """The mistake that a part's equation stays open by `gap`: in rad, of turns, or in units [m]."""
    size = f"{gap * DEGREES:.3g} deg" if turns else f"{gap * unit:.3g} m"
    return initial(case, f"{why}: {part} stays open by {size}")


def several(
    case: Case, count: int, coordinate: str, values: list[str], near: Mapping[str, str]
) -> CaseError:
    """Ways to assemble, told by one coordinate; near: what would choose one of them."""
    parts: dict[str, list[str]] = {}
    for name, value in near.items():
        part, _, field = name.partition(".")
        parts.setdefault(part, []).append(f"{field}: {value}")
    text = ", ".join(f"{part}: {{{', '.join(fields)}}}" for part, fields in parts.items())
    return initial(
        case,
        f"the mechanism can be assembled in {count} ways: {coordinate} = {' or '.join(values)}; "
        f"say which by `near`, for instance near: {{{text}}}",
    )


def none_near(case: Case, name: str, values: list[str]) -> CaseError:
    """Ways to assemble, of which none is where `near` says; told by what is farthest from it."""
    part, _, field = name.partition(".")
    has = " or ".join(dict.fromkeys(values))
    place = ("near", part, field) if field in case.near[part].given else ("near", part)
    what = f"the mechanism cannot be assembled near this: {name} is {has}; say one of these"
    return CaseError([case.mistake(place, what)])


def missing(case: Case, count: int, names: list[str]) -> CaseError:
    """Coordinates or rates that follow from nothing."""
    return initial(
        case,
        f"{count} more needed: {', '.join(names)} {'is' if len(names) == 1 else 'are'} "
        "not determined by what is given and the constraints",
    )


def dead_centre(case: Case, names: list[str]) -> CaseError:
    """Two ways to assemble fall together: the constraints hold, but hardly determine anything."""
    return initial(
        case,
        f"the mechanism stands at a dead centre, where what is given hardly determines "
        f"{', '.join(names)}; give one of these instead",
    )


def dependent(case: Case, part: str) -> CaseError:
    """A joint, contact, constraint or drive that repeats what others hold."""
    scene = case.scene
    sections = {"joints": scene.joints, "contacts": scene.contacts, "drive": scene.drives}
    section = next((key for key, parts in sections.items() if part in parts), "constraints")
    such = " (a ball, a universal joint)" if scene.frame is SPACE and section == "joints" else ""
    what = (
        "the constraints are not independent: what this one holds is held by the others "
        "already, for good or in this position, so its reaction has no single value; "
        f"leave it out, replace it by one that holds less{such}, or start elsewhere"
    )
    return CaseError([case.mistake(("scene", section, part), what)])


def without_length(case: Case, rod: str) -> CaseError:
    """A rod whose points start at one place."""
    what = "has no length: its two points start at the same place, and it would have no direction"
    return CaseError([case.mistake(("scene", "joints", rod), what)])


def another_turn(case: Case, joint: str, off: float) -> CaseError:
    """A joint's angle that is whole turns from that of its bodies; off [rad]: how far."""
    given = case.initial[joint].given["angle"]
    what = (
        f"is {given:.6g} rad, but the bodies start {given + off:.6g} rad apart, which is another "
        "turn: angles count their turns, so give both on the same one"
    )
    return CaseError([case.mistake(("initial", joint, "angle"), what)])


def locked(case: Case, joint: Joint, angle: float) -> CaseError:
    """Three turns, of which the first and the last are about one axis."""
    first, middle, last = joint.turns
    at = f"{joint.name}.{middle.name} = {angle * DEGREES:.4g} deg"
    axes = f"{first.name!r} and {last.name!r} turn about one axis"
    return initial(
        case, f"at {at} {axes}, so that they determine nothing; start it by the body's `attitude`"
    )


def unreached(case: Case, joint: Joint) -> CaseError:
    """Three turns about skew axes, which cannot make the attitude that is given."""
    names = ", ".join(repr(turn.name) for turn in joint.turns)
    return initial(
        case,
        f"the turns {names} of {joint.name} cannot make the attitude at which it starts; write a "
        "ball, or axes of which each is at right angles to the one before it",
    )


def flat(case: Case) -> CaseError:
    """A rim that lies on the floor."""
    rims = ", ".join(name for name, contact in case.scene.contacts.items() if contact.rim)
    return initial(case, f"{rims}: a disk that lies flat has no lowest point; start it tilted")


def rates_violate(case: Case, part: str) -> CaseError:
    """The given rates contradict each other."""
    return initial(case, f"the rates violate {part}: no motion satisfies all that is given")


def rate_unsaid(case: Case, joint: str, *, angular: bool) -> CaseError:
    """A joint on a part that moves gives its place, and not its rate."""
    place, rate = ("angle", "omega") if angular else ("shift", "speed")
    what = (
        f"gives the {place} and no {rate}, where one of its parts moves: zero may be the joint's "
        f"rate or the other part's, and these are two starts; say {rate}"
    )
    return CaseError([case.mistake(("initial", joint, place), what)])


def moves(case: Case, point: str) -> CaseError:
    """The given rates move a point that is to stand still."""
    return initial(
        case,
        f"`on` says that {point} does not move at the start, and the rates that are given move it: "
        f"leave these out, or give its place instead ({point.replace('.', ': {', 1)}: [x, y]}})",
    )
