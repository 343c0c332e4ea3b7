"""Why a motion that switches is refused, at the place in the case that causes it."""

from ..cases.case import Case
from ..cases.mistake import CaseError
from .generated.choosing import BadStart, Undetermined
from .integrators.march import IntegrationError
from .motion.follow import ZenoError

SWITCHING_FAILURES = (BadStart, Undetermined, ZenoError, IntegrationError, ArithmeticError)


def switching_refused(case: Case, failure: Exception) -> CaseError:
    """The failure as a mistake in the case."""
    match failure:
        case BadStart():
            return CaseError([case.mistake(("initial",), str(failure))])
        case Undetermined(part=part) if part in case.scene.contacts:
            where = ("scene", "contacts", part, "friction")
            return CaseError([case.mistake(where, str(failure))])
        case Undetermined(part=part):
            where = ("scene", "joints", part, "dry_friction")
            return CaseError([case.mistake(where, str(failure))])
        case ZenoError(event=event, time=time):
            what = (
                f"the motion cannot be followed beyond t = {time:.4g} s: {event!r} happens "
                "thousands of times or without end (a Zeno sequence)"
            )
        case IntegrationError(time=time):
            what = f"the motion cannot be followed beyond t = {time:.4g} s: {failure}"
        case _:
            what = f"the motion cannot be followed: {failure}"
    return CaseError([case.mistake(("duration",), what)])
