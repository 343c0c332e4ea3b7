"""What cures a row, from the report of causes, where there is one."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from ...cases.case import Case
from ...cases.find import shipped
from ..write import HERE
from .summary import Cures

NAME = "causes.csv"
KEY = ("case", "engine", "setting", "quantity")


def committed(cases: Sequence[Case]) -> Cures:
    """Of those of the cases that are shipped ones, from the committed report."""
    files = {path.resolve() for path in shipped().values()}
    ours = {case.name for case in cases if Path(case.source.file).resolve() in files}
    return {key: cure for key, cure in cures(HERE).items() if key[0] in ours}


def cures(folder: Path) -> Cures:
    """By case, engine, setting and quantity, in words; several cures are joined by "or"."""
    file = folder / NAME
    if not file.is_file():
        return {}
    rows = pd.read_csv(file, dtype=str, keep_default_na=False, comment="#")
    found: dict[tuple[str, str, str, str], str] = {}
    for *key, cure in rows[[*KEY, "cure"]].itertuples(index=False):
        name = (key[0], key[1], key[2], key[3])
        before = found.get(name)
        found[name] = f"{before} or {cure}" if before and cure not in before else cure
    return found
