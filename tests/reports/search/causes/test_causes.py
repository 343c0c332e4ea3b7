"""Causes of real rows: those that are known by hand, carried over, and told by the commands."""

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given import scenes
from given.command import NEW, textmech
from given.command.lines import ladder, row

from textmech.reports.front.show.cures import carried
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_engines
from textmech.reports.search.causes import explained
from textmech.reports.search.causes.causes import Known
from textmech.reports.search.causes.why import OURS, Key, Rows, key_of
from textmech.reports.tables import write
from textmech.reports.tables.row import (
    ANOTHER,
    BEYOND,
    FALLS,
    UNSEARCHED,
    UNSETTLED,
    Advice,
    Cause,
    Comparison,
    as_written,
)

# Causes of real rows: those that are known by hand, and what is said where there are none.

CASES = ("bar_pendulum", "four_bar", "sliding_block.below", "growing_force")
"""`test_causes_are_current` searches them anew: what is committed of them is what is found."""


@pytest.fixture(scope="module")
def causes() -> list[Cause]:
    return [c for c in write.read(write.HERE / "causes.csv", Cause) if c.case in CASES]


@pytest.fixture(scope="module")
def comparisons() -> list[Comparison]:
    rows = write.read(write.HERE / "tolerance.csv", Comparison)
    return [row for row in rows if row.case in CASES]


def of(causes: list[Cause], *key: str) -> list[Cause]:
    """Those of a case, an engine and a quantity, as shipped."""
    case, engine, quantity = key
    wanted = (case, engine, "shipped", quantity)
    return [c for c in causes if (c.case, c.engine, c.setting, c.quantity) == wanted]


@pytest.mark.parametrize(
    ("case", "engine", "quantity", "cures"),
    [
        ("bar_pendulum", "mujoco", "energy.total", ["RK4", "step"]),
        ("bar_pendulum", "pymunk", "bar.angle", ["error_bias 0 + step"]),
        ("bar_pendulum", "pymunk", "hinge.gap", ["step"]),
        ("four_bar", "mujoco", "crank.angle", ["RK4 + softness of loops"]),
        ("four_bar", "mujoco", "D.gap", ["RK4 + softness of loops", "softness of loops + step"]),
        ("sliding_block.below", "mujoco", "block.x", ["impratio 1e6"]),
        ("growing_force", "pymunk", "block.x", [OURS["law"]]),
        ("growing_force", "mujoco", "block.x", [OURS["law"]]),
    ],
)
def test_causes_that_are_known(
    causes: list[Cause], case: str, engine: str, quantity: str, cures: list[str]
) -> None:
    assert [cause.cure for cause in of(causes, case, engine, quantity)] == cures


def test_a_cure_brings_the_error_within_and_says_at_what_cost(causes: list[Cause]) -> None:
    cured = [cause for cause in causes if cause.error_after is not None]
    assert len(cured) > 20
    assert all(c.error_after <= (c.allowed or 0.0) for c in cured if c.error_after is not None)
    assert all((c.error or 0.0) > (c.allowed or 0.0) for c in cured)
    (rk4, finer) = of(causes, "bar_pendulum", "mujoco", "energy.total")
    assert (rk4.options, rk4.step, rk4.cost) == ("{integrator: RK4}", 2e-3, 4.0)
    assert (finer.options, finer.step, finer.cost, finer.law) == ("{}", 5e-4, 4.0, "h^1")


def test_the_last_column_says_them_after_what_is_declared(comparisons: list[Comparison]) -> None:
    because = {(r.case, r.engine, r.setting, r.quantity): r.because for r in comparisons
               if r.realised == "native"}  # fmt: skip
    pendulum = because["bar_pendulum", "mujoco", "shipped", "energy.total"]
    assert pendulum == "cured by RK4 (×4 the cost) or step 0.0005 s (×4 the cost)"
    assert all("cured by" in row.because for row in comparisons if row.verdict == BEYOND)
    declared = "one number for friction: it breaks loose at the kinetic 3 N; cured by "
    assert because["growing_force", "pymunk", "tuned", "block.x"] == declared + OURS["law"]


@pytest.mark.slow
def test_without_a_search_what_the_ladder_tells_stays() -> None:
    engines = choose_engines(["mujoco.shipped"], [])
    report = explained.measure(Request([scenes.EVERY["bar_pendulum"]], engines, book=False))
    assert {cause.cure for cause in report.causes} == {UNSEARCHED}
    row = next(r for r in report.comparisons if r.verdict == BEYOND)
    assert row.because.startswith("the step: it falls with order 1.0")


