"""Arguments and options that several commands have, said in the same words."""

from collections.abc import Callable
from typing import Any

import click

Decorated = Callable[[Any], Any]

named_cases = click.argument("cases", nargs=-1, metavar="[CASES]...")
jobs = click.option(
    "--jobs", type=click.IntRange(min=1), help="Processes; as many as cores by default."
)
no_cache = click.option(
    "--no-cache",
    is_flag=True,
    help="Compute everything anew. Else results lie in $TEXTMECH_CACHE, by default "
    "~/.cache/textmech, and are used while nothing they depend on has changed.",
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
        metavar="shipped|tuned|FILE",
        help=f"Only this setting; a FILE of your own engine options {becomes}. May be repeated.",
    )
