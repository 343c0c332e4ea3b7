"""The MJCF file that a user pastes: the scene at its start, headed by comments."""

import re
from collections.abc import Iterable, Sequence

from ...cases.scene import Scene
from ..engine import Choice, Start
from .scene import mjcf


def text(
    scene: Scene,
    start: Start,
    choices: Iterable[Choice],
    begun: tuple[Sequence[float], Sequence[float]],
    head: Iterable[str],
) -> str:
    """The file; head: its comments."""
    return commented(head) + mjcf(scene, start, choices, begun)


def commented(head: Iterable[str]) -> str:
    """Lines as comments, in which two hyphens would end one."""
    return "".join(f"<!-- {re.sub('-(?=-)', '- ', line)} -->\n" for line in head)
