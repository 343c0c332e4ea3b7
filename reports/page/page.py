"""The page as one text: the same bytes from the same rows and motions."""

import gzip
import json
import re
from base64 import b64encode
from collections.abc import Mapping, Sequence
from importlib.resources import files
from itertools import groupby
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from ...cases.case import Case
from ...cases.theme import THEMES, themes
from ..row import MUTANTS
from ..selection import BOOK
from . import beside
from .advice import advice
from .column import Column, columns
from .folder import BESIDE, Folder
from .heat import SHADES, Cell, cells
from .listed import listed
from .motions import Motion
from .mutants import mutants
from .overview import moving, overview
from .rows import rows
from .stick_slip import stick_slip
from .trust import trust
from .work import work

SCRIPTS = ("read", "plot", "mechanism", "case", "section", "filter", "start")
POWER = re.compile(r"(?<=\de)(?:\+0*|(-)0+)(?=\d)")  # of ten: 2e-07 and 2e+03 are 2e-7 and 2e3
STYLES = ("style", "heat", "print")


def page(folder: Folder, cases: Sequence[Case], motions: Mapping[str, Motion]) -> str:
    """One HTML file. Text of a case is escaped wherever it stands."""
    shown = columns(folder.comparisons)
    mapped = [one for one in shown if one.engine != BOOK] or shown
    found = cells(folder.comparisons, folder.rungs)
    about = {case.name: themes(case) for case in cases}
    named = {row.case for row in folder.comparisons}
    told = [case for case in sorted(cases, key=lambda case: case.name) if case.name in named]
    template = _environment().get_template("page.html")
    return template.render(
        run=folder.run,
        head=overview(folder, found, shown),
        moving=moving(motions, about, found),
        themes=[(name, THEMES[name]) for name in THEMES if any(name in t for t in about.values())],
        absent={name: beside.absent(name) for name in BESIDE},
        advice=advice(folder.beside.get("advice.csv"), about),
        causes=beside.causes(folder.beside.get("causes.csv")),
        versions=beside.versions(folder.beside.get("versions.csv")),
        names=named,
        work=bool(folder.steps),
        engines=list(dict.fromkeys(one.engine for one in mapped)),
        groups=[(name, len(list(of))) for name, of in groupby(one.engine for one in mapped)],
        columns=mapped,
        kinds=sorted({cell.kind for cell in found.values()}),
        shades=_shades(),
        heat=[_line(case, mapped, found, about[case.name]) for case in told],
        stick_slip=stick_slip(told, motions),
        files=listed(told, shown, found, about),
        trust=trust(folder),
        mutants=mutants(folder.beside.get(MUTANTS)),
        style=_text(f"{name}.css" for name in STYLES),
        script=_text(f"{name}.js" for name in SCRIPTS),
        motions=embedded(motions),
        rows=embedded(
            rows(folder, shown) | {"work": work(folder.comparisons, folder.steps, about)}
        ),
    )


def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader(__package__ or "", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["breakable"] = _breakable
    environment.filters["tidy"] = lambda text: POWER.sub(r"\1", str(text))
    return environment


def _breakable(name: str) -> Markup:
    """Returns a case's name that may go on in another line behind its dots and underscores."""
    return Markup(re.sub(r"([._])", r"\1<wbr>", str(escape(name))))


def _text(names: Any) -> str:
    """Our own styles and scripts, which are no one's text."""
    folder = files(__package__ or "") / "templates"
    return "\n".join((folder / name).read_text(encoding="utf-8").rstrip() for name in names)


def embedded(value: Any) -> str:
    """Returns JSON packed by gzip, in 64 letters, none of which can close a script element.

    No time stands in it: the same value gives the same letters.
    """
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return b64encode(gzip.compress(text.encode(), compresslevel=9, mtime=0)).decode()


def _shades() -> list[str]:
    ends = [f"{bound:g}" for bound in SHADES]
    return [f"up to {ends[0]}", *(f"to {end}" for end in ends[1:]), f"above {ends[-1]}, or lost"]


def _line(
    case: Case, shown: Sequence[Column], found: Mapping[Any, Cell], about: Sequence[str]
) -> dict[str, Any]:
    return {
        "case": case.name,
        "title": case.title,
        "themes": " ".join(about),
        "cells": [(one, found.get((case.name, one))) for one in shown],
    }
