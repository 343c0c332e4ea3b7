"""One instant of a motion: all that is asked of it, and the rows of what holds the bodies."""

from functools import cached_property
from typing import Any

import numpy as np

from second import contacts
from second.bodies import three
from second.forces import Effect, effect
from second.geometry import Held
from second.moving import Array, Length, Vector, along, dot, fixed, unit


def level(v: Vector) -> Vector:
    """The shadow of a vector on a level plane."""
    E = np.diag([1.0, 1.0, 0.0])
    return Vector(E @ v.p, E @ v.v, E @ v.J, E @ v.b)


def left(v: Vector) -> Vector:
    """A level vector turned to its left by a right angle."""
    T = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return Vector(T @ v.p, T @ v.v, T @ v.J, T @ v.b)


class Now:
    """A model at one time, with its places, rates, turned angles and inner states."""

    def __init__(self, model: Any, t: float, x: Array, u: Array, turned: Array, inner: Array):
        self.model, self.t, self.x, self.u = model, t, x, u
        self.turned, self.inner = turned, inner
        self.n = model.n
        self.poses = model.layout.poses(x, u)

    def point(self, name: str) -> Vector:
        """A point `body.point` or `ground.point`."""
        return self.model.layout.point(self.poses, name, self.t)

    @cached_property
    def held(self) -> dict[str, Held]:
        """Each joint as it is now."""
        m = self.model
        return {
            name: Held(j, m.layout, self.poses, self.t, self.turned[m.angles[name]])
            for name, j in m.joints.items()
        }

    @cached_property
    def coordinates(self) -> dict[str, dict[str, Length]]:
        """The coordinates of each joint, by its name and theirs."""
        return {name: held.coordinates(self.x) for name, held in self.held.items()}

    def coordinate(self, rate: str) -> Length:
        """The coordinate of a joint whose rate has this name, `joint.rate`."""
        name, rate = rate.split(".")
        joint = self.model.joints[name]
        return self.coordinates[name][joint.names[joint.rates.index(rate)]]

    def turn(self, name: str) -> Length:
        """The turn of a joint by its name, or by that and its freedom's."""
        joint, _, freedom = name.partition(".")
        return self.coordinates[joint][freedom or "angle"]

    def law(self, name: str) -> Any:
        """The value of a force's law in time."""
        return self.model.laws[name].value(self.t)

    @cached_property
    def effects(self) -> dict[str, Effect]:
        """What each force does."""
        m = self.model
        return {
            name: effect(name, told, self, self.inner[m.inner.index(name)]
                         if name in m.inner else None)
            for name, told in m.forces.items()
        }  # fmt: skip

    def edge(self, told: dict[str, Any]) -> dict[str, Length]:
        """The rows of a blade: its slip to the left, its speed along it, its height in space."""
        owner = told["edge"].split(".")[0]
        heading = self.poses[owner].direction(three(told["along"]))
        heading = unit(level(heading))
        P = self.point(told["edge"])
        found = {"slip": along(left(heading), P), "speed": along(heading, P)}
        if told.get("height") == "kept":
            h = dot(fixed([0, 0, 1], self.n), P)
            found["gap"] = Length(h.p - self.model.heights.get(told["edge"], h.p), *h[1:])
        return found

    def driven(self, row: Length, name: str) -> Length:
        """A rate less what its law prescribes."""
        prescribed = self.model.laws[name]
        t = self.t
        return Length(
            0.0, row.v - float(prescribed.value(t)), row.J, row.b - float(prescribed.slope(t))
        )

    def rows(self) -> list[tuple[str, str, Length]]:
        """All that holds at every instant of a smooth motion: owner, what of it, and the row."""
        m = self.model
        found = [
            (name, str(i), row)
            for name, held in self.held.items()
            for i, row in enumerate(held.rows(self.x))
        ]
        for name, told in m.constraints.items():
            rows = self.edge(told)
            found.append((name, "force", rows["slip"]))
            if "speed" in told:
                found.append((name, "drive", self.driven(rows["speed"], name)))
            if "height" in told:
                found.append((name, "normal", rows["gap"]))
        for rate in m.drives:
            found.append((rate.split(".")[0], rate, self.driven(self.coordinate(rate), rate)))
        for name, c in m.contacts.items():
            if m.layout.space:
                rows = contacts.in_space(c, self)
                found += zip([name] * 3, ("fx", "fy", "normal"), rows, strict=True)
            elif c.ideal == "rolling":
                gap, slip = contacts.touching(c, self)
                found += [(name, "normal", gap), (name, "tangent", slip)]
        return found
