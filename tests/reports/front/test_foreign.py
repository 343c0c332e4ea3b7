"""A folder from elsewhere may hold anything: nothing outside of it is touched, nor what is not ours
in it, and who only reads writes nothing at all."""

import errno
import os
import re
import shutil
import stat
import subprocess
import sys
from collections.abc import Callable
from dataclasses import fields
from dataclasses import replace as changed
from pathlib import Path

import pytest
from given.command import NEW, textmech
from given.command.report_folders import ROW, report
from given.command.trees import digest
from given.otherwise import otherwise
from matplotlib.figure import Figure

from textmech.reports.front.page.paint import save
from textmech.reports.tables import ownership
from textmech.reports.tables import replace as replacing
from textmech.reports.tables.ownership import unasked
from textmech.reports.tables.replace import replace
from textmech.reports.tables.row import Comparison
from textmech.reports.tables.write import FILES, read

VICTIM = "what must stay\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A report beside a file that must stay."""
    (tmp_path / "victim.txt").write_text(VICTIM, encoding="utf-8")
    (tmp_path / "victims").mkdir()
    (tmp_path / "victims" / "names").write_text(VICTIM, encoding="utf-8")
    return report(tmp_path / "in" / "reports")


def linked(path: Path, to: Path) -> None:
    path.unlink()
    path.symlink_to(to)


@pytest.mark.parametrize("to", ["victims", "victim.txt", "nowhere"])
def test_a_folder_of_ours_that_leads_elsewhere_is_not_written_through(
    to: str, folder: Path
) -> None:
    """Somebody may have put it where a killed run leaves one."""
    above = folder.parents[1]
    (folder / replacing.MAKING).symlink_to(above / to)
    before = (above / "victim.txt").read_bytes(), digest(above / "victims")
    with pytest.raises(FileExistsError):
        replace(folder, {"tolerance.csv": "new"})
    assert ((above / "victim.txt").read_bytes(), digest(above / "victims")) == before
    assert sorted(path.name for path in above.iterdir()) == ["in", "victim.txt", "victims"]


@pytest.mark.parametrize("name", ["../../victim.txt", "/tmp/victim.txt", "..", ".", ""])
def test_a_name_that_leads_elsewhere_is_refused(name: str, folder: Path) -> None:
    with pytest.raises(OSError, match="is no file's name"):
        replace(folder, {name: "new"})


def test_what_stands_in_a_files_place_is_replaced_and_never_written_through(folder: Path) -> None:
    linked(folder / "tolerance.csv", folder.parents[1] / "victim.txt")
    replace(folder, {"tolerance.csv": "new"})
    assert (folder.parents[1] / "victim.txt").read_text() == VICTIM
    assert not (folder / "tolerance.csv").is_symlink()


@pytest.mark.parametrize("make", [os.mkfifo, lambda path: os.symlink("/dev/zero", path)])
def test_a_pipe_or_device_in_a_files_place_hangs_nothing(
    make: Callable[[Path], None], folder: Path
) -> None:
    (folder / "tolerance.csv").unlink()
    make(folder / "tolerance.csv")
    if not (folder / "tolerance.csv").is_symlink():
        with pytest.raises(OSError, match="is no file"):
            replace(folder, {"tolerance.csv": "new"})
    assert stat.S_ISCHR(os.stat("/dev/zero").st_mode)


