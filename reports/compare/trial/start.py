"""Where an engine starts: row 0 of the reference, or the assembled scene, the same to rounding."""

from ....cases.case import Case
from ....cases.trajectory import Trajectory
from ....engines.engine import Start
from ....reference.start.assembly import start_poses
from ....reference.system import Pose


def first(reference: Trajectory) -> Start:
    """Row 0 of the reference."""
    return {name: tuple(rows[0].tolist()) for name, rows in reference.states.items()}  # type: ignore[misc]


def assembled(case: Case) -> Start:
    """The start of a case that nobody has solved. Raises CaseError where there is none."""
    return {name: tuple(float(x) for x in pose) for name, pose in _poses(case).items()}  # type: ignore[misc]


def _poses(case: Case) -> dict[str, Pose]:
    if case.states is None:
        return start_poses(case)
    from ....reference.states.answer import first_state  # with all modes, which a motion's lacks

    return first_state(case)
