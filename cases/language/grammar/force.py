"""Forces as a case file writes them; each says itself what that is."""

from typing import Annotated

from ...fields.part import OneOf
from ...scene.forces.force import FORCES
from .element import Element, element

_PLANE: dict[str, type[Element]] = {word: element(word, noun) for word, noun in FORCES.items()}
_SPRING = element("spring", FORCES["spring"], without=("only",), axes=3)
_SPRING.elsewhere = {"only": "a spring in space acts on both sides"}
_AS_IN_THE_PLANE = ("damper", "torsion", "torsion_damper", "motor")
_ALONG_THREE_AXES = ("push", "torque")
KINDS: dict[int, dict[str, type[Element]]] = {
    2: _PLANE,
    3: {
        "spring": _SPRING,
        **{word: _PLANE[word] for word in _AS_IN_THE_PLANE},
        **{word: element(word, FORCES[word], axes=3) for word in _ALONG_THREE_AXES},
    },
}
"""By the dimension of the frame."""
NOT_IN_SPACE = {
    "couple": "in space a torque between two bodies is a `motor` about a hinge",
    "rope": "in space nothing comes taut or slackens",
    "stops": "in space nothing is struck",
}
Force = Annotated[Element, OneOf("force", KINDS[2])]
SpatialForce = Annotated[Element, OneOf("force", KINDS[3], NOT_IN_SPACE)]
