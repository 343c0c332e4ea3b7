"""Arguments and options that several commands have, said in the same words."""

from collections.abc import Callable
from typing import Any

import click

from ..data.ownership import OVERWRITE
from ..system.limit import choose

Decorated = Callable[[Any], Any]

named_cases = click.argument("cases", nargs=-1, metavar="[CASES]...")


processes = click.option(
    "--jobs", type=click.IntRange(min=1), help="Processes; as many as cores by default."
)


def _chosen(context: click.Context, option: click.Parameter, seconds: float | None) -> None:
    try:
        choose(seconds)
    except ValueError as error:
        if str(error).startswith("$"):  # of the environment
            raise click.UsageError(str(error), context) from None
        raise click.BadParameter(str(error), context, option) from None


def jobs(command: Any) -> Any:
    """How the work is spread over processes, and how long one of them may take for a task."""
    decorated = click.option(
        "--time-limit",
        type=click.FloatRange(min=0, min_open=True),
        expose_value=False,
        callback=_chosen,
        metavar="S",
        help="How long an engine may take for one run, beyond ten times what its steps are worth; "
        "120 s by default, or $TEXTMECH_TIME_LIMIT.",
    )(command)
    return processes(decorated)


no_cache = click.option(
    "--no-cache",
    is_flag=True,
    help="Compute everything anew. Else results lie in $TEXTMECH_CACHE, by default "
    "~/.cache/textmech, and are used while nothing they depend on has changed.",
)
overwrite = click.option(
    f"--{OVERWRITE}",
    is_flag=True,
    help="Overwrite files of the names that are written there which textmech did not write.",
)
allow_long = click.option(
    "--allow-long", is_flag=True, help="Do any amount of work, and not only what takes minutes."
)


def named_engines(beside: str = "") -> Decorated:
    """The option that chooses engines; beside: what else it takes."""
    return click.option(
        "--engine",
        "names",
        multiple=True,
        metavar="E",
        help=f"An installed engine, as mujoco, pymunk; {beside}or with its setting, as "
        "mujoco.tuned. May be repeated.",
    )


def own_settings(becomes: str = "stands beside them, by its name") -> Decorated:
    """The option for one setting alone; becomes: what a file of own options does."""
    return click.option(
        "--settings",
        multiple=True,
        metavar="shipped|recommended|tuned|FILE",
        help=f"Only this setting; a FILE of your own engine options {becomes}. May be repeated.",
    )
