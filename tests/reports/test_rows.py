"""The rows of a run on a terminal of 80 columns."""

from dataclasses import replace

from given.lines import refused, row

from textmech.reports.data.row import FAILS, Certificate
from textmech.reports.show.terminal import certificate_lines, rows

LONG = (
    "does not vanish with the step: 0.346 stay; "
    + "one number for friction where there are two; " * 3
)


def test_a_setting_has_its_step_and_each_quantity_its_bound() -> None:
    found = [row(), row(quantity="rod.omega", error=0.2, ratio=20.0, because="the step")]
    assert list(rows(found)) == [
        "",
        "swing in mujoco 4.0.0 shipped (defaults), h = 2 ms",
        "  rod.angle  1.00e-03 rad  of 1.0e-02   agrees",
        "  rod.omega  2.00e-01 rad  of 1.0e-02   too far off",
        "      the step",
    ]


def test_a_reason_that_rows_share_is_told_once() -> None:
    twice = [row(quantity=name, ratio=2.0, because="the step") for name in ("a.x", "b.x")]
    other = row(quantity="c.x", ratio=2.0, because="the model")
    assert [line.split()[0] for line in list(rows([*twice, other]))[2:]] == [
        "a.x",
        "b.x",
        "the",
        "c.x",
        "the",
    ]


def test_what_agrees_needs_no_reason() -> None:
    assert "read back" not in "\n".join(rows([row(because="6 numbers read back")]))


def test_what_is_refused_is_named_together() -> None:
    names = [refused(quantity=name) for name in ("a.x", "b.x")]
    assert list(rows([row(), *names]))[3:] == ["  a.x, b.x", "      not supported: engine: no"]
    assert list(rows([refused(because="why")]))[1:] == [
        "swing in mujoco 4.0.0 shipped (defaults)",
        "  rod.angle",
        "      not supported: why",
    ]


def test_nothing_is_wider_than_a_terminal() -> None:
    found = [row(protocol=LONG), row(quantity="b.x", ratio=2.0, because=LONG)]
    found += [
        row("tuned", realised="law"),
        *(refused("tuned", quantity=f"q{i}") for i in range(40)),
    ]
    lines = list(rows(found))
    assert max(map(len, lines)) <= 80
    assert "swing in mujoco 4.0.0 tuned (best found, our force law), h = 2 ms" in lines
    assert LONG.split() == " ".join(lines[2:5]).split()


def test_what_a_reference_is_certified_to() -> None:
    angle = "error of rod.angle"
    certified = Certificate("swing", "", "generated", angle, 3e-10, 0.01, 3e-12, "rad", "holds")
    law = Certificate("swing", "", "generated", "power balance", 1e-16, 1e-12, None, "", "holds")
    assert list(certificate_lines([law])) == []
    said = "swing: the reference is certified: rod.angle to 3e-12 rad"
    assert list(certificate_lines([law, certified])) == ["", said]
    assert max(map(len, certificate_lines([certified] * 9))) <= 80
    broken = replace(law, verdict=FAILS)
    assert (
        list(certificate_lines([broken, certified])) == []
    )  # of one that does not hold nothing is known
