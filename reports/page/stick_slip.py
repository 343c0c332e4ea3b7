"""The chapter's pictures of dry friction, of the cases that are its Examples 2.3 and 2.4."""

from collections.abc import Mapping, Sequence

from ...cases.case import Case
from .motions import Motion

APPROXIMATED = (
    ("growing_force", "block.vx", "tube", "Figures 2.29, 2.30: the speed under a growing force."),
    ("growing_force", "block.vx", "error", "By how much each law and engine is off that."),
    ("dynamometer", "block.vx", "tube", "Figures 2.31, 2.32: the speed behind a moving spring."),
    ("dynamometer", "block.vx", "error", "By how much each law and engine is off that."),
    ("dynamometer", "block.x", "tube", "Its place: a staircase."),
    ("dynamometer", "scale.force", "tube", "Figures 2.23, 2.24: what the dynamometer shows."),
)
"""The book's Examples 2.3 and 2.4: system, quantity, plot, and what it shows."""


def stick_slip(cases: Sequence[Case], motions: Mapping[str, Motion]) -> list[dict[str, str]]:
    """Which pictures are drawn, each with its words."""
    by_system = {case.system: case.name for case in cases if case.system and case.name in motions}
    return [
        {"case": by_system[system], "quantity": quantity, "plot": plot, "caption": caption}
        for system, quantity, plot, caption in APPROXIMATED
        if system in by_system and quantity in motions[by_system[system]]["curves"]["quantities"]
    ]
