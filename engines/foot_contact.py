"""Feet that stand one after the other: a swinging one meets the floor only ahead of the other.

No engine's floor lets a foot pass midway, so a driver tells it before each step which it meets.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass

from ..cases.scene import Anchor, Contact, Scene

AHEAD = 1e-3  # of the largest length on a body: feet that are nearer are passing each other
NO_STRIDE = "engine: its floor meets a foot wherever it is low, also where it has to pass"

Place = Callable[[Anchor], tuple[float, float]]
"""x and y [m] of a point."""


@dataclass
class Stride:
    """The feet of a scene by name, and which of them meet the floor.

    A foot meets it from where it is `ahead` [m] of the other and above the floor; when it has come
    down, the other one is let go, without an impulse.
    """

    feet: dict[str, Contact]
    ahead: float
    meets: dict[str, bool]

    def look(self, place: Place) -> None:
        """Before a step."""
        for name, foot in self.feet.items():
            assert foot.ahead_of is not None
            (x, y), (other, _) = place(foot.at), place(foot.ahead_of)
            if x <= other + self.ahead:
                continue
            if y > 0.0:
                self.meets[name] = True
            elif self.meets[name]:
                self.come_down(name)

    def come_down(self, name: str) -> None:
        """The foot stands, and the one behind is let go."""
        self.meets[name] = True
        for behind, contact in self.feet.items():
            self.meets[behind] &= contact.at != self.feet[name].ahead_of

    def stands(self, place: Place) -> str:
        """The foot that carries: of those that meet the floor the one behind."""
        met = [name for name, meets in self.meets.items() if meets]
        return min(met or self.feet, key=lambda name: place(self.feet[name].at)[0])


def stride(scene: Scene, standing: Collection[str]) -> Stride | None:
    """At the start; standing: the contacts that lie on the floor there. None without such feet."""
    feet = strode(scene)
    if not feet:
        return None
    lengths = (abs(x) for body in scene.bodies.values() for at in body.points.values() for x in at)
    return Stride(feet, AHEAD * max(lengths), {name: name in standing for name in feet})


def strode(scene: Scene) -> dict[str, Contact]:
    """The contacts that are such feet."""
    return {name: foot for name, foot in scene.contacts.items() if foot.ahead_of is not None}


def strides(scene: Scene) -> bool:
    """Whether a driver has to tell which foot meets the floor."""
    return bool(strode(scene))
