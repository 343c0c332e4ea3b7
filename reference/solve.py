"""Case → reference motion with its own certificate.

The motion is the hand-written system's where there is one, else the generated mechanism's.
"""

from dataclasses import dataclass

import numpy as np

from cases.case import Case
from cases.mistake import CaseError
from cases.trajectory import Trajectory
from reference.assembly import assemble
from reference.certificate import Check, certify
from reference.explicit import dormand_prince
from reference.mechanism import Mechanism
from reference.motion import TOLERANCE, integrate, motion
from reference.systems import SYSTEMS


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
    generated = Mechanism(case.scene, assemble(case))
    system = SYSTEMS[case.system](**case.parameters) if case.system else generated
    integration = integrate(system, case.times, dormand_prince, tolerance=TOLERANCE)
    trajectory = motion(system, case.times, integration.y, generated)
    _possible(case, trajectory)
    checks = certify(case, system, generated, integration, trajectory)
    return Solution(trajectory, case.system or "generated", checks)


def _possible(case: Case, trajectory: Trajectory) -> None:
    """Rolling is only assumed: |λ_t| ≤ μ λ_n and λ_n > 0 at every sample, or the case is refused.

    Raises CaseError naming the first time at which it fails, and the μ that would be enough.
    """
    for contact in case.scene.contacts.values():
        normal = trajectory.reactions[f"{contact.name}.normal"]
        tangent = np.abs(trajectory.reactions[f"{contact.name}.tangent"])
        fails = (normal <= 0) | (tangent > contact.friction * normal)
        if not np.any(fails):
            continue
        t = trajectory.times[np.argmax(fails)]
        if np.any(normal <= 0):
            what = f"the floor would have to pull at t = {t:.3g} s: the disk leaves it"
        else:
            what = (
                f"rolling is not possible with friction {contact.friction:.3g}: at t = {t:.3g} s "
                f"it would slip; rolling all the way needs {np.max(tangent / normal):.3g}"
            )
        raise CaseError([case.mistake(("scene", "contacts", contact.name, "ideal"), what)])
