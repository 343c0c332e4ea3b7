"""Whatever an engine does costs its own rows: they say so, and all others are as they were."""

import csv
import json
from pathlib import Path

import pytest
from given.adapters.faulty import ACTS, ANSWERS, AUDITS, PLANS, Faulty

from textmech import engines
from textmech.cases.case import Case
from textmech.engines.engine import Engine
from textmech.reports.compare.trial import limit
from textmech.reports.compare.trial.table_text import spelled
from textmech.reports.front.show import document
from textmech.reports.runs import suite
from textmech.reports.runs.request import Request
from textmech.reports.tables import write
from textmech.reports.tables.row import AGREES, DIVERGED, FAILS, Comparison

LONGEST = 400  # letters of what a row says

ENGINES = [
    *(Faulty(verb=verb, act=act) for verb in ("plans", "measure", "run") for act in ACTS),
    *(Faulty(answer=answer) for answer in ANSWERS),
    *(Faulty(planned=planned) for planned in PLANS),
    *(Faulty(read=read) for read in AUDITS),
    Faulty(act="diverges at length"),
]


def told(engine: Faulty) -> str:
    return "-".join(
        filter(None, (engine.verb, engine.act, engine.answer, engine.planned, engine.read))
    )


def measured(case: Case, *chosen: Engine) -> suite.Report:
    return suite.measure(Request([case], chosen, jobs=2, book=False))


def of(report: suite.Report, setting: str) -> list[Comparison]:
    return [row for row in report.comparisons if row.setting == setting]


@pytest.mark.parametrize("engine", ENGINES, ids=told)
@pytest.mark.slow
def test_a_fault_costs_the_engines_own_rows(
    engine: Faulty, moving: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(limit.VARIABLE, "1.0" if engine.act in ("hangs", "spins") else "60")
    monkeypatch.setenv(limit.MEMORY, "1")
    if engine.verb == "run":  # as an installed one of somebody else's; the others break the pool
        monkeypatch.setattr(engines, "foreign", lambda name: True)
    report = measured(moving, engine, Faulty(setting="sound"))
    sound = of(report, "sound")
    assert [row.verdict for row in sound] == [AGREES, AGREES], [row.because for row in sound]
    mine = of(report, "tuned")
    assert mine
    wrong = (FAILS, DIVERGED)  # of a user's own case what diverges is an answer
    assert any(row.verdict in wrong for row in mine), [row.verdict for row in mine]
    for row in mine:
        assert len(row.because) <= LONGEST
        assert row.because.isprintable()
        assert row.because or row.verdict == AGREES
        if engine.act == "eats" and row.verdict == FAILS:
            assert row.because.endswith("its process may take 1 GiB")
        assert row.realised == "native"
    write.write(write.tables(report, report.cases), tmp_path / "reports")
    with (tmp_path / "reports" / "tolerance.csv").open(encoding="utf-8", newline="") as file:
        assert sum(line[0] == "moving" for line in csv.reader(file)) == len(report.comparisons)
    found = document.of_run(report, [], cures={}, written=None, exit_code=1)
    assert json.loads(json.dumps(found))["exit_code"] == 1


@pytest.mark.mutant("a refusal in words that a spreadsheet computes")
@pytest.mark.parametrize("words", ["=1+1", "+1", "@sum", "-cmd|x", "=" * 1000])
def test_what_a_spreadsheet_would_compute_is_in_quotes(words: str) -> None:
    assert spelled(words)[0] == "'"
    assert spelled(f"no {words[:9]}") == f"no {words[:9]}"
