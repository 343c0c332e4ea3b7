"""`textmech list`."""

import re
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import groupby
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

import click

from ..show.console import say
from .options import as_json

if TYPE_CHECKING:
    from ....cases.titled import Titled

WIDTH = 80


@click.command("list", short_help="The shipped cases, with titles and sources.")
@click.argument("words", nargs=-1, metavar="[WORD]...")
@as_json
def list_(words: tuple[str, ...], wants_json: bool) -> None:
    """The shipped cases, with titles and sources: the textbook's, public questions, models.

    With WORDS those that have all of them, as in `textmech list wheel`: in name, title or source,
    and then those whose scene or quantities have them, in our words or in what others call them
    (`restitution`, `motor`, `penetration`, `revolute`, `3d`).

    Below a file's name are its variants: `sliding_block .below` is run as sliding_block.below.
    """
    from ....cases.find import models, of_the_book, questions, shipped
    from ....cases.titled import titled

    every = [case for file in (shipped() | models()).values() for case in titled(file)]
    named = [case for case in every if _has(f"{case.name} {case.title} {case.origin}", words)]
    beside = [case for case in every if case not in named and _has(_case_text(case.file), words)]
    cases = [*named, *beside]
    if not cases:
        raise click.ClickException(f"no shipped case has {' and '.join(words)} in it")
    if wants_json:
        from ..show import document  # which needs all that a run's rows need

        document.write(document.of_cases(cases))
        return
    groups = {"Textbook mechanics": of_the_book(), "What people ask": questions()}
    for title, files in (groups | {"Models, as yours may be": models()}).items():
        group = [case for case in named if case.name.partition(".")[0] in files]
        if group:
            say(f"{title}\n")
        for line in _lines(group):
            say(f"  {line}")
        if group:
            say()
    if beside:
        say("In their scenes and quantities\n")
    for line in _lines(beside):
        say(f"  {line}")


def _has(text: str, words: Sequence[str]) -> bool:
    text = text.lower()
    return all(any(x in text for x in (w, *ALIKE.get(w, ()))) for w in map(str.lower, words))


@cache
def _case_text(file: str) -> str:
    """Returns the text of a case file without its comments."""
    return re.sub(r"(?m)(^|\s)#.*$", "", Path(file).read_text(encoding="utf-8"))


ALIKE = {
    "penetration": ("sink",),
    "bounce": ("restitution: ", "elastic"),
    "collision": ("strikes", "bounce", "knock", "lands"),
    "impact": ("strikes", "bounce", "knock", "lands"),
    "stiction": ("dry_friction", "sticks"),
    "revolute": ("{pin:", "{hinge:"),
    "prismatic": ("{slide:",),
    "spherical": ("{ball:",),
    "actuator": ("{motor:", "drive:"),
    "servo": ("{motor:", "drive:"),
    "limit": ("{stops:",),
    "tendon": ("{rope:",),
    "cable": ("{rope:",),
    "contact": ("contacts:",),
    "damping": ("damper",),
    "rod": ("{bar:", "{distance:"),
    "box": ("{block:",),
    "3d": ("space: 3",),
    "spatial": ("space: 3",),
    "quaternion": ("attitude",),
    "nonholonomic": ("{edge:", "ideal: rolling"),
    "inverse dynamics": ("mass_matrix",),
}
"""What others call something, and how case files write it."""


def _lines(cases: "Sequence[Titled]") -> Iterator[str]:
    for file, group in groupby(cases, key=lambda case: case.name.partition(".")[0]):
        variants = [*group]
        names = [case.name.removeprefix(file) for case in variants]
        yield from _wrapped(f"{file} {' '.join(names)}".rstrip(), "")
        yield from _wrapped(variants[0].title, "    ")
        yield from _wrapped(str(variants[0].origin), "    ")


def _wrapped(text: str, indent: str) -> list[str]:
    return wrap(text, WIDTH - 2, initial_indent=indent, subsequent_indent=indent or "    ")
