"""Contacts: what touches, where it may slip or part, and what may hold at one instant."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from second.bodies import three
from second.forces import both_ways, word
from second.moving import Array, Length, Vector, along, cross, dot, fixed, size, skew, unit

# Contacts: the gap of each point that may touch, and its slip, as lengths with their rows.

UP = np.array([0.0, 0.0, 1.0])
SIDES = {"top": (0, 1), "bottom": (0, -1), "left": (-1, 0), "right": (1, 0)}


@dataclass(frozen=True)
class Contact:
    """A place where two things may touch: the first a body or one of its points."""

    name: str
    first: str
    second: str
    static: float
    kinetic: float
    restitution: float
    ideal: str | None
    ahead_of: str | None

    @property
    def body(self) -> str:
        """The body that touches."""
        return self.first.split(".")[0]

    @property
    def point(self) -> str | None:
        """The point of it that touches, if it is not a rim, a sphere, or spokes."""
        return self.first.split(".")[1] if "." in self.first else None


def contact(name: str, told: dict[str, Any]) -> Contact:
    """The contact that a map describes."""
    mu = told["friction"]
    static, kinetic = (mu["static"], mu["kinetic"]) if isinstance(mu, dict) else (mu, mu)
    first, second = told["between"]
    return Contact(
        name, first, second, static, kinetic, told.get("restitution", 0.0),
        told.get("ideal"), told.get("ahead_of"),
    )  # fmt: skip


def scaled(x: Vector, by: Length) -> Vector:
    """A vector times a number, both moving."""
    J = by.p * x.J + np.outer(x.p, by.J)
    b = by.p * x.b + 2 * by.v * x.v + by.b * x.p
    return Vector(by.p * x.p, by.p * x.v + by.v * x.p, J, b)


def right_of(n: Vector) -> Vector:
    """The direction in the plane that has n to its left."""
    T = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return Vector(T @ n.p, T @ n.v, T @ n.J, T @ n.b)


def rolled(now: Any, body: str, R: float) -> Length:
    """R times the rate of the turn of a body in the plane."""
    pose = now.poses[body]
    return Length(0.0, R * pose.w[2], R * pose.Jw[2], 0.0)


def sum_of(*lengths: Length) -> Length:
    """The sum of some lengths."""
    return Length(*(sum(each) for each in zip(*lengths, strict=True)))


def less(l: Length, R: float) -> Length:
    """A length without a constant."""
    return Length(l.p - R, *l[1:])


def on_plane(c: Contact, now: Any) -> tuple[Length, Length]:
    """Gap and slip of a point, a particle or a rim on a plane of the ground."""
    at, normal = now.model.planes[c.second.split(".")[1]]
    n = fixed(normal / np.linalg.norm(normal), now.n)
    body = now.model.bodies[c.body]
    P = now.point(c.first if c.point else f"{c.body}.center")
    R = 0.0 if c.point else body.radius
    gap = less(dot(n, P.minus(fixed(at, now.n))), R)
    slip = along(right_of(n), P)
    return gap, sum_of(slip, rolled(now, c.body, R)) if R else slip


def on_rim(c: Contact, now: Any) -> tuple[Length, Length]:
    """Gap and slip of a disk or a particle on a disk."""
    R = [now.model.bodies[name].radius for name in (c.first, c.second)]
    way = now.point(f"{c.first}.center").minus(now.point(f"{c.second}.center"))
    gap = less(size(way), sum(R))
    slip = along(right_of(unit(way)), way)
    turning = [rolled(now, name, r) for name, r in zip((c.first, c.second), R, strict=True) if r]
    # the first's point against the second body, which goes on beyond its rim while they are apart
    w = rolled(now, c.second, 1.0)
    beyond = Length(0.0, gap.p * w.v, gap.p * w.J, gap.v * w.v)
    return gap, sum_of(slip, *turning, beyond)


def on_side(c: Contact, now: Any) -> tuple[Length, Length]:
    """Gap and slip of a point, a particle or a rim on a side of a block."""
    block, side = c.second.split(".")
    body, pose = now.model.bodies[block], now.poses[block]
    n = three(SIDES[side])
    R = 0.0 if c.point else now.model.bodies[c.body].radius
    way = now.point(c.first if c.point else f"{c.body}.center").minus(pose.center)
    gap = less(dot(pose.direction(n), way), R + float(abs(n) @ body.half))
    slip = dot(right_of(pose.direction(n)), way)
    slip = Length(0.0, *slip[1:])
    if R:
        slip = sum_of(slip, rolled(now, c.body, R), rolled(now, block, -R))
    return gap, slip


def touching(c: Contact, now: Any) -> tuple[Length, Length]:
    """Gap and slip of a contact in the plane."""
    if c.second.startswith("ground."):
        return on_plane(c, now)
    return on_side(c, now) if "." in c.second else on_rim(c, now)


def lowest(c: Contact, now: Any) -> Vector:
    """In space: the way from a body's centre to its lowest point, of a rim or a sphere."""
    body = now.model.bodies[c.body]
    if body.axle is None:
        return fixed(-body.radius * UP, now.n)
    e = now.poses[c.body].direction(body.axle / np.linalg.norm(body.axle))
    up = fixed(UP, now.n)
    d = unit(up.minus(scaled(e, dot(e, up))))
    return Vector(*(-body.radius * each for each in d))


def in_space(c: Contact, now: Any) -> list[Length]:
    """What an ideal contact with the floor holds: the slip along x and y, and the gap."""
    up = fixed(UP, now.n)
    if c.point:
        P = now.point(c.first)
        rows = [dot(fixed(e, now.n), P) for e in np.eye(3)]
        return [Length(0.0, *rows[0][1:]), Length(0.0, *rows[1][1:]), rows[2]]
    pose, rho = now.poses[c.body], lowest(c, now)
    v = pose.center.v + cross(pose.w, rho.p)
    J = pose.center.J - skew(rho.p) @ pose.Jw
    b = cross(pose.w, rho.v)
    slips = [Length(0.0, v[i], J[i], b[i]) for i in range(2)]
    return [*slips, dot(up, pose.center.plus(rho))]


