"""How large a case may be: its arrays are refused here, its time by the clock of whoever works.

A person may allow any amount of work; what nobody expected ends with a message instead of a night.
The steps of engines are counted where engines are known (reports/compare/trial/work.py).
"""

from collections.abc import Iterator, Mapping
from typing import Any

from ...scene import Scene
from ..grammar.file import File
from ..parse import Finding

LIMIT = 300.0  # s of one case, what a person waits for without having been asked
VARIANTS = 100  # each is solved and run; a sweep of more is several files
PARTS = 300  # bodies and what is between them: a chain of 100 bars has 200
ROWS = 200_000  # states of bodies: some hundred megabytes with their checks; shipped cases have 600

GO_ON = "if that is meant, go on with --allow-long (pytest: --textmech-allow-long)"


def too_many_variants(data: Mapping[str, Any]) -> str | None:
    """The mistake of too many variants in a file's data, in words; None if they are few enough."""
    given = data.get("variants")
    count = len(given) if isinstance(given, Mapping) else 0
    return _exceeds(count, VARIANTS, f"{count} variants")


def work(file: File, scene: Scene) -> Iterator[Finding]:
    """Yields what is above its limit: parts of the scene, rows of its samples or states."""
    parts, bodies = len([*scene.elements()]), len(scene.bodies)
    if what := _exceeds(parts, PARTS, f"{parts} bodies, joints, constraints, contacts and forces"):
        yield ("scene",), what
        return
    count = file.samples if file.states is None else file.states.random
    name = "samples" if file.states is None else "states"
    of = f"{count} {name} of {bodies} {'body' if bodies == 1 else 'bodies'}"
    if what := _exceeds(count * bodies, ROWS, f"{of} are {count * bodies} rows"):
        yield ("samples",) if file.states is None else ("states", "random"), what


def _exceeds(number: float, limit: float, what: str) -> str | None:
    return f"{what}, and the limit is {limit:g}: {GO_ON}" if number > limit else None
