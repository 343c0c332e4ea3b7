"""Contacts that may come down on a plane of the ground, by a driver that cuts the step there.

As `contact.follower` has it, but for steps of any length; and what never slips is reflected along
the plane too. Friction holds the velocity at the new place alone, and the curved path of a tip
about which a body turns then carries it along the floor, by a length of first order in h.
"""

import math

from ....cases.scene import Contact
from ..model.chipmunk_state import reading
from ..model.contact import ABOVE, PASSES, is_tip, over, sink
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
    """A contact: where it is, whether it stands on its plane, and what pymunk is told of it.

    meets: whether its plane meets it at all.
    """

    def __init__(self, world: World, contact: Contact, seed: float, carrier: Carrier) -> None:
        self.contact, self.part, self.carrier = contact, world.scene.bodies[contact.body], carrier
        self.shape = world.wheels[contact.name]
        self._is_disk = self.part.radius is not None
        self.meets, self.stands = True, not self._is_disk and self.shape.radius > ABOVE
        self._seed, self._meeting = seed, self.shape.filter
        self._turns = is_tip(world.scene, contact)
        self._point = self.part.points[contact.at.point]
        self._far, self._normal = math.hypot(*self._point), contact.plane.normal
        self._place = *self._point, *self._normal, *contact.plane.at, self.part.radius or 0.0
        # As pymunk has been told, which costs more than to look here.
        self._met, self._radius, self._elasticity = True, self.shape.radius, self.shape.elasticity
        self._back, self._slips = contact.restitution, (0.0, 0.0)

    def gap(self, ahead: float, falls: float = 0.0) -> float:
        """How high [m] it is along its velocity, so long [s] ahead; falls: of that freely [s]."""
        x, y, dx, dy, cos, sin = self.carrier.pose(ahead, falls)
        a, b, nx, ny, px, py, radius = self._place
        x += dx + cos * a - sin * b
        y += dy + sin * a + cos * b
        return nx * (x - px) + ny * (y - py) - radius

    def look(self, step: float) -> None:
        """Before a step [s]: whether it stands; the curve of its path lifts it by (ω h)² l/2."""
        near = 0.0
        if self.stands and not self._is_disk:
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
            return longest  # on the plane, to rounding
        return float(brentq(height, 0.0, longest, xtol=_ROOT))

    @property
    def is_down(self) -> bool:
        """Whether it has come down just now."""
        return self.meets and not self.stands and self.gap(0.0) <= 0.0

    def lay(self, length: float, *, strikes: bool) -> None:
        """Before a step so long [s]; strikes: with its own restitution, also where it stands."""
        if self.meets != self._met:
            self.shape.filter = self._meeting if self.meets else PASSES
            self._met = self.meets
        if not self._is_disk and (radius := ABOVE + self._depth(length)) != self._radius:
            self.shape.unsafe_set_radius(radius)
            self._radius = radius
        if not self._turns:
            return
        *_, cos, sin = self.carrier.pose(length, 0.0)
        self.shape.unsafe_set_offset(over(self._normal, self._point, cos, sin))
        stays = self.stands and not strikes
        self._throw(1.0 if stays else self._back)
        if self.contact.ideal == "pivot":
            self._carry(self._slip(cos, sin) if stays else 0.0)

    def _depth(self, length: float) -> float:
        """How much [m] its circle is larger, so that the plane finds it after the step."""
        return max(0.0, self.gap(length)) + _DEEPER if self.stands else 0.0

    def _slip(self, cos: float, sin: float) -> float:
        """How fast [m/s] it moves along its plane, turned like that, as the body moves now."""
        (nx, ny), (a, b), (_, _, _, vx, vy, omega) = self._normal, self._point, self.carrier.state
        lever = nx * (cos * a - sin * b) + ny * (sin * a + cos * b)  # over the body's centre
        return ny * vx - nx * vy - omega * lever

    def _carry(self, slip: float) -> None:
        """After the step it slips as fast the other way: as on a belt, of which pymunk knows.

        That holds the lowest point of the circle, which is a little deeper than the tip.
        """
        slip -= self.carrier.state[5] * (self._radius - ABOVE)
        ux, uy = self.contact.plane.along
        if (slips := (slip * ux, slip * uy)) != self._slips:
            self.shape.surface_velocity = self._slips = slips

    def _throw(self, elasticity: float) -> None:
        if elasticity != self._elasticity:
            self.shape.elasticity = self._elasticity = elasticity

    def touch(self, step: float) -> None:
        """It touches from here on; a disk, as at the start, a little deeper.

        A bounce that would be over within a step [s] is the last of its pile, and throws nothing
        back: else each step would end in one, and pymunk tells no force of what lasts no time.
        """
        self.stands = True
        thrown = self.contact.restitution * (self.gap(0.0) - self.gap(step))
        is_last = thrown < self.gap(step) - self.gap(step, step)
        self._back = 0.0 if is_last else self.contact.restitution
        self._throw(self._back)
        if self._is_disk:
            self._sink(self.gap(0.0) + self._seed)

    def bounce(self) -> None:
        """Let the foot touch no longer after it has been thrown back."""
        if self._back:
            self.stands = False
            if self._is_disk:
                self._sink(-self._seed)

    def _sink(self, depth: float) -> None:
        sink(self.contact, self.part, self.shape, depth)
        self.carrier.look()
