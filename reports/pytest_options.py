"""Adds our options to pytest's: each has a name that is nobody else's."""

from argparse import ArgumentTypeError
from contextlib import suppress
from math import inf

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
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
