"""Forces in space as a case file writes them: those of the plane, along three axes."""

from typing import Annotated

from ....fields.part import OneOf
from ....scene.forces.force import FORCES
from .. import force as plane
from ..element import Element, element

AS_IN_THE_PLANE = ("spring", "damper", "torsion", "torsion_damper", "motor")
ALONG_THREE_AXES = ("push", "torque")
SPRING = element("spring", FORCES["spring"], without=("only",), axes=3)
SPRING.elsewhere = {"only": "a spring in space acts on both sides"}
KINDS: dict[str, type[Element]] = {word: plane.KINDS[word] for word in AS_IN_THE_PLANE}
KINDS |= {"spring": SPRING}
KINDS |= {word: element(word, FORCES[word], axes=3) for word in ALONG_THREE_AXES}
ELSEWHERE = {
    "couple": "in space a torque between two bodies is a `motor` about a hinge",
    "rope": "in space nothing comes taut or slackens",
    "stops": "in space nothing is struck",
}
Force = Annotated[Element, OneOf("force", KINDS, ELSEWHERE)]
