"""pytest items from case files: one for each case × engine × setting × quantity.

Inert unless a case file is named on the command line, or `textmech_cases` in the configuration
lists some. Everything heavy is imported only then.
"""

import glob
import os
import sys
from argparse import ArgumentTypeError
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, suppress
from dataclasses import asdict, replace
from fnmatch import fnmatch
from functools import partial
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from ...cases.case import Case
    from ...cases.mistake import CaseError
    from ...cases.model_case import ModelCase
    from ..runs.suite import Report
    from ..tables.row import Certificate, Comparison
    from .collecting import Earlier

SUFFIXES = (".yaml", ".yml")
_REPORT = pytest.StashKey["Report"]()
_ROWS = pytest.StashKey[dict[tuple[str, ...], "Comparison"]]()
_EARLIER = pytest.StashKey["Earlier"]()
_FOLDER = pytest.StashKey[Path]()
_KNOWN = pytest.StashKey[set[str]]()
_ERRORS = os.dup(2) if sys.stderr is not None else -1  # before pytest takes it
TOLD = ("case", "engine", "version", "setting", "realised", "quantity", "unit", "step", "error",
        "allowed", "verdict", "because")  # fmt: skip
"""What junit's XML holds of a row, as properties."""
_LIMITS = ("TEXTMECH_TIME_LIMIT", "TEXTMECH_MEMORY_LIMIT")  # all else imports nothing of ours here
_SHARED = "textmech_shared"  # what a worker of xdist is told: the session's own folder


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds our options to pytest's: each has a name that is nobody else's."""
    parser.addini(
        "textmech_cases",
        "case files to compare engines on, as patterns of a shell (`**`: any folders)",
        "args",
        [],
    )
    parser.addini(
        "textmech_settings", "a file of your own engine options, which have to agree", None, ""
    )
    group = parser.getgroup("textmech", "comparing physics engines with textbook mechanics")
    group.addoption(
        "--textmech-engine",
        dest="textmech_engine",
        action="append",
        default=[],
        metavar="E",
        help="only this engine: mujoco, pymunk, or e.g. mujoco.tuned (may be repeated)",
    )
    group.addoption(
        "--textmech-case",
        dest="textmech_case",
        action="append",
        default=[],
        metavar="CASE",
        help="only this case or variant (may be repeated)",
    )
    group.addoption(
        "--textmech-settings",
        dest="textmech_settings",
        metavar="FILE",
        help="your own engine options, as of `textmech run --settings`: what has to agree; "
        "else the ini key textmech_settings names the file",
    )
    group.addoption(
        "--textmech-no-cache",
        dest="textmech_no_cache",
        action="store_true",
        help="compute everything anew, and take nothing from earlier runs",
    )
    group.addoption(
        "--textmech-allow-long",
        dest="textmech_allow_long",
        action="store_true",
        help="do any amount of work, and not only what takes minutes",
    )
    group.addoption(
        "--textmech-time-limit",
        dest="textmech_time_limit",
        type=_seconds,
        metavar="S",
        help="how long an engine may take for one run, beyond ten times what its steps are worth; "
        "120 s by default, or $TEXTMECH_TIME_LIMIT",
    )


def _seconds(word: str) -> float:
    """Raises ArgumentTypeError, which is a line of pytest's."""
    with suppress(ValueError):
        if 0.0 < (seconds := float(word)) < inf:
            return seconds
    raise ArgumentTypeError(f"should be a time in s above 0, is {word!r}")


