"""The users' models on the page: the table with a row a model, and what is said of each."""

from collections.abc import Mapping, Sequence
from itertools import groupby, takewhile
from typing import Any

from ...compare import own_equations
from ...compare.own_rows import Modelled
from ...tables.model_line import ModelLine
from ...tables.row import AGREES
from ..show.model import cells as words_of
from ..show.model import model_lines
from .column import Column
from .heat import Cell
from .listed import chips


def models_section(
    lines: Sequence[ModelLine],
    models: Sequence[Modelled],
    shown: Sequence[Column],
    cells: Mapping[Any, Cell],
) -> dict[str, Any] | None:
    """Returns the table of the models, and each of them by its file; None where there is none."""
    if not lines:
        return None
    names = [line.case for line in lines]
    chosen = [model for model in models if model.case.name in names]
    return {
        "result": result(lines),
        "lines": [(line.case, words_of(line)[1:]) for line in lines],
        "sections": {model.case.name for model in chosen},
        "cured": any(line.cure for line in lines),
        "files": [
            {"title": of[0].case.title, "models": [_model(model, shown, cells) for model in of]}
            for _, group in groupby(chosen, key=lambda model: model.case.file)
            for of in [list(group)]
        ],
    }


def _model(model: Modelled, shown: Sequence[Column], cells: Mapping[Any, Cell]) -> dict[str, Any]:
    name = model.case.name
    head, *said = (words.strip() for words in takewhile(bool, model_lines(model)))
    return {
        "name": name,
        "cells": chips(name, shown, cells),
        "said": [head.removeprefix(f"{name}: "), *said] if model.model else said,
        "equations": [words.strip() for words in own_equations.lines(model.parts)],
    }


def result(lines: Sequence[ModelLine]) -> str:
    """Says in a sentence how models fare at their own settings; of one what a person sees."""
    if len(lines) > 1:
        kept = sum(line.verdict == AGREES for line in lines)
        return f"Each at its own setting, all is kept by {kept} of {len(lines)} models."
    (line,) = lines
    name, own, keeps, *_ = words_of(line)
    if not line.verdict or line.because:
        return f"{name}: {line.because or 'nothing is compared'}."
    seen = line.seen or f"{own} of what is allowed at its own setting"
    return f"{name}: {seen}; {f'all is kept from {keeps} on' if line.keeps_step else keeps}."
