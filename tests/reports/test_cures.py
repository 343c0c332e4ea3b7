"""Cures from the report of causes: joined by row, and of a user's own case none."""

from pathlib import Path

import pytest
from given.swing import SWING

from textmech.cases.load import load
from textmech.reports.selection import choose_cases
from textmech.reports.show import cures

HEAD = "case,engine,setting,quantity,error_before,allow,cure,options,step,error_after,cost,law\n"
ROWS = """\
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,RK4,{integrator: RK4},0.002,1e-7,4,
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,a step of 0.5 ms,{step: 0.0005},0.0005,0.6,4,h^1
bar_pendulum,pymunk,shipped,bar.angle,340,0.01,"error_bias 0, and the step",{error_bias: 0},,,20,
# 3 rows of run 0123456789ab
"""


def test_without_the_report_nothing_is_known(tmp_path: Path) -> None:
    assert cures.cures(tmp_path) == {}


def test_cures_of_one_row_are_joined(tmp_path: Path) -> None:
    (tmp_path / cures.NAME).write_text(HEAD + ROWS, encoding="utf-8")
    assert cures.cures(tmp_path) == {
        ("bar_pendulum", "mujoco", "shipped", "energy.total"): "RK4 or a step of 0.5 ms",
        ("bar_pendulum", "pymunk", "shipped", "bar.angle"): "error_bias 0, and the step",
    }


def test_a_case_of_ones_own_has_none_of_a_shipped_ones(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / cures.NAME).write_text(HEAD + ROWS, encoding="utf-8")
    monkeypatch.setattr(cures, "HERE", tmp_path)
    assert len(cures.committed(choose_cases(["bar_pendulum"]))) == 2
    own = tmp_path / "bar_pendulum.yaml"
    own.write_text(SWING, encoding="utf-8")
    assert cures.committed(load(own)) == {}
