"""Feet that stand one after the other, by a driver that cuts a step where one comes down.

As `contact.follower` has it, but for steps of any length; and what never slips is reflected along
the floor too. Friction holds the velocity at the new place alone, and the curved path of a foot
about which a body turns then carries it along the floor, by a length of first order in h.
"""

import math

from ....cases.scene import Contact
from ..model.chipmunk_state import reading
from ..model.contact import PASSES, circle_centre, tip_radius
from ..model.world import World

BELOW = 1e-12  # m: so deep it has come down for sure
_DOWN = BELOW / 2  # m: less deep it has only come to the plane, to rounding
_DEEPER = 1e-9  # m: what stands touches by so much, whatever the curve of its path
_ROOT = 4e-16  # s: as well as a time is known

Pose = tuple[float, float, float, float, float, float]
"""x and y of a body's centre, how far it has gone from there, and its angle's cosine and sine."""


class Carrier:
    """A body on feet, read once for all of them: whoever moves it has it looked at anew."""

    def __init__(self, world: World, body: str) -> None:
        self._read, self._gravity = reading(world.bodies[body]), world.space.gravity
        self.look()

    def look(self) -> None:
        """Reads where it is now."""
        self.state, self._poses = self._read(), dict[tuple[float, float], Pose]()

    def pose(self, ahead: float, falls: float) -> Pose:
        """Along its velocity, so long [s] ahead; falls: of that freely [s]."""
        if known := self._poses.get((ahead, falls)):
            return known
        x, y, angle, vx, vy, omega = self.state
        (gx, gy), fallen = self._gravity, falls * falls / 2
        angle += ahead * omega
        gone = ahead * vx + fallen * gx, ahead * vy + fallen * gy
        self._poses[ahead, falls] = pose = x, y, *gone, math.cos(angle), math.sin(angle)
        return pose


class Foot:
    """A foot: where it is, whether it stands on the floor, and what pymunk is told of it.

    meets: whether the floor meets it at all.
    """

    def __init__(self, world: World, contact: Contact, seed: float, carrier: Carrier) -> None:
        self.contact, self.carrier = contact, carrier
        self.shape = world.wheels[contact.name]
        self._size = tip_radius(world.scene)
        self.meets, self.stands = True, self.shape.radius > self._size
        self._seed, self._meeting = seed, self.shape.filter
        self._point = world.scene.bodies[contact.body].points[contact.at.point]
        self._far = math.hypot(*self._point)
        # As pymunk has been told, which costs more than to look here.
        self._met, self._radius, self._elasticity = True, self.shape.radius, self.shape.elasticity
        self._slips = 0.0

    def gap(self, ahead: float, falls: float = 0.0) -> float:
        """How high [m] it is along its velocity, so long [s] ahead; falls: of that freely [s]."""
        (_, y, _, dy, cos, sin), (a, b) = self.carrier.pose(ahead, falls), self._point
        return y + (dy + sin * a + cos * b)

    def look(self, step: float) -> None:
        """Before a step [s]: whether it stands; the curve of its path lifts it by (ω h)² l/2."""
        near = 0.0
        if self.stands:
            turned = step * self.carrier.state[5]
            near = self._seed + turned * turned * self._far / 2
        self.stands = self.meets and self.gap(0.0) < near

    def comes(self, behind: float, length: float) -> bool:
        """Whether it is down within so long [s]; behind: how far [s] the place is behind now."""
        return self.meets and not self.stands and self.gap(behind + length, length) <= -_DOWN

    @property
    def is_above(self) -> bool:
        """Whether it has still to come down."""
        return self.gap(0.0) > -_DOWN

    def after(self, longest: float) -> float:
        """When it has come down, from now on [s]."""
        from scipy.optimize import brentq

        height = lambda ahead: self.gap(ahead, ahead) + BELOW  # noqa: E731
        if height(longest) > 0.0:
            return longest  # on the floor, to rounding
        return float(brentq(height, 0.0, longest, xtol=_ROOT))

    @property
    def is_down(self) -> bool:
        """Whether it has come down just now."""
        return self.meets and not self.stands and self.gap(0.0) <= 0.0

    def lay(self, length: float, *, strikes: bool) -> None:
        """Before a step so long [s]; strikes: thrown back by nothing, also where it stands."""
        if self.meets != self._met:
            self.shape.filter = self._meeting if self.meets else PASSES
            self._met = self.meets
        if (radius := self._size + self._depth(length)) != self._radius:
            self.shape.unsafe_set_radius(radius)
            self._radius = radius
        *_, cos, sin = self.carrier.pose(length, 0.0)
        normal = self.contact.plane.normal
        self.shape.unsafe_set_offset(circle_centre(normal, self._point, cos, sin, self._size))
        stays = self.stands and not strikes
        if (elasticity := 1.0 if stays else 0.0) != self._elasticity:
            self.shape.elasticity = self._elasticity = elasticity
        self._carry(self._slip(cos, sin) if stays else 0.0)

    def _depth(self, length: float) -> float:
        """How much [m] its circle is larger, so that the floor finds it after the step."""
        return max(0.0, self.gap(length)) + _DEEPER if self.stands else 0.0

    def _slip(self, cos: float, sin: float) -> float:
        """How fast [m/s] it moves along the floor, turned like that, as the body moves now."""
        (a, b), (_, _, _, vx, _, omega) = self._point, self.carrier.state
        return vx - omega * (sin * a + cos * b)

    def _carry(self, slip: float) -> None:
        """After the step it slips as fast the other way: as on a belt, of which pymunk knows."""
        if slip != self._slips:
            self.shape.surface_velocity = slip, 0.0
            self._slips = slip
