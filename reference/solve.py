"""Case → reference motion with its own certificate.

The motion is the hand-written system's where there is one, else the generated mechanism's.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..cases.case import Case
from ..cases.mistake import CaseError
from ..cases.observe import observe
from ..cases.quantity import table
from ..cases.trajectory import ANGLE, OMEGA, VX, VY, Array, Trajectory, X, Y
from .certificate.certificate_switching import certify_switching
from .certificate.certify import Check, certify
from .generated.choosing import SwitchingMechanism
from .generated.element import switches
from .generated.mechanism import Mechanism
from .integrators.explicit import dormand_prince
from .motion.follow import follow
from .motion.record import Motion, completed
from .motion.smooth import TOLERANCE, Stuck, integrate, motion
from .obstacle import refused
from .start.assembly import assemble
from .start.closure import Closure
from .switching_refusal import SWITCHING_FAILURES, switching_refused
from .systems import SWITCHING, SYSTEMS

STILL = 1e-9  # of the motion's size: smaller changes are no motion
ALIKE = {"m": [X, Y], "m/s": [VX, VY], "rad": [ANGLE], "rad/s": [OMEGA]}  # columns of a state
OPEN = 1e-9  # of the mechanism's size: nearer than that, a contact starts closed
ROUNDING = 1e-12  # of the normal force: a wheel that needs no friction rolls without any


@dataclass(frozen=True)
class Solution:
    """The reference motion of a case, and why it can be believed."""

    trajectory: Trajectory
    system: str  # which system moved: its name, or `generated`
    checks: tuple[Check, ...]

    @property
    def holds(self) -> bool:
        return all(check.holds for check in self.checks)


def solve(case: Case) -> Solution:
    """The certified motion of a case at its sample times.

    Raises CaseError where the case cannot be started or its idealisation does not hold.
    """
    if switches(case.scene):
        return _followed(case)
    generated = Mechanism(case.scene, assemble(case))
    system = SYSTEMS[case.system](**case.parameters) if case.system else generated
    try:
        integration = integrate(system, case.times, dormand_prince, tolerance=TOLERANCE)
        trajectory = motion(system, case.times, integration.y, generated)
        _possible(case, trajectory)
        _moving(case, trajectory)
        checks = certify(case, system, generated, integration, trajectory)
    except Stuck as stuck:
        raise refused(case, generated, stuck) from stuck
    return Solution(trajectory, case.system or "generated", checks)


def _followed(case: Case) -> Solution:
    """The motion of a scene that switches, from event to event."""
    try:
        generated = SwitchingMechanism(case.scene, assemble(case), Closure(case).size)
        system = SWITCHING[case.system](**case.parameters) if case.system else generated
        built = follow(generated, case.times)
        followed = built if system is generated else follow(system, case.times)
        trajectory = _with_record(case, Motion(system, followed), Motion(generated, built))
        _placed(case, trajectory)
        _possible(case, trajectory)
        _moving(case, trajectory)
        checks = certify_switching(
            case, Motion(system, followed), Motion(generated, built), trajectory
        )
    except SWITCHING_FAILURES as failure:
        raise switching_refused(case, failure) from failure
    return Solution(trajectory, case.system or "generated", checks)


def _placed(case: Case, trajectory: Trajectory) -> None:
    """A contact that starts above the floor has to say so: more often it is a slip of the pen.

    Raises CaseError unless an event of the case is about its gap.
    """
    said = {event.quantity for event in case.events.values()}
    for name, contact in case.scene.contacts.items():
        gap = float(observe(case.scene, trajectory, f"{name}.gap")[0])
        if contact.switches and gap > OPEN * Closure(case).size and f"{name}.gap" not in said:
            what = (
                f"starts {gap:.3g} m above the floor; if it is meant to fall on it, name the "
                f"event: events: {{lands: {{{name}.gap: falls to zero}}}}"
            )
            raise CaseError([case.mistake(("scene", "contacts", name), what)])


def _with_record(case: Case, written: Motion, generated: Motion) -> Trajectory:
    """The motion and its record, with the reactions that only the generated modes know."""
    at_samples, recorded = written.trajectory(case.times), written.record(case.times)
    if written.system is not generated.system:
        at_samples = completed(at_samples, generated.trajectory(case.times))
        recorded = completed(recorded, generated.record(case.times))
    return replace(at_samples, record=recorded)


def _possible(case: Case, trajectory: Trajectory) -> None:
    """Rolling is assumed: |λ_t| ≤ μ λ_n and λ_n > 0 at every sample, or the case is refused.

    Raises CaseError naming the first time at which it fails, and the μ that would be enough.
    """
    for contact in case.scene.contacts.values():
        if contact.switches:
            continue
        normal = trajectory.reactions[f"{contact.name}.normal"]
        tangent = np.abs(trajectory.reactions[f"{contact.name}.tangent"])
        fails = (normal <= 0) | (tangent > (contact.friction + ROUNDING) * normal)
        if not np.any(fails):
            continue
        first = int(np.argmax(fails))
        t = trajectory.times[first]
        if normal[first] <= 0:
            what = f"the floor would have to pull at t = {t:.3g} s: the disk leaves it"
        else:
            what = (
                f"rolling is not possible with friction {contact.friction:.3g}: at t = {t:.3g} s "
                f"it would slip; {_needed(normal, tangent)}"
            )
        raise CaseError([case.mistake(("scene", "contacts", contact.name, "ideal"), what)])


def _moving(case: Case, trajectory: Trajectory) -> None:
    """A place or velocity that stays what it was proves nothing, unless the case says it rests.

    Raises CaseError naming every observed one that never moves.
    """
    if case.rests:
        return
    mistakes = []
    known = table(case.scene)
    states = np.concatenate(list(trajectory.states.values()))
    for name in (name for name in case.allow if name in known):  # the rest are of events
        quantity = known[name]
        if quantity.kind not in ("coordinate", "velocity"):
            continue
        samples = observe(case.scene, trajectory, name)
        # a place held at 0 trembles by rounding, which is small only beside the other bodies'
        size = max(np.max(np.abs(samples)), np.max(np.abs(states[:, ALIKE[quantity.unit]])))
        if np.ptp(samples) <= STILL * size:
            what = f"never moves: it stays {samples[0]:.6g}, so nothing is compared; leave it out"
            mistakes.append(case.mistake(("allow", name), f"{what}, or say `rests: true`"))
    if mistakes:
        raise CaseError(mistakes)


def _needed(normal: Array, tangent: Array) -> str:
    if np.any(normal <= 0):
        return "later the disk would even leave the floor"
    return f"rolling all the way needs {np.max(tangent / normal):.3g}"
