"""What MuJoCo does with planar scenes."""

from .compilation import compiled, lent, placed
from .contact import RECIPES, closed, worth
from .drive import controls
from .plain import plain
from .planes import met
from .plans import plan, ways
from .read.measure import measured
from .refuse import unbuildable
from .rods import with_rods
from .run import simulate
from .scene import mjcf
from .settings import best, soft, tuned, with_own
from .world import World

PLANE = World(
    unbuildable, ways, plan, tuned, best, RECIPES, worth, met, closed, soft, with_own, compiled,
    placed, lent, measured, mjcf, controls, simulate, plain, with_rods,
)  # fmt: skip
