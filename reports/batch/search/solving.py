"""References of cases that no row was made of: other samples, other parameters."""

from ....cases.case import Case
from ....cases.mistake import CaseError
from ....reference.solve import Solution, solve


def solved(case: Case) -> Solution | CaseError:
    """The case's reference, or the mistakes that only solving finds."""
    try:
        return solve(case)
    except CaseError as error:
        return error
