"""The page as one text: the same bytes from the same rows and motions."""

import gzip
import json
import re
from base64 import b64encode
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from itertools import groupby
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from ....cases.case import Case
from ....cases.theme import THEMES, themes
from ....reference.certificate.errors import ERROR
from ...compare.own_rows import Modelled
from ...runs.processes.temporary_folder import temporary_folder
from ...runs.selection import BOOK
from ...runs.suite import Report
from ...tables import run_list, write
from ...tables.ownership import unasked
from ...tables.replace import replace
from ...tables.row import FAILS, MUTANTS
from ...tables.spoken import WORDS, spoken
from . import beside
from .advice import advice
from .column import Column, columns
from .folder import BESIDE, Folder, folder, of_cases
from .heat import SHADES, Cell, cells
from .listed import listed
from .models import models_section
from .motions import Motion, motions
from .overview import moving, overview
from .rows import rows
from .work import work

SCRIPTS = ("read", "plot", "mechanism", "case", "section", "filter", "start")
POWER = re.compile(r"(?<=\de)(?:\+0*|(-)0+)(?=\d)")  # of ten: 2e-07 and 2e+03 are 2e-7 and 2e3
STYLES = ("style", "heat", "print")


def page(
    folder: Folder,
    cases: Sequence[Case],
    motions: Mapping[str, Motion],
    models: Sequence[Modelled] = (),
) -> str:
    """One HTML file. Text of a case or of a model is escaped wherever it stands."""
    every, results = columns(folder.comparisons), cells(folder.comparisons, folder.rungs)
    named = {row.case for row in folder.comparisons}
    scenes = of_cases(folder)
    shown, case_cells = columns(scenes.comparisons), cells(scenes.comparisons, scenes.rungs)
    mapped = [column for column in shown if column.engine != BOOK] or shown
    about = {case.name: themes(case) for case in cases}
    ran = [case for case in sorted(cases, key=lambda case: case.name) if case.name in named]
    template = _environment().get_template("page.html")
    return template.render(
        run=folder.run,
        head=overview(scenes, case_cells, shown),
        models=models_section(folder.models, models, every, results),
        releases=sorted({(r.engine, r.version) for r in folder.comparisons if r.engine != BOOK}),
        moving=moving(motions, about, results),
        themes=[(name, THEMES[name]) for name in THEMES if any(name in t for t in about.values())],
        absent={name: beside.absent(name) for name in BESIDE},
        advice=advice(folder.beside.get("advice.csv"), about),
        causes=beside.causes(folder.beside.get("causes.csv")),
        versions=beside.versions(folder.beside.get("versions.csv")),
        names=named,
        work=bool(scenes.steps),
        engines=list(dict.fromkeys(column.engine for column in mapped)),
        groups=[(name, len(list(of))) for name, of in groupby(column.engine for column in mapped)],
        columns=mapped,
        kinds=sorted({cell.kind for cell in case_cells.values()}),
        shades=_shades(),
        heat=[_line(case, mapped, case_cells, about[case.name]) for case in ran],
        stick_slip=stick_slip(ran, motions),
        files=listed(ran, shown, case_cells, about),
        trust=trust(scenes),
        style=_text(f"{name}.css" for name in STYLES),
        script=_text(f"{name}.js" for name in SCRIPTS),
        motions=embedded(motions),
        rows=embedded(
            rows(folder, every)
            | {"work": work(scenes.comparisons, scenes.steps, about), "spoken": WORDS}
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
    environment.filters["spoken"] = spoken
    environment.filters["anchor"] = _anchor
    environment.filters["urlencode"] = lambda name: quote(_anchor(name), safe="")
    environment.filters["tidy"] = lambda text: POWER.sub(r"\1", str(text))
    return environment


def _anchor(name: str) -> str:
    """Returns the id of a case's section, which no other part of the page has."""
    return f"case {name}" if name in _own_ids() else name


@cache
def _own_ids() -> frozenset[str]:
    """Returns the ids of the page's own parts."""
    templates = (files(__package__ or "") / "templates").iterdir()
    texts = [file.read_text(encoding="utf-8") for file in templates if file.name.endswith(".html")]
    return frozenset(re.findall(r' id="([\w-]+)"', "".join(texts)))


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
    case: Case, shown: Sequence[Column], cells: Mapping[Any, Cell], about: Sequence[str]
) -> dict[str, Any]:
    return {
        "case": case.name,
        "title": case.title,
        "themes": " ".join(about),
        "cells": [(column, cells.get((case.name, column))) for column in shown],
    }


# The chapter's pictures of dry friction, of the cases that are its Examples 2.3 and 2.4.


APPROXIMATED = (
    ("growing_force", "block.vx", "tube", "Figures 2.29, 2.30: the speed under a growing force."),
    ("growing_force", "block.vx", "error", "By how much each law and engine is off that."),
    ("dynamometer", "block.vx", "tube", "Figures 2.31, 2.32: the speed behind a moving spring."),
    ("dynamometer", "block.vx", "error", "By how much each law and engine is off that."),
    ("dynamometer", "block.x", "tube", "Its place: a staircase."),
    ("dynamometer", "scale.force", "tube", "Figures 2.23, 2.24: what the dynamometer shows."),
)
"""The book's Examples 2.3 and 2.4: system, quantity, plot, and what it shows."""


def stick_slip(cases: Sequence[Case], motions: Mapping[str, Motion]) -> list[dict[str, str]]:
    """Returns the stick-slip pictures that are drawn, each with its words."""
    by_system = {case.system: case.name for case in cases if case.system and case.name in motions}
    return [
        {"case": by_system[system], "quantity": quantity, "plot": plot, "caption": caption}
        for system, quantity, plot, caption in APPROXIMATED
        if system in by_system and quantity in motions[by_system[system]]["curves"]["quantities"]
    ]


# The results of the references' own checks, and how much of the chapter is executed.


def trust(folder: Folder) -> dict[str, int]:
    """Returns how many checks there are and fail, how many items of the chapter are executed."""
    # What is known of one quantity stands in its case.
    checks = [row for row in folder.certificates if not row.check.startswith(ERROR)]
    return {
        "checks": len(checks),
        "failing": sum(row.verdict == FAILS for row in checks),
        "items": len(folder.coverage),
        "covered": int(folder.coverage["cases"].astype(bool).sum()),
        "mutants": len(folder.beside.get(MUTANTS, ())),
    }


# Where the page is written: beside its reports, all files of a run together.


NAME = "index.html"


def write_committed(
    report: Report, cases: Sequence[Case], rows: Path, out: Path, *, overwrite: bool = False
) -> None:
    """The page of reports that are there, and of the motions behind them.

    overwrite: also what is no page of ours. Raises Missing where there are none, and OSError: then
    the folder holds what it held.
    """
    unasked(out, [NAME], overwrite=overwrite)
    replace(out, {NAME: page(folder(rows), cases, motions(report), report.models)})


def write_measured(report: Report, out: Path, *, overwrite: bool = False) -> None:
    """The reports of a run and their page. Raises OSError: then the folder holds what it held."""
    frames = write.tables(report, report.cases)
    unasked(out, [*frames, run_list.NAME, NAME], overwrite=overwrite)
    with temporary_folder("textmech-page-") as made:
        write.write(frames, made)
        contents = folder(made, beside=out)
    made_of = page(contents, report.cases, motions(report), report.models)
    replace(out, lambda: write.texts(frames, out) | {NAME: made_of})
