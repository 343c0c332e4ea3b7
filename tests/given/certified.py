"""The certificate of a case that is answered by a system of the test's choice."""

from functools import partial

from textmech.cases.case import Case
from textmech.reference.certificate.agreement import Check
from textmech.reference.certificate.certify import certify
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import TOLERANCE, either, follow
from textmech.reference.solve import reactions_of
from textmech.reference.system import System

from . import scenes


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
