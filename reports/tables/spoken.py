"""Words of the tables as they are said to a person: a table's own are one word each, and stay."""

from .row import BEYOND, DEVIATES, REFUSED

WORDS = {
    BEYOND: "too far off",
    DEVIATES: "off as declared",
    REFUSED: "not supported",
    "declared": "off as declared",
    "audit": "model check",
    "native": "",
    "law": "our force law",
    "driver": "our force law and loop",
}
"""Of verdicts, of the audit, and of the ways in which an engine is run."""
SETTINGS = {"shipped": "defaults", "recommended": "its manual’s", "tuned": "best found"}


def spoken(word: str) -> str:
    """Returns a table's word as it is said to a person; most stay as they are written."""
    return WORDS.get(word, word)
