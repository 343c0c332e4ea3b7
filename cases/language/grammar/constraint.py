"""Constraints as a case file writes them."""

from typing import Annotated

from ...fields.part import OneOf
from ...scene.constraint import CONSTRAINTS
from .element import Element, element

KINDS = {word: element(word, noun) for word, noun in CONSTRAINTS.items()}
Constraint = Annotated[Element, OneOf("constraint", KINDS)]
