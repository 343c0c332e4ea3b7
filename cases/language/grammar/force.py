"""Forces as a case file writes them; each says itself what that is."""

from typing import Annotated

from ...force import FORCES
from .element import Element, element
from .part import OneOf

KINDS = {word: element(word, noun) for word, noun in FORCES.items()}
Force = Annotated[Element, OneOf("force", KINDS)]
