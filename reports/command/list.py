"""`textmech list`."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from textwrap import wrap
from typing import TYPE_CHECKING

import click

from ..show.say import say
from .answer import as_json

if TYPE_CHECKING:
    from ...cases.load import Titled

WIDTH = 80


@click.command("list", short_help="The shipped cases, with titles and sources.")
@click.argument("words", nargs=-1, metavar="[WORD]...")
@as_json
def list_(words: tuple[str, ...], wants_json: bool) -> None:
    """The shipped cases, with titles and sources: the textbook's, then public questions.

    With WORDS those that have all of them in name, title or source, as in `textmech list wheel`.

    Below a file's name are its variants: `sliding_block .below` is run as sliding_block.below.
    """
    from ...cases.find import of_the_book, questions, shipped
    from ...cases.load import titled
    from ..show import document

    cases = [case for file in shipped().values() for case in titled(file) if _has(case, words)]
    if wants_json:
        document.write(document.of_cases(cases))
        return
    if not cases:
        raise click.UsageError(f"no shipped case has {' and '.join(words)} in it")
    for title, files in (("Textbook mechanics", of_the_book()), ("What people ask", questions())):
        group = [case for case in cases if case.name.partition(".")[0] in files]
        if group:
            say(f"{title}\n")
        for line in _lines(group):
            say(f"  {line}")
        if group:
            say()


def _has(case: "Titled", words: Sequence[str]) -> bool:
    text = f"{case.name} {case.title} {case.origin}".lower()
    return all(word.lower() in text for word in words)


def _lines(cases: "Sequence[Titled]") -> Iterator[str]:
    for file, found in groupby(cases, key=lambda case: case.name.partition(".")[0]):
        variants = [*found]
        names = [case.name.removeprefix(file) for case in variants]
        yield from _within(f"{file} {' '.join(names)}".rstrip(), "")
        yield from _within(variants[0].title, "    ")
        yield from _within(str(variants[0].origin), "    ")


def _within(text: str, indent: str) -> list[str]:
    return wrap(text, WIDTH - 2, initial_indent=indent, subsequent_indent=indent or "    ")
