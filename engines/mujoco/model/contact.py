"""MuJoCo's recipes for contacts, chosen by the scene and its start.

MuJoCo asks of a contact the acceleration d (−b v − k r) + (1 − d) a, where a is the one without
the contact. What holds a wheel (d near 1) makes a sliding body hop and takes the friction out of
an impact, and a spring that carries (k) throws back what falls: so there are several. Each is
measured by rows of reports/tolerance.csv.

In space it leaves out that the touching point wanders over the body (J̇ v): a disk that steers
slips by h J̇ v, so that its error is of first order, whatever the integrator. Who takes J̇ v from
`efc_aref` in the control callback, and an impratio of 1e8, has the second order (tested in
tests/engines/mujoco/space/test_rolling.py).
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ....cases.scene import CENTER, Anchor, Contact, Pair, Scene
from ....cases.scene.frame import PLANE, SPACE, Frame
from ...engine import Choice, Start, begun
from .bounce import dead, springy
from .number_text import of_one
from .planes import met, touching

HARDEST = 0.9999  # of d: MuJoCo clamps it
SOFTEST = 1.01e-4  # of d: MuJoCo clamps it at 1e-4
CLOSED = 1e-9  # m: what is nearer to the floor than that lies on it


def recipe(scene: Scene, start: Start | None) -> list[Choice]:
    """The contacts' numbers; without a start everything is taken to lie on the floor."""
    return recipes(scene)[chosen(scene, start)](scene)


def chosen(scene: Scene, start: Start | None) -> str:
    """Which of the recipes the scene needs from its start on."""
    if scene.frame is SPACE:
        return "rim" if any(map(_tilts, scene.contacts.values())) else "roll"
    contacts = met(scene)
    if not any(contact.switches for contact in contacts):
        return "roll"
    if any(contact.ideal == "pivot" for contact in scene.contacts.values()):
        return "pivot"
    if any(contact.restitution for contact in contacts):
        return "bounce"
    if start is not None and falls(scene, start):
        return "pivot" if rocks(scene, start) else "land"
    return "slide" if _all_alone(scene) else "tip"


def worth(scene: Scene) -> list[str]:
    """Which of the recipes may do something for the scene, from whatever start."""
    if not met(scene):
        return []
    if scene.frame is SPACE:
        return list(recipes(scene))
    thrown = ["bounce"] if any(contact.restitution for contact in met(scene)) else []
    tips = [] if _all_alone(scene) else ["tip", "pivot"]
    return ["roll", "slide", *tips, *thrown, "land"]


def _tilts(contact: Any) -> bool:
    """Whether the body in space stands on a rim or a point, and not on a sphere."""
    return contact.rim or contact.ideal == "pivot"


def _all_alone(scene: Scene) -> bool:
    return not scene.pairs and all(alone(scene, contact) for contact in touching(scene).values())


def alone(scene: Scene, contact: Contact) -> bool:
    """Whether a disk or a particle touches, and nothing else holds it."""
    joined = (end.body for joint in scene.joints.values() for end in (joint.a, joint.b))
    met_by = [other.body for other in scene.touching.values()]
    met_by += [body for pair in scene.pairs.values() for body in (pair.body, pair.touched)]
    once = met_by.count(contact.body) == 1
    return contact.at.point == CENTER and once and contact.body not in joined


def falls(scene: Scene, start: Start) -> bool:
    """Whether something starts above its plane, of spokes all tips, or apart from the other."""
    if scene.frame is SPACE:
        return False  # what touches there does so from the start on
    motion = begun(scene, start)
    if any(pair.normal_and_gap(motion)[1][0] > CLOSED for pair in scene.pairs.values()):
        return True
    return any(
        min(height(scene, point, start) for point in contact.each()) > CLOSED
        for contact in scene.contacts.values()
    )


