"""The option `--json`: a command answers with one document, whatever becomes of it."""

from collections.abc import Callable
from functools import wraps
from typing import Any

import click

from ...cases.mistake import CaseError

FAILED = 1
BAD_INPUT = 2


def as_json(command: Callable[..., None]) -> Callable[..., None]:
    """Adds the option, as `wants_json`; mistakes that end the command are its document then."""

    @wraps(command)
    def answered(*args: Any, wants_json: bool, **kwargs: Any) -> None:
        try:
            command(*args, wants_json=wants_json, **kwargs)
        except CaseError as error:
            if not wants_json:
                raise
            from ..show import document

            found = document.mistakes(error.mistakes)
            document.write({"mistakes": found, "exit_code": BAD_INPUT})
            raise click.exceptions.Exit(BAD_INPUT) from None

    what = "Print one JSON document, for scripts."
    return click.option("--json", "wants_json", is_flag=True, help=what)(answered)
