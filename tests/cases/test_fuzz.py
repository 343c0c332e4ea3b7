"""However a shipped case file is mangled, `load` gives cases or a CaseError."""

import random
import re
from pathlib import Path

import pytest

from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.mistake import CaseError

_JUNK = ["", "null", "[]", "{}", "-1", ".nan", "1e999", "x y", "&a 1", "*a", "!!set", "'", "0 m"]


def mangled(text: str, chance: random.Random) -> str:
    """The text with one to three of its tokens deleted, renamed, doubled or replaced."""
    tokens = re.findall(r"\w+|\s+|[^\w\s]", text)
    for _ in range(chance.randint(1, 3)):
        i = chance.randrange(len(tokens))
        other = chance.choice(tokens)
        tokens[i] = chance.choice(["", tokens[i] + "x", tokens[i] * 2, other, chance.choice(_JUNK)])
    return "".join(tokens)


@pytest.mark.slow
def test_mangled(tmp_path: Path) -> None:
    chance = random.Random(1)
    texts = [path.read_text(encoding="utf-8") for path in shipped().values()]
    path = tmp_path / "case.yaml"
    refused = 0
    for _ in range(300):
        path.write_text(mangled(chance.choice(texts), chance), encoding="utf-8")
        try:
            load(path, systems={"four_bar": ("m", "a", "b", "c", "d", "crank0")})
        except CaseError as error:
            refused += len(error.mistakes) > 0
    assert 150 < refused < 300
