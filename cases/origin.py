"""Where a case comes from, in the words of its file."""

from dataclasses import dataclass

_KINDS = ("example", "exercise", "figure", "section")


@dataclass(frozen=True)
class Origin:
    """Where the case comes from: numbers of the book as text ("2.10" is not 2.1).

    thread: the public question that it answers, as `owner/repository#number`.
    """

    equations: tuple[str, ...] = ()
    example: str | None = None
    exercise: str | None = None
    figures: tuple[str, ...] = ()
    section: str | None = None
    thread: str | None = None

    def __str__(self) -> str:
        words = [f"{kind} {number}" for kind in _KINDS for number in self.places(kind)]
        asked = () if self.thread is None else (self.thread,)
        return ", ".join([*words, *(f"({number})" for number in self.equations), *asked])

    def places(self, kind: str) -> tuple[str, ...]:
        """The numbers of one kind, as `figure`: there may be several figures, one of any other."""
        if kind == "figure":
            return self.figures
        number = getattr(self, kind)
        return () if number is None else (number,)
