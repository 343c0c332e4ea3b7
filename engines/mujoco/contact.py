"""MuJoCo's three recipes for contacts with the floor, chosen by the scene and its start.

MuJoCo asks of a contact the acceleration d (−b v − k r) + (1 − d) a, where a is the one without
the contact. What holds a wheel makes a sliding body hop, and what lets it slide makes a falling
one bounce: so there are three.
"""

import math

from scipy.optimize import brentq

from ...cases.scene import Contact, Scene
from ..engine import Choice, Start

HARDEST = 0.9999  # of d: MuJoCo clamps it
SOFTEST = 1.01e-4  # of d: MuJoCo clamps it at 1e-4
CLOSED = 1e-9  # m: what is nearer to the floor than that lies on it


def recipe(scene: Scene, tied_to: float, start: Start | None) -> list[Choice]:
    """The contacts' numbers; without a start everything is taken to lie on the floor."""
    if not any(contact.switches for contact in scene.contacts.values()):
        return _rolling(tied_to)
    bounce = max(contact.restitution for contact in scene.contacts.values())
    if bounce > 0 or (start is not None and falls(scene, start)):
        return _impact(bounce, tied_to)
    bodies = [contact.body for contact in scene.contacts.values()]
    return _sliding(tied_to, shared=len(set(bodies)) < len(bodies))


def falls(scene: Scene, start: Start) -> bool:
    """Whether something starts above the floor."""
    return any(height(scene, contact, start) > CLOSED for contact in scene.contacts.values())


def height(scene: Scene, contact: Contact, start: Start) -> float:
    """How high [m] what touches is above the floor."""
    body = scene.bodies[contact.body]
    dx, dy = body.points[contact.at.point]
    _, y, angle, *_ = start[contact.body]
    return y + math.sin(angle) * dx + math.cos(angle) * dy - (body.radius or 0.0)


def _rolling(h: float) -> list[Choice]:
    return [
        Choice("pair.solref", [2 * h, 1.0], "the stiffest that stays stable: 2 h"),
        Choice("pair.solimp", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes: d = 0.9999"),
        _ELLIPTIC,
        Choice("option.impratio", 100.0, "less creep; from 1e4 on Newton stops early"),
    ]


def _sliding(h: float, *, shared: bool) -> list[Choice]:
    k, b = (0.1, 0.4) if shared else (0.25, 1.0)
    why = "two contacts of a body act together: softer" if shared else "critically damped"
    return [
        Choice("pair.solref", [-k / h**2, -b / h], f"k = {k}/h², b = {b}/h: {why}"),
        Choice(
            "pair.solimp",
            [SOFTEST, SOFTEST, 0.001],
            "the softest MuJoCo takes, or a cone's friction lifts what slides: it hops",
        ),
        Choice(
            "pair.solreffriction",
            [-1.0, -b * SOFTEST / h],
            f"b = {b}/h along the floor (times d, by which MuJoCo divides): slip ends in a step "
            "or two; RK4 is stable up to 2.8/h",
        ),
        _ELLIPTIC,
        Choice("option.impratio", 1e6, "makes up for the soft d: slip 2e-6 · a; Newton bears it"),
        Choice("option.noslip_iterations", 5, "a block at rest creeps 1e-19 m/s instead of 1e-6"),
    ]


def _impact(bounce: float, h: float) -> list[Choice]:
    if bounce:
        k, b = (_BEAT / h) ** 2, 2 * damping_ratio(bounce) * _BEAT / h
        because = f"k = ({_BEAT}/h)²: a bounce lasts 16 h and keeps its energy to 3e-4; b gives e"
    else:
        k, b = (0.1 / h) ** 2, 1 / h
        because = "k = (0.1/h)², b = 1/h: five times overdamped, it does not throw back"
    return [
        Choice("pair.solref", [-k, -b], because),
        Choice("pair.solimp", [HARDEST, HARDEST, 0.001], "the contact's own motion, no weight"),
        _ELLIPTIC,
        Choice("option.impratio", 100.0, "less creep; from 1e4 on Newton stops early"),
    ]


_ELLIPTIC = Choice("option.cone", "elliptic", "the pyramid's friction depends on the direction")
_BEAT = 0.2  # h times the contact's frequency: RK4 keeps the energy to 3e-4, with 0.5 to 1e-2
LEAST_BOUNCE = 0.02  # below, the damper that a spring of _BEAT needs is unstable with RK4


def damping_ratio(bounce: float) -> float:
    """ζ of a spring and damper that push only, and throw back with `bounce` of the speed.

    With ζ = sin ψ: e = exp(−(π − 2ψ) tan ψ); with ζ = cosh χ: e = exp(−2χ coth χ).
    """
    turning = math.exp(-2.0)  # e at ζ = 1
    if bounce == 1.0:
        return 0.0
    if bounce > turning:
        psi = brentq(
            lambda x: math.exp(-(math.pi - 2 * x) * math.tan(x)) - bounce, 0.0, math.pi / 2 - 1e-6
        )
        return math.sin(psi)
    chi = brentq(lambda x: math.exp(-2 * x / math.tanh(x)) - bounce, 1e-6, 50.0)
    return math.cosh(chi)
