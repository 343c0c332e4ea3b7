"""Cures from the report of causes: joined by row, and of a user's own case none."""

from dataclasses import replace
from pathlib import Path

import pytest
from given.swing import SWING

from textmech.cases.load import load
from textmech.reports.batch.selection import choose_cases
from textmech.reports.data.row import Cause
from textmech.reports.show import cures

HEAD = "case,engine,setting,quantity,error,allowed,cure,options,step,error_after,cost,law\n"
ROWS = """\
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,RK4,{integrator: RK4},0.002,1e-7,4,
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,step,{},0.0005,0.6,4,h^1
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,implicit + midpoint,{},0.002,0.6,9,
bar_pendulum,pymunk,shipped,bar.angle,340,0.01,error_bias 0 + step,{error_bias: 0},0.00125,,20,
bar_pendulum,pymunk,shipped,b.x,340,0.01,our force law in place of its own,,,,,
bar_pendulum,pymunk,shipped,hinge.gap,340,0.01,not searched,,,,,
"""


def test_without_the_report_nothing_is_known(tmp_path: Path) -> None:
    assert cures.cures(tmp_path) == {}


def test_the_two_cheapest_cures_of_a_row_are_joined_and_steps_told(tmp_path: Path) -> None:
    (tmp_path / cures.NAME).write_text(HEAD + ROWS, encoding="utf-8")
    assert cures.cures(tmp_path) == {
        ("bar_pendulum", "mujoco", "shipped", "energy.total"): "RK4 or step 0.5 ms",
        ("bar_pendulum", "pymunk", "shipped", "bar.angle"): "error_bias 0 + step 1.25 ms",
        ("bar_pendulum", "pymunk", "shipped", "b.x"): "our force law",
    }


def test_a_case_of_ones_own_has_none_of_a_shipped_ones(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / cures.NAME).write_text(HEAD + ROWS, encoding="utf-8")
    monkeypatch.setattr(cures, "HERE", tmp_path)
    assert len(cures.committed(choose_cases(["bar_pendulum"]))) == 3
    own = tmp_path / "bar_pendulum.yaml"
    own.write_text(SWING, encoding="utf-8")
    assert cures.committed(load(own)) == {}


def test_what_a_run_has_searched_is_told_alike() -> None:
    one = Cause("mine", "mujoco", "shipped", "b.x", 2.0, 1.0, "step", "{}", 5e-4, 0.6, 4.0, "h^1")
    none = replace(one, quantity="b.y", cure="not searched", step=None)
    both = replace(one, cure="RK4", options="{integrator: RK4}", step=2e-3)
    assert cures.found_cures([both, one, none]) == {
        ("mine", "mujoco", "shipped", "b.x"): "RK4 or step 0.5 ms"
    }
