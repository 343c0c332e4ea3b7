"""Rows without a reference that holds: nothing can be judged by it."""

from dataclasses import replace

from ....reference.solve import Solution
from ...tables.row import FAILS
from .compare import Outcome

POSSIBLE = "modes possible"
MOVES = tuple(f"generated {what}" for what in ("motion", "accelerations", "reactions", "states"))


def uncertified(solution: Solution) -> str:
    """Returns in words why nothing can be judged by a solution."""
    broken = next(check for check in solution.checks if not check.holds)
    differs = f"{broken.name} differs by {broken.difference:.2e}, its bound is {broken.bound:.2e}"
    return f"the reference is not certified: {otherwise(solution)}{differs}"


def otherwise(solution: Solution) -> str:
    """Words for a hand-written system of another scene, if that is what does not hold."""
    broken = [check.name for check in solution.checks if not check.holds]
    if solution.system == "generated":
        return ""
    alone = "leave out `system`, then the scene alone answers; or undo what has been changed; "
    if POSSIBLE in broken:
        return f"the system {solution.system!r} has no mode for what happens here: {alone}"
    if any(name in MOVES for name in broken):
        what = "moves otherwise than this scene, or by other forces"
        return f"the system {solution.system!r} {what}: {alone}"
    return ""


def failing(outcome: Outcome, because: str) -> Outcome:
    """The outcome with the verdict FAILS in every row, for the reason `because`."""
    rows = [replace(row, verdict=FAILS, because=because) for row in outcome.rows]
    return replace(outcome, rows=rows)
