"""Forces: what each acts along, and how much, with what it stores and what goes on inside."""

from typing import Any, NamedTuple

import numpy as np

from second.bodies import three
from second.moving import Length, Vector, size

TIMED = ("push", "torque", "couple", "motor")
KINDS = (
    "spring", "damper", "rope", "push", "torque", "couple", "torsion", "torsion_damper", "motor",
    "stops", "drag", "viscous", "magnetic", "muscle", "linear_muscle",
)  # fmt: skip


class Effect(NamedTuple):
    """What a force does at one instant.

    on: what it acts along (a length, an angle or a point) and how much it is there, growing the
    length where it is positive; stored: its potential energy; told: its quantities; inner: the
    rate of its inner state; bends: what is zero where its law changes, and the rate of that.
    """

    on: list[tuple[Any, Any]]
    stored: float = 0.0
    told: dict[str, float] = {}  # noqa: RUF012
    inner: float | None = None
    bends: tuple[float, float] | None = None

    @property
    def power(self) -> float:
        """What it does on all that it acts on, per second."""
        return float(sum(np.dot(amount, thing.v) for thing, amount in self.on))


def word(told: dict[str, Any]) -> str:
    """Which kind of force a map describes."""
    return next(kind for kind in KINDS if kind in told)


def part(pose: Any) -> Vector:
    """The turning of a body as a vector that a torque acts along."""
    return Vector(np.zeros(3), pose.w, pose.Jw, np.zeros(3))


def powered(v: float, d: Any, backward: float, exponent: float) -> float:
    """The viscous force (2.86) at a speed, with a coefficient for each way."""
    return -np.sign(v) * (d if v >= 0 else backward) * abs(v) ** exponent


def both_ways(told: Any) -> tuple[float, float]:
    """One number for both ways, or one for each: forward and backward."""
    return (told["forward"], told["backward"]) if isinstance(told, dict) else (told, told)


def stretched(told: dict[str, Any], kind: str, l: Length) -> Effect:
    """A spring or damper along a line."""
    if kind == "damper":
        f = told["damping"] * l.v
        return Effect([(l, -f)], told={"length": l.p, "force": f})
    x, c, only = l.p - told["rest_length"], told["stiffness"], told.get("only")
    acts = {None: True, "compression": x < 0, "tension": x > 0}[only]
    f = c * x if acts else 0.0
    return Effect(
        [(l, -f)], c * x * x / 2 if acts else 0.0, {"length": l.p, "force": f},
        bends=None if only is None else (x, l.v),
    )  # fmt: skip


def contracted(told: dict[str, Any], kind: str, l: Length, u: float) -> Effect:
    """A muscle: what contracts in series with one spring, and a second one beside both."""
    series = told["series_stiffness"] * (l.p - u)
    beside = told["parallel_stiffness"] * (l.p - told["rest_length"])
    if kind == "muscle":
        a, b = told["hill_a"], told["hill_b"]
        shortening = (told["isometric"] + a) * b / (series + a) - b
    else:
        shortening = (told["isometric"] - series) / told["damping"]
    f = series + beside
    stored = (series * (l.p - u) + beside * (l.p - told["rest_length"])) / 2  # of both springs
    return Effect(
        [(l, -f)], stored, {"length": l.p, "force": f, "contractile_length": u}, -shortening
    )


def dragged(told: dict[str, Any], p: Vector, direction: Vector | None) -> Effect:
    """Viscous friction of a point, or of an edge along its direction and across it."""
    d, exponent = told["coefficient"], told["exponent"]
    v = p.v
    if direction is None:
        speed = float(np.sqrt(v @ v))
        F = -d * speed**exponent * v / speed if speed > 0 else np.zeros(3)
    else:
        e = direction.p / np.linalg.norm(direction.p)
        n = np.array([-e[1], e[0], 0.0])
        F = powered(v @ e, d, told.get("backward", d), exponent) * e
        F = F + powered(v @ n, told["across"], told["across"], exponent) * n
    told_of = {"fx": F[0], "fy": F[1], "fz": F[2], "force": float(np.sqrt(F @ F))}
    return Effect([(p, F)], told=told_of)


def about(told: dict[str, Any], kind: str, a: Length, moment: float) -> Effect:
    """A torsion spring, a damper or a motor about a turn."""
    if kind == "torsion":
        x = a.p - told["rest_angle"]
        M = -told["stiffness"] * x
        return Effect([(a, M)], -M * x / 2, {"angle": a.p, "torque": M})
    if kind == "torsion_damper":
        M = -told["damping"] * a.v
        return Effect([(a, M)], told={"angle": a.p, "torque": M})
    return Effect([(a, moment)])


def effect(name: str, told: dict[str, Any], now: Any, inner: float | None) -> Effect:
    """What the force of a map does now (`now` knows points, poses and coordinates)."""
    kind = word(told)
    timed = now.law(name) if kind in TIMED else 0.0
    if kind in ("spring", "damper", "muscle", "linear_muscle"):
        one, two = (now.point(name) for name in told[kind])
        l = size(two.minus(one))
        return stretched(told, kind, l) if inner is None else contracted(told, kind, l, inner)
    if kind == "push":
        return Effect([(now.point(told[kind]), three(timed))])
    if kind == "torque":
        M = np.asarray(timed)
        return Effect([(part(now.poses[told[kind]]), M if M.ndim else M * np.array([0, 0, 1]))])
    if kind == "couple":
        M = float(timed) * np.array([0, 0, 1])
        one, two = (part(now.poses[name]) for name in told[kind])
        return Effect([(one, -M), (two, M)])  # of the first on the second
    if kind in ("torsion", "torsion_damper", "motor"):
        return about(told, kind, now.turn(told[kind]), float(timed))
    if kind == "drag":
        owner = told["drag"].split(".")[0]
        edge = now.poses[owner].direction(three(told["along"])) if "along" in told else None
        return dragged(told, now.point(told["drag"]), edge)
    if kind == "viscous":
        s = now.held[told["viscous"]].shifts()[0]
        F = powered(s.v, *both_ways(told["coefficient"]), told["exponent"])
        return Effect([(s, F)], told={"speed": s.v, "force": F})
    if kind == "magnetic":
        p = now.poses[told["magnetic"]].center
        F = told["charge"] * np.cross(p.v, [0.0, 0.0, told["along_z"]])
        return Effect([(p, F)])
    return Effect([])  # ropes and stops are rows
