"""Constraints as a case file writes them."""

from typing import Annotated

from ...constraint import CONSTRAINTS
from .element import Element, element
from .part import OneOf

KINDS = {word: element(word, noun) for word, noun in CONSTRAINTS.items()}
Constraint = Annotated[Element, OneOf("constraint", KINDS)]
