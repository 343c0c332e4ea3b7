"""Where a case comes from: places in the book, or the public question that it answers."""

from typing import Annotated

from pydantic import Field, Tag

from ...fields.part import Part, plain_or_list
from ...fields.text import THREAD, Place, Text, asked, equation

BookPlace = Annotated[str, Place()]
Places = Annotated[
    Annotated[str, Place(), Tag("<plain>")] | Annotated[tuple[BookPlace, ...], Tag("<list>")],
    plain_or_list(),
]


class Source(Part):
    """Where the case comes from: places in the book as text, for "2.10" is not 2.1; a question."""

    equations: tuple[Annotated[str, Place(equation, r"^2\.[1-9][0-9]?$")], ...] = ()
    example: BookPlace | None = None
    exercise: BookPlace | None = None
    figure: Places | None = None  # one, or a list of several
    section: BookPlace | None = None
    thread: Annotated[str, Text(asked, THREAD)] | None = Field(
        default=None, description="the public question that it answers: owner/repository#number"
    )

    @property
    def figures(self) -> tuple[str, ...]:
        """The figures that are given."""
        return (self.figure,) if isinstance(self.figure, str) else self.figure or ()