def pytest_configure(config: pytest.Config) -> None:
    """Sets the time limit of a task. Raises UsageError where the option or variable is no time."""
    seconds = config.getoption("textmech_time_limit")
    if seconds is not None or any(name in os.environ for name in _LIMITS):
        from ..compare.trial.limit import choose

        try:
            choose(seconds)
        except ValueError as error:
            raise pytest.UsageError(str(error)) from None


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Tells each worker of xdist a folder that all of them share, if any makes it, until the end.

    There they find what one of them has computed where nothing may be remembered for longer.
    """
    config, stash = node.config, node.config.stash
    if not config.getini("textmech_cases") and not any(map(_is_case, config.args)):
        return
    if _FOLDER not in stash:
        from ..runs.processes.temporary_folder import temporary_folder

        folder = ExitStack()
        stash[_FOLDER] = folder.enter_context(temporary_folder("textmech-shared-"))
        config.add_cleanup(folder.close)
    node.workerinput[_SHARED] = str(stash[_FOLDER])


def pytest_sessionstart(session: pytest.Session) -> None:
    """Patterns of the ini file that find nothing must not look like a pass.

    Who names files or folders on the command line, or stands in one, has said which.
    """
    config, source = session.config, pytest.Config.ArgsSource
    if config.args_source is source.ARGS or hasattr(config, "workerinput"):
        return
    root, by_paths = config.rootpath, config.args_source is source.TESTPATHS
    walked = [(config.invocation_params.dir / argument).resolve() for argument in config.args]
    for pattern in config.getini("textmech_cases"):
        paths = [Path(file) for file in glob.glob(_from_root(pattern, config), recursive=True)]
        files = [file for file in paths if file.suffix in SUFFIXES]
        stray = next(_outside(files, walked if by_paths else [root]), None)
        if not files:
            what = f"no case file fits {pattern!r}; a pattern with a space stands in quotes"
        elif stray and by_paths:
            what = f"{stray} is below none of `testpaths`, where alone pytest looks: add it there"
        elif stray:
            what = f"{stray} is not below {root}, where alone pytest looks: name it to pytest"
        else:
            continue
        raise pytest.UsageError(f"textmech_cases: {what}")


def _outside(files: Sequence[Path], tops: Sequence[Path]) -> Iterator[Path]:
    """Yields the files that are below none of the folders, neither themselves nor by a link."""
    for file in files:
        ways = Path(os.path.normpath(file)), file.resolve()
        if not any(way.is_relative_to(top) for way in ways for top in tops):
            yield ways[0]


def _from_root(pattern: str, config: pytest.Config) -> str:
    root = glob.escape(str(config.rootpath))  # it is a folder, whatever letters it is called by
    return os.path.join(root, pattern)


def _is_case(argument: str) -> bool:
    return Path(argument.partition("::")[0]).suffix in SUFFIXES


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collects a case file that is named, or that `textmech_cases` of the configuration matches."""
    if file_path.suffix not in SUFFIXES:
        return None
    if parent.session.isinitpath(file_path) or _configured(file_path, parent.config):
        return CaseFile.from_parent(parent, path=file_path)
    return None


def _configured(file: Path, config: pytest.Config) -> bool:
    patterns = (_from_root(pattern, config) for pattern in config.getini("textmech_cases"))
    return any(_fits(file.parts, Path(os.path.normpath(pattern)).parts) for pattern in patterns)


def _fits(parts: tuple[str, ...], patterns: tuple[str, ...]) -> bool:
    """Whether a path is one of a pattern's, as a shell has them: `**` are any folders."""
    if not patterns:
        return not parts
    first, *others = patterns
    if first == "**":
        return any(_fits(parts[k:], tuple(others)) for k in range(len(parts) + 1))
    return bool(parts) and fnmatch(parts[0], first) and _fits(parts[1:], tuple(others))


def pytest_itemcollected(item: pytest.Item) -> None:
    """Remember each case that is there, whether its items are run or deselected."""
    known = item.config.stash.setdefault(_KNOWN, set[str]())
    if isinstance(item, CaseItem):
        known |= {item.case.name, item.path.stem}
    elif isinstance(item, MistakeItem):
        known.add(f"{item.path.stem} with mistakes")


def pytest_collection_finish(session: pytest.Session) -> None:
    """A case that was asked for and is in no file, or in two, must not look like a pass."""
    wanted = session.config.getoption("textmech_case") or []
    items = [item for item in session.items if isinstance(item, CaseItem)]
    known = session.config.stash.get(_KNOWN, set[str]())
    files: dict[str, Path] = {}
    for item in items:
        other = files.setdefault(item.case.name, item.path)
        if other != item.path:
            raise pytest.UsageError(f"{other} and {item.path} have one name: rename one of them")
    for name in wanted:
        if known.isdisjoint({name, f"{name.partition('.')[0]} with mistakes"}):
            raise pytest.UsageError(f"no such case in the collected files: {name!r}")


