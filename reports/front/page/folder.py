"""A folder of reports, read: the rows of a run, and what other commands add to them."""

from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path
from typing import Any

import pandas as pd

from ...tables import run_list
from ...tables.file_content import text as content
from ...tables.model_line import ModelLine
from ...tables.row import MUTANTS, Certificate, Comparison, Instant, Rungs, StepError
from ...tables.write import NAMES, read

BESIDE = {
    "advice.csv": "textmech advise",
    "causes.csv": "textmech causes",
    "versions.csv": "textmech versions",
}
"""What may stand beside the reports, and which command writes it."""


class Missing(Exception):
    """A folder without the reports of a run, in words."""


@dataclass(frozen=True)
class Folder:
    """The rows of a run, and the tables that may be there as text, by file name."""

    comparisons: list[Comparison]
    rungs: list[Rungs]
    steps: list[StepError]
    instants: list[Instant]
    certificates: list[Certificate]
    models: list[ModelLine]
    coverage: pd.DataFrame
    beside: dict[str, pd.DataFrame]
    run: str  # the run's name


def folder(path: Path, beside: Path | None = None) -> Folder:
    """Reads a folder; what other commands add may lie in another one too, `beside`.

    Raises Missing where there are no reports, ValueError where a file is cut or of another run.
    """
    lacking = [name for name in NAMES if not (path / name).is_file()]
    if lacking:
        raise Missing(
            f"{path} has no {', '.join(lacking)}: `textmech run --out {path}` writes them"
        )
    places = [place for place in (beside, path) if place]  # of two, the run's own is shown
    return Folder(
        comparisons=read(path / "tolerance.csv", Comparison),
        rungs=read(path / "convergence.csv", Rungs),
        steps=read(path / "steps.csv", StepError),
        instants=read(path / "events.csv", Instant),
        certificates=read(path / "reference.csv", Certificate),
        models=read(path / "models.csv", ModelLine),
        coverage=_text(path / "coverage.csv"),
        beside={
            name: _text(place / name)
            for place in places
            for name in (*BESIDE, MUTANTS)
            if (place / name).is_file()
        },
        run=run_list.read(path)[NAMES[0]].run,
    )


def of_cases(folder: Folder) -> Folder:
    """Returns a folder without the rows of models."""
    models = {row.case for row in folder.models}

    def kept(rows: list[Any]) -> list[Any]:
        return [row for row in rows if row.case not in models]

    return replace(
        folder,
        comparisons=kept(folder.comparisons),
        rungs=kept(folder.rungs),
        steps=kept(folder.steps),
        certificates=kept(folder.certificates),
        models=[],
    )


def _text(path: Path) -> pd.DataFrame:
    """A table as it is written: no number is read, so that none is written otherwise."""
    return pd.read_csv(StringIO(content(path)), dtype=str, keep_default_na=False)
