"""The head of the page: versions, and what share of the rows is within its tolerance."""

from collections.abc import Mapping, Sequence
from typing import Any

from ..row import AGREES, REFUSED
from .column import Column
from .folder import Folder
from .heat import Cell

Cells = Mapping[tuple[str, Column], Cell]


def overview(folder: Folder, cells: Cells, columns: Sequence[Column]) -> dict[str, Any]:
    """The numbers of the head. Rows that are refused are counted by themselves."""
    versions = {(row.engine, row.version) for row in folder.comparisons if row.engine != "book"}
    return {
        "cases": len({row.case for row in folder.comparisons}),
        "versions": sorted(versions),
        "shares": [_share(one, cells) for one in columns],
    }


def _share(column: Column, cells: Cells) -> dict[str, Any]:
    own = [cell for (_, other), cell in cells.items() if other == column]
    ran = [cell for cell in own if cell.kind != REFUSED]
    judged = sum(cell.judged for cell in ran)
    within = sum(cell.within for cell in ran)
    return {
        "title": column.title,
        "judged": judged,
        "within": within,
        "percent": 100 * within // judged if judged else 0,  # 100 is only what is all
        "cases": len(ran),
        "cases_within": sum(cell.kind == AGREES for cell in ran),
        "declared": sum(cell.kind == "declared" for cell in ran),
        "refused": len(own) - len(ran),
    }