class CaseFile(pytest.File):
    """A case file: its mistakes, or the items of all its variants."""

    def collect(self) -> Iterator[pytest.Item]:
        from ...cases.load_model import has_model
        from ...cases.mistake import CaseError
        from .collecting import collected, collected_models

        option, earlier = self.config.getoption, partial(_earlier, self.session)
        long, names = bool(option("textmech_allow_long")), option("textmech_engine") or []
        wanted, own = option("textmech_case") or [], _settings(self.config)
        spare = not option("textmech_settings")  # what the ini file names may be of other engines
        try:
            cases: list[Any] = (
                [*collected_models(self.path, names, own, wanted, long=long)]
                if has_model(self.path)
                else collected(
                    self.path, names, own, wanted, earlier, long=long, spare=spare, write=_tell
                )
            )
        except CaseError as error:
            error = _as_typed(error)
            if {mistake.file for mistake in error.mistakes} == {str(self.path)}:
                yield MistakeItem.from_parent(self, name="mistakes", text=str(error))
                return
            raise self.CollectError(str(error)) from None
        for case, keys in cases:
            yield CertificateItem.from_parent(self, name=f"{case.name}-reference", case=case)
            for key in keys:
                _, engine, setting, realised, quantity = key
                how = "" if realised == "native" else f".{realised}"
                name = f"{case.name}-{engine}.{setting}{how}-{quantity}"
                yield ComparisonItem.from_parent(self, name=name, case=case, key=key)


def _as_typed(error: "CaseError") -> "CaseError":
    """Returns the mistakes, with options called as pytest's are."""
    from ...cases.mistake import CaseError

    ours = {word: f"--textmech-{word[2:]}" for word in ("--engine", "--settings")}
    return CaseError([replace(m, file=ours.get(m.file, m.file)) for m in error.mistakes])


def _settings(config: pytest.Config) -> list[str]:
    """The file of the user's own options, if there is one: named by a word, or by pytest's ini."""
    if word := config.getoption("textmech_settings"):
        return [word]
    named = config.getini("textmech_settings")
    return [str(config.rootpath / named)] if named else []


def _earlier(session: pytest.Session) -> "Earlier":
    """Returns the engines' answers to earlier sessions, the same for all files of the session."""
    from ..runs.cache.store import usable
    from .collecting import Earlier

    if _EARLIER not in session.stash:
        cached = not session.config.getoption("textmech_no_cache")
        session.stash[_EARLIER] = Earlier.of(usable() if cached else None)
    return session.stash[_EARLIER]