def track(c: Contact, now: Any) -> Array:
    """In space: the level direction in which a rim rolls."""
    axle = now.model.bodies[c.body].axle
    t = np.cross(now.poses[c.body].R @ axle, UP)
    return t / np.linalg.norm(t)


# Sites: where something opens and closes, or sticks and slides, with the rows of both.

AHEAD = 1e-6  # m: feet that pass each other are level there, but for rounding


@dataclass(frozen=True)
class Site:
    """One place that switches.

    gap: how far it is open, None where it never opens; slip: None where nothing rubs. holds and
    rubs: the largest friction at rest and the friction in motion, of the force that presses it
    together and of the slip, with its sign. pivot: it stays where it strikes and lets all other
    pivots go, if `ahead` says so.
    """

    name: str
    part: str
    gap: Callable[[Any], Length] | None
    slip: Callable[[Any], Length] | None
    holds: Callable[[float, float], float]
    rubs: Callable[[float, float], float]
    restitution: float = 0.0
    pivot: bool = False
    ahead: Callable[[Any], bool] = lambda now: True
    pressed: bool = True
    what: str = "tangent"


def of_contact(c: Contact, part: str = "") -> Site:
    """The site of a contact in the plane."""

    def ahead(now: Any) -> bool:
        if c.ahead_of is None:
            return True
        return bool(now.point(c.first).p[0] > now.point(c.ahead_of).p[0] + AHEAD)

    pivot = c.ideal == "pivot"
    return Site(
        c.name, part or c.name,
        lambda now: touching(c, now)[0],
        (lambda now: touching(c, now)[1]) if c.static or c.kinetic or pivot else None,
        lambda N, v: math.inf if pivot else c.static * N,
        lambda N, v: c.kinetic * N,
        c.restitution, pivot, ahead,
    )  # fmt: skip


def of_rope(name: str, told: dict[str, Any]) -> Site:
    """The site of a rope: it is open while it is slack."""

    def slack(now: Any) -> Length:
        one, two = (now.point(end) for end in told["rope"])
        l = size(two.minus(one))
        return Length(told["length"] - l.p, -l.v, -l.J, -l.b)

    return Site(name, name, slack, None, lambda N, v: 0.0, lambda N, v: 0.0)


def of_stop(name: str, told: dict[str, Any], end: str) -> Site:
    """The site of one stop of a turn."""
    sign = 1.0 if end == "low" else -1.0

    def left(now: Any) -> Length:
        a = now.turn(told["stops"])
        return Length(sign * (a.p - told[end]), sign * a.v, sign * a.J, sign * a.b)

    none = lambda N, v: 0.0  # noqa: E731
    return Site(name, f"{name}.{end}", left, None, none, none, told.get("restitution", 0.0))


def of_friction(name: str, told: dict[str, Any]) -> Site:
    """The site of dry friction in a joint, which never opens."""
    kinetic = both_ways(told["kinetic"])
    static = both_ways(told.get("static", told["kinetic"]))
    fades = told.get("stribeck", {}).get("speed")

    def rubs(N: float, v: float) -> float:
        k, s = kinetic[int(v < 0)], static[int(v < 0)]
        return k + (s - k) * math.exp(-abs(v) / fades) if fades else k

    return Site(
        name, name, None, lambda now: next(iter(now.coordinates[name].values())),
        lambda N, v: static[int(v < 0)], rubs, pressed=False, what="friction",
    )  # fmt: skip


def of_viscous(name: str, joint: str) -> Site:
    """The site of viscous friction with an exponent below 1, which comes to rest."""
    return Site(
        name, name, None, lambda now: now.held[joint].shifts()[0],
        lambda N, v: 0.0, lambda N, v: 0.0, pressed=False, what="rest",
    )  # fmt: skip


def tips(c: Contact, model: Any) -> list[Site]:
    """The sites of spokes, one of each tip."""
    names = [p for p in model.bodies[c.first].points if p.startswith("tip")]
    rest = (c.second, c.static, c.kinetic, c.restitution, c.ideal, c.ahead_of)
    return [
        of_contact(Contact(c.name, f"{c.first}.{tip}", *rest), f"{c.name}.{tip}") for tip in names
    ]


def sites(model: Any) -> list[Site]:
    """All sites of a model in the plane."""
    found: list[Site] = []
    if model.layout.space:
        return found
    for c in model.contacts.values():
        if any(p == "tip0" for p in model.bodies[c.body].points) and not c.point:
            found += tips(c, model)
        elif c.ideal != "rolling":
            found.append(of_contact(c))
    for name, told in model.forces.items():
        if word(told) == "rope":
            found.append(of_rope(name, told))
        elif word(told) == "stops":
            found += [of_stop(name, told, end) for end in ("low", "high") if end in told]
        elif word(told) == "viscous" and told["exponent"] < 1:
            found.append(of_viscous(name, told["viscous"]))
    found += [of_friction(name, told) for name, told in model.dry.items()]
    return found


def group(site: Site, model: Any) -> str:
    """What shares its friction with a site: two points of one body on the same thing."""
    c = model.contacts.get(site.name)
    return f"{c.body} on {c.second.split('.')[0]}" if c else site.part


def bends(now: Any) -> list[tuple[float, float]]:
    """What is zero where a force changes its law, as a spring that becomes slack, and its rate."""
    return [effect.bends for effect in now.effects.values() if effect.bends]
