"""The law of soft constraints' forces: what is projected is nearest among all that are allowed."""

from collections.abc import Iterator

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.cases.constraints import Bound, Constraint
from textmech.cases.trajectory import Array
from textmech.reference.laws import constraints
from textmech.reference.laws.constraints import projected

MU = np.array([0.5, 0.5, 0.02, 0.01])
NORMAL, SLIP = 2.0, 3.0  # R of the normal, and R μ² of all friction
BOUNDS: dict[Bound, tuple[Array, Array]] = {
    "none": (np.zeros(0), np.array([0.7])),
    "one way": (np.zeros(0), np.array([0.7])),
    "loss": (np.array([0.4]), np.array([0.7])),
    "cone": (MU, np.array([NORMAL, *SLIP / MU**2])),
}
"""By how a force is bounded the numbers of that, and R."""


def allowed(bound: Bound, random: np.random.Generator) -> Iterator[Array]:
    """Yields some forces that may be."""
    for _ in range(200):
        if bound == "cone":
            y, normal = random.normal(size=len(MU)), random.exponential()
            yield np.array([normal, *MU * y / np.linalg.norm(y) * normal * random.uniform() ** 0.1])
        else:
            low = {"none": -2.0, "one way": 0.0, "loss": -0.4}[bound]
            yield random.uniform(low, {"loss": 0.4}.get(bound, 2.0), 1)


def worst(bound: Bound, project: object = projected) -> float:
    """The largest (f − free)·R (f − λ) over allowed λ: of the nearest one it is not above 0."""
    random, (bounds, R) = np.random.default_rng(0), BOUNDS[bound]
    constraint, ways = Constraint("any", bound, 0, bounds), set[str]()
    largest = -np.inf
    for scale in (-9.0, -0.5, 0.5, 9.0):
        free = random.normal(size=len(R)) * np.array([1.0, *bounds] if bound == "cone" else [1.0])
        free[0] = scale
        force: Array = project(constraint, free, R)  # type: ignore[operator]
        ways.add("free" if np.array_equal(force, free) else "none" if not force.any() else "edge")
        for other in (*allowed(bound, random), 0.999 * force, 0.0 * force):
            size = float(np.abs(free) @ (R * np.abs(free)))
            largest = max(largest, float((force - free) @ (R * (force - other))) / size)
    assert ways <= {"free", "none", "edge"}
    assert bound != "cone" or ways == {"free", "none", "edge"}
    return largest


@pytest.mark.parametrize("bound", BOUNDS)
def test_a_projected_force_is_the_nearest_that_is_allowed(bound: Bound) -> None:
    assert worst(bound) < 1e-14


@pytest.mark.mutant("{what}")
@pytest.mark.parametrize(
    ("what", "was", "now"),
    [
        ("a cone nearest by its height", "(R[0] * normal + rho * aside) / (R[0] + rho)", "normal"),
        ("a cone nearest by its width", "(R[0] * normal + rho * aside) / (R[0] + rho)", "aside"),
        ("a cone without regard to R", "rho * aside) / (R[0] + rho)", "aside) / (R[0] + 1)"),
    ],
)
def test_another_force_is_farther(what: str, was: str, now: str) -> None:
    assert worst("cone", otherwise(constraints, was, now).projected) > 1e-3
