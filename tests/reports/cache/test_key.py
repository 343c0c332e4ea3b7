"""Whatever a result depends on changes its key, and what it does not depend on does not."""

import os
import shutil
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.engines import make
from textmech.reports.cache import key
from textmech.reports.cache.key import Keys, described

CASE = scenes.SHIPPED["rolling_wheel.pushed"]
ENGINE = make("pymunk", "tuned")
OTHER = {
    "name": "other", "title": "other", "system": None, "duration": 9.0, "samples": 9, "step": 9.0,
    "rests": True, "drops_out": ("x",),
}  # fmt: skip
SAME = ("source",)  # its text: only for messages


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the code that a test may change."""
    for room in ("cases", "reference", "engines", "reports"):
        shutil.copytree(key.ROOT / room, tmp_path / room)
    monkeypatch.setattr(key, "ROOT", tmp_path)
    return tmp_path


def words(case: Case = CASE, engine: Any = ENGINE) -> tuple[str, str]:
    """The keys of the reference and of an outcome."""
    keys = replace(Keys.now(), salt="")
    return keys.solution(case), keys.outcome(keys.ways(case, engine), "native")


@pytest.mark.parametrize("field", [f.name for f in fields(Case) if f.name not in SAME])
def test_every_field_of_a_case_counts(field: str) -> None:
    other = replace(CASE, **{field: OTHER.get(field, {"other": 1.0})})
    assert not set(words(other)) & set(words())


def test_its_text_does_not() -> None:
    assert words(replace(CASE, source=replace(CASE.source, file="b", lines=("#",)))) == words()


def test_a_number_counts_to_the_last_bit() -> None:
    near = {**CASE.parameters, "m": float(np.nextafter(CASE.parameters["m"], 9))}
    assert words(replace(CASE, parameters=near))[0] != words()[0]


@pytest.mark.parametrize(
    "engine",
    [make("pymunk", "shipped"), make("pymunk", "own", {"iterations": 30}),
     make("pymunk", "own", {"iterations": 31}), make("mujoco", "tuned"),
     replace(ENGINE, version="0.0")],  # pyright: ignore[reportArgumentType, reportCallIssue]
    ids=["shipped", "30", "31", "mujoco", "version"],
)  # fmt: skip
def test_engine_setting_options_and_version_count(engine: Any, request: Any) -> None:
    found = [words(engine=e)[1] for e in (engine, ENGINE, make("pymunk", "own", {}))]
    assert len(set(found)) == 3
    assert words(engine=engine)[0] == words()[0]


def test_the_way_it_is_realised_counts() -> None:
    keys = Keys((), "")
    assert keys.outcome("w", "law") != keys.outcome("w", "native")


def test_a_rungs_ladder_and_step_count() -> None:
    keys = Keys((), "")
    rungs = [("following", 1e-3), ("held", 1e-3), ("held", 1e-3 * (1 + 2**-52))]
    assert len({keys.rung("o", *rung) for rung in rungs}) == 3


def test_what_is_tried_counts_and_the_code_that_tries_it(code: Path) -> None:
    def word(options: str = "{}", step: float = 1e-3) -> str:
        return replace(Keys.now(), salt="").tried(CASE, ENGINE, options, step)

    assert len({word(), word('{"iterations": 30}'), word(step=1e-3 * (1 + 2**-52))}) == 3
    before, row = word(), words()[1]
    for file in ("candidate.py", "errors.py"):
        with (code / "reports" / "search" / file).open("a", encoding="utf-8") as text:
            text.write("# changed\n")
        assert word() != before
        before = word()
    assert words()[1] == row


@pytest.mark.parametrize(
    ("file", "reference", "outcome"),
    [
        ("cases/observe.py", True, True),
        ("reference/laws/friction.py", True, True),
        ("reference/motion/follow.py", True, True),
        ("engines/engine.py", False, True),
        ("engines/pymunk/law/friction.py", False, True),
        ("engines/mujoco/run.py", False, False),
        ("reports/judge/verdict.py", False, True),
        ("reports/trial/ladder.py", False, True),
        ("reports/events/times.py", False, True),
        ("reports/row.py", False, True),
        ("reports/unit.py", False, True),
        ("reports/write.py", False, False),
    ],
)
def test_the_code_that_makes_it_counts_and_no_other(
    file: str, reference: bool, outcome: bool, code: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(key, "_home", lambda kind: code / "engines" / "pymunk")
    before = words()
    with (code / file).open("a", encoding="utf-8") as text:
        text.write("# changed\n")
    after = words()
    assert (before[0] != after[0], before[1] != after[1]) == (reference, outcome)


def test_an_engine_is_its_package() -> None:
    assert key._home(type(ENGINE)) == key.ROOT / "engines" / "pymunk"


@pytest.mark.parametrize(
    "change",
    [
        lambda patch: patch.setenv("OPENBLAS_CORETYPE", "Prescott"),
        lambda patch: patch.setenv("NPY_DISABLE_CPU_FEATURES", "AVX2"),
        lambda patch: patch.setattr(np, "__version__", "0"),
        lambda patch: patch.setattr(key.scipy, "__version__", "0"),
        lambda patch: patch.setattr("sys.version", "0"),
        lambda patch: patch.setattr(key, "_processor", lambda: "another"),
        lambda patch: patch.setattr("platform.machine", lambda: "another"),
    ],
)
def test_the_machine_counts(
    change: Callable[[pytest.MonkeyPatch], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = key.machine.__wrapped__()
    change(monkeypatch)
    assert key.machine.__wrapped__() != before


def test_code_newer_than_the_process_gives_keys_of_its_own(code: Path) -> None:
    file = code / "cases" / "observe.py"
    for path in code.rglob("*.py"):
        os.utime(path, (1, 1))
    assert Keys.now().salt == ""
    os.utime(file)
    assert Keys.now().salt != Keys.now().salt != ""


def test_code_that_changes_meanwhile_is_noticed(code: Path) -> None:
    keys = Keys.now()
    assert keys.hold()
    (code / "cases" / "observe.py").write_text("", encoding="utf-8")
    assert not keys.hold()
    keys = Keys.now()
    (code / "cases" / "observe.py").unlink()
    assert not keys.hold()


@pytest.mark.parametrize(
    ("one", "other"),
    [(1, 1.0), (0.0, -0.0), ("1", 1), ((1, 2), [1, 2]), ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
     ("a, 'b'", ("a", "b")), (np.zeros(2), np.zeros((2, 1))), (True, 1), (None, "None")],
)  # fmt: skip
def test_what_differs_is_described_differently(one: object, other: object) -> None:
    assert described(one) != described(other)


def test_what_cannot_be_told_apart_is_not_described() -> None:
    for value in (lambda: 1, object()):
        with pytest.raises(TypeError):
            described(value)
