"""A list says of each case what the case says of itself, though it reads less of the file."""

from pathlib import Path

import pytest

from textmech.cases import titled as listing
from textmech.cases.find import is_shipped, shipped
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.titled import titled


def said(file: Path) -> list[tuple[object, ...]]:
    return [(one.name, one.title, one.origin, one.file) for one in titled(file)]


@pytest.mark.mutant("a list of a file reads no variants")
@pytest.mark.slow
def test_a_list_says_what_the_cases_say(monkeypatch: pytest.MonkeyPatch) -> None:
    for file in shipped().values():
        assert said(file) == [(c.name, c.title, c.origin, c.source.file) for c in load(file)]
    monkeypatch.setattr(listing, "SAID", ("title", "source", ""))
    many = shipped()["rolling_wheel"]
    assert len(said(many)) == 1 < len(load(many))


@pytest.mark.parametrize(
    ("head", "key"),
    [
        ("title: [a]\nsource: {figure: 3}", "title"),
        ("title: a\nsource: {figure: 3}", "source.figure"),
        ("title: a\nsource: {example: {}}", "source.example"),
        ("title: a\nsource: a", "source"),
        ("title: a\nsource: {example: '2.1'}\nvariants: [b]", "variants"),
    ],
)
def test_a_list_of_a_mistaken_file_says_where(head: str, key: str, tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(f"scene: {{bodies: {{}}}}\n{head}\n", encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        titled(file)
    assert key in {m.where for m in caught.value.mistakes}


def test_a_shipped_file_is_told_by_its_place(tmp_path: Path) -> None:
    assert all(map(is_shipped, shipped().values()))
    mine = tmp_path / "four_bar.yaml"
    mine.write_bytes(shipped()["four_bar"].read_bytes())
    (tmp_path / "cases").symlink_to(shipped()["four_bar"].parent)
    assert not is_shipped(mine)
    assert is_shipped(tmp_path / "cases" / "four_bar.yaml")
    assert not is_shipped(shipped()["four_bar"].with_name("no_such_case.yaml"))
