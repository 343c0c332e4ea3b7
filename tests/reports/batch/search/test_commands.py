"""`textmech causes` and `textmech advise` as a user meets them, with a case of one's own."""

import json
from pathlib import Path

import pytest
from given.command import NEW, process

from textmech.reports.data.row import Advice
from textmech.reports.output import write


@pytest.fixture
def new(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


@pytest.mark.slow
def test_causes_of_ones_own_case(new: Path) -> None:
    done = process("causes", new, "--no-cache", folder=new.parent)
    assert done.returncode == 0, done.stderr
    assert "cart in pymunk.shipped" in done.stdout
    assert "the cost" in done.stdout
    assert [file.name for file in new.parent.iterdir()] == ["cart.yaml"]


@pytest.mark.slow
def test_causes_for_scripts(new: Path) -> None:
    words = (new, "--json", "--no-cache")
    done, run = process("causes", *words), process("run", "--causes", *words)
    found = json.loads(done.stdout)
    assert (found["mistakes"], found["exit_code"]) == ([], 0)
    assert {"case": "cart", "engine": "pymunk", "setting": "shipped"}.items() <= found["causes"][
        -1
    ].items()
    assert json.loads(run.stdout)["causes"] == found["causes"]


@pytest.mark.slow
def test_what_is_advised_for_ones_own_case_keeps_its_promise(new: Path) -> None:
    """The printed settings, pasted into a file, bring every row within its tolerance."""
    done = process("advise", new, "--engine", "pymunk", "--no-cache", folder=new.parent)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    words = [lines[i + 1] for i, line in enumerate(lines) if "as a file of --settings" in line]
    assert words
    for word in words:  # the fewest changes, and the cheapest
        own = new.with_name("own.yaml")
        own.write_text(word.strip(), encoding="utf-8")
        run = process("run", new, "--engine", "pymunk", "--settings", own, folder=new.parent)
        tables = run.stdout.split("\ncart in ")
        (rows,) = [part for part in tables if part.split("\n")[0].count(" own")]
        assert rows.count(" agrees") >= 2
        assert "beyond" not in rows.split("\n\n")[0]


@pytest.mark.slow
def test_scripts_read_rows(new: Path, tmp_path: Path) -> None:
    done = process(
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


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [(), ("bar_pendulum", "--all"), ("bar_pendulum", "--margin", "0.5")]
)
def test_mistaken_words_are_told(words: tuple[str, ...], tmp_path: Path) -> None:
    done = process("advise", *words, folder=tmp_path)
    assert done.returncode == 2
    assert "Error" in done.stderr
