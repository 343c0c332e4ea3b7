"""`textmech list`."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from textwrap import wrap
from typing import TYPE_CHECKING

import click

from ..show.say import say
from .answer import as_json

if TYPE_CHECKING:
    from ...cases.case import Case

WIDTH = 80


@click.command("list")
@as_json
def list_(wants_json: bool) -> None:
    """The shipped cases, with their titles and sources: the textbook's, then public questions.

    Below a file's name are its variants: `sliding_block .below` is run as sliding_block.below.
    """
    from ...cases.find import of_the_book, questions
    from ..selection import choose_cases
    from ..show import document

    if wants_json:
        document.write(document.of_cases(choose_cases([], known=None)))
        return
    for title, files in (("Textbook mechanics", of_the_book()), ("What people ask", questions())):
        say(f"{title}\n")
        for line in _lines(choose_cases(list(files), known=None)):
            say(f"  {line}")
        say()


def _lines(cases: "Sequence[Case]") -> Iterator[str]:
    for file, found in groupby(cases, key=lambda case: case.name.partition(".")[0]):
        variants = [*found]
        names = [case.name.removeprefix(file) for case in variants]
        yield from _within(f"{file} {' '.join(names)}".rstrip(), "")
        yield from _within(variants[0].title, "    ")
        yield from _within(str(variants[0].origin), "    ")


def _within(text: str, indent: str) -> list[str]:
    return wrap(text, WIDTH - 2, initial_indent=indent, subsequent_indent=indent or "    ")
