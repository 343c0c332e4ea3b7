"""Every command and every program in the README runs, and every link leads somewhere."""

import json
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from given.command import textmech

from textmech.reports.cli import command

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
PARSED = {"textmech run", "textmech bench"}  # they take minutes


def fenced(kind: str) -> list[str]:
    """The blocks of a kind."""
    return re.findall(rf"^```{kind}\n(.*?)^```$", TEXT, flags=re.DOTALL | re.MULTILINE)


def commands() -> Iterator[str]:
    """Each line of the shell's blocks once, without what is said of it."""
    lines = [line for block in fenced("sh") for line in block.splitlines()]
    yield from dict.fromkeys(line.partition("  #")[0].strip() for line in lines)


def of(program: str) -> list[str]:
    return [line for line in commands() if line.split()[0] == program]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A user's, with the case and the settings of the README."""
    case, settings = fenced("yaml")
    (tmp_path / "my_case.yaml").write_text(case, encoding="utf-8")
    (tmp_path / "mine.yaml").write_text(settings, encoding="utf-8")
    return tmp_path


def test_nothing_else_is_in_the_shells_blocks() -> None:
    assert {line.split()[0] for line in commands()} == {"textmech", "make", "pip", "pytest"}


@pytest.mark.whole
@pytest.mark.parametrize("line", of("textmech"))
def test_a_command_runs(line: str, folder: Path) -> None:
    _, name, *words = shlex.split(line)
    if line in PARSED:
        assert command.commands[name].make_context(name, words) is not None
        return
    done = textmech(name, *words, folder=folder)
    assert done.returncode == 0, done.stderr
    assert done.stdout


@pytest.mark.whole
@pytest.mark.parametrize("line", of("pytest"))
def test_a_case_is_tested(line: str, folder: Path) -> None:
    words = [sys.executable, "-m", *shlex.split(line), "-p", "no:cacheprovider"]
    done = subprocess.run(words, capture_output=True, text=True, cwd=folder, check=False)
    assert done.returncode == 0, done.stdout
    assert "passed" in done.stdout


@pytest.mark.parametrize("line", of("make"))
def test_a_target_of_make_exists(line: str) -> None:
    (target,) = line.split()[1:]
    assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text(), flags=re.MULTILINE)


@pytest.mark.whole
@pytest.mark.parametrize("program", fenced("python"), ids=lambda text: text.split("\n")[0])
def test_a_program_runs(program: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    exec(compile(program, "README.md", "exec"), {})


@pytest.mark.whole
def test_the_first_command_prints_what_stands_below_it() -> None:
    first = TEXT.split("<!-- first: ")[1].split("<!-- /first -->")[0]
    table = first.split("```\n")[1]
    assert table.count("\n") > 2
    assert table in textmech("run", "four_bar").stdout


@pytest.mark.whole
@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("run", ["my_case.yaml", "--engine", "mujoco.tuned"]),
        ("check", ["my_case.yaml"]),
        ("list", ["four_bar"]),
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
