"""What textmech did not write is never overwritten unasked, and no case's files by another's."""

from pathlib import Path

import pytest
from given.command import NEW, textmech
from given.report_folders import report
from given.trees import digest

from textmech.reports.data import ownership as ours

STRANGE = {
    "run": ("tolerance.csv", ("run", "cart.yaml", "--out", "o")),
    "keep": ("cart.csv", ("run", "cart.yaml", "--keep", "o")),
    "keep's events": ("cart.events.csv", ("run", "cart.yaml", "--keep", "o")),
    "page": ("index.html", ("page", "cart.yaml", "--out", "o")),
    "page's reports": ("events.csv", ("page", "cart.yaml", "--out", "o")),
    "advise": ("advice.csv", ("advise", "cart.yaml", "--out", "o")),
    "versions": ("versions.csv", ("versions", "pymunk==1.0", "cart.yaml", "--out", "o")),
}


@pytest.mark.mutant("a stranger's file is overwritten")
@pytest.mark.parametrize("name", STRANGE)
def test_a_strangers_file_is_never_overwritten_unasked(name: str, tmp_path: Path) -> None:
    """And that is said before the work."""
    (tmp_path / "cart.yaml").write_text(NEW, encoding="utf-8")
    file, words = STRANGE[name]
    (tmp_path / "o").mkdir()
    (tmp_path / "o" / file).write_text("mine, mine\n1, 2\n", encoding="utf-8")
    before = digest(tmp_path, folders_dates=False)  # whether it can be written to is tried
    done = textmech(*words, folder=tmp_path)
    assert done.returncode == 2
    assert f"o/{file}: was not written by textmech, and would be overwritten" in done.stderr
    assert "say --overwrite; nothing was written" in done.stderr
    assert "engines" not in done.stderr
    assert digest(tmp_path, folders_dates=False) == before


ONE = ("--engine", "mujoco.shipped")


@pytest.mark.slow
def test_what_we_wrote_is_overwritten_and_a_strangers_if_asked(tmp_path: Path) -> None:
    """Of reports, of what is kept, of a page: each is known as ours again."""
    (tmp_path / "cart.yaml").write_text(NEW, encoding="utf-8")
    run = ("run", "cart.yaml", *ONE, "--out", "o", "--keep", "k")
    page = ("page", "cart.yaml", *ONE, "--out", "p")
    for _ in range(2):
        for words in (run, page):
            done = textmech(*words, folder=tmp_path)
            assert done.returncode == 0, done.stderr
    for file in ("o/tolerance.csv", "k/cart.csv", "p/index.html"):
        (tmp_path / file).write_text("mine\n", encoding="utf-8")
    for words in (run, page):
        assert textmech(*words, folder=tmp_path).returncode == 2
        assert textmech(*words, "--overwrite", folder=tmp_path).returncode == 0
    assert "mine\n" not in [f.read_text(errors="replace") for f in tmp_path.glob("?/*.*")]


def test_a_link_is_no_file_of_ours(tmp_path: Path) -> None:
    """It may lead to one: what it leads to stays, but whose is the link?"""
    folder = report(tmp_path / "reports")
    (folder / "tolerance.csv").rename(folder / "sound.csv")
    (folder / "tolerance.csv").symlink_to("sound.csv")
    with pytest.raises(FileExistsError, match="is a link"):
        ours.unasked(folder, ["tolerance.csv"], overwrite=False)
    ours.unasked(folder, ["sound.csv", "events.csv", "not there.csv"], overwrite=False)


def test_two_cases_that_would_be_kept_in_one_file_are_refused_before_the_work(
    tmp_path: Path,
) -> None:
    (tmp_path / "cart.yaml").write_text(NEW, encoding="utf-8")
    (tmp_path / "cart.events.yaml").write_text(NEW, encoding="utf-8")
    words = ("run", "cart.yaml", "cart.events.yaml", *ONE, "--keep", "o")
    done = textmech(*words, folder=tmp_path)
    assert done.returncode == 2
    assert "cart.events.csv would be kept of 'cart' and of 'cart.events': rename" in done.stderr
    assert "engines" not in done.stderr
    assert list((tmp_path / "o").iterdir()) == []
