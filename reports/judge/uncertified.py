"""Rows without a reference that holds: nothing can be judged by it."""

from dataclasses import replace

from ...reference.solve import Solution
from ..row import FAILS
from .compare import Outcome


def uncertified(solution: Solution) -> str:
    """Why nothing can be judged by it, in words."""
    broken = next(check for check in solution.checks if not check.holds)
    return (
        f"the reference is not certified: {broken.name} differs by {broken.difference:.2e}, "
        f"its bound is {broken.bound:.2e}"
    )


def failing(outcome: Outcome, because: str) -> Outcome:
    """All rows FAIL."""
    rows = [replace(row, verdict=FAILS, because=because) for row in outcome.rows]
    return replace(outcome, rows=rows)
