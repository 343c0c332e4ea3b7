"""Strikes by a driver: a step is cut where a foot comes down, and the impact is one instant.

pymunk finds a strike at the end of the step in which it happens, up to h late and v h deep: an
error of first order. Here the step ends at the touch-down, as the motion goes on along the
velocities and as it falls freely; there the impact is pymunk's own, in a step that lasts no time;
and the rest of the step begins behind it. Each part is a step of the midpoint protocol.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from pymunk.space import Space
from pymunk.vec2d import Vec2d

from ....cases.scene import Scene
from ...foot_contact import strides
from ..model.slot import oblique
from ..model.world import World
from .foot import Carrier, Foot
from .force import ELEMENTS

_SHORTEST = 1e-9  # of a step: what lasts no longer happens at once
_PARTS = 3  # for each that comes down: nearly there, there, and there again


def cuts(scene: Scene) -> bool:
    """Whether feet cut a step: only they touch, and what acts is pymunk's own.

    Its own takes steps of any length.
    """
    if not strides(scene) or any(foot.ahead_of is None for foot in scene.contacts.values()):
        return False
    by_law = any(ELEMENTS[type(force)].tell for force in scene.forces.values())
    by_law |= bool(scene.drives or scene.constraints) or any(scene.laws())
    gives = any(joint.dry_friction for joint in scene.joints.values()) or any(scene.limits())
    carried = any(oblique(scene, joint) for joint in scene.joints.values())
    return not (by_law or gives or carried or scene.pairs or any(scene.one_sided()))


class Strikes:
    """The feet of a world; `step` takes its steps in place of `space.step`."""

    def __init__(self, world: World, seed: float) -> None:
        assert world.stride is not None
        self.world, self.space, self.stride = world, world.space, world.stride
        feet = self.stride.feet.values()
        self._carriers = {foot.body: Carrier(world, foot.body) for foot in feet}
        self.feet = [Foot(world, foot, seed, self._carriers[foot.body]) for foot in feet]
        self._lengths, self._begun = Lengths(world.space), False

    def step(self, step: float) -> None:
        """One step [s], in as many parts as feet come down in it; places are h/2 behind."""
        self._moved()
        self._look(step)
        if not self._begun:
            self._begin(step)
        if any(foot.comes(step / 2, step) for foot in self.feet):
            self._cut(step)
        else:
            self._take(step, step)

    def _moved(self) -> None:
        for carrier in self._carriers.values():
            carrier.look()

    def _drift(self, length: float) -> None:
        drift(self.space, length)
        self._moved()

    def _begin(self, step: float) -> None:
        """Take the impacts at the start before the first step."""
        self._begun = True
        if any(foot.stands for foot in self.feet):
            self._drift(step / 2)
            self._strike([])
            self._drift(-step / 2)

    def _cut(self, step: float) -> None:
        self._drift(step / 2)
        rest = step
        if late := [foot for foot in self.feet if foot.is_down and not foot.is_above]:
            # As the step before ended, by a little more than it had foreseen.
            self._strike(late)
        for _ in range(_PARTS * len(self.feet)):
            after = [
                foot.after(rest) for foot in self.feet if foot.is_above and foot.comes(0.0, rest)
            ]
            if not after:
                break
            self._part(min(after), step)
            rest -= min(after)
            if down := [foot for foot in self.feet if foot.is_down]:
                self._strike(down)
        self._part(rest, step)
        self._drift(-step / 2)

    def _part(self, length: float, step: float) -> None:
        """A step so long [s] from where the bodies are now to where they are then."""
        if length > _SHORTEST * step:
            self._drift(-length / 2)
            with open_gaps(self.space):
                self._take(length, step)
            self._drift(length / 2)

    def _take(self, length: float, step: float) -> None:
        self._lay(length)
        self._lengths.take(length)
        self.world.share[0] = length / step

    def _strike(self, struck: Sequence[Foot]) -> None:
        for foot in struck:
            self.stride.come_down(foot.contact.name)
            self._meet()
            foot.stands = True
        self._lay(NO_TIME, strikes=True)
        self._lengths.impact()
        self._moved()

    def _look(self, step: float) -> None:
        self.stride.look(self.world.place)
        self._meet()
        for foot in self.feet:
            foot.look(step)

    def _meet(self) -> None:
        for foot in self.feet:
            foot.meets = self.stride.meets[foot.contact.name]

    def _lay(self, length: float, *, strikes: bool = False) -> None:
        for foot in self.feet:
            foot.lay(length, strikes=strikes)


# Impacts alone, and steps of another length than the one before.
#
# Chipmunk begins a step with the impulses of the last one times dt/dt_old, but counts on from
# what they were: what touches may then pull with the difference, and what it tells is of no step.
# So before a step of another length all impulses are forgotten.


NO_TIME = 1e-12  # s: forces and speeds do nothing in it, impulses all

Places = list[tuple[Vec2d, float]]


def places(space: Space) -> Places:
    """Where all bodies are."""
    return [(body.position, body.angle) for body in space.bodies]


def put(space: Space, where: Places) -> None:
    """The bodies there."""
    for body, (position, angle) in zip(space.bodies, where, strict=True):
        body.position, body.angle = position, angle


def drift(space: Space, length: float) -> None:
    """The bodies so long [s] along their velocities, or back."""
    for body in space.bodies:
        body.position += length * body.velocity
        body.angle += length * body.angular_velocity


@contextmanager
def open_gaps(space: Space) -> Iterator[None]:
    """Joints stop what would open their gaps, and close none: in a short step that is a blow."""
    held = [(joint, joint.max_bias) for joint in space.constraints]
    for joint, _ in held:
        joint.max_bias = 0.0
    yield
    for joint, fastest in held:
        joint.max_bias = fastest


class Lengths:
    """Steps of any lengths of a space."""

    def __init__(self, space: Space) -> None:
        self._space, self._last = space, 0.0

    def take(self, length: float) -> None:
        """One step so long [s]."""
        if length != self._last:
            forget(self._space)
        self._last = length
        self._space.step(length)

    def impact(self) -> None:
        """The impulses of what touches, and of joints, in no time."""
        where, self._last = places(self._space), 0.0  # another impact may have been the last
        with open_gaps(self._space):
            self.take(NO_TIME)
        put(self._space, where)


def forget(space: Space) -> None:
    """Forget all impulses of the last step: take contacts out, and let joints exert nothing."""
    shapes = [shape for body in space.bodies for shape in body.shapes]
    space.remove(*shapes)
    if space.constraints:
        _slacken(space)
    space.add(*shapes)


def _slacken(space: Space) -> None:
    where = places(space)
    rates = [(body.velocity, body.angular_velocity) for body in space.bodies]
    strengths = [(joint, joint.max_force) for joint in space.constraints]
    for joint, _ in strengths:
        joint.max_force = 0.0
    space.step(NO_TIME)
    for joint, strength in strengths:
        joint.max_force = strength
    put(space, where)
    for body, (velocity, turning) in zip(space.bodies, rates, strict=True):
        body.velocity, body.angular_velocity = velocity, turning