def rocks(scene: Scene, start: Start) -> bool:
    """Whether all that touches are blocks, which each start on a corner and come down on others.

    The spring of what lands rises slowly, and the corner that has to carry would sink in it. A bar
    that slides and comes down flat needs it all the same: by the other it is off by 0.4 rad.
    """
    blocks = all(scene.bodies[contact.body].size for contact in scene.contacts.values())
    if scene.pairs or not blocks:
        return False
    stands = {(c.body, c.plane.name) for c in scene.contacts.values() if lies(scene, c, start)}
    return all((c.body, c.plane.name) in stands for c in scene.contacts.values())


def lies(scene: Scene, contact: Contact, start: Start) -> bool:
    """Whether what touches starts on its plane, and is not about to rise from it."""
    dx, dy = scene.bodies[contact.body].points[contact.at.point]
    (nx, ny), (*_, angle, vx, vy, omega) = contact.plane.normal, start[contact.body]
    cos, sin = math.cos(angle), math.sin(angle)
    rises = nx * (vx - omega * (sin * dx + cos * dy)) + ny * (vy + omega * (cos * dx - sin * dy))
    still = CLOSED * (math.hypot(vx, vy) or 1.0)
    return height(scene, contact, start) <= CLOSED and rises <= still


def meet(scene: Scene, pair: Pair, start: Start) -> bool:
    """Whether two bodies start in contact, and are not about to part."""
    motion = begun(scene, start)
    still = CLOSED * (max(math.hypot(*start[name][3:5]) for name in scene.bodies) or 1.0)
    gap, parting = pair.normal_and_gap(motion)[1][0], pair.slip_and_gap_rate(motion)[1][0]
    return bool(gap <= CLOSED and parting <= still)


def closed(scene: Scene, start: Start) -> bool:
    """Whether at the start anything lies on its plane or on another, or a limit holds."""
    if scene.frame is SPACE:
        return bool(scene.contacts)  # all that touches does, from the start on
    on_planes = any(lies(scene, contact, start) for contact in touching(scene).values())
    if on_planes or any(meet(scene, pair, start) for pair in scene.pairs.values()):
        return True
    motion = begun(scene, start)
    return any(gap[0] <= CLOSED for limit in scene.limits() for gap in limit.gaps(motion))


def height(scene: Scene, contact: Contact, start: Start) -> float:
    """How high [m] what touches is above its plane."""
    body = scene.bodies[contact.body]
    return float(contact.plane.height(*place(scene, contact.at, start))) - (body.radius or 0.0)


def place(scene: Scene, at: Anchor, start: Start) -> tuple[float, float]:
    """x and y [m] of a point of a body."""
    dx, dy = scene.bodies[at.body].points[at.point]
    x, y, angle, *_ = start[at.body]
    cos, sin = math.cos(angle), math.sin(angle)
    return x + cos * dx - sin * dy, y + sin * dx + cos * dy


def _rolling(scene: Scene) -> list[Choice]:
    return [*_HOLDING, _ELLIPTIC, _CREEPING]


def _sliding(scene: Scene) -> list[Choice]:
    because = "k = 0.25/h², b = 1/h: critically damped"
    return [
        *_soft("0.25/h2", b=1.0, along=1.0, because=because),
        Choice("option.noslip_iterations", 5, "a block at rest creeps 1e-19 m/s instead of 1e-6"),
    ]


def _tip(scene: Scene) -> list[Choice]:
    because = "k = 0.1/h², b = 0.4/h: contacts of one body act together, their stiffness adds up"
    return [*_soft("0.1/h2", b=0.4, along=0.8, because=because), _EXACT]


def _pivoting(scene: Scene) -> list[Choice]:
    because = "k = 0.1/h², b = 1.4/h: a strike throws nothing back; RK4 bears 2.8/h, of two tips"
    return [*_soft("0.1/h2", b=1.4, along=1.4, because=because), _EXACT]


def _bouncing(scene: Scene) -> list[Choice]:
    bounce = max(contact.restitution for contact in met(scene))
    k, b, because = springy(bounce)
    return [*_soft(k, b=b, along=1.0, because=because), _EXACT, *_otherwise(scene, bounce)]


