"""Translates a Space into the data of a case file, and watches where these do not suffice."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from math import sqrt
from typing import Any

import numpy as np
from pymunk.body import Body
from pymunk.constraints import PivotJoint
from pymunk.space import Space

from ...cases.scene import Scene
from ...cases.scene.observe import observe
from ...cases.trajectory import Trajectory, X, Y
from ..pymunk.model.contact import tip_radius
from ..pymunk.settings.options import SHIPPED_STEP
from .constraints import read_constraints
from .meeting import DEEP, depth, first_overlap, past_end_times
from .reading import Reading, read_bodies, turns
from .shapes import Outline, Touch, body_shapes, collisions, find_contacts, outlines, start_corners

DURATION, SAMPLES = 1.0, 26
TOLERANCE = 1e-3  # of the size of the motion, and of 1 rad
SOLVER = (
    ("iterations", "collision_slop", "collision_bias", "collision_persistence"),
    ("error_bias", "max_bias"),
)
"""Numbers of pymunk's solver, which are no part of a scene: of a Space, and of constraints."""
Pair = tuple[Outline, Outline]


@dataclass(frozen=True)
class Read:
    """A Space in words, as far as there are any.

    pairs: shapes that pymunk lets collide, with the contacts that a case file has for them. met:
    those that do. astray: by contact when [s] it closes where its shapes have no side: it is none.
    """

    reading: Reading
    known: Sequence[Outline]
    pairs: Mapping[Pair, Touch | None]
    met: Sequence[Pair]
    astray: Mapping[str, float] = field(default_factory=dict[str, float])

    @property
    def refused(self) -> Sequence[tuple[str, str]]:
        """(place, why) of what has no word."""
        return self.reading.refused

    def data(self) -> dict[str, Any]:
        """The data of a case file; it bounds the place of the first body, and nothing else."""
        r, met = self.reading, [touch for pair in self.met if (touch := self.pairs[pair])]
        contacts = dict(chain.from_iterable(touch.contacts.items() for touch in met))
        scene = {
            "gravity": tuple(r.space.gravity),
            "points": r.points,
            "planes": dict(chain.from_iterable(touch.planes.items() for touch in met)),
            "bodies": body_shapes(r, self.known),
            "joints": r.joints,
            "contacts": {name: x for name, x in contacts.items() if name not in self.astray},
            "forces": r.forces,
            "drive": r.drive,
        }
        return {
            "title": "pymunk.Space",
            "scene": scene,
            "initial": r.initial,
            "duration": DURATION,
            "samples": SAMPLES,
            "allow": {f"{next(iter(r.initial))}.x": 1.0},
        }

    def seen(self, scene: Scene, motion: Trajectory) -> "Read":
        """Returns the reading with the first contact that the motion shows to be missing or astray.

        Itself, where it lacks nothing; what has no word, or leaves its bounds, is refused then.
        """
        size, never = self.size(motion), float("inf")
        meets = {pair: first_overlap(motion, *pair, size) for pair in self.pairs}
        strays = {
            name: time
            for pair in self.met
            if (touch := self.pairs[pair])
            for name, time in past_end_times(scene, motion, touch, size).items()
        }
        first = min(chain(meets.values(), strays.values()), default=never)
        if first < never:
            pairs = [pair for pair, time in meets.items() if time == first]
            if wrong := [pair for pair in pairs if pair in self.met or not self.pairs[pair]]:
                for pair in wrong:
                    self._no_word(*pair, first)
                return self
            astray = {name: time for name, time in strays.items() if time == first}
            return replace(self, met=[*self.met, *pairs], astray={**astray, **self.astray})
        for bound in self.reading.withins:
            values = observe(scene, motion, bound.quantity)
            slack = DEEP * max(abs(x) for x in (bound.low, bound.high) if abs(x) < never)
            out = (values < bound.low - slack) | (values > bound.high + slack)
            if np.any(out):
                at = motion.times[np.argmax(out)]
                self.reading.refuse(bound.place, f"{bound.at}, at t = {at:.3g} s")
        return self

    def _no_word(self, first: Outline, second: Outline, time: float) -> None:
        touch, why = self.pairs[first, second], "in a way that has no word"
        if past := [t for name, t in self.astray.items() if touch and name in touch.contacts]:
            time, why = min(past), "and goes past its end, which has no word"
        self.reading.refuse(first.place, f"meets {second.place} at t = {time:.3g} s, {why}")

    def claims(
        self, scene: Scene, motion: Trajectory, ajar: float, stays: Callable[[str], bool]
    ) -> dict[str, Any]:
        """The data of the case: with the contacts that come near, all places and angles bounded.

        ajar: the gap [m] from which on a contact is open at the start. stays: whether a quantity
        does not move.
        """
        size = self.size(motion)
        data, names = self.data(), (*scene.contacts, *scene.pairs)
        gaps = {name: observe(scene, motion, f"{name}.gap") for name in names}
        near = {name: gap for name, gap in gaps.items() if gap.min() < TOLERANCE * size}
        contacts = {name: data["scene"]["contacts"][name] for name in near}
        opened = [name for name, gap in near.items() if gap[0] > ajar]
        places = [f"{name}.{axis}" for name in scene.bodies for axis in "xy"]
        angles = [f"{name}.angle" for name, body in scene.bodies.items() if body.turns]
        bar = float(f"{TOLERANCE * size:.2g}")
        lands = [near[name] for name in opened if not self._round(scene, name)]
        fast = max((np.max(-np.diff(gap)) / motion.times[1] for gap in lands), default=0.0)
        most = tip_radius(scene) / SHIPPED_STEP
        said = "; ".join(self._said(size, through=most if fast > most else 0.0))
        return {
            **data,
            "title": f"{data['title']}: {said}",
            "scene": data["scene"] | {"contacts": contacts},
            "events": {f"{name}_closes": {f"{name}.gap": "falls to zero"} for name in opened},
            "allow": dict.fromkeys(places, bar) | dict.fromkeys(angles, TOLERANCE),
            "stays": tuple(name for name in (*places, *angles) if stays(name)),
        }

    def _round(self, scene: Scene, contact: str) -> bool:
        """Whether a contact is with a rim, not with a corner or a particle."""
        touching = (scene.contacts if contact in scene.contacts else scene.pairs)[contact]
        return scene.bodies[touching.body].radius is not None

    def _said(self, size: float, *, through: float) -> Iterator[str]:
        """Yields what a user should know of how it is read."""
        yield f"its units are written as m and kg, places may be off by {TOLERANCE:g} of {size:.3g}"
        space, plain = self.reading.space, Space()
        joint = PivotJoint(Body(1.0, 1.0), Body(1.0, 1.0), (0.0, 0.0))
        owners = [(space, plain, SOLVER[0]), *((c, joint, SOLVER[1]) for c in space.constraints)]
        other = {
            name: getattr(owner, name)
            for owner, usual, names in owners
            for name in names
            if getattr(owner, name) != getattr(usual, name)
        }
        if other:
            options = ", ".join(f"{name}: {number!r}" for name, number in other.items())
            yield f"with its solver's numbers it runs by --settings FILE: pymunk: {{{options}}}"
        if through:
            yield (
                f"corners land faster than {through:g} a second, and in steps of "
                f"{SHIPPED_STEP:g} s those of textmech's pymunk fall through: "
                "believe its finer steps"
            )
        if space.sleep_time_threshold < float("inf"):
            yield "nothing falls asleep"

    def size(self, motion: Trajectory) -> float:
        """Diagonal [m] of the region that the motion and its anchors cover.

        At least a radius of gyration; 1 where nothing has a size.
        """
        places = [states[:, [X, Y]] for states in motion.states.values()]
        fixed = [point for point in self.reading.points.values() if isinstance(point, tuple)]
        places += [np.array([point]) for point in fixed]
        for outline in self.known:
            if outline.body:
                corners = np.array(start_corners(outline))
                places += [corners - outline.radius, corners + outline.radius]
        every = np.concatenate(places)
        arms = [sqrt(body.moment / body.mass) for body in self.reading.names if turns(body)]
        size = max(float(np.hypot(*np.ptp(every, axis=0))), *arms, 0.0)
        return size if size > DEEP * float(np.max(np.abs(every))) else 1.0


def read_space(space: Space) -> Read:
    """Reads a Space into the words of a case file."""
    reading = read_bodies(space)
    read_constraints(reading)
    known = outlines(reading)
    pairs = {pair: find_contacts(reading, known, *pair) for pair in collisions(known, space)}
    touch = list[Pair]()
    for first, second in pairs:
        deep, rounding = depth(first, second)
        if deep > rounding:
            what = f"is {deep:.3g} deep in {second.place} at the start, which pymunk would part"
            reading.refuse(first.place, f"{what}: a filter can say that they pass")
        elif deep >= -rounding:
            touch.append((first, second))
    return Read(reading, known, pairs, touch)
