"""Sites: where something opens and closes, or sticks and slides, with the rows of both."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from second import contacts
from second.forces import both_ways, word
from second.moving import Length, size

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


def of_contact(c: contacts.Contact, part: str = "") -> Site:
    """The site of a contact in the plane."""

    def ahead(now: Any) -> bool:
        if c.ahead_of is None:
            return True
        return bool(now.point(c.first).p[0] > now.point(c.ahead_of).p[0] + AHEAD)

    pivot = c.ideal == "pivot"
    return Site(
        c.name, part or c.name,
        lambda now: contacts.touching(c, now)[0],
        (lambda now: contacts.touching(c, now)[1]) if c.static or c.kinetic or pivot else None,
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


def tips(c: contacts.Contact, model: Any) -> list[Site]:
    """The sites of spokes, one of each tip."""
    names = [p for p in model.bodies[c.first].points if p.startswith("tip")]
    rest = (c.second, c.static, c.kinetic, c.restitution, c.ideal, c.ahead_of)
    return [
        of_contact(contacts.Contact(c.name, f"{c.first}.{tip}", *rest), f"{c.name}.{tip}")
        for tip in names
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
