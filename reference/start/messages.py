"""Why a start is refused: the words that the plane and space share, at their places in the file."""

import math

from ...cases.case import Case
from ...cases.mistake import CaseError

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


def several(case: Case, count: int, coordinate: str, values: list[str]) -> CaseError:
    """Ways to assemble, told by one coordinate."""
    part, _, field = coordinate.partition(".")
    return initial(
        case,
        f"the mechanism can be assembled in {count} ways: {coordinate} = {' or '.join(values)}; "
        f"say which by `near`, for instance near: {{{part}: {{{field}: {values[0]}}}}}",
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


def dependent(case: Case, section: str, part: str, such: str = "") -> CaseError:
    """A constraint that repeats what others hold; such: for instance, what holds less."""
    return CaseError(
        [
            case.mistake(
                ("scene", section, part),
                "the constraints are not independent: what this one holds is held by the others "
                "already, for good or in this position, so its reaction has no single value; "
                f"leave it out, replace it by one that holds less{such}, or start elsewhere",
            )
        ]
    )


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
