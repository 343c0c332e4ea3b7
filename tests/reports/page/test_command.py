"""`textmech page` and `textmech plot`, as a person types them."""

import re
from pathlib import Path

import pandas as pd
import pytest
from given.command import NEW, textmech

from textmech import engines
from textmech.reports.output import write

PNG = b"\x89PNG\r\n"


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


@pytest.mark.slow
def test_a_page_of_ones_own_case_comes_with_its_reports(cart: Path, tmp_path: Path) -> None:
    before = [file.read_bytes() for file in sorted(write.HERE.glob("*.csv"))]
    done = textmech("page", cart, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "written to textmech-page/index.html\n"
    out = tmp_path / "textmech-page"
    assert {file.name for file in out.iterdir()} == {*write.FILES, "index.html"}
    text = (out / "index.html").read_text(encoding="utf-8")
    assert re.findall(r'<details class="case" id="([^"]*)">', text) == ["cart"]
    assert "A bar that hangs on a cart" in text
    assert [file.read_bytes() for file in sorted(write.HERE.glob("*.csv"))] == before


@pytest.mark.slow
def test_a_run_writes_the_page_of_its_reports(cart: Path, tmp_path: Path) -> None:
    """It is the one that `textmech page` makes of them."""
    one = ("--engine", "mujoco.tuned")
    done = textmech("run", cart, *one, "--out", "o", "--page", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    again = textmech("page", cart, *one, "--out", "p", folder=tmp_path)
    assert again.returncode == 0, again.stderr
    assert {file.name for file in (tmp_path / "o").iterdir()} == {*write.FILES, "index.html"}
    for file in (tmp_path / "o").iterdir():
        assert file.read_bytes() == (tmp_path / "p" / file.name).read_bytes()


def test_a_run_that_writes_nothing_has_no_page(cart: Path, tmp_path: Path) -> None:
    done = textmech("run", cart, "--page", folder=tmp_path)
    assert done.returncode == 2
    assert "--page stands beside the CSV files, and needs --out" in done.stderr


@pytest.mark.slow
def test_ones_own_settings_are_a_column(cart: Path, tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text("mujoco: {integrator: RK4}\n", encoding="utf-8")
    words = ("page", cart, "--settings", "mine.yaml", "--settings", "shipped", "--out", "o")
    done = textmech(*words, "--engine", "mujoco", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "o" / "index.html").read_text(encoding="utf-8")
    heads = re.findall(r'<th scope="row">(mujoco[^<]*)</th>', text)
    assert heads == ["mujoco shipped", "mujoco mine"]


@pytest.mark.slow
def test_a_file_with_mistakes_is_left_out_and_told(cart: Path, tmp_path: Path) -> None:
    (tmp_path / "bad.yaml").write_text(NEW.replace("mass: 2.0", "mass: -2"), encoding="utf-8")
    words = ("page", cart, tmp_path / "bad.yaml", "--engine", "mujoco.tuned", "--out", "o")
    done = textmech(*words, folder=tmp_path)
    assert done.returncode == 2
    assert "bad.yaml:5:" in done.stderr
    assert "left out" in done.stderr
    assert (tmp_path / "o" / "index.html").is_file()


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
