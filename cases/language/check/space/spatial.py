"""All that must fit together in a scene in space beside what must in the plane."""

from collections.abc import Iterator
from typing import Any

from ...parse import Finding, Parsed
from .axis import turns_freely
from .blade import blades
from .drive import drives
from .roll import rolls
from .start import starts


def spatial(parsed: Parsed, scene: Any) -> Iterator[Finding]:
    """Every mistake in the sound parts that only a scene in space can have."""
    for check in (turns_freely, rolls, drives, blades):
        yield from check(parsed, scene)
    for key in ("initial", "near"):
        yield from starts(parsed, scene, key)
