"""Solutions and outcomes as bytes: arrays and JSON, never a pickle, which could be anything."""

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from io import BytesIO
from typing import Any

import numpy as np

from ...cases.trajectory import Trajectory
from ...reference.certificate.agreement import Check
from ...reference.solve import Solution
from ..judge.compare import Outcome
from ..row import Comparison, Instant, Rungs

KINDS = {
    kind.__name__: kind
    for kind in (Solution, Trajectory, Check, Outcome, Comparison, Rungs, Instant)
}
NAME = "arr_{}"  # numpy's, of the arrays in their order; the first holds the JSON


def packed(value: Any) -> bytes:
    """The value's bytes. Raises TypeError for what has no form here."""
    arrays: list[np.ndarray] = []
    tree = json.dumps(_plain(value, arrays))
    out = BytesIO()
    np.savez(out, np.frombuffer(tree.encode(), np.uint8), *arrays)
    return out.getvalue()


def unpacked(data: bytes) -> Any:
    """What was packed; every float is the same to the last bit."""
    with np.load(BytesIO(data), allow_pickle=False) as arrays:
        return _whole(json.loads(arrays[NAME.format(0)].tobytes()), arrays)


def _plain(value: Any, arrays: list[np.ndarray]) -> Any:
    """As JSON: lists and scalars as they are, all else a map from one word to what it holds."""

    def plain(values: Any) -> list[Any]:
        return [_plain(v, arrays) for v in values]

    match value:
        case None | bool() | int() | float() | str():
            return value
        case list():
            return plain(value)
        case tuple():
            return {"tuple": plain(value)}
        case frozenset():
            return {"set": plain(sorted(value))}
        case Mapping():
            return {"map": [plain(item) for item in value.items()]}
        case np.ndarray() if value.dtype != object:
            arrays.append(value)
            return {"array": len(arrays)}
        case _ if is_dataclass(value) and type(value).__name__ in KINDS:
            of = {f.name: _plain(getattr(value, f.name), arrays) for f in fields(value)}
            return {type(value).__name__: of}
    raise TypeError(f"{type(value).__name__} has no form in the cache")


def _whole(tree: Any, arrays: Mapping[str, Any]) -> Any:
    if isinstance(tree, list):
        return [_whole(t, arrays) for t in tree]
    if not isinstance(tree, dict):
        return tree
    ((word, held),) = tree.items()
    match word:
        case "tuple":
            return tuple(_whole(t, arrays) for t in held)
        case "set":
            return frozenset(_whole(t, arrays) for t in held)
        case "map":
            return {_whole(k, arrays): _whole(v, arrays) for k, v in held}
        case "array":
            return arrays[NAME.format(held)]
    return KINDS[word](**{name: _whole(t, arrays) for name, t in held.items()})
