"""The page as text: the same bytes every time, whole by itself, and no text of a case is markup."""

import gzip
import json
import re
from base64 import b64decode
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import unquote

import pytest

from textmech.cases.case import Case
from textmech.reports.batch.suite import Report
from textmech.reports.output import write
from textmech.reports.output.write import FILES
from textmech.reports.page.folder import BESIDE, Missing, folder
from textmech.reports.page.motions import motions
from textmech.reports.page.page import embedded, page

LARGEST = 3_000_000  # bytes: what a person waits for
VOID = {"meta", "link", "input", "br", "img", "hr"}


class Parsed(HTMLParser):
    """Elements in their order, whether each is closed, and what they refer to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wrong: list[str] = []
        self.names: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        told = dict(attrs)
        self.names.append(tag)
        self.ids += [told["id"] or ""] if "id" in told else []
        self.links += [told[name] or "" for name in ("href", "src") if name in told]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


@pytest.fixture(scope="module")
def parsed(made: SimpleNamespace) -> Parsed:
    return Parsed(made.text)


def data(text: str, name: str) -> Any:
    """What a script element of the page holds, as its script unpacks it."""
    (packed,) = re.findall(rf'<script type="text/plain" id="{name}">([^<]*)</script>', text)
    return json.loads(gzip.decompress(b64decode(packed, validate=True)))


@pytest.mark.slow
def test_the_same_rows_and_motions_give_the_same_bytes(made: SimpleNamespace) -> None:
    assert page(made.folder, made.cases, made.motions) == made.text
    assert data(made.text, "motions") == json.loads(json.dumps(made.motions))


@pytest.mark.slow
def test_the_page_of_the_committed_rows_is_small_and_the_same_every_time(
    whole: Path, report: Report, shipped: list[Case]
) -> None:
    """It is not committed: everyone who builds it gets these bytes."""
    text = whole.read_text(encoding="utf-8")
    assert len(text.encode()) <= LARGEST
    assert set(data(text, "motions")) == {case.name for case in shipped if case.states is None}
    assert page(folder(write.HERE), shipped, motions(report)) == text


def test_every_element_is_closed_and_has_a_name_of_its_own(parsed: Parsed) -> None:
    assert parsed.wrong == []
    assert parsed.open == []
    assert len(parsed.ids) == len(set(parsed.ids))


def test_links_stay_within_the_file(parsed: Parsed) -> None:
    for link in parsed.links:
        place = unquote(link.partition("?")[0])
        assert place.startswith("data:,") or place[1:] in parsed.ids, link


def test_a_title_is_text_wherever_it_stands(made: SimpleNamespace, parsed: Parsed) -> None:
    assert "&lt;script&gt;window.struck" in made.text
    assert "<script>window.struck" not in made.text
    assert parsed.names.count("script") == 3  # motions, rows, ours
    assert "<i>nothing cures it</i>" not in made.text  # nor is that of a table beside


def test_words_in_the_data_close_no_script(made: SimpleNamespace) -> None:
    words = {"because": "</script><script><!-- \u2028"}
    assert not set(embedded(words)) & set("<>&")
    assert json.loads(gzip.decompress(b64decode(embedded(words)))) == words
    assert data(made.text, "rows")["cases"].keys() == {"swing", made.odd}


def test_powers_of_ten_are_written_in_one_style(made: SimpleNamespace) -> None:
    """As the page's script writes them: 2e-7 and 2e3, in all that is read."""
    shown = re.sub(r"<(style|script|svg).*?</\1>", "", made.text, flags=re.DOTALL)
    assert "1.2e-5" in shown
    assert not re.search(r"\de(\+|-0)\d", shown)


def test_tables_beside_the_reports_are_shown(made: SimpleNamespace) -> None:
    assert "pymunk: {error_bias: 0.0}" in made.text
    assert "bias + step" in made.text
    shares = made.text.partition('id="versions"')[2].partition("</section>")[0]
    assert shares.index("3.9.0") < shares.index("3.10.0") < shares.index("4.0.0")
    assert "The 1 rows that moved" not in shares
    assert "The row that moved" in shares


@pytest.mark.slow
def test_what_is_not_there_is_said_in_a_sentence(made: SimpleNamespace) -> None:
    bare = SimpleNamespace(**{**vars(made.folder), "beside": {}})
    text = page(bare, made.cases, made.motions)  # type: ignore[arg-type]
    for name, words in BESIDE.items():
        assert f"There is no {name} beside these reports; {words}" in text


def test_a_folder_without_reports_says_so(tmp_path: Path) -> None:
    with pytest.raises(Missing, match=r"has no tolerance\.csv, .* `textmech run --out"):
        folder(tmp_path)


def test_tables_beside_are_read_as_they_are_written(made: SimpleNamespace, tmp_path: Path) -> None:
    """With no digit changed; those of the run itself come first."""
    here, there = tmp_path / "here", tmp_path / "there"
    for place in (here, there):
        place.mkdir()
        (place / "advice.csv").write_text(f"case,step\n{place.name},1.0e-3\n")
    (there / "versions.csv").write_text("case\na\n")
    for name in FILES:
        (here / name).write_bytes((made.place / name).read_bytes())
    found = folder(here, beside=there).beside
    assert found["advice.csv"].to_numpy().tolist() == [["here", "1.0e-3"]]
    assert found["versions.csv"].to_numpy().tolist() == [["a"]]


def test_a_cut_table_is_told(made: SimpleNamespace, tmp_path: Path) -> None:
    for file in made.place.glob("*.csv"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    cut = (tmp_path / "tolerance.csv").read_text().splitlines()
    (tmp_path / "tolerance.csv").write_text("\n".join([*cut[:2], *cut[3:]]) + "\n")
    with pytest.raises(ValueError, match="cut, or changed by hand"):
        folder(tmp_path)