class MistakeItem(pytest.Item):
    """A file with mistakes: it fails, and the other files run."""

    def __init__(self, *, text: str, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.text = text

    def runtest(self) -> None:
        raise RowError(self.text)

    def repr_failure(self, excinfo: Any, style: Any = None) -> str:
        return str(excinfo.value)

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, 0, f"file {self.path.name}"


class CaseItem(pytest.Item):
    """A row of the report, run together with all others that are collected."""

    def __init__(self, *, case: "Case | ModelCase", **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.case = case

    def report(self) -> "Report":
        """Returns the report of all collected rows.

        Raises RowError with the mistakes of the item's own file, if solving found some.
        """
        from ...cases.mistake import CaseError

        report = _session_report(self.session)
        mine = [mistake for mistake in report.mistakes if mistake.file == self.case.source.file]
        if mine:
            raise RowError(str(CaseError(mine)))
        return report

    def place(self, *path: str) -> int:
        """The line of the case file, from 1, where the row's claim stands."""
        return max(self.case.mistake(path, "").line, 1)

    def repr_failure(self, excinfo: Any, style: Any = None) -> str:
        # A traceback of a finding tells nothing, and costs pytest more than the row does us.
        if isinstance(excinfo.value, RowError | pytest.xfail.Exception):
            return str(excinfo.value)
        return str(super().repr_failure(excinfo, style))


class RowError(Exception):
    """A row that FAILS, as it is to be read."""


def _size_text(row: "Comparison") -> str:
    """Returns how far off a row is, and when: the line that begins pytest's short summary.

    As `×7.92 of 0.01 rad at 2.9 s`; of what has no number its verdict and its reason.
    """
    if row.ratio is None or row.allowed is None:
        return f"{row.verdict}: {row.because}" if row.because else row.verdict
    when = "" if row.when is None else f" at {row.when:.3g} s"
    return f"×{row.ratio:.3g} of {f'{row.allowed:.3g} {row.unit}'.rstrip()}{when}"


def _row_text(row: "Comparison") -> str:
    """Returns all that is known of a row, one column a line."""
    kept = {k: v for k, v in asdict(row).items() if v not in (None, "")}
    return "\n".join(
        f"  {name:9} {value:.3g}" if isinstance(value, float) else f"  {name:9} {value}"
        for name, value in kept.items()
    )


def _certificate_text(row: "Certificate") -> str:
    """Says which check of a case's reference does not hold, and by how much."""
    return (
        f"{row.case}: the reference ({row.system}) is not certified: {row.check}: "
        f"{row.difference:.2e} is above {row.bound:.2e}"
    )


class CertificateItem(CaseItem):
    """The reference's own certificate: every check of it."""

    def runtest(self) -> None:
        rows = [row for row in self.report().certificates if row.case == self.case.name]
        if not rows:
            raise RowError("no certificate was made")
        broken = [row for row in rows if row.verdict == "FAILS"]
        if broken:
            raise RowError("\n".join(_certificate_text(row) for row in broken))

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, self.place("title") - 1, f"case {self.name}"


class ComparisonItem(CaseItem):
    """One quantity in one engine. What is a finding and no failure shows as an expected one.

    A finding that the committed reports did not have is a failure: a row that got worse.
    """

    def __init__(self, *, key: tuple[str, ...], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.key = key

    def runtest(self) -> None:
        from ..tables.committed import worse
        from ..tables.row import AGREES, DEVIATES, FAILS, REFUSED
        from .show.terminal import line

        row = self.row()
        self.user_properties += [(name, getattr(row, name)) for name in TOLD]
        if row.verdict == FAILS:
            place = f"{self.path}:{self.place('allow', row.quantity)}"
            raise RowError(f"{_size_text(row)}\n{place}: {row.quantity}\n{_row_text(row)}")
        try:
            lost = worse(self.case, row)
        except ValueError as cut:
            raise RowError(str(cut)) from None
        if lost:
            raise RowError(f"{_size_text(row)}\n{lost}\n{_row_text(row)}")
        if row.verdict not in (AGREES, DEVIATES):
            if self.promised and row.verdict != REFUSED:
                place = f"{self.path}:{self.place('allow', row.quantity)}"
                whose = f"{place}: {row.quantity}, by your own settings"
                raise RowError(f"{_size_text(row)}\n{whose}\n{_row_text(row)}")
            pytest.xfail(" ".join(line(row).split()))

    @property
    def promised(self) -> bool:
        """Whether it is of the user's own options, which have to agree wherever they run.

        So has a model of the user's own at its own setting.
        """
        from ...cases.find import is_shipped
        from ...cases.model_case import ModelCase
        from ..compare.own_steps import OWN

        own = self.key[2] in [Path(word).stem for word in _settings(self.config)]
        mine = isinstance(self.case, ModelCase) and self.key[2] == OWN
        return own or (mine and not is_shipped(self.path))

    def row(self) -> "Comparison":
        """Returns the item's row. Raises RowError where it has none."""
        from ..tables.committed import key_of

        report, stash = self.report(), self.session.stash
        if _ROWS not in stash:
            stash[_ROWS] = {key_of(row): row for row in report.comparisons}
        if self.key not in stash[_ROWS]:
            planned = "its engine told another way when it ran than when it was collected"
            raise RowError(f"{self.case.name}: {planned}")
        return stash[_ROWS][self.key]

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, self.place("allow", self.key[-1]) - 1, f"case {self.name}"


def measured(session: pytest.Session) -> "Report":
    """Returns the report of all collected rows. Raises RowError where a file has mistakes."""
    report = _session_report(session)
    if report.mistakes:
        raise RowError("\n".join(map(str, report.mistakes)))
    return report


def _session_report(session: pytest.Session) -> "Report":
    """Returns the report of all collected rows, each simulated once in the session.

    It also says what could not be simulated.
    """
    if _REPORT not in session.stash:
        session.stash[_REPORT] = _measure(session)
    return session.stash[_REPORT]


def _measure(session: pytest.Session) -> "Report":
    """Runs what is collected, or takes it from another worker of xdist, which collects the same."""
    from ...cases.model_case import ModelCase
    from .session import rows
    from .show.progress import aloud, progress

    items = [item for item in session.items if isinstance(item, CaseItem)]
    cases = {item.case.name: item.case for item in items}
    used = {
        ".".join(item.key[1:3])
        for item in items
        if isinstance(item, ComparisonItem) and not isinstance(item.case, ModelCase)
    }
    shared = getattr(session.config, "workerinput", {}).get(_SHARED)
    cached = not session.config.getoption("textmech_no_cache")
    with aloud(_tell), progress(quiet=True) as listener:
        own = _settings(session.config)
        models = [case for case in cases.values() if isinstance(case, ModelCase)]
        scenes = [case for case in cases.values() if not isinstance(case, ModelCase)]
        return rows(scenes, sorted(used), own, shared, listener, cached=cached, models=models)


def _tell(line: str) -> None:
    """Prints to the error stream, past what pytest captures; a worker of xdist has none."""
    with suppress(OSError):
        os.write(_ERRORS, f"\ntextmech: {line}\n".encode(errors="backslashreplace"))
