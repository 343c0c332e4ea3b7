"""Makes the data of each variant of a case file: the file's own, overlaid by the changed keys.

A file without variants has one, whose name is empty. Only the data are merged here; whether they
are a sound case is asked later, of each variant by itself.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ...fields.number import shown
from ...mistake import Mistake, Path, Source, nearest
from ..grammar.file import OVERLAID
from .document import Document


def overlay(document: Document) -> tuple[dict[str, tuple[dict[str, Any], Source]], list[Mistake]]:
    """Returns the variants, and what is wrong with the way in which they are written.

    The variants are by name ("" where the file has none): the merged data, and the source that
    says where in the file each of their keys is written.
    """
    base = {key: value for key, value in document.data.items() if key != "variants"}
    given = document.data.get("variants", {})
    source = document.source
    if not isinstance(given, dict):
        what = f"should be a map of names, is {shown(given)}"
        # A key without a value is among the mistakes of the document already.
        return {"": (base, source)}, [] if given is None else [source.mistake(("variants",), what)]
    if not given:
        return {"": (base, source)}, []
    variants: dict[str, tuple[dict[str, Any], Source]] = {}
    mistakes: list[Mistake] = []
    for name, changes in given.items():
        path: Path = ("variants", name)
        wrong = [source.mistake((*path, *where), what) for where, what in _mistakes(name, changes)]
        if wrong:
            mistakes += wrong
        elif changes is not None:
            variants[name] = (_merged(base, changes), _places(source, path))
    # Where no variant is sound the rest is still looked at, so that all mistakes are said at once.
    return variants or {"": (base, source)}, mistakes


def _mistakes(name: str, changes: object) -> Iterator[tuple[Path, str]]:
    """Yields what is wrong with a variant's form: the place below its name, and the words."""
    if not name.isidentifier():
        yield (), f"{name!r} is not a name: letters, digits and _, not starting with a digit"
    if changes is None:
        return  # a key without a value is among the mistakes of the document already
    if not isinstance(changes, dict):
        yield (), f"should be a map of keys, is {shown(changes)}"
        return
    for key in changes:
        if key not in OVERLAID:
            yield (key,), f"unknown key {key!r} in a variant{nearest(key, OVERLAID)}"


def _merged(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Returns the base with the changes: map into map, key by key; anything else is replaced."""
    merged = dict(base)
    for key, value in changes.items():
        old = base.get(key)
        both = isinstance(old, dict) and isinstance(value, dict)
        merged[key] = _merged(old, value) if both else value  # type: ignore[arg-type]
    return merged


def _places(source: Source, path: Path) -> Source:
    """Returns the source with the places of the merged data: a changed key's is in its variant."""
    depth = len(path)
    changed = {p[depth:]: at for p, at in source.places.items() if p[:depth] == path}
    return replace(source, places={**source.places, **changed})
