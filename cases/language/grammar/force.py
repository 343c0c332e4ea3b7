"""Forces as a case file writes them; each says itself what that is."""

from typing import Annotated

from ...fields.part import OneOf
from ...scene.forces.force import FORCES
from .element import Element, element

KINDS = {word: element(word, noun) for word, noun in FORCES.items()}
Force = Annotated[Element, OneOf("force", KINDS)]
