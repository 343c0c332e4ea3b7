"""Defines where a case comes from: places of the textbook, or a question asked in public."""

from dataclasses import dataclass

_KINDS = ("example", "exercise", "figure", "section")


@dataclass(frozen=True)
class Origin:
    """The places of the textbook from which a case is taken, and the question it answers.

    Numbers of the book are text, since "2.10" is not 2.1. thread: the public question, as
    `owner/repository#number`.
    """

    equations: tuple[str, ...] = ()
    example: str | None = None
    exercise: str | None = None
    figures: tuple[str, ...] = ()
    section: str | None = None
    thread: str | None = None

    def __str__(self) -> str:
        """Returns all in one line: `example 2.3, figure 2.10`, equations in parentheses, thread."""
        words = [f"{kind} {number}" for kind in _KINDS for number in self.places(kind)]
        asked = () if self.thread is None else (self.thread,)
        return ", ".join([*words, *(f"({number})" for number in self.equations), *asked])

    def places(self, kind: str) -> tuple[str, ...]:
        """Returns the numbers of one of _KINDS: any count of figures, at most one of the others."""
        if kind == "figure":
            return self.figures
        number = getattr(self, kind)
        return () if number is None else (number,)
