"""Every command and every program in the README runs, and every link leads somewhere."""

import json
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from given.command import textmech

from textmech.reports import write
from textmech.reports.cli import command

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
LONG = ("textmech run", "textmech bench")  # they take minutes, and are only parsed
ELSEWHERE = ("textmech versions", "pip")  # they ask a package index
KINDS = {"textmech", "make", "pip", "pytest"}


def fenced(kind: str) -> list[str]:
    """The blocks of a kind."""
    return re.findall(rf"^```{kind}\n(.*?)^```$", TEXT, flags=re.DOTALL | re.MULTILINE)


def commands(block: str) -> list[str]:
    """The lines of a shell's block, without what is said of them."""
    return [line.partition("  #")[0].strip() for line in block.splitlines()]


SHELL = [commands(block) for block in (*fenced("sh"), *fenced("shell"))]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A user's, with the case and the settings of the README."""
    case, settings = fenced("yaml")
    (tmp_path / "my_case.yaml").write_text(case, encoding="utf-8")
    (tmp_path / "mine.yaml").write_text(settings, encoding="utf-8")
    return tmp_path


def test_nothing_else_is_in_the_shells_blocks() -> None:
    assert {line.split()[0] for block in SHELL for line in block} == KINDS


@pytest.fixture
def committed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A copy of the committed reports: what writes beside them by default, writes there."""
    copy = shutil.copytree(
        write.HERE,
        tmp_path / "reports",
        ignore=lambda _, names: [name for name in names if not name.endswith((".csv", ".html"))],
    )
    monkeypatch.setattr(write, "by_default", lambda: copy)


@pytest.mark.slow
@pytest.mark.usefixtures("committed")
@pytest.mark.parametrize("block", SHELL, ids=lambda block: block[0])
def test_commands_run_one_after_another(block: list[str], folder: Path) -> None:
    for line in block:
        if line.startswith("pytest"):
            by_pytest(line, folder)
        elif line.startswith("make"):
            by_make(line)
        elif line in LONG or line.startswith(ELSEWHERE):
            only_parsed(line)
        else:
            done = textmech(*shlex.split(line)[1:], folder=folder)
            assert done.returncode == 0, done.stderr
            assert done.stdout


def by_pytest(line: str, folder: Path) -> None:
    words = [sys.executable, "-m", *shlex.split(line), "-p", "no:cacheprovider"]
    done = subprocess.run(words, capture_output=True, text=True, cwd=folder, check=False)
    assert done.returncode == 0, done.stdout
    assert "passed" in done.stdout


def by_make(line: str) -> None:
    (target,) = line.split()[1:]
    assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text(), flags=re.MULTILINE)


def only_parsed(line: str) -> None:
    program, name, *words = shlex.split(line)
    if program == "textmech":
        assert command.commands[name].make_context(name, words) is not None


@pytest.mark.slow
@pytest.mark.parametrize("program", fenced("python"), ids=lambda text: text.split("\n")[0])
def test_a_program_runs(program: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    exec(compile(program, "README.md", "exec"), {})


@pytest.mark.slow
def test_the_first_command_prints_what_stands_below_it() -> None:
    first = TEXT.split("<!-- first: ")[1].split("<!-- /first -->")[0]
    table = first.split("```\n")[1]
    assert table.count("\n") > 2
    assert table in textmech("run", "four_bar").stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("run", ["my_case.yaml", "--engine", "mujoco.tuned"]),
        ("check", ["my_case.yaml"]),
        ("list", ["four_bar"]),
        ("causes", ["my_case.yaml", "--engine", "pymunk"]),
        ("advise", ["my_case.yaml", "--engine", "pymunk"]),
        ("any, if it ends before that", ["run", "my_cse.yaml"]),
    ],
)
def test_the_keys_of_json_are_those_it_names(name: str, words: list[str], folder: Path) -> None:
    (said,) = re.findall(rf"^\| `?{name}`? \| (.*) \|$", TEXT, flags=re.MULTILINE)
    words = words if name.startswith("any") else [name, *words]
    found = json.loads(textmech(*words, "--json", folder=folder).stdout)
    assert re.findall(r"`(\w+)`", said) == list(found)


def test_links_lead_somewhere() -> None:
    headings = re.findall(r"^#+ (.*)$", TEXT, flags=re.MULTILINE)
    anchors = {re.sub(r"[^\w -]", "", h.lower()).replace(" ", "-") for h in headings}
    links = re.findall(r"\]\(([^)]+)\)", TEXT)
    assert len(links) > 5
    for link in links:
        file, _, anchor = link.partition("#")
        assert (ROOT / file).exists(), link
        assert file or anchor in anchors, link


def test_lines_of_text_are_short() -> None:
    """A table's and a block's are as long as they are."""
    plain = re.sub(r"^```.*?^```$", "", TEXT, flags=re.DOTALL | re.MULTILINE)
    long = [line for line in plain.splitlines() if len(line) > 120 and line[:1] not in "|<!"]
    assert not long
