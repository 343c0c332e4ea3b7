"""Constraints as a case file writes them."""

from typing import Annotated

from pydantic import Field

from ...fields.part import Direction, OneOf
from ...scene.constraint import CONSTRAINTS
from .element import Element, element

_ALONG = Annotated[Direction, Field(description="in the axes of the body")]
KINDS = {
    word: element(word, noun, without=("kept", "frame"), typed={"along": _ALONG})
    for word, noun in CONSTRAINTS.items()
}
Constraint = Annotated[Element, OneOf("constraint", KINDS)]
