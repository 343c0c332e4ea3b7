"""Rows of claims about states: native, without a step or an order, and refused in words."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from bench.adapters import rows as rows_of_bench
from given import scenes
from given.claims import CHAIN, PLANE, claimed
from given.lines import said

from textmech import engines
from textmech.cases.case import Case, Deviation
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array
from textmech.engines.engine import Engine, Start
from textmech.engines.pymunk import Pymunk
from textmech.reports.batch import suite
from textmech.reports.compare.trial.states import SILENT, ways_of
from textmech.reports.data.row import AGREES, BEYOND, DEVIATES, FAILS, Comparison
from textmech.reports.output import motion_files as keep
from textmech.reports.output import write
from textmech.reports.show.script import script

MUJOCO, PYMUNK = (engines.make(name, "tuned") for name in ("mujoco", "pymunk"))


def rows(case: Case, engine: Any) -> dict[str, Comparison]:
    report = suite.measure([case], [engine], progress=lambda *_: None, book=False)
    assert report.rungs == []
    assert report.instants == []
    return {row.quantity: row for row in report.comparisons}


@pytest.mark.slow
def test_rows(tmp_path: Path) -> None:
    case = claimed(tmp_path, PLANE)
    found = rows(case, MUJOCO)
    assert set(found) == {"audit", *case.allow}
    for row in found.values():
        assert (row.realised, row.verdict, row.step, row.when) == ("native", AGREES, None, None)
        assert row.protocol == ""
    assert found["wheel.inertia"].unit == "kg m²"


@pytest.mark.slow
def test_what_is_not_told_is_refused(tmp_path: Path) -> None:
    case = claimed(tmp_path, PLANE, allow={"wheel.P.ax": 1e-11, "wheel.P.x": 1e-12})
    found = rows(case, PYMUNK)
    assert found["wheel.P.ax"].because.startswith("engine: pymunk has velocities")
    assert found["wheel.P.x"].verdict == AGREES


@pytest.mark.slow
def test_space_is_refused_by_an_engine_of_the_plane(tmp_path: Path) -> None:
    found = rows(claimed(tmp_path, CHAIN), PYMUNK)
    assert {said(row) for row in found.values()} == {
        "refused: engine: pymunk moves bodies in a plane, and this scene is in space"
    }


@pytest.mark.slow
def test_twice_the_energy_is_beyond_fails_or_is_declared(tmp_path: Path) -> None:
    case = claimed(tmp_path, PLANE, allow={"energy.kinetic": 1e-11})
    shipped = engines.make("pymunk", "shipped")
    row = rows(case, shipped)["energy.kinetic"]
    assert row.verdict == BEYOND
    assert row.because.startswith("largest in state ")
    assert rows(case, PYMUNK)["energy.kinetic"].verdict == BEYOND
    promised = replace(case, reach={"pymunk": {"energy.kinetic": 1e-12}})
    assert rows(promised, PYMUNK)["energy.kinetic"].verdict == FAILS
    assert row.error is not None
    near = Deviation("it is m v² + J ω²", by=(0.9 * row.error, 1.1 * row.error))
    declared = replace(case, deviates={"pymunk.shipped": {"energy.kinetic": near}})
    assert rows(declared, shipped)["energy.kinetic"].verdict == DEVIATES
    gone = Deviation("it is m v² + J ω²", by=(1.1 * row.error, 1.2 * row.error))
    declared = replace(case, deviates={"pymunk.shipped": {"energy.kinetic": gone}})
    assert rows(declared, shipped)["energy.kinetic"].verdict == FAILS


class Silent:
    """An engine without the verb."""

    name, setting, version, own_step = "silent", "shipped", "1", None


def test_an_engine_without_answers_is_refused(tmp_path: Path) -> None:
    engine: Any = Silent()
    (way,) = ways_of(engine, claimed(tmp_path, PLANE), {})
    assert way.because == SILENT  # type: ignore[union-attr]


class Broken(Pymunk):
    """One that answers with what is no number."""

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        n = len(next(iter(states.values())))
        return {name: np.full(n, np.nan) for name in wanted}


def test_what_is_no_number_fails(tmp_path: Path) -> None:
    engine: Engine = Broken("tuned")
    found = rows(claimed(tmp_path, PLANE), engine)
    assert found["wheel.P.x"].verdict == FAILS
    assert found["wheel.P.x"].because == "diverged: wheel.P.x is not finite"


class Wrong(Pymunk):
    """One that cannot be asked."""

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        raise ZeroDivisionError("no answer")


def test_what_raises_is_no_refusal_that_passes(tmp_path: Path) -> None:
    engine: Any = Wrong("tuned")
    (way,) = ways_of(engine, claimed(tmp_path, PLANE), {})
    assert way.because == "ZeroDivisionError: no answer"  # type: ignore[union-attr]
    found = rows(claimed(tmp_path, PLANE), engine)
    assert {row.verdict for row in found.values()} == {FAILS}


def test_nothing_of_it_can_be_shown(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="is a claim about states: nothing is run"):
        script(claimed(tmp_path, PLANE), MUJOCO)


@pytest.mark.slow
@pytest.mark.parametrize("name", scenes.CLAIMS)
def test_shipped_claims(name: str) -> None:
    case = scenes.CLAIMS[name]
    for engine in (MUJOCO, PYMUNK):
        found = rows(case, engine)
        verdicts = {name: row.verdict.partition(":")[0] for name, row in found.items()}
        assert set(verdicts.values()) <= {AGREES, DEVIATES, "refused"}
        answered = {
            v for name, v in verdicts.items() if name.split(".")[0] not in case.scene.forces
        }
        assert engine is PYMUNK or answered == {AGREES}


@pytest.mark.slow
def test_friction_that_an_engine_has_not_is_refused_and_the_rest_answered() -> None:
    for engine in (MUJOCO, PYMUNK):
        found = rows(scenes.CLAIMS["sliding_points"], engine)
        assert found["momentum.x"].verdict == AGREES
        assert found["pad.fx"].because.startswith("engine: ")


@pytest.mark.slow
def test_its_rows_can_be_written_and_read(tmp_path: Path) -> None:
    case = claimed(tmp_path, PLANE)
    report = suite.measure([case], [MUJOCO], progress=lambda *_: None, book=False)
    write.write(write.tables(report, [case]), tmp_path)
    back = write.read(tmp_path / "tolerance.csv", Comparison)
    assert {(row.quantity, row.verdict, row.step) for row in back} == {
        (name, AGREES, None) for name in ("audit", *case.allow)
    }


@pytest.mark.slow
def test_what_is_kept_has_a_row_for_each_state(tmp_path: Path) -> None:
    case = claimed(tmp_path, PLANE)
    report = suite.measure([case], [MUJOCO], progress=lambda *_: None, book=False)
    keep.keep(report, tmp_path / "kept")
    table = pd.read_csv(tmp_path / "kept" / "claimed.csv")
    assert table["state"].tolist() == [0, 1, 2, 3]
    one, other = (table[f"wheel.P.x [m] {who}"] for who in ("reference", "mujoco.tuned.native"))
    assert np.max(np.abs(one - other)) < 1e-12


def test_it_is_no_case_for_the_bench(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="is a claim about states: nothing is run"):
        next(rows_of_bench(claimed(tmp_path, PLANE), [MUJOCO], 1, 1))
