"""What the project's own tests break on purpose, and which test sees it."""

from itertools import groupby
from typing import Any

import pandas as pd

from .beside import records

COLUMNS = ("room", "planted", "seen_by")


def mutants(frame: pd.DataFrame | None) -> dict[str, Any] | None:
    """The mistakes of each room, by the test that sees them. None where there is no list."""
    if frame is None:
        return None
    rows = sorted(records(frame, COLUMNS), key=lambda row: (row["room"], row["seen_by"]))
    rooms = [_room(room, list(of)) for room, of in groupby(rows, lambda row: row["room"])]
    return {
        "count": len(rows),
        "tests": sum(len(room["tests"]) for room in rooms),
        "rooms": rooms,
    }


def _room(name: str, rows: list[dict[str, str]]) -> dict[str, Any]:
    tests = [
        {"seen_by": seen_by, "planted": [row["planted"] for row in of]}
        for seen_by, of in groupby(rows, lambda row: row["seen_by"])
    ]
    return {"room": name, "count": len(rows), "tests": tests}
