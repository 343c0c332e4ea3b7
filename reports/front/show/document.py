"""Prints what a command says as one JSON document, for scripts."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ....cases.find import models, questions
from ....cases.mistake import Mistake
from .console import say
from .summary import Cures, approximations, summary

if TYPE_CHECKING:
    from ....cases.titled import Titled
    from ...runs.suite import Report
    from ...tables.row import Cause

Document = Mapping[str, Any]


def write(document: Document) -> None:
    """Prints a document; a number that is not finite, which JSON lacks, is null."""
    say(json.dumps(_finite(document), indent=2, allow_nan=False))


def of_run(
    report: "Report",
    wrong: Sequence[Mistake],
    *,
    cures: Cures,
    written: Path | None,
    exit_code: int,
) -> Document:
    """Returns the document of `textmech run`: its rows as they are, with all their digits."""
    lines = (*summary(report.comparisons, report.rungs, cures),)
    book = approximations(report.comparisons, report.rungs)
    return {
        "summary": [asdict(line) for line in (*lines, *book)],
        "tolerance": [asdict(row) for row in report.comparisons],
        "convergence": [asdict(row) for row in report.rungs],
        "steps": [asdict(row) for row in report.steps],
        "events": [asdict(row) for row in report.instants],
        "reference": [asdict(row) for row in report.certificates],
        "causes": [asdict(row) for row in report.causes],
        "models": [asdict(line) for line in report.lines],
        "warnings": [{"case": case, "what": what} for case, what in report.warnings()],
        "mistakes": mistakes(wrong),
        "written": None if written is None else str(written),
        "exit_code": exit_code,
    }


def of_causes(causes: "Sequence[Cause]", wrong: Sequence[Mistake], *, exit_code: int) -> Document:
    """Returns the document of `textmech causes`."""
    rows = [asdict(cause) for cause in causes]
    return {"causes": rows, "mistakes": mistakes(wrong), "exit_code": exit_code}


def of_cases(cases: "Sequence[Titled]") -> Document:
    """Returns the document of `textmech list`."""
    groups = dict.fromkeys(questions(), "questions") | dict.fromkeys(models(), "models")
    return {
        "cases": [
            {
                "name": case.name,
                "group": groups.get(case.name.partition(".")[0], "textbook"),
                "title": case.title,
                "source": str(case.origin),
                "thread": case.origin.thread,
                "file": case.file,
            }
            for case in cases
        ]
    }


def mistakes(wrong: Sequence[Mistake]) -> list[dict[str, Any]]:
    """Returns each mistake with its place; line and column from 1, and 0 is the whole file."""
    return [
        {"file": m.file, "line": m.line, "column": m.column, "field": m.where, "what": m.what}
        for m in wrong
    ]


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _finite(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
