"""Case files as they come out of an accident: strategies that damage sound ones."""

import re
from collections.abc import Sequence

from hypothesis import strategies as st

from textmech.cases.find import shipped

TEXTS = [path.read_text(encoding="utf-8") for path in shipped().values()]
WRONG = [
    *("", "null", "[]", "{}", ".nan", ".inf", "1e999", "true", "[1, 2, 3]", "{a: 1}", "x y", "'"),
    *("&a 1", "*a", "!!set", "? a", "- 1", "---", "...", "|", ">", "::", "#", "%", "@", "\t"),
    *("ground", "ground.O", "energy.total", "unknown", "none", '"\\e[1m"', '"a\\0"', "é", "\u202e"),
]
UNITS = ["m", "kg", "deg", "rad", "N", "s", "mm", "rad/s", "rpm", "N s/m", "m^-4", "parsec"]
TOKEN = re.compile(r"\w+|\s+|[^\w\s]")
NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])")


def numbers() -> st.SearchStrategy[str]:
    """Of any size and sign, bare or with a unit that may not fit."""
    sizes = st.builds(lambda x, e: f"{x:.3g}e{e}", st.floats(-10, 10), st.integers(-40, 40))
    plain = sizes | st.integers(-10, 10**19).map(str) | st.sampled_from(WRONG)
    return plain | st.builds(lambda x, unit: f"{x} {unit}", plain, st.sampled_from(UNITS))


@st.composite
def damaged(draw: st.DrawFn, texts: Sequence[str] = TEXTS) -> bytes:
    """One of the files (the shipped ones) after one to three accidents."""
    text = draw(st.sampled_from(texts))
    accident = draw(st.sampled_from([_tokens, _lines, _numbers, _bytes]))
    content = text.encode()
    for _ in range(draw(st.integers(1, 3))):
        content = accident(draw, content)
    return content


def _replaced(draw: st.DrawFn, parts: list[str], other: st.SearchStrategy[str]) -> bytes:
    i = draw(st.integers(0, len(parts) - 1))
    part = parts[i]
    parts[i] = draw(st.sampled_from(["", part * 2, part + "x"]) | other)
    return "".join(parts).encode()


def _tokens(draw: st.DrawFn, content: bytes) -> bytes:
    parts = TOKEN.findall(content.decode())
    if not parts:  # an accident before may have left nothing
        return content
    return _replaced(draw, parts, st.sampled_from(parts) | st.sampled_from(WRONG))


def _lines(draw: st.DrawFn, content: bytes) -> bytes:
    parts = content.decode().splitlines(keepends=True)
    if not parts:
        return content
    moved = st.sampled_from(parts).map(lambda line: f"  {line}")
    return _replaced(draw, parts, st.sampled_from(parts) | moved)


def _numbers(draw: st.DrawFn, content: bytes) -> bytes:
    text = content.decode()
    found = list(NUMBER.finditer(text))
    if not found:
        return content
    match = draw(st.sampled_from(found))
    return (text[: match.start()] + draw(numbers()) + text[match.end() :]).encode()


def _bytes(draw: st.DrawFn, content: bytes) -> bytes:
    i = draw(st.integers(0, len(content)))
    new = draw(st.binary(max_size=3))
    return content[:i] + new + content[i + draw(st.integers(0, 2)) :]
