"""A case file → its cases, one for each variant, or all of its mistakes at once."""

import functools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from .case import Case
from .fields.number import shown
from .find import case_name, check_name
from .language.check.check import check
from .language.check.engines import Engines
from .language.check.work import too_many_variants, work
from .language.document import Document, read
from .language.grammar.file import OVERLAID
from .language.parse import parse
from .language.resolve import resolve_case, resolve_scene
from .mistake import NO_VALUE, CaseError, Mistake, Path, Source, nearest

Systems = Mapping[str, tuple[str, ...]]


def load(
    path: FilePath,
    *,
    systems: Systems | None = None,
    engines: Engines | None = None,
    long: bool = False,
) -> list[Case]:
    """The cases of a file.

    systems: the parameters of each known hand-written system. engines: the settings of each known
    engine. Of what is None no name is checked. long: whether any amount of work is allowed.

    Raises CaseError with every mistake of the file.
    """
    return load_document(read(path), path, systems=systems, engines=engines, long=long)


def load_document(
    document: Document,
    path: FilePath,
    *,
    systems: Systems | None = None,
    engines: Engines | None = None,
    long: bool = False,
) -> list[Case]:
    """The cases of a document, as of a file at this path. Raises CaseError with every mistake."""
    if not long and (what := too_many_variants(document.data)):  # before any is even looked at
        raise CaseError([*document.mistakes, document.source.mistake(("variants",), what)])
    variants, mistakes = overlay(document)
    mistakes = [*check_name(path), *document.mistakes, *mistakes, *_check_base(document, variants)]
    by_variant: dict[str, list[Mistake]] = {}
    cases: list[Case] = []
    for variant, (data, source) in variants.items():
        parsed = parse(data)
        scene = resolve_scene(parsed.file)
        checked = check(parsed, scene, data=document.data, systems=systems, known=engines)
        findings = [*parsed.findings, *checked, *(() if long else work(parsed.file, scene))]
        by_variant[variant] = [
            source.mistake(where, what)
            for where, what in findings
            if what != NO_VALUE  # the document has said so
        ]
        cases.append(resolve_case(case_name(path, variant), parsed.file, scene, source, long=long))
    mistakes += merge_mistakes(by_variant)
    if mistakes:
        raise CaseError(mistakes)
    return cases


def merge_mistakes(by_variant: Mapping[str, list[Mistake]]) -> list[Mistake]:
    """Merge the mistakes of all variants: shared ones once, others with their variant's name."""
    shared = set.intersection(*(set(mistakes) for mistakes in by_variant.values()))
    return [
        m if m in shared else replace(m, what=f"{m.what} (variant {variant!r})")
        for variant, mistakes in by_variant.items()
        for m in mistakes
    ]


# Makes the data of each variant of a case file: the file's own, overlaid by the changed keys.
#
# A file without variants has one, whose name is empty. Only the data are merged here; whether
# they are a sound case is asked later, of each variant by itself.


def overlay(
    document: Document, keys: Sequence[str] = OVERLAID
) -> tuple[dict[str, tuple[dict[str, Any], Source]], list[Mistake]]:
    """Returns the variants, and the mistakes in how they are written.

    The variants are by name ("" where the file has none): the merged data, and the source that
    says where in the file each of their keys is written. keys: which a variant may change.
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
        wrong = [
            source.mistake((*path, *where), what) for where, what in _mistakes(name, changes, keys)
        ]
        if wrong:
            mistakes += wrong
        elif changes is not None:
            variants[name] = (_merged(base, changes), _places(source, path))
    # Where no variant is sound the rest is still looked at, so that all mistakes are said at once.
    return variants or {"": (base, source)}, mistakes


def _mistakes(name: str, changes: object, keys: Sequence[str]) -> Iterator[tuple[Path, str]]:
    """Yields what is wrong with a variant's form: the place below its name, and the words."""
    if not name.isidentifier():
        yield (), f"{name!r} is not a name: letters, digits and _, not starting with a digit"
    if changes is None:
        return  # a key without a value is among the mistakes of the document already
    if not isinstance(changes, dict):
        yield (), f"should be a map of keys, is {shown(changes)}"
        return
    for key in changes:
        if key not in keys:
            yield (key,), f"unknown key {key!r} in a variant{nearest(key, keys)}"


def _merged(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Returns the base with the changes: map into map, key by key; anything else is replaced."""
    merged = dict(base)
    for key, value in changes.items():
        old = base.get(key)
        both = isinstance(old, dict) and isinstance(value, dict)
        merged[key] = _merged(old, value) if both else value  # type: ignore[arg-type]
    return merged


def _check_base(
    document: Document, variants: Mapping[str, tuple[dict[str, Any], Source]]
) -> Iterator[Mistake]:
    """Mistakes of form in those parts of the base that every variant replaces.

    Read with the first variant around them: units, names and `space` may be its own.
    """
    first, *others = (data for data, _ in variants.values())
    replaced = {
        path: value
        for path, value in _leaves({k: v for k, v in document.data.items() if k != "variants"})
        if all(_value_at(data, path) is not value for data in (first, *others))
    }
    whole = first
    for path, value in replaced.items():
        whole = _merged(whole, functools.reduce(lambda x, key: {key: x}, reversed(path), value))
    for where, what in parse(whole).findings if replaced else ():
        if what != NO_VALUE and any(where[: len(path)] == path for path in replaced):
            yield document.source.mistake(where, f"{what} (the base's; each variant replaces it)")


def _leaves(data: Mapping[str, Any], path: Path = ()) -> Iterator[tuple[Path, Any]]:
    for key, value in data.items():
        inner = isinstance(value, dict)
        yield from _leaves(value, (*path, key)) if inner else [((*path, key), value)]


def _value_at(data: Any, path: Path) -> Any:
    for key in path:
        data = data.get(key) if isinstance(data, dict) else None
    return data


def _places(source: Source, path: Path) -> Source:
    """Returns the source with the places of the merged data: a changed key's is in its variant."""
    depth = len(path)
    changed = {p[depth:]: at for p, at in source.places.items() if p[:depth] == path}
    return replace(source, places={**source.places, **changed})
