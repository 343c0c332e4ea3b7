"""The table is read in a terminal of 80 columns, the CSV by a spreadsheet."""

import csv
import io
import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from given.command import NEW
from given.planning import SETTINGS, words

from bench import __main__ as command
from bench import adapters, table
from bench.adapters import Row
from bench.growth import Grown
from bench.integrators import Compared
from bench.turns import Ratio

RATIO = r" +(?P<{}>[\d.]+) ±[\d.]+"
LINE = re.compile(
    r"  (?P<who>\w+\.\w+) +(?P<step>[\d.]+) µs"
    + "".join(RATIO.format(name) for name in ("samples", "recorded", "building"))
    + r" +(?P<apart>\S+)"
)


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


def measure(*words: object) -> Result:
    """What `make bench` does in this process."""
    return CliRunner().invoke(command.bench, [str(word) for word in words])


@pytest.mark.slow
def test_a_case_of_ones_own_is_measured(cart: Path) -> None:
    done = measure(cart, "--rounds", 1, "--steps", 2)
    assert done.exit_code == 0, done.output
    lines = done.stdout.splitlines()
    assert max(map(len, lines)) <= 80
    assert "mujoco: `mj_step(model, data, n)`" in done.stdout
    assert "cart" in lines
    found = [m.groupdict() for line in lines if (m := LINE.fullmatch(line))]
    assert [row["who"] for row in found] == [words(engine) for engine in SETTINGS]
    for row in found:
        assert float(row["apart"]) < 1e-12
        assert all(float(row[name]) > 0 for name in ("samples", "recorded", "building", "step"))
    assert lines[-4].split() == ["median", "(most)", *table.AIMS]
    assert [line.split()[0] for line in lines[-3:]] == ["aim", "mujoco", "pymunk"]


def test_the_same_as_csv(cart: Path) -> None:
    done = measure(cart, "--engine", "pymunk.tuned", "--rounds", 1, "--steps", 1, "--csv")
    (row,) = csv.DictReader(io.StringIO(done.stdout))
    assert (row["case"], row["engine"], row["setting"]) == ("cart", "pymunk", "tuned")
    assert float(row["samples"]) > 0
    assert float(row["samples_spread"]) == 0  # of one round


ANOTHER = "the plain loop makes another motion"
OTHER = Row("cart", "toy", "tuned", "law", apart=0.03, because=ANOTHER)


def test_another_motion_is_said_and_fails(monkeypatch: pytest.MonkeyPatch, cart: Path) -> None:
    assert table.line(OTHER) == f"  toy.tuned (law)           {ANOTHER}, 3e-02 apart"
    monkeypatch.setattr(adapters, "rows", lambda *given: [OTHER])
    assert measure(cart).exit_code == 1


def test_a_long_reason_stays_in_the_terminal() -> None:
    row = Row("cart", "toy", "tuned", "native", because="refused: adapter: " + 30 * "too long ")
    assert len(table.line(row)) <= 80
    assert "refused: adapter: too long" in table.line(row)


def test_the_book_has_no_loop() -> None:
    done = measure("growing_force", "--engine", "book")
    assert done.exit_code == 2
    assert "no engine below them" in done.output


def measured(setting: str, realised: str, size: float) -> Row:
    of = {name: Ratio(size, 0.0) for name in ("samples", "recorded", "building")}
    return Row("a", "toy", setting, realised, 1e-6, **of, apart=0.0)  # type: ignore[arg-type]


def test_the_summary_has_each_kind_once() -> None:
    """What a law costs is no cost of recording; what was not compared is in none."""
    found = [measured("shipped", "native", 1.0), measured("tuned", "native", 1.2)]
    found += [measured("tuned", "law", 3.0), OTHER]
    assert [line.split() for line in table.summary(found)][2] == [
        "toy", "1.10", "(1.20)", "3.00", "(3.00)", "–", "1.10", "(1.20)", "1.20", "(3.00)",
    ]  # fmt: skip


def test_the_reference_says_which_of_scipys_was_best() -> None:
    rows = [
        Compared("four_bar", 1e-9, 0.02, "LSODA", Ratio(0.6, 0.01)),
        Compared("rhombus", 1e-9, 0.02, "none of scipy's reaches it", None),
    ]
    lines = list(table.reference(rows))
    assert max(map(len, lines)) <= 80
    assert lines[1].split() == ["aim", "0.50"]
    assert lines[2].split() == ["four_bar", "1e-09", "20.0", "ms", "LSODA", "0.60", "±0.01"]
    assert lines[3].endswith("none of scipy's reaches it")


def test_growth_stands_beside_its_bound_and_a_refusal_in_words() -> None:
    rows = [Grown("chain of 10 bars", 1.23, 60.0), Grown("too many", 0.1, 2.0, "9 samples " * 20)]
    lines = list(table.growth(rows))
    assert max(map(len, lines)) <= 80
    assert lines[1].split() == ["chain", "of", "10", "bars", "1.2", "60"]
    assert lines[2].split() == ["too", "many", "0.1", "2"]
    assert lines[3].startswith("    9 samples 9 samples")
