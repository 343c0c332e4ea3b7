"""Planes of the ground as a case file writes them: a point of each, and its normal."""

from pydantic import Field

from ...fields.part import Direction, Part, Position
from ...scene.plane import Plane as Noun


class Plane(Part):
    """A straight line, seen from the side, on which bodies stand and slide."""

    at: Position = Field(description="any of its points")
    normal: Direction = Field(description="points away from it, to where bodies are")

    def named(self, name: str) -> Noun:
        """The plane."""
        return Noun(name, self.at, self.normal)