@pytest.mark.mutant("our law for a cure, where the engine's own smaller step is one: {setting}")
@pytest.mark.parametrize("setting", ["shipped", "tuned"])
@pytest.mark.parametrize("told", [{"usable": 1e-3}, {"usable": None, "verdict": FALLS}])
def test_our_law_is_no_cause_where_a_smaller_step_agrees(
    setting: str, told: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    off, law = row(ratio=3.0, allowed=1e-2), row("tuned", realised="law")
    given = [off, row("tuned", ratio=2.0), law]
    assert Rows(given, [ladder(**told, setting=setting)]).ours(off) == []
    assert Rows(given, [ladder(None, setting, verdict=ANOTHER)]).ours(off) == [law]
    short = Rows(given, [ladder(None, setting, verdict=UNSETTLED)])
    assert short.ours(off) == ([] if setting == "tuned" else [law])
    assert Rows(given, [ladder(**told, setting=setting, realised="law")]).ours(off) == [law]
    monkeypatch.setattr(Rows, "_by_steps", set())
    assert Rows(given, [ladder(**told, setting=setting)]).ours(off) == [law]


# Causes that a committed table knows are not searched while what they stand on is the same.


def run(place: Path, known: Known | None = None) -> tuple[list[Cause], Known, bool]:
    """The causes of one case in one setting, these as tables hold them, and whether any was run."""
    phases = set[str]()
    report = explained.measure(
        Request(
            [scenes.EVERY["bar_pendulum"]],
            choose_engines(["mujoco.shipped"], []),
            progress=lambda what, *_: phases.add(what),
            store=Store(place),
            book=False,
        ),
        search=True,
        known=known,
    )
    written: dict[Key, list[Cause]] = {}
    for one in report.causes:
        error, allowed = as_written(one.error), as_written(one.allowed)
        written.setdefault(key_of(one), []).append(replace(one, error=error, allowed=allowed))
    rows = report.comparisons
    verdicts = {(*key_of(r)[:3], r.realised, r.quantity): r.verdict for r in rows}
    return report.causes, Known(written, verdicts), "causes" in phases


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[Cause], Known]:
    causes, known, searched = run(tmp_path_factory.mktemp("first"))
    assert searched
    return causes, known


@pytest.mark.slow
def test_what_stands_on_the_same_is_carried_over(
    first: tuple[list[Cause], Known], tmp_path: Path
) -> None:
    causes, known = first
    again, read, searched = run(tmp_path, known)
    assert not searched
    assert read.causes == known.causes
    told = carried(again, known.causes)
    assert told.startswith(f"causes: {len(known.causes)} rows keep the committed ones")
    assert carried(causes, {}) == ""


Change = Callable[[Cause], Cause]
CHANGES: Mapping[str, Change] = {
    "of another version or adapter": lambda c: replace(c, searched_with="4.0.0 0123456789ab"),
    "of another error": lambda c: replace(c, error=1.01 * (c.error or 0.0)),
    "of another tolerance": lambda c: replace(c, allowed=2 * (c.allowed or 0.0)),
    "of no search": lambda c: replace(c, searched_with=""),
}


@pytest.mark.slow
@pytest.mark.mutant("causes are carried over {what}")
@pytest.mark.parametrize("what", [*CHANGES, "beside another verdict"])
def test_what_does_not_is_searched(
    what: str, first: tuple[list[Cause], Known], tmp_path: Path
) -> None:
    causes, known = first
    change = CHANGES.get(what, lambda cause: cause)
    other = {key: [change(one) for one in some] for key, some in known.causes.items()}
    mark = "" if what in CHANGES else "?"
    verdicts = {key: f"{verdict}{mark}" for key, verdict in known.verdicts.items()}
    again, _, searched = run(tmp_path, Known(other, verdicts))
    assert searched
    assert again == causes


# `textmech causes` and `textmech advise` as a user meets them, with a case of one's own.


@pytest.fixture
def new(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


@pytest.mark.slow
def test_causes_for_scripts(new: Path) -> None:
    words = (new, "--json", "--no-cache")
    done, run = textmech("causes", *words), textmech("run", "--causes", *words)
    found = json.loads(done.stdout)
    assert (found["mistakes"], found["exit_code"]) == ([], 0)
    assert {"case": "cart", "engine": "pymunk", "setting": "shipped"}.items() <= found["causes"][
        -1
    ].items()
    assert json.loads(run.stdout)["causes"] == found["causes"]


@pytest.mark.slow
def test_what_is_advised_for_ones_own_case_keeps_its_promise(new: Path) -> None:
    """The printed settings, pasted into a file, bring every row within its tolerance."""
    done = textmech("advise", new, "--engine", "pymunk", "--no-cache", folder=new.parent)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    words = [lines[i + 1] for i, line in enumerate(lines) if "as a file of --settings" in line]
    assert words
    for word in words:  # the fewest changes, and the cheapest
        own = new.with_name("own.yaml")
        own.write_text(word.strip(), encoding="utf-8")
        run = textmech("run", new, "--engine", "pymunk", "--settings", own, folder=new.parent)
        tables = run.stdout.split("\ncart in ")
        (rows,) = [part for part in tables if part.split("\n")[0].count(" own")]
        assert rows.count(" agrees") >= 2
        assert "beyond" not in rows.split("\n\n")[0]


@pytest.mark.slow
def test_scripts_read_rows(new: Path, tmp_path: Path) -> None:
    done = textmech(
        "advise", new, "--json", "--out", tmp_path / "out", "--no-cache", folder=new.parent
    )
    found = json.loads(done.stdout)
    assert found["exit_code"] == 0
    assert {row["engine"] for row in found["advice"]} == {"mujoco", "pymunk"}
    assert all(0 < row["ratio"] <= 0.5 for row in found["advice"])
    written = write.read(tmp_path / "out" / write.ADVICE, Advice)
    assert [(row.engine, row.want, row.recipe) for row in written] == [
        (row["engine"], row["want"], row["recipe"]) for row in found["advice"]
    ]


@pytest.mark.parametrize(
    "words", [(), ("bar_pendulum", "--all"), ("bar_pendulum", "--margin", "0.5")]
)
def test_mistaken_words_are_told(words: tuple[str, ...], tmp_path: Path) -> None:
    done = textmech("advise", *words, folder=tmp_path)
    assert done.returncode == 2
    assert "Error" in done.stderr