def _otherwise(scene: Scene, most: float) -> Iterator[Choice]:
    """Springs of their own for what throws back less than the most, or nothing."""
    for contact in met(scene):
        e = contact.restitution
        if e != most:
            k, b, because = springy(e) if e else _dead(scene)
            yield Choice(f"{of_one(contact.name)}.solref", [f"-{k}", f"{-b}/h"], because)


def _dead(scene: Scene) -> tuple[str, float, str]:
    bodies = [contact.body for contact in met(scene)]
    return dead(max(map(bodies.count, bodies)))


def _landing(scene: Scene) -> list[Choice]:
    k, b, because = _dead(scene)
    return [*_soft(k, b=b, along=b, because=because), _EXACT]


def _soft(k: str, *, b: float, along: float, because: str) -> list[Choice]:
    """The softest d, so that friction and normal force do not feel each other.

    k [1/s²]; b and along [1/h]: the damping of the normal velocity and of the slip.
    """
    return [
        Choice("pair.solref", [f"-{k}", f"{-b}/h"], because),
        Choice(
            "pair.solimp",
            [SOFTEST, SOFTEST, 0.001],
            "the softest MuJoCo takes, or a cone's friction lifts what slides: it hops",
        ),
        Choice(
            "pair.solreffriction",
            [-1.0, f"{-along * SOFTEST}/h"],
            f"b = {along}/h along the floor (times d, by which MuJoCo divides): slip ends in a "
            "step or two; RK4 is stable up to 2.8/h",
        ),
        _ELLIPTIC,
        Choice("option.impratio", 1e6, "makes up for the soft d: slip 2e-6 · a; Newton bears it"),
    ]


def _sphere(scene: Scene) -> list[Choice]:
    return [*_HOLDING, _CREEPING, _ELLIPTIC, _EXACT_IN_SPACE]


def _rim(scene: Scene) -> list[Choice]:
    """Measured on steady circles of a coin that leans by 8, 30 and 70 degrees, and on its fall."""
    return [
        Choice(
            "pair.solref",
            ["-0.1/h2", "-0.4/h"],
            "k = 0.1/h², b = 0.4/h: stiffer, the normal force of what tilts is 10 times worse",
        ),
        Choice(
            "pair.solimp",
            [SOFTEST, SOFTEST, 0.001],
            "the softest MuJoCo takes; with d = 0.9999 a disk that falls flutters, N is 13 N off",
        ),
        Choice(
            "pair.solreffriction",
            [-1.0, f"{-2 * SOFTEST}/h"],
            "b = 2/h (times d, by which MuJoCo divides): slip h J̇ v/2; RK4 is stable up to 2.8/h",
        ),
        Choice("option.impratio", 1e6, "makes up for the soft d; Newton bears it"),
        _ELLIPTIC,
        _EXACT_IN_SPACE,
    ]


Recipe = Callable[[Scene], list[Choice]]

RECIPES: Mapping[Frame, Mapping[str, Recipe]] = {
    PLANE: {
        "roll": _rolling,
        "slide": _sliding,
        "tip": _tip,
        "pivot": _pivoting,
        "bounce": _bouncing,
        "land": _landing,
    },
    SPACE: {"roll": _sphere, "rim": _rim},
}
"""By the scene's frame, and by the word that an own option calls them."""


def recipes(scene: Scene) -> Mapping[str, Recipe]:
    """The recipes that there are for the scene's contacts, by their words."""
    return RECIPES[scene.frame]


_HOLDING = (
    Choice("pair.solref", ["2h", 1.0], "the stiffest that stays stable: 2 h"),
    Choice("pair.solimp", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes: d = 0.9999"),
)
_CREEPING = Choice("option.impratio", 100.0, "less creep; from 1e4 on Newton stops early")
_EXACT = Choice(
    "flag.diagexact",
    "enable",
    "or k and b are those of a mean inertia: a bar's tip has up to four times its inverse mass",
)
_EXACT_IN_SPACE = Choice(
    "flag.diagexact",
    "enable",
    "or d, k and b are those of a mean inertia over x, y and z, at another attitude",
)
_ELLIPTIC = Choice("option.cone", "elliptic", "the pyramid's friction depends on the direction")
