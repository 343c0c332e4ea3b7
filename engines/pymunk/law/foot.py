"""What may come down on a plane of the ground, by a driver that cuts the step there.

As `contact.follower` has it, but for steps of any length; and what never slips is reflected along
the plane too. Friction holds the velocity at the new place alone, and the curved path of a tip
about which a body turns then carries it along the floor, by a length of first order in h.
"""

import math

from ....cases.scene import Contact
from ..contact import ABOVE, PASSES, above, is_tip, sink
from ..world import World

BELOW = 1e-12  # m: so deep it has come down for sure
_DOWN = BELOW / 2  # m: less deep it has only come to the plane, to rounding
_DEEPER = 1e-9  # m: what stands touches by so much, whatever the curve of its path
_ROOT = 4e-16  # s: as well as a time is known


class Foot:
    """A contact: where it is, whether it stands on its plane, and what pymunk is told of it.

    meets: whether its plane meets it at all.
    """

    def __init__(self, world: World, contact: Contact, seed: float) -> None:
        self.contact, self.part = contact, world.scene.bodies[contact.body]
        self.body, self.shape = world.wheel(contact.name), world.wheels[contact.name]
        self._is_disk = self.part.radius is not None
        self.meets, self.stands = True, not self._is_disk and self.shape.radius > ABOVE
        self._seed, self._meeting = seed, self.shape.filter
        self._far = math.hypot(*self.part.points[contact.at.point])
        self._gravity, self._turns = world.space.gravity, is_tip(world.scene, contact)

    def gap(self, ahead: float, falls: float = 0.0) -> float:
        """How high [m] it is along its velocity, so long [s] ahead; falls: of that freely [s]."""
        plane, body = self.contact.plane, self.body
        (x, y), (vx, vy) = body.position, body.velocity
        a, b = self.part.points[self.contact.at.point]
        (gx, gy), fallen = self._gravity, falls * falls / 2
        angle = body.angle + ahead * body.angular_velocity
        cos, sin = math.cos(angle), math.sin(angle)
        x += ahead * vx + fallen * gx + cos * a - sin * b
        y += ahead * vy + fallen * gy + sin * a + cos * b
        return float(plane.height(x, y)) - (self.part.radius or 0.0)

    def look(self, step: float) -> None:
        """Before a step [s]: whether it stands; the curve of its path lifts it by (ω h)² l/2."""
        near = 0.0
        if self.stands and not self._is_disk:
            turned = step * self.body.angular_velocity
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
            return longest  # on the plane, to rounding
        return float(brentq(height, 0.0, longest, xtol=_ROOT))

    @property
    def is_down(self) -> bool:
        """Whether it has come down just now."""
        return self.meets and not self.stands and self.gap(0.0) <= 0.0

    def lay(self, length: float, *, strikes: bool) -> None:
        """Before a step so long [s]; strikes: with its own restitution, also where it stands."""
        self.shape.filter = self._meeting if self.meets else PASSES
        if not self._is_disk:
            self.shape.unsafe_set_radius(ABOVE + self._depth(length))
        if not self._turns:
            return
        turned = self.body.angle + length * self.body.angular_velocity
        point = self.part.points[self.contact.at.point]
        self.shape.unsafe_set_offset(above(self.contact.plane, point, turned))
        stays = self.stands and not strikes
        self.shape.elasticity = 1.0 if stays else self.contact.restitution
        if self.contact.ideal == "pivot":
            self._carry(self._slip(turned) if stays else 0.0)

    def _depth(self, length: float) -> float:
        """How much [m] its circle is larger, so that the plane finds it after the step."""
        return max(0.0, self.gap(length)) + _DEEPER if self.stands else 0.0

    def _slip(self, angle: float) -> float:
        """How fast [m/s] it moves along its plane at that angle, as the body moves now."""
        (ux, uy), (vx, vy) = self.contact.plane.along, self.body.velocity
        return ux * vx + uy * vy - self.body.angular_velocity * self._lever(angle)

    def _lever(self, angle: float) -> float:
        """How far [m] it is over the body's centre, along the normal of its plane."""
        a, b = self.part.points[self.contact.at.point]
        (nx, ny), cos, sin = self.contact.plane.normal, math.cos(angle), math.sin(angle)
        return nx * (cos * a - sin * b) + ny * (sin * a + cos * b)

    def _carry(self, slip: float) -> None:
        """After the step it slips as fast the other way: as on a belt, of which pymunk knows.

        That holds the lowest point of the circle, which is a little deeper than the tip.
        """
        slip -= self.body.angular_velocity * (self.shape.radius - ABOVE)
        ux, uy = self.contact.plane.along
        self.shape.surface_velocity = slip * ux, slip * uy

    def touch(self) -> None:
        """It touches from here on; a disk, as at the start, a little deeper."""
        self.stands = True
        if self._is_disk:
            self._sink(self.gap(0.0) + self._seed)

    def bounce(self) -> None:
        """What has been thrown back touches no longer."""
        if self.contact.restitution:
            self.stands = False
            if self._is_disk:
                self._sink(-self._seed)

    def _sink(self, depth: float) -> None:
        sink(self.contact, self.part, self.shape, depth)
