"""What people ask: every question has a case, and with the setting that it names it comes right."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from given.otherwise import otherwise

from textmech.cases.find import of_the_book
from textmech.cases.find import questions as files
from textmech.cases.load import load
from textmech.reports import run
from textmech.reports.front.show import readme as asking
from textmech.reports.front.show.readme import WORDS, questions
from textmech.reports.front.show.readme import listed_questions as listed
from textmech.reports.tables.row import AGREES

Setting = Mapping[str, Any] | str
EACH = [(n, e, s) for n, q in listed().items() for e, s in q.settings.items()]
REALISED = {"shipped": ("shipped", "native"), "law": ("tuned", "law")}


def agrees(rows: pd.DataFrame, setting: str, realised: str) -> bool:
    found = rows[(rows.setting == setting) & (rows.realised == realised)]
    assert len(found) > 1, "nothing beside the audit was run"
    return bool((found.verdict == AGREES).all())


def holds(case: str, engine: str, setting: Setting) -> bool:
    """Whether it comes right with the setting, and with no smaller change."""
    if isinstance(setting, str):
        rows = run(case, engines=[engine]).tolerance
        less = [] if setting == "shipped" else ["shipped", "tuned"]
        return agrees(rows, *REALISED[setting]) and not any(agrees(rows, s, "native") for s in less)
    rows = run(case, engines=[f"{engine}.shipped"], options={engine: setting}).tolerance
    return agrees(rows, "own", "native") and not agrees(rows, "shipped", "native")


@pytest.mark.slow
@pytest.mark.parametrize(("case", "engine", "setting"), EACH, ids=[f"{c}-{e}" for c, e, _ in EACH])
def test_the_setting_is_an_answer(case: str, engine: str, setting: Setting) -> None:
    assert holds(case, engine, setting)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "engine", "setting"),
    [
        ("creeping_block", "mujoco", {"cone": "elliptic", "impratio": 2}),
        ("leaking_pendulum", "pymunk", {"error_bias": 0}),
        ("rolling_down", "mujoco", {"integrator": "RK4"}),  # right as it is
        ("rolling_down", "pymunk", "shipped"),
        ("held_joint", "mujoco", "law"),  # more than it needs
    ],
)
def test_a_setting_that_is_none_is_seen(case: str, engine: str, setting: Setting) -> None:
    assert not holds(case, engine, setting)


def test_every_question_has_its_case_with_a_thread_and_every_case_its_question() -> None:
    assert list(files()) == sorted(listed())
    for file in files().values():
        for case in load(file):
            assert case.origin.thread
            assert str(case.origin).endswith(case.origin.thread)


def test_no_question_is_called_as_a_case_of_the_book() -> None:
    assert not set(files()) & set(of_the_book())


def test_the_table_says_question_case_answer_and_setting() -> None:
    head, *lines = questions()
    assert head == ["question", "case", "answer", "setting"]
    rows = {line[1].split("`")[1]: line for line in lines}
    assert list(rows) == list(listed())
    assert "impratio: 100" in rows["creeping_block"][3]
    assert WORDS["law"] in rows["break_away"][3]
    assert all(line[0].endswith("?") for line in lines)


@pytest.mark.mutant("the engines of the README's settings exchanged")
def test_each_engine_has_its_own_setting(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    listed = tmp_path / "questions.yaml"
    listed.write_text(
        "moving:\n  asks: why?\n  answer: so\n"
        "  with: {mujoco: {integrator: RK4}, pymunk: {error_bias: 0.0}}\n",
        encoding="utf-8",
    )
    monkeypatch.setattr(asking, "LISTED", listed)
    wanted = "`mujoco: {integrator: RK4}`<br>`pymunk: {error_bias: 0.0}`"
    assert asking.questions()[1][-1] == wanted
    was = "for e, s in question.settings.items())"
    now = "for e, s in zip(question.settings, reversed(question.settings.values())))"
    exchanged = otherwise(asking, was, now)
    exchanged.LISTED = listed
    assert exchanged.questions()[1][-1] != wanted
