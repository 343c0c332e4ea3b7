"""The functions with which MuJoCo's adapter handles planar scenes."""

from ..model.contact import RECIPES, closed, worth
from ..model.drive import controls
from ..model.planes import met
from ..model.rods import with_rods
from ..model.scene import mjcf
from ..read.measure import measured
from ..settings.settings import best, soft, tuned, with_own
from .compilation import compiled, lent, placed
from .plans import plan, ways
from .refuse import unbuildable
from .run import simulate
from .world import World

PLANE = World(
    unbuildable, ways, plan, tuned, best, RECIPES, worth, met, closed, soft, with_own, compiled,
    placed, lent, measured, mjcf, controls, simulate, with_rods,
)  # fmt: skip
