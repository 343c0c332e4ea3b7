"""The functions with which MuJoCo's adapter handles scenes in space."""

from ...model.contact import closed, recipes, worth
from ...model.planes import met
from ...model.space.scene import mjcf, signals
from ...read.space.measure import measured
from ...settings.settings import best, soft, tuned, with_own
from ..world import World
from .compilation import compiled, lent, placed
from .plans import plan, ways
from .refuse import unbuildable
from .run import simulate


def unwritten(*given: object) -> None:
    """Nobody has written the plain loop for space."""


SPACE = World(
    unbuildable, ways, plan, tuned, best, recipes, worth, met, closed, soft, with_own, compiled,
    placed, lent, measured, mjcf, signals, simulate, unwritten,
)  # fmt: skip
