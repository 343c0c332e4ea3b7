"""The list of cases, file by file: what the variants of one share is told once."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

from ...cases.case import Case
from ...cases.theme import THEMES
from ..row import REFUSED
from .column import Column
from .equations import equations
from .heat import Cell


def listed(
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
                            if (cell := found.get((case.name, one))) and cell.kind != REFUSED
                        ],
                    }
                    for case in variants
                ],
            }
        )
    return out
