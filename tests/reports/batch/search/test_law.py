"""A power law is told where the errors follow one, and nowhere else."""

import pytest

from textmech.reports.batch.search.cures import law


@pytest.mark.parametrize(
    ("errors", "words"),
    [
        ({4e-3: 16.0, 2e-3: 4.0, 1e-3: 1.0}, "h^2"),
        ({4e-3: 4.2, 2e-3: 2.0, 1e-3: 1.0}, "h^1"),  # 10 % may be missing
        ({8e-3: 99.0, 5e-4: 2.0, 4e-3: 16.0, 2e-3: 4.0, 1e-3: 1.0, 25e-5: 1 / 16}, ""),
        (
            {9e-3: 3.0, 8e-3: 64.0, 4e-3: 16.0, 2e-3: 4.0, 1e-3: 1.0, 5e-4: 0.25},
            "h^2",
        ),  # the finest 5
        ({4e-3: 5.0, 2e-3: 4.0, 1e-3: 1.0}, ""),  # it bends
        ({4e-3: 1.0, 2e-3: 1.0, 1e-3: 1.0}, ""),  # it makes no difference
        ({2e-3: 4.0, 1e-3: 1.0}, ""),  # two points are always on a line
        ({4e-3: 16.0, 2e-3: float("inf"), 1e-3: 1.0}, ""),
        ({4e-3: 16.0, 2e-3: 4.0, 1e-3: 0.0}, ""),
    ],
)
def test_a_law(errors: dict[float, float], words: str) -> None:
    assert law("h", errors) == words
