"""The page as text, and the commands that write it."""

import gzip
import json
import re
import unicodedata
from base64 import b64decode
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import unquote
from xml.etree.ElementTree import fromstring

import pandas as pd
import pytest
from given.command import NEW, textmech

from textmech import engines
from textmech.cases.case import Case
from textmech.reports.front.page.folder import BESIDE, Missing, folder
from textmech.reports.front.page.listed import _equation, equations, mathml
from textmech.reports.front.page.motions import motions
from textmech.reports.front.page.page import embedded, page
from textmech.reports.runs.selection import choose_cases
from textmech.reports.runs.suite import Report
from textmech.reports.tables import write
from textmech.reports.tables.row import MUTANTS
from textmech.reports.tables.write import FILES

# The page as text: the same bytes every time, whole by itself, and no text of a case is markup.

LARGEST = 3_000_000  # bytes: what a person waits for
VOID = {"meta", "link", "input", "br", "img", "hr", "wbr"}


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
    moving = {case.name for case in shipped if case.states is None}
    moving |= {model.case.name for model in report.models if model.steps}
    assert set(data(text, "motions")) == moving
    assert page(folder(write.HERE), shipped, motions(report), report.models) == text


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
    text = page(replace(made.folder, beside={}), made.cases, made.motions)
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


# Planted mistakes on the page: their number, beside the project's own reports.


def shown(made: SimpleNamespace, beside: dict[str, pd.DataFrame]) -> str:
    text = page(replace(made.folder, beside=beside), made.cases, made.motions)
    return text.partition('id="trust"')[2].partition("</details>")[0]


@pytest.mark.slow
def test_a_list_of_other_tests_is_counted_where_there_is_one(made: SimpleNamespace) -> None:
    frame = pd.DataFrame({"planted": ["gravity upside down", "a term left out"]})
    assert "tests plant 2: <code>" in shown(made, {MUTANTS: frame})
    assert MUTANTS not in shown(made, {})


# Equations as MathML: every letter is kept, at its place, and nothing is markup.


def told(line: str) -> str:
    return "".join(fromstring(mathml(line)).itertext()).replace("\u2061", "").replace("\xa0", " ")


def test_letters_have_their_dots_indices_and_exponents() -> None:
    found = mathml("J_O φ̈ = −m g ω₁² e_β′ sin² φ")
    assert "<msub><mi>J</mi><mrow><mi>O</mi></mrow></msub>" in found
    assert '<mi class="dotted">φ̈</mi>' in unicodedata.normalize("NFD", found)
    assert "<msubsup><mi>ω</mi><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></msubsup>" in found
    assert "<mi>β</mi></mrow><mrow><mo>′</mo></mrow></msubsup>" in found
    assert '<msup><mi mathvariant="normal">sin</mi>' in found


def test_indices_and_exponents_of_more_letters_go_together() -> None:
    assert "<mi>k</mi><mo>,</mo>" in mathml("ω_{k,k−1}")
    assert "<mrow><mn>1</mn><mo>−</mo><mi>α</mi></mrow></msup>" in mathml("v^{1−α}")
    assert mathml("ṙ_c²").count("<msubsup>") == 1
    assert '<mi mathvariant="normal">max</mi><mrow><mi>i</mi>' in mathml("max_i x")
    assert "<mrow><mn>10</mn></mrow></msup>" in mathml("v^10")
    assert "<mrow><mo>−</mo><mn>1</mn></mrow></msup>" in mathml("v^−1")


@pytest.mark.parametrize("unit", ["m²/s²", "1/s", "rad/s²", "N m"])
def test_a_unit_behind_an_equation_is_no_part_of_it(unit: str) -> None:
    found = _equation("(2.5)", f"a = b c [{unit}]")
    assert found is not None
    assert found.unit == unit
    assert "[" not in found.html


def test_what_would_be_markup_is_a_sign() -> None:
    assert told('a <b> & "c') == 'a<b>&"c'
    assert "<b>" not in mathml('a <b> & "c')


@pytest.mark.slow
def test_every_hand_written_motion_shows_its_equations(shipped: list[Case]) -> None:
    cases = [case for case in shipped if case.system and case.states is None]
    for case in cases:
        found = equations(case)
        assert found, case.name
        assert any("(2." in one.numbers for one in found), case.name
        for one in found:
            assert "`" not in one.html + one.words
            fromstring(one.html)


def test_the_pendulum_shows_its_own_equation() -> None:
    (case,) = choose_cases(["bar_pendulum"])
    first = equations(case)[0]
    assert first.numbers == "(2.34)"
    assert first.unit == "rad/s²"
    assert told_of(first.html) == "JOφ̈=−mg(l/2)cosφ"


