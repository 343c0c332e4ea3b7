"""The list of planted mistakes: it is what the tests plant now, and no run has to do with it."""

import ast
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pandas as pd
import planted
import pytest
from given.command.report_folders import report
from given.command.tree import TESTS

from textmech.reports.front.page.folder import folder
from textmech.reports.tables import write
from textmech.reports.tables.diff.columns import Rule
from textmech.reports.tables.diff.compare import difference
from textmech.reports.tables.diff.folder import opened
from textmech.reports.tables.row import MUTANTS, OF_NO_RUN, Comparison

COMMITTED = write.HERE / MUTANTS
LONGEST = 110  # letters of a mistake: it is a name, and no explanation
# Their names say that they plant, and they do not.
SOUND = {"test_every_parameter_has_a_mutant", "test_the_laws_hold_where_nothing_is_planted"}


def rows() -> pd.DataFrame:
    return pd.read_csv(COMMITTED, dtype=str, keep_default_na=False)


@pytest.mark.slow
def test_the_committed_list_is_what_the_tests_plant() -> None:
    """Collected in a process of its own, whatever this session collects, and once."""
    told = {key: value for key, value in os.environ.items() if key != "PYTEST_ADDOPTS"}
    words = [sys.executable, str(planted.ROOT / "tests" / "planted.py"), "--print"]
    done = subprocess.run(words, capture_output=True, check=False, cwd=planted.ROOT, env=told)
    assert done.returncode == 0, done.stderr.decode()
    now = done.stdout.decode()
    assert now == COMMITTED.read_text(encoding="utf-8"), "run `python tests/planted.py`"


def test_each_says_in_words_what_is_wrong() -> None:
    told = rows()
    assert len(told) > 700
    assert not told.duplicated().any()
    for row in told.to_dict("records"):
        words = row["planted"]
        assert len(words.split()) >= 2, row
        assert len(words) <= LONGEST, row
        assert not [odd for odd in ("<", " at 0x", "\n", "{}") if odd in words], row
        assert (planted.ROOT / "tests" / row["room"]).is_dir()


@pytest.mark.slow
def test_what_is_called_a_mutant_is_marked() -> None:
    unmarked = set()
    for file in TESTS:
        for node in ast.parse(file.read_text(encoding="utf-8")).body:
            if not isinstance(node, ast.FunctionDef) or not node.name.startswith("test_"):
                continue
            marks = " ".join(map(ast.unparse, node.decorator_list))
            plants = any(word in node.name for word in ("mutant", "planted", "mistake_is_seen"))
            if plants and file.parent != planted.ROOT / "tests" and "mark.mutant(" not in marks:
                unmarked.add(node.name)
    assert unmarked == SOUND


class Heavy:
    """J 5 % too large. And more is said of it."""


def upside_down(g: float) -> float:
    return -g


def lost(g: float) -> float:
    """A term that is lost."""
    return 0.0 * g


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("a lost drive", "a lost drive"),
        (Heavy, "J 5 % too large"),
        (upside_down, "upside down"),
        (lost, "a term that is lost"),
        ({"accelerations": lost, "U": upside_down}, "a term that is lost, upside down"),
        ({"d": -0.5}, "d -0.5"),
        (("a", (6, 4)), "a 6 4"),
    ],
)
def test_a_parameter_says_itself(value: Any, words: str) -> None:
    assert planted.worded(value) == words


def item(test: str, *words: str, slow: bool = False, **params: Any) -> Any:
    """A collected test with the mark."""
    marks = [SimpleNamespace(args=words)]
    return SimpleNamespace(
        nodeid=f"tests/engines/{test}",
        callspec=SimpleNamespace(params=params),
        iter_markers=lambda name: marks if name == planted.MARK else [],
        get_closest_marker=lambda name: slow if name == planted.SLOW else None,
    )


def test_a_row_is_a_mistake_of_a_test_and_not_each_of_its_parameters() -> None:
    found = planted.listed(
        [
            item("test_b.py::test_seen[one-x]", "{wrong} lost in {where}", wrong="J", where=Heavy),
            item("test_a.py::test_seen[x]", "γ of {kind.name} lost", "no γ", kind=Heavy),
            item("test_a.py::test_seen[y]", "γ of {kind.name} lost", slow=True, kind=Heavy),
            item("test_a.py::test_long", "no γ", slow=True),
        ]
    )
    assert found.to_numpy().tolist() == [
        ["engines", "no γ", "tests/engines/test_a.py::test_long", "slow"],
        ["engines", "no γ", "tests/engines/test_a.py::test_seen", "quick"],
        ["engines", "γ of Heavy lost", "tests/engines/test_a.py::test_seen", "quick"],
        ["engines", "J lost in J 5 % too large", "tests/engines/test_b.py::test_seen", "quick"],
    ]


def test_who_plants_and_says_nothing_is_told() -> None:
    with pytest.raises(ValueError, match="does not say what it plants"):
        planted.listed([item("test_a.py::test_seen")])


@pytest.fixture
def list_beside() -> Callable[[Path], Path]:
    def copied(place: Path) -> Path:
        (place / MUTANTS).write_bytes(COMMITTED.read_bytes())
        return place

    return copied


def test_a_run_beside_it_neither_reads_nor_deletes_it(
    tmp_path: Path, list_beside: Callable[[Path], Path]
) -> None:
    place = list_beside(report(tmp_path / "here"))
    report(place)
    assert (place / MUTANTS).read_bytes() == COMMITTED.read_bytes()
    assert write.read(place / "tolerance.csv", Comparison)
    assert len(folder(place).beside[MUTANTS]) == len(rows())


@pytest.mark.parametrize("name", OF_NO_RUN)
@pytest.mark.parametrize("text", ["", "cut", None])
def test_a_diff_does_not_look_at_it(
    name: str, text: str | None, tmp_path: Path, list_beside: Callable[[Path], Path]
) -> None:
    """Whether one folder has none, or what is no table; nor at those that were drawn by chance."""
    old, new = list_beside(report(tmp_path / "old")), report(tmp_path / "new")
    if text is not None:
        (new / name).write_text(text, encoding="utf-8")
    before, after = opened({"OLD": old, "NEW": new})
    found = difference(before, after, Rule())
    assert (found.alone, found.changes) == ((), ())
    assert not {*OF_NO_RUN} & found.counts.keys()
