"""MuJoCo's recipes for what rolls on the floor z = 0: a sphere, and a disk on its rim.

MuJoCo asks of a contact the acceleration d (−b v − k r) + (1 − d) a, and leaves out that the
touching point wanders over the body (J̇ v): a disk that steers slips by h J̇ v, so that its error is
of first order, whatever the integrator.
"""

from ....cases.space.scene import SpatialScene
from ...engine import Choice
from ..contact import HARDEST as HARD


def recipe(scene: SpatialScene, tied_to: float) -> list[Choice]:
    """The contacts' numbers."""
    if not scene.contacts:
        return []
    rims = any(contact.rim for contact in scene.contacts.values())
    steps = 4 if rims else 2
    because = (
        "4 h: with 2 h a disk that tilts flutters, and its normal force is 1e-3 off at any h"
        if rims
        else "the stiffest that stays stable: 2 h"
    )
    return [
        Choice("pair.solref", [steps * tied_to, 1.0], because),
        Choice("pair.solimp", [HARD, HARD, 0.001], "the hardest MuJoCo takes: d = 0.9999"),
        Choice("option.cone", "elliptic", "the pyramid's friction depends on the direction"),
        Choice("option.impratio", 100.0, "less creep; from 1e4 on Newton stops early"),
        Choice(
            "flag.diagexact",
            "enable",
            "or d, k and b are those of a mean inertia over x, y and z, at another attitude",
        ),
    ]
