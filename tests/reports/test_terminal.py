"""What a run shows of its references on the terminal."""

import pytest

from textmech.reports.batch.suite import Report
from textmech.reports.data.row import Certificate
from textmech.reports.show import terminal


def test_what_a_reference_is_certified_to_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    angle = "error of rod.angle"
    row = Certificate("swing", "", "generated", angle, 3e-10, 0.01, 3e-12, "rad", "holds")
    law = Certificate("swing", "", "generated", "power balance", 1e-16, 1e-12, None, "", "holds")
    report = Report(certificates=[law, row])
    terminal.show(report, detailed=True, written=None)
    said = "swing: the reference is certified: rod.angle to 3e-12 rad\n"
    assert said in capsys.readouterr().out
    terminal.show(report, detailed=False, written=None)
    assert said not in capsys.readouterr().out
