"""Every command and every program in the READMEs runs, and every link leads somewhere."""

import json
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from given.command import textmech

from textmech import engines
from textmech.reports.front.cli import command
from textmech.reports.tables import write

ROOT = Path(__file__).parents[1]
FOLDERS = (".", "cases", "cases/questions", "reference", "engines", "reports", "tests")
FILES = {
    path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
    for folder in FOLDERS
    for path in sorted((ROOT / folder).glob("*.md"))
}
TEXT, REPORTS = FILES["README.md"], FILES["reports/README.md"]
LINES, BYTES = 200, 13_000  # what a newcomer reads at once
LONG = ("textmech run", "pytest cases")  # minutes each, and only parsed
ELSEWHERE = ("textmech versions", "pip")  # they ask a package index
KINDS = {"textmech", "make", "pip", "pytest"}


def fenced(kind: str, *texts: str) -> list[str]:
    """The blocks of a kind, of the texts in turn."""
    pattern = re.compile(rf"^```{kind}\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
    return [block for text in texts for block in pattern.findall(text)]


def plain(text: str) -> str:
    """Without its blocks."""
    return re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)


def commands(block: str) -> list[str]:
    """The lines of a shell's block, without what is said of them."""
    return [line.partition("  #")[0].strip() for line in block.splitlines()]


SHELL = [commands(block) for block in fenced("(?:sh|shell)", TEXT, REPORTS)]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A user's, with the case and the settings of the README."""
    case, settings = fenced("yaml", TEXT)
    (tmp_path / "my_case.yaml").write_text(case, encoding="utf-8")
    (tmp_path / "mine.yaml").write_text(settings, encoding="utf-8")
    robot = ROOT / "cases" / "models" / "acrobot.xml"
    shutil.copyfile(robot, tmp_path / "robot.xml")
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
        if line in LONG or line.startswith(ELSEWHERE):
            only_parsed(line)
        elif line.startswith("pytest"):
            by_pytest(line, folder)
        elif line.startswith("make"):
            by_make(line)
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
@pytest.mark.parametrize(
    "program", fenced("python", TEXT, REPORTS), ids=lambda text: text.split("\n")[0]
)
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
    (said,) = re.findall(rf"^\| `?{name}`? \| (.*) \|$", REPORTS, flags=re.MULTILINE)
    words = words if name.startswith("any") else [name, *words]
    found = json.loads(textmech(*words, "--json", folder=folder).stdout)
    assert re.findall(r"`(\w+)`", said) == list(found)


@pytest.mark.parametrize("name", FILES)
def test_commands_within_a_sentence_have_these_options(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    for line in re.findall(r"`(textmech [a-z][^`]+)`", plain(FILES[name])):
        only_parsed(line.replace("\n", " ").replace("FILE", "mine.yaml"))


def anchors(text: str) -> set[str]:
    """What a page makes of its headings."""
    headings = re.findall(r"^#+ (.*)$", plain(text), flags=re.MULTILINE)
    return {re.sub(r"[^\w -]", "", h.lower()).replace(" ", "-") for h in headings}


def astray(name: str, text: str) -> list[str]:
    """The links of a file that lead nowhere."""
    links = re.findall(r"\]\(([^)]+)\)", re.sub(r"`[^`]*`", "", plain(text)))
    return [link for link in links if not leads(name, *link.partition("#")[::2])]


def leads(name: str, link: str, anchor: str) -> bool:
    path = (ROOT / name).parent / link if link else ROOT / name
    if not path.is_file() or not path.resolve().is_relative_to(ROOT):
        return bool(link) and path.is_dir() and not anchor
    return not anchor or anchor in anchors(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", FILES)
def test_links_lead_somewhere(name: str) -> None:
    assert not astray(name, FILES[name])


def test_a_link_astray_is_seen() -> None:
    good = "[a](#files) [b](../README.md#folders) [c](../cases) [d](README.md#exit-codes)"
    assert astray("reports/README.md", "## Files\n" + good.replace("#files", "")) == []
    bad = ["#gone", "gone.md", "../README.md#gone", "../cases#gone", "../../../etc/hosts"]
    assert astray("reports/README.md", " ".join(f"[x]({link})" for link in bad)) == bad


def test_the_first_page_leads_to_all_others() -> None:
    seen, new = set[str](), {"README.md"}
    while new:
        seen |= new
        links = {
            ((ROOT / name).parent / link.partition("#")[0]).resolve()
            for name in new
            for link in re.findall(r"\]\(([^)]+\.md[^)]*)\)", FILES[name])
        }
        new = {path.relative_to(ROOT).as_posix() for path in links} - seen
    assert seen == set(FILES)


@pytest.mark.parametrize("name", ["README.md", "reports/README.md", "cases/questions/README.md"])
def test_lines_of_text_are_short(name: str) -> None:
    """A table's and a block's are as long as they are."""
    lines = plain(FILES[name]).splitlines()
    assert not [line for line in lines if len(line) > 120 and line[:1] not in "|<!"]


def test_the_first_page_is_short() -> None:
    assert TEXT.count("\n") <= LINES
    assert len(TEXT.encode()) <= BYTES


def test_its_versions_and_steps_are_those_of_the_package() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    told = TEXT.replace("\n", " ")
    assert f"Python ≥ {project['requires-python'].removeprefix('>=')}" in told
    for name, shown in (("mujoco", "MuJoCo"), ("pymunk", "pymunk")):
        (least,) = (d for d in project["dependencies"] if d.startswith(f"{name}>="))
        assert f"{shown} ≥ {least.partition('>=')[2]}" in told
    steps = {name: engines.make(name, "shipped").own_step for name in ("mujoco", "pymunk")}
    assert steps == {"mujoco": 2e-3, "pymunk": 1e-2}
    assert "MuJoCo's step is 2 ms; pymunk has none of its own, we take 10 ms" in told
