"""Lists what people ask in public: the case that answers, in a line, and the setting it takes."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from ...engines.knobs import as_text

LISTED = Path(__file__).parents[1] / "questions.yaml"
WORDS = {
    "shipped": "as shipped",
    "law": "none: only our law beside it",
}
"""What may stand in place of own options, and what is said of it."""


@dataclass(frozen=True)
class Question:
    """A question, its answer, and with what each engine agrees: own options, or one of WORDS."""

    asks: str
    answer: str
    settings: Mapping[str, Mapping[str, Any] | str]


def listed() -> Mapping[str, Question]:
    """By the name of the case that answers, in the order in which they are to be read."""
    found = YAML(typ="safe").load(LISTED.read_text(encoding="utf-8"))
    return {name: Question(q["asks"], q["answer"], q["with"]) for name, q in found.items()}


def questions() -> list[list[str]]:
    """Lines of cells, the head first."""
    lines = [["question", "case", "answer", "setting"]]
    for name, question in listed().items():
        settings = (_setting(e, s) for e, s in question.settings.items())
        case = f"[`{name}`]({name}.yaml)"
        lines.append([question.asks, case, question.answer, "<br>".join(settings)])
    return lines


def _setting(engine: str, setting: Mapping[str, Any] | str) -> str:
    """A file of settings, whole, or in words."""
    if isinstance(setting, str):
        return f"{engine}: {WORDS[setting]}"
    return f"`{engine}: {as_text(setting)}`"
