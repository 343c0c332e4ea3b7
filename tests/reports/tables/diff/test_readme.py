"""What reports/README.md says of comparing versions runs as it stands there."""

import re
import shlex
from pathlib import Path

import pytest
from given.command import NEW, textmech
from ruamel.yaml import YAML

from textmech.reports.front.cli import command
from textmech.reports.tables import run_list, write
from textmech.reports.tables.diff.columns import Rule

README = (write.HERE / "README.md").read_text(encoding="utf-8")
TEXT = README.partition("## Compare two versions\n")[2].partition("\n## ")[0]


def blocks(kind: str) -> list[str]:
    return re.findall(rf"^```{kind}\n(.*?)^```$", TEXT, flags=re.DOTALL | re.MULTILINE)


def words(line: str) -> list[str]:
    """Of a command of ours, without what is said of it or done with it."""
    name, *rest = shlex.split(re.split(r"  #| \|\| | >> ", line)[0])
    assert name == "textmech"
    return rest


@pytest.mark.slow
def test_two_folders_are_compared(tmp_path: Path) -> None:
    lines = blocks("shell")[0].splitlines()
    assert len(lines) == 4
    for line in lines:
        done = textmech(*words(line), folder=tmp_path)
        assert done.returncode == 0, done.stderr


def test_commands_that_take_long_have_these_options(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_case.yaml").write_text(NEW, encoding="utf-8")
    job = YAML(typ="safe").load(blocks("yml")[0])["jobs"]["textmech"]
    steps = [step["run"] for step in job["steps"] if "run" in step]
    lines = [*blocks("shell")[1].splitlines(), *(s for s in steps if s.startswith("textmech"))]
    assert len(lines) == 5
    for line in lines:
        name, *rest = words(line)
        assert command.commands[name].make_context(name, rest) is not None


def test_its_numbers_are_the_rules() -> None:
    rule = Rule()
    told = TEXT.replace("\n", " ")
    assert f"more than {rule.moved:.1%}".replace("%", " %") in told
    assert f"more than {rule.floor:.0e}".replace("e-06", "e-6") in told
    assert f"error {rule.worse} times as large and above 1e-3" in told
    assert rule.matters == 1e-3


def test_what_it_says_of_releases_is_in_the_table() -> None:
    rows = run_list.table(write.HERE / "versions.csv")
    crank = {
        (row["version"], row["setting"]): row["error"]
        for row in rows
        if (row["case"], row["engine"]) == ("four_bar", "mujoco")
        and row["quantity"] == "crank.angle"
    }
    assert (crank["3.6.0", "shipped"], crank["3.7.0", "shipped"]) == ("4.19", "2.08")
    assert float(crank["3.6.0", "tuned"]) == pytest.approx(0.017, rel=0.05)
    assert float(crank["3.7.0", "tuned"]) == pytest.approx(2e-8, rel=0.2)
    told = {(row["engine"], row["version"]) for row in rows}
    assert len(told) == 10
