"""cases/GLOSSARY.md has few words, each of them in the code or at the head of a table."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
ROWS = re.findall(
    r"^\| (\w+) \| (.+) \|.*\|$", (ROOT / "cases/GLOSSARY.md").read_text("utf-8"), re.M
)
MOST = 40


def lacking(words: list[str]) -> list[str]:
    """The words that are in no module, and name no column of a table."""
    files = [f for room in ("cases", "reference", "engines", "reports") for f in _texts(room)]
    text = " ".join(files)
    return [word for word in words if not re.search(rf"\b{word}\b", text)]


def _texts(room: str) -> list[str]:
    heads = [f.read_text("utf-8").partition("\n")[0] for f in (ROOT / room).glob("*.csv")]
    return [f.read_text("utf-8") for f in (ROOT / room).rglob("*.py")] + heads


def test_a_newcomer_can_read_it_at_once() -> None:
    words = [word for word, _ in ROWS[1:]]
    assert 30 <= len(words) == len({*words}) <= MOST


def test_every_word_is_one_of_ours() -> None:
    assert lacking([word for word, _ in ROWS[1:]]) == []
    assert lacking(["case", "hyperparameter"]) == ["hyperparameter"]
