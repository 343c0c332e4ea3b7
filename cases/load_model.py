"""A case file with a `model` → its cases, one for each variant, or all of its mistakes at once."""

import csv
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from .fields.number import NONE
from .fields.signal import Signal
from .find import case_name, check_name
from .language.check.work import too_many_variants
from .language.document import read
from .language.grammar.model_file import OVERLAID, ControlFile, ModelFile
from .load import merge_mistakes, overlay
from .mistake import NO_VALUE, CaseError, Mistake, Source
from .model_case import Law, ModelCase, ModelStart, Steps

TIME = "time"
LARGEST = 20_000_000  # bytes of a table of controls


def has_model(path: FilePath) -> bool:
    """Whether a file is a case of a model: it has that key. A file that is no YAML has none."""
    try:
        return "model" in read(path, only=("model",)).data
    except CaseError:
        return False


def load_model(path: FilePath, *, long: bool = False) -> list[ModelCase]:
    """Returns the cases of a file. Raises CaseError with every mistake of the file.

    Whether the model has the names is known when it is compiled.
    """
    document = read(path)
    if not long and (what := too_many_variants(document.data)):
        raise CaseError([*document.mistakes, document.source.mistake(("variants",), what)])
    variants, mistakes = overlay(document, OVERLAID)
    mistakes = [*check_name(path), *document.mistakes, *mistakes]
    by_variant: dict[str, list[Mistake]] = {}
    cases: list[ModelCase] = []
    for variant, (data, source) in variants.items():
        by_variant[variant] = []
        try:
            cases.append(_case(case_name(path, variant), data, source))
        except CaseError as error:
            by_variant[variant] = error.mistakes
    if mistakes := [*mistakes, *merge_mistakes(by_variant)]:
        raise CaseError(mistakes)
    return cases


def _case(name: str, data: Mapping[str, Any], source: Source) -> ModelCase:
    try:
        file = ModelFile.model_validate(data, context=NONE)
    except ValidationError as error:
        errors = [(_path(e["loc"]), e["msg"]) for e in error.errors(include_url=False)]
        mistakes = [source.mistake(path, what) for path, what in errors if what != NO_VALUE]
        raise CaseError(mistakes) from None
    control = file.control
    start = file.initial
    random = start.random_rates
    return ModelCase(
        name,
        file.path(source.file),
        source.file,
        source,
        file.title,
        ModelStart(start.keyframe, start.joints, start.rates, random.noun if random else None),
        _table(control, source) if isinstance(control, ControlFile) else control,
        file.contacts == "on",
        file.duration,
        file.samples,
        file.allow,
    )


def _path(loc: tuple[str | int, ...]) -> tuple[str | int, ...]:
    """Returns the place without pydantic's tags."""
    return tuple(part for part in loc if not (isinstance(part, str) and part.startswith("<")))


def _table(control: ControlFile, source: Source) -> dict[str, Law]:
    """Returns the laws of a CSV file's columns, by actuator. Raises CaseError."""
    path = FilePath(source.file).parent / control.table

    def refused(what: str) -> CaseError:
        return CaseError([source.mistake(("control",), f"{control.table}: {what}")])

    try:
        if path.stat().st_size > LARGEST:
            raise refused(f"is larger than {LARGEST // 10**6} MB")
        with path.open(encoding="utf-8-sig", newline="") as file:
            head, *rows = [row for row in csv.reader(file) if row]
        numbers = [tuple(map(float, row)) for row in rows]
    except (OSError, UnicodeDecodeError) as error:
        raise refused(f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    except ValueError:  # no line at all, or what is no number
        raise refused(f"should have a head, as `{TIME},elbow`, and numbers below it") from None
    if not head or head[0] != TIME or len(head) < 2:
        raise refused(f"its first column should be `{TIME}` [s], each other one an actuator")
    if any(len(row) != len(head) for row in numbers) or len(numbers) < 2:
        raise refused(f"should have at least 2 rows of {len(head)} numbers each")
    times, *columns = zip(*numbers, strict=True)
    if not all(before < after for before, after in pairwise(times)):
        raise refused("its times should rise")
    if not all(abs(number) < float("inf") for row in numbers for number in row):
        raise refused("its numbers should be finite")
    laws: dict[str, Law] = {}
    for name, values in zip(head[1:], columns, strict=True):
        linear = Signal("table", (1.0,), times=times, values=values)
        laws[name] = Steps(times, values) if control.between == "held" else linear
    return laws