def told_of(html: str) -> str:
    text = "".join(fromstring(html).itertext()).replace("\u2061", "")
    return unicodedata.normalize("NFD", text)


def test_what_is_generated_has_none() -> None:
    (case,) = choose_cases(["free_pair"])
    assert case.system is None
    assert equations(case) == []


# `textmech page` and `textmech plot`, as a person types them.

PNG = b"\x89PNG\r\n"


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


@pytest.mark.slow
def test_a_run_writes_the_page_of_its_reports(cart: Path, tmp_path: Path) -> None:
    """It is the one that `textmech page` makes of them."""
    one = ("--engine", "mujoco.tuned")
    done = textmech("run", cart, *one, "--out", "o", "--page", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    again = textmech("page", cart, *one, folder=tmp_path)
    assert again.returncode == 0, again.stderr
    assert again.stdout == "written to textmech-page/index.html\n"
    assert {file.name for file in (tmp_path / "o").iterdir()} == {*write.FILES, "index.html"}
    for file in (tmp_path / "o").iterdir():
        assert file.read_bytes() == (tmp_path / "textmech-page" / file.name).read_bytes()


def test_a_run_that_writes_nothing_has_no_page(cart: Path, tmp_path: Path) -> None:
    done = textmech("run", cart, "--page", folder=tmp_path)
    assert done.returncode == 2
    assert "--page stands beside the CSV files, and needs --out" in done.stderr


def test_where_there_are_no_reports_it_says_which_command_writes_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(write, "by_default", lambda: tmp_path / "nothing")
    done = textmech("page", "--out", tmp_path / "o", folder=tmp_path)
    assert done.returncode == 2
    assert "has no tolerance.csv" in done.stderr
    assert "textmech run --out" in done.stderr
    assert "done" not in done.stderr  # before minutes of work


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cart.png", "CART.SVG"])
def test_a_plot_is_what_its_name_says(cart: Path, tmp_path: Path, name: str) -> None:
    words = ("plot", cart, "--engine", "mujoco.tuned", "--quantity", "rod.angle", "-o", name)
    done = textmech(*words, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"written to {name}: rod.angle\n"
    found = (tmp_path / name).read_bytes()
    if name.endswith("png"):
        assert found.startswith(PNG)
    else:
        assert b"rod.angle" in found  # text stays text
        assert b"<dc:date>" not in found
        again = textmech(*words, folder=tmp_path)
        assert again.returncode == 0
        assert (tmp_path / name).read_bytes() == found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("cart.yaml", "-o", "cart.gif"), "cart.gif is no picture that can be drawn: .png or .svg"),
        (("cart.yaml", "-o", "no/cart.png"), "there is no folder no"),
        (("cart.yaml",), "Missing option '-o'"),
        (("sliding_block", "-o", "x.png"), "has variants; plot one of: sliding_block.below"),
        (("cart.yaml", "--quantity", "rod.angel", "-o", "x.png"), "did you mean 'rod.angle'?"),
        (("four_bra", "-o", "x.png"), "did you mean 'four_bar'?"),
        (("robot_states", "-o", "x.png"), "is a claim about states: nothing moves"),
    ],
)
def test_what_cannot_be_plotted_is_told(
    cart: Path, tmp_path: Path, words: tuple[str, ...], told: str
) -> None:
    done = textmech("plot", *words, "--engine", "mujoco.tuned", folder=tmp_path)
    assert done.returncode == 2
    assert told in done.stderr
    assert not list(tmp_path.glob("x.png"))


@pytest.mark.slow
def test_kept_poses_are_one_long_table_with_units(cart: Path, tmp_path: Path) -> None:
    words = ("run", cart, "--engine", "mujoco", "--keep", "k")
    done = textmech(*words, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    (file,) = (tmp_path / "k").glob("cart.poses.*")
    read = pd.read_parquet if file.suffix == ".parquet" else pd.read_csv
    frame = read(file)
    assert set(frame["engine"]) == {"reference", "mujoco"}
    units = dict(zip(frame["field"], frame["unit"], strict=True))
    assert units == {"x": "m", "y": "m", "angle": "rad"}
    settings = engines.settings("mujoco")
    assert len(frame) == (1 + len(settings)) * 2 * 3 * 6  # runs, bodies, fields, samples
    begins = frame[(frame["t [s]"] == 0) & (frame["body"] == "rod") & (frame["field"] == "angle")]
    assert begins["value"].tolist() == pytest.approx([-0.6981317] * (1 + len(settings)))
