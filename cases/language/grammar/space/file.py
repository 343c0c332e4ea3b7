"""The keys that may stand in the file of a case in space: scene and start have their own words."""

from pydantic import Field

from ....fields.part import Name
from ..file import File
from .scene import SpatialScene
from .start import Start


class SpatialFile(File):
    """A case: one claim about the motion of one scene in space."""

    scene: SpatialScene  # pyright: ignore[reportIncompatibleVariableOverride]
    initial: dict[Name, Start]  # pyright: ignore[reportIncompatibleVariableOverride]
    near: dict[Name, Start] = Field(  # pyright: ignore[reportIncompatibleVariableOverride]
        {}, description="a guess, where the constraints have more than one solution"
    )
