"""The difference as one JSON document."""

import json
from dataclasses import asdict
from math import isfinite
from typing import Any

from .change import KINDS, Change, Seen
from .compare import Difference
from .folder import Folder


def as_json(found: Difference) -> str:
    """Returns the whole difference as JSON text; a number that JSON has not (inf, NaN) is null."""
    document = {
        "old": _folder(found.old),
        "new": _folder(found.new),
        "rule": asdict(found.rule),
        "regressed": found.regressed,
        "counts": {kind: len(found.of(kind)) for kind in KINDS},
        "rows": {
            name: {
                "compared": count.compared,
                "not looked at": [count.old, count.new],
                "not searched by both": list(count.searched),
            }
            for name, count in found.counts.items()
        },
        "files of one folder": list(found.alone),
        "changes": [_change(change) for change in found.changes],
        "mistakes": [],
        "exit_code": int(found.regressed),
    }
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)


def _folder(folder: Folder) -> dict[str, Any]:
    return {"folder": folder.name, "run": folder.run, "versions": folder.versions}


def _change(change: Change) -> dict[str, Any]:
    return {
        "kind": change.kind,
        "file": change.file,
        **asdict(change.place),
        "old": _seen(change.was),
        "new": _seen(change.now),
        "number is": change.label,
        "unit": change.unit,
        "allowed": _number(change.allowed),
        "times": _number(change.times),
        "note": change.note,
    }


def _seen(seen: Seen | None) -> dict[str, Any] | None:
    return None if seen is None else {"words": seen.words, "number": _number(seen.number)}


def _number(number: float | None) -> float | None:
    return None if number is None or not isfinite(number) else number
