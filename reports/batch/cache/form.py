"""Solutions and outcomes as bytes: arrays and JSON, never a pickle, which could be anything."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from math import prod
from typing import Any

import numpy as np

from ....cases.trajectory import Trajectory
from ....reference.certificate.agreement import Check
from ....reference.solve import Solution
from ...compare.judge.compare import Outcome
from ...data.row import Comparison, Instant, Rungs, StepError

KINDS = {
    kind.__name__: kind
    for kind in (Solution, Trajectory, Check, Outcome, Comparison, Rungs, StepError, Instant)
}
SIZE = 8  # bytes, in which the length of the JSON is told
NUMBERS = "biuf"  # numpy's kinds: booleans, integers, floats


def packed(value: Any) -> bytes:
    """The value's bytes: JSON, then the arrays as they lie. Raises TypeError for what has no form.

    numpy's own archive takes four times as long to read, and a run that computes nothing reads.
    """
    arrays: list[np.ndarray] = []
    tree = _plain(value, arrays)
    head = json.dumps([tree, [[a.dtype.str, *a.shape] for a in arrays]]).encode()
    return b"".join([len(head).to_bytes(SIZE), head, *(a.tobytes() for a in arrays)])


def unpacked(data: bytes) -> Any:
    """The value that was packed; every float is the same to the last bit. Raises ValueError."""
    end = SIZE + int.from_bytes(data[:SIZE])
    tree, told = json.loads(data[SIZE:end])
    arrays: list[np.ndarray] = []
    for kind, *shape in told:
        count = prod(shape)
        found = np.frombuffer(data, kind, count, end) if count else np.empty(0, kind)
        arrays.append(found.reshape(shape).copy())
        end += found.nbytes
    return _whole(tree, arrays)


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
        case np.ndarray() if value.dtype.kind in NUMBERS:
            arrays.append(value)
            return {"array": len(arrays) - 1}
        case _ if is_dataclass(value) and type(value).__name__ in KINDS:
            of = {f.name: _plain(getattr(value, f.name), arrays) for f in fields(value)}
            return {type(value).__name__: of}
    raise TypeError(f"{type(value).__name__} has no form in the cache")


def _whole(tree: Any, arrays: Sequence[np.ndarray]) -> Any:
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
            return arrays[held]
    return KINDS[word](**{name: _whole(t, arrays) for name, t in held.items()})
