"""The page as one text: the same bytes from the same rows and motions."""

import json
import re
from collections.abc import Mapping, Sequence
from importlib.resources import files
from itertools import groupby
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from ...cases.case import Case
from . import beside
from .column import Column, columns
from .equations import equations
from .folder import BESIDE, Folder
from .heat import SHADES, Cell, cells
from .motions import Motion
from .overview import overview
from .rows import rows
from .theme import THEMES, themes
from .trust import trust
from .work import work

SCRIPTS = ("read", "plot", "mechanism", "case", "section", "filter", "start")
STYLES = ("style", "heat", "print")
MOTIONS = re.compile(r'<script type="application/json" id="motions">(.*?)</script>', re.DOTALL)
APPROXIMATED = (
    ("growing_force", "block.vx", "tube", "Figures 2.29, 2.30: the speed under a growing force."),
    ("growing_force", "block.vx", "error", "By how much each law and engine is off that."),
    ("dynamometer", "block.vx", "tube", "Figures 2.31, 2.32: the speed behind a moving spring."),
    ("dynamometer", "block.vx", "error", "By how much each law and engine is off that."),
    ("dynamometer", "block.x", "tube", "Its place: a staircase."),
    ("dynamometer", "scale.force", "tube", "Figures 2.23, 2.24: what the dynamometer shows."),
)
"""The book's Examples 2.3 and 2.4: system, quantity, plot, and what it shows."""


def page(folder: Folder, cases: Sequence[Case], motions: Mapping[str, Motion]) -> str:
    """One HTML file. Text of a case is escaped wherever it stands."""
    shown = columns(folder.comparisons)
    found = cells(folder.comparisons, folder.rungs)
    about = {case.name: themes(case) for case in cases}
    engines = list(dict.fromkeys(one.engine for one in shown))
    named = {row.case for row in folder.comparisons}
    told = [case for case in sorted(cases, key=lambda case: case.name) if case.name in named]
    template = _environment().get_template("page.html")
    return template.render(
        run=folder.run,
        head=overview(folder, found, shown),
        themes=[(name, THEMES[name]) for name in THEMES if any(name in t for t in about.values())],
        absent={name: beside.absent(name) for name in BESIDE},
        advice=beside.advice(folder.beside.get("advice.csv"), about),
        causes=beside.causes(folder.beside.get("causes.csv")),
        versions=beside.versions(folder.beside.get("versions.csv")),
        names=named,
        work=work(folder.comparisons, folder.rungs, about),
        engines=engines,
        groups=[(name, len(list(of))) for name, of in groupby(one.engine for one in shown)],
        columns=shown,
        kinds=sorted({cell.kind for cell in found.values()}),
        shades=_shades(),
        heat=[_line(case, shown, found, about[case.name]) for case in told],
        stick_slip=_stick_slip(told, motions),
        files=_files(told, shown, found, about),
        trust=trust(folder),
        style=_text(f"{name}.css" for name in STYLES),
        script=_text(f"{name}.js" for name in SCRIPTS),
        motions=embedded(motions),
        rows=embedded(rows(folder, shown)),
    )


def motions_of(text: str) -> dict[str, Motion]:
    """Of a page that was made: what it was made of beside the rows."""
    found = MOTIONS.search(text)
    return json.loads(found[1]) if found else {}


def _environment() -> Environment:
    return Environment(
        loader=PackageLoader(__package__ or "", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )


def _text(names: Any) -> str:
    """Our own styles and scripts, which are no one's text."""
    folder = files(__package__ or "") / "templates"
    return "\n".join((folder / name).read_text(encoding="utf-8").rstrip() for name in names)


def embedded(value: Any) -> str:
    """As it may stand within a script element: no letter there can close it."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


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


def _files(
    cases: Sequence[Case],
    shown: Sequence[Column],
    found: Mapping[Any, Cell],
    about: Mapping[str, tuple[str, ...]],
) -> list[dict[str, Any]]:
    """The cases of each file together: they share title and equations."""
    out = []
    for name, group in groupby(cases, key=lambda case: case.name.partition(".")[0]):
        variants = list(group)
        first = variants[0]
        out.append(
            {
                "name": name,
                "title": first.title,
                "source": str(first.origin),
                "system": first.system,
                "themes": [t for t in THEMES if any(t in about[case.name] for case in variants)],
                "equations": equations(first),
                "cases": [
                    {
                        "name": case.name,
                        "variant": case.name.partition(".")[2] or case.name,
                        "cells": [
                            (one, cell)
                            for one in shown
                            if (cell := found.get((case.name, one))) and cell.kind != "refused"
                        ],
                    }
                    for case in variants
                ],
            }
        )
    return out


def _stick_slip(cases: Sequence[Case], motions: Mapping[str, Motion]) -> list[dict[str, str]]:
    by_system = {case.system: case.name for case in cases if case.system and case.name in motions}
    return [
        {"case": by_system[system], "quantity": quantity, "plot": plot, "caption": caption}
        for system, quantity, plot, caption in APPROXIMATED
        if system in by_system and quantity in motions[by_system[system]]["curves"]["quantities"]
    ]
