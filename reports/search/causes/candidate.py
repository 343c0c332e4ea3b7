"""A candidate in a search: options of an engine, and a step."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .... import engines
from ....engines.engine import Engine
from ....engines.knobs import Options

TRIED = "tried"  # the setting's name


@dataclass(frozen=True)
class Candidate:
    """Options as a user would write them, and the step [s]; equal where these are."""

    text: str  # the options as JSON
    step: float

    @staticmethod
    def of(options: Options, step: float) -> "Candidate":
        return Candidate(json.dumps(options, sort_keys=True), step)

    @property
    def options(self) -> Mapping[str, Any]:
        """The options without the step."""
        return json.loads(self.text)

    def engine(self, name: str) -> Engine:
        """Returns the engine with these options. Raises ValueError where it does not take them."""
        return engines.make(name, TRIED, {**self.options, "step": self.step})

    def on(self, shapes: Options) -> "Candidate":
        """The candidate with the options that build other shapes; with none itself."""
        return Candidate.of({**self.options, **shapes}, self.step) if shapes else self

    def at(self, step: float) -> "Candidate":
        """The candidate with the same options at another step [s]."""
        return Candidate(self.text, step)
