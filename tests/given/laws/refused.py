"""The one mistake that a case is refused for."""

import pytest

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.solve import solve


def refused(wrong: Case) -> Mistake:
    """The mistake that `solve` raises; a failure if there is none, or another one beside it."""
    with pytest.raises(CaseError) as error:
        solve(wrong)
    (mistake,) = error.value.mistakes
    return mistake
