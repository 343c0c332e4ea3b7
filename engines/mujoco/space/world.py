"""What MuJoCo does with scenes in space."""

from ..world import World
from .compilation import compiled, lent, placed
from .contact import RECIPES, closed, met, worth
from .plans import plan, ways
from .read.measure import measured
from .refuse import unbuildable
from .run import simulate
from .scene import mjcf, signals
from .settings import best, soft, tuned, with_own


def unwritten(*given: object) -> None:
    """Nobody has written the plain loop for space."""


SPACE = World(
    unbuildable, ways, plan, tuned, best, RECIPES, worth, met, closed, soft, with_own, compiled,
    placed, lent, measured, mjcf, signals, simulate, unwritten,
)  # fmt: skip
