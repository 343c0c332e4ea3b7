"""Shipped cases with their solutions, those of `tests/scenes` by name, and typed ones."""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ruamel.yaml import YAML

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.language.document import read
from textmech.cases.load import load
from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.solve import Solution, solve
from textmech.reference.solve import mechanism as generated
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import usable

EVERY = {case.name: case for path in shipped().values() for case in load(path)}
SHIPPED = {name: case for name, case in EVERY.items() if case.states is None}
"""Those that move."""
FIRST = {Path(case.source.file).stem: case for case in reversed(SHIPPED.values())}
ONE_OF_EACH_FILE = [case.name for case in reversed(FIRST.values())]
"""The first variant of every file: the others move the same scene."""
CLAIMS = {name: case for name, case in EVERY.items() if case.states is not None}
"""Those about states."""


@cache
def solved(name: str) -> Solution:
    """The certified motion of a shipped case, once for all tests: from the store, if it is there.

    Nothing is stored here: who asks may have planted a mistake.
    """
    case, store = EVERY[name], usable()
    kept = store.get(Keys.now(store).solution(case)) if store else None
    return solve(case) if kept is None else kept


def mechanism(case: Case) -> Any:
    """The generated mechanism of a case, at its start: in the plane, or in space."""
    return generated(case)


SCENES = Path(__file__).parents[2] / "scenes"


def scene_text(name: str, changes: Mapping[str, Any] | str | None = None, **parameters: Any) -> str:
    """Returns the case file `tests/scenes/<name>.yaml` with other parameters and other entries.

    Every parameter must be one of the file. changes: as in a variant, or as its text; a map goes
    into a map key by key, anything else replaces what stands there; None removes the key.
    """
    entries: Any = changes
    if isinstance(changes, str):
        entries = YAML(typ="safe", pure=True).load(changes)
    data = read(SCENES / f"{name}.yaml").data
    unknown = set(parameters) - set(data.get("parameters", {}))
    assert not unknown, f"{name}.yaml has no parameter {', '.join(sorted(unknown))}"
    return json.dumps(_merged(data, {"parameters": parameters, **(entries or {})}), indent=1)


def scene(name: str, changes: Mapping[str, Any] | str | None = None, **parameters: Any) -> Case:
    """Returns the case of `scene_text`: `scene("slope", mu=0.3)`."""
    return cases_of(scene_text(name, changes, **parameters), name)[0]


def cases_of(text: str, name: str = "typed", **options: Any) -> list[Case]:
    """Returns the cases of a file of this name with this text; options: those of `load`."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.yaml"
        path.write_text(text, encoding="utf-8")
        return load(path, **options)


def mistakes_of(text: str, **options: Any) -> Sequence[Mistake]:
    """Returns the mistakes of such a file: none where it is sound."""
    try:
        cases_of(text, **options)
    except CaseError as error:
        return error.mistakes
    return ()


def _merged(data: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(data)
    for key, value in changes.items():
        old = data.get(key)
        both = isinstance(old, Mapping) and isinstance(value, Mapping)
        merged[key] = _merged(old, value) if both else value  # type: ignore[arg-type]
    return {key: value for key, value in merged.items() if value is not None}


HEAD = """\
title: A scene typed in a test
source: {equations: ["2.60"]}
"""


def tail(duration: float, samples: int) -> str:
    """The end of a case file."""
    step = duration / (samples - 1) / 4
    return (
        f"duration: {duration}\nsamples: {samples}\nstep: {{mujoco: {step!r}, pymunk: {step!r}}}\n"
    )


TAIL = tail(1.0, 26)


def typed(tmp_path: Path, scene: str, *, tail: str = TAIL) -> Case:
    """The case of a file with this scene and start."""
    path = tmp_path / "typed.yaml"
    path.write_text(HEAD + scene + tail, encoding="utf-8")
    return load(path)[0]


def parsed(scene: str, *, tail: str = TAIL) -> Case:
    """Returns the case of `typed`, whose file nobody asks for."""
    return cases_of(HEAD + scene + tail)[0]
