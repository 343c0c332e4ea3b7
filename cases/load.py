"""A case file → its cases, one for each variant, or all of its mistakes at once."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path as FilePath

from .case import Case
from .find import case_name, misnamed
from .language.check.check import check
from .language.check.engines import Engines
from .language.check.work import too_many_variants, work
from .language.parse import parse
from .language.read.document import read
from .language.read.overlay import overlay
from .language.resolve import resolve_case, resolve_scene
from .mistake import NO_VALUE, CaseError, Mistake

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
    document = read(path)
    if not long and (what := too_many_variants(document.data)):  # before any is even looked at
        raise CaseError([*document.mistakes, document.source.mistake(("variants",), what)])
    variants, mistakes = overlay(document)
    mistakes = [*misnamed(path), *document.mistakes, *mistakes]
    found: dict[str, list[Mistake]] = {}
    cases: list[Case] = []
    for variant, (data, source) in variants.items():
        parsed = parse(data)
        scene = resolve_scene(parsed.file)
        checked = check(parsed, scene, data=document.data, systems=systems, known=engines)
        findings = [*parsed.findings, *checked, *(() if long else work(parsed.file, scene))]
        found[variant] = [
            source.mistake(where, what)
            for where, what in findings
            if what != NO_VALUE  # the document has said so
        ]
        cases.append(resolve_case(case_name(path, variant), parsed.file, scene, source, long=long))
    mistakes += _once(found)
    if mistakes:
        raise CaseError(mistakes)
    return cases


def _once(found: Mapping[str, list[Mistake]]) -> list[Mistake]:
    """Mistakes of all variants: one that all share once, any other with its variant's name."""
    shared = set.intersection(*(set(mistakes) for mistakes in found.values()))
    return [
        m if m in shared else replace(m, what=f"{m.what} (variant {variant!r})")
        for variant, mistakes in found.items()
        for m in mistakes
    ]
