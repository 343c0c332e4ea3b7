"""The certificate of a case that is answered by a system of the test's choice, and what it says."""

from collections.abc import Iterable
from functools import partial

from textmech.cases.case import Case
from textmech.reference.certificate.agreement import Check
from textmech.reference.certificate.certify import certify
from textmech.reference.certificate.errors import ERROR
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import TOLERANCE, either, follow
from textmech.reference.solve import Solution, reactions_of
from textmech.reference.system import System

from .. import scenes


def certified(
    case: Case, system: System | None = None, *, tolerance: float = TOLERANCE
) -> tuple[Check, ...]:
    """All checks that apply if this system answers; without one, the generated mechanism does."""
    generated = scenes.mechanism(case)
    built = Answer(generated, follow(generated, case.times), scene=case.scene)
    marched = built.march(forces=False)
    if system is None:
        return certify(case, built, built, generated, built.trajectory(case.times), marched)
    followed = follow(system, case.times, by=partial(either, tolerance=tolerance))
    beside = reactions_of(generated, built.followed, followed)
    answer = Answer(system, followed, beside, scene=case.scene)
    return certify(case, answer, built, generated, answer.trajectory(case.times), marched)


def broken(checks: Iterable[Check] | Solution) -> set[str]:
    """Returns the names of the checks that do not hold."""
    rows = checks.checks if isinstance(checks, Solution) else checks
    return {check.name for check in rows if not check.holds}


def stated(solution: Solution) -> dict[str, float]:
    """Returns what each observed quantity, and each event's time, is certified to."""
    return {
        check.name.removeprefix(ERROR): check.certified
        for check in solution.checks
        if check.certified is not None
    }
