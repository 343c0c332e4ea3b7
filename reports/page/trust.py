"""What the references' own checks found, and how much of the chapter is executed."""

from collections.abc import Mapping
from typing import Any

from ...reference.certificate.errors import ERROR
from ..row import FAILS, Certificate
from .folder import Folder

NAMED = 8  # cases of an item by name; of more the number tells it


def trust(folder: Folder) -> dict[str, Any]:
    """The checks by their kind, and the items of the chapter."""
    items = [_item(row) for row in folder.coverage.to_dict("records")]
    kinds: dict[str, list[Certificate]] = {}
    for check in folder.certificates:
        if not check.check.startswith(ERROR):  # what is known of one quantity stands in its case
            kinds.setdefault(check.check, []).append(check)
    return {
        "checks": sum(map(len, kinds.values())),
        "failing": sum(row.verdict == FAILS for rows in kinds.values() for row in rows),
        "kinds": [_kind(name, rows) for name, rows in sorted(kinds.items())],
        "chapter": items,
        "covered": sum(bool(item["cases"]) for item in items),
    }


def _kind(name: str, rows: list[Certificate]) -> dict[str, Any]:
    def part(row: Certificate) -> float:
        return row.difference / row.bound if row.bound else row.difference

    worst = max(rows, key=part)
    return {"check": name, "cases": len(rows), "part": f"{part(worst):.2g}", "worst": worst.case}


def _item(row: Mapping[Any, Any]) -> dict[str, Any]:
    names = str(row["cases"]).split()
    told = ", ".join(names[:NAMED])
    more = len(names) - NAMED
    return {**row, "cases": f"{told} and {more} more" if more > 0 else told}