READING = {
    "diff": lambda f, other: ("diff", f, other, "--json"),
    "diff --markdown": lambda f, other: ("diff", other, f, "--markdown"),
    "check": lambda f, other: ("check", f / "cart.yaml"),
    "list": lambda f, other: ("list",),
    "show": lambda f, other: ("show", f / "cart.yaml", "--engine", "mujoco.shipped"),
    "run": lambda f, other: ("run", f / "cart.yaml", "--engine", "mujoco.shipped"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", READING)
def test_who_reads_writes_nothing(name: str, folder: Path, tmp_path: Path) -> None:
    """Into the folder, beside it, or anywhere below, whatever an interrupted run has left there."""
    (folder / "cart.yaml").write_text(NEW, encoding="utf-8")
    (folder / replacing.MAKING).mkdir()
    (folder / replacing.MAKING / "tolerance.csv").write_text("half")
    other = report(tmp_path / "other", rows=[changed(ROW, error=3e-3)])
    before = digest(tmp_path)
    folder.chmod(0o555)
    try:
        done = textmech(*READING[name](folder, other), folder=folder)
    finally:
        folder.chmod(0o755)
    assert done.returncode in (0, 1), done.stderr
    assert digest(tmp_path) == before


def test_a_folder_that_was_left_between_two_runs_is_read_as_neither(
    folder: Path, tmp_path: Path
) -> None:
    """Of files half of which a killed run has replaced: said, and not settled."""
    other = report(tmp_path / "other", rows=[changed(ROW, error=3e-3)])
    for name in FILES[:2]:
        shutil.copy(other / name, folder / name)
    assert "or of another run" in textmech("diff", folder, other).stderr
    with pytest.raises(ValueError, match="or of another run"):
        read(folder / "tolerance.csv", Comparison)
    replace(folder, {name: (other / name).read_bytes() for name in FILES})  # the next run
    assert textmech("diff", folder, other).stdout.strip().endswith("nothing changed")


@pytest.mark.parametrize("to", ["/dev/zero", "/dev/stdin", "/proc/kmsg", "/dev/full", "."])
def test_a_table_that_leads_to_a_device_hangs_nothing(
    to: str, folder: Path, tmp_path: Path
) -> None:
    """Some say that they are files, as those of /proc."""
    linked(folder / "tolerance.csv", Path(to))
    done = textmech("diff", folder, report(tmp_path / "other"))
    assert done.returncode == 2
    assert re.search(r"tolerance\.csv:(\d+:)* ", done.stderr)  # kmsg may have lines to read


@pytest.mark.mutant("a table that only begins like a report counts as ours")
def test_a_report_with_a_column_of_somebodys_own_is_not_overwritten(tmp_path: Path) -> None:
    head = ",".join(column.name for column in fields(Comparison))
    (tmp_path / "tolerance.csv").write_text(f"{head},mine\n", encoding="utf-8")
    with pytest.raises(FileExistsError, match="was not written by textmech"):
        ownership.unasked(tmp_path, ["tolerance.csv"], overwrite=False)
    begins = otherwise(ownership, "first in _REPORTS or", "first.startswith(tuple(_REPORTS)) or")
    begins.unasked(tmp_path, ["tolerance.csv"], overwrite=False)


@pytest.mark.parametrize("head", ["state", "t [s]", "state,capital"])
def test_a_table_that_has_our_first_column_alone_is_not_overwritten(
    head: str, tmp_path: Path
) -> None:
    (tmp_path / "u.csv").write_text(f"{head}\nOhio\n", encoding="utf-8")
    with pytest.raises(FileExistsError, match="was not written by textmech"):
        ownership.unasked(tmp_path, ["u.csv"], overwrite=False)


@pytest.mark.slow
@pytest.mark.mutant("a picture overwrites a file that is not ours")
@pytest.mark.parametrize("name", ["a.svg", "a.png", "A.PNG"])
def test_a_picture_overwrites_no_stranger(name: str, tmp_path: Path) -> None:
    file = tmp_path / name
    Figure().savefig(file)  # anybody's
    before = file.read_bytes()
    refused = textmech("plot", "four_bar", "-o", file)
    assert (refused.returncode, refused.stdout) == (2, "")
    assert f"{name}: was not written by textmech" in refused.stderr
    assert file.read_bytes() == before
    unasked(tmp_path, [name], overwrite=True)
    save(Figure(), file)
    unasked(tmp_path, [name], overwrite=False)


@pytest.mark.mutant("a picture is written through a link")
def test_a_picture_is_written_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    link, precious = tmp_path / "a.svg", tmp_path / "precious.txt"
    precious.write_text("mine", encoding="utf-8")
    link.symlink_to(precious)
    save(Figure(), link)
    assert precious.read_text(encoding="utf-8") == "mine"
    assert not link.is_symlink()
    before = link.read_bytes()

    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Figure, "savefig", full)
    with pytest.raises(OSError, match="No space"):
        save(Figure(), link)
    assert link.read_bytes() == before


def test_a_strangers_table_beside_a_report_is_not_compared(tmp_path: Path, folder: Path) -> None:
    """`run --out` leaves it alone, and so does who reads."""
    (folder / "mine.csv").write_text("a,b\n1\n", encoding="utf-8")
    os.mkfifo(folder / "pipe.csv")
    (folder / "drawer.csv").mkdir()
    done = textmech("diff", folder, report(tmp_path / "other"))
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip().endswith("nothing changed")


@pytest.mark.slow
def test_a_refused_command_leaves_no_empty_folder(tmp_path: Path) -> None:
    command = [sys.executable, "-c", "from textmech.reports.front.start import main; main()", "run"]
    for words in (["nope.yaml"], ["bar_pendulum", "--engine", "nope"]):
        done = subprocess.run(
            [*command, *words, "--out", "new/one/more"], cwd=tmp_path, check=False, timeout=60,
            capture_output=True, text=True,
        )  # fmt: skip
        assert done.returncode == 2, done.stderr
        assert [*tmp_path.iterdir()] == []


# What textmech did not write is never overwritten unasked.

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
        ownership.unasked(folder, ["tolerance.csv"], overwrite=False)
    ownership.unasked(folder, ["sound.csv", "events.csv", "not there.csv"], overwrite=False)


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
