"""The comments of the MJCF file that a user pastes."""

import re
from collections.abc import Iterable


def commented(head: Iterable[str]) -> str:
    """Lines as comments, in which two hyphens would end one."""
    return "".join(f"<!-- {re.sub('-(?=-)', '- ', line)} -->\n" for line in head)
