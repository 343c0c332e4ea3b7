"""The functions with which MuJoCo's adapter handles scenes in space."""

from ...model.space.contact import RECIPES, closed, met, worth
from ...model.space.scene import mjcf, signals
from ...read.space.measure import measured
from ...settings.space.settings import best, soft, tuned, with_own
from ..world import World
from .compilation import compiled, lent, placed
from .plans import plan, ways
from .refuse import unbuildable
from .run import simulate

SPACE = World(
    unbuildable, ways, plan, tuned, best, RECIPES, worth, met, closed, soft, with_own, compiled,
    placed, lent, measured, mjcf, signals, simulate,
)  # fmt: skip
