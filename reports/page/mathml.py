"""A line of a docstring as MathML: `J_O φ̈ = −m g (l/2) cos φ [rad/s²], (1,).`

Letters become identifiers, with their dots, primes, indices and exponents; what is a word stays
text. Nothing is understood, only set: an unknown sign is an operator.
"""

import re
import unicodedata
from html import escape

FUNCTIONS = frozenset(
    ("sin", "cos", "tan", "cot", "arccos", "arcsin", "arctan", "atan", "sinh", "cosh", "tanh",
     "exp", "log", "ln", "sqrt", "arg", "sign", "max", "min", "sn", "cn", "dn", "cd", "det",
     "Re", "Im")
)  # fmt: skip
SUBSCRIPTS = {
    ord(a): b for a, b in zip("₀₁₂₃₄₅₆₇₈₉₊₋ᵢⱼₖₐᵦᵣₓₛₜₙ", "0123456789+−ijkaβrxstn", strict=True)
}
SUPERSCRIPTS = {ord(a): b for a, b in zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᵀᵃᵇⁿᵗᵢ", "0123456789+−Tabnti", strict=True)}
MARKS = "\u0307\u0308\u0303\u0304\u0302"  # dots, tilde, bar, hat

LOW = "".join(map(chr, SUBSCRIPTS))
HIGH = "".join(map(chr, SUPERSCRIPTS)).replace("ᵢ", "")
BASE = rf"(?:[^\W\d_{LOW}{HIGH}])"
WORD = r"[A-Za-z]{2,}"
TOKEN = re.compile(
    rf"(?P<word>{WORD}(?![{MARKS}_{LOW}]))"
    rf"|(?P<name>{BASE}[{MARKS}]*)"
    r"|(?P<number>\d+(?:\.\d+)?)"
    r"|(?P<space>\s+)"
    r"|(?P<sign>.)"
)
AFTER = re.compile(
    rf"(?P<primes>[′']*)(?:(?P<low>[{LOW}]+)|_(?:\{{(?P<braced>[^}}]*)\}}|(?P<one>(?:(?![{HIGH}])\w)+)))?"
    rf"(?P<more>[′']*)(?P<high>[{HIGH}]*)(?:\^(?:\{{(?P<over>[^}}]*)\}}|(?P<up>[−\w])))?"
)
CLOSING = ")]}|∞"
FENCES = "()[]{}|"
SPACE = '<mspace width="0.4em"/>'
APPLIED = '<mo>&#x2061;</mo><mspace width="0.17em"/>'


def mathml(line: str) -> str:
    """One `<math>` element; all that was markup in the line is escaped."""
    return f'<math display="inline">{_row(unicodedata.normalize("NFD", line))}</math>'


def _row(text: str) -> str:
    out: list[str] = []
    place = 0
    while place < len(text):
        found = TOKEN.match(text, place)
        if found is None:
            break
        place = found.end()
        element = _element(found)
        if element and (found["name"] or found["number"] or found[0] in CLOSING or _named(found)):
            after = AFTER.match(text, place)
            if after and after[0]:
                element, place = _scripted(element, after), after.end()
        out.append(element)
    return "".join(out)


def _named(found: re.Match[str]) -> bool:
    return found["word"] in FUNCTIONS


def _element(found: re.Match[str]) -> str:
    text = found[0]
    if found["space"]:
        return ""
    if found["word"]:
        if text in FUNCTIONS:
            return f'<mi mathvariant="normal">{text}</mi>{APPLIED}'
        return f"<mtext>&#xA0;{escape(text)}&#xA0;</mtext>"
    if found["number"]:
        return f"<mn>{text}</mn>"
    if found["name"]:
        letter = escape(unicodedata.normalize("NFC", text))
        # As one letter with its dots: as an accent beside it they are lost where no font for
        # mathematics is installed. Such a letter is not slanted by itself.
        return f"<mi>{letter}</mi>" if len(text) == 1 else f'<mi class="dotted">{letter}</mi>'
    stretchy = ' stretchy="false"' if text in FENCES else ""
    return f"<mo{stretchy}>{escape(text)}</mo>{SPACE if text in ',;' else ''}"


def _scripted(element: str, after: re.Match[str]) -> str:
    """The element with what stands below and above it."""
    low = (after["low"] or "").translate(SUBSCRIPTS) or after["braced"] or after["one"] or ""
    high = (after["high"] or "").translate(SUPERSCRIPTS) or after["over"] or after["up"] or ""
    primes = len(after["primes"] + after["more"]) * "′"
    above = (f"<mo>{primes}</mo>" if primes else "") + (_row(high) if high else "")
    below = f"<mrow>{_row(low)}</mrow>" if low else ""
    base, tail = _split(element)
    if below and above:
        return f"<msubsup>{base}{below}<mrow>{above}</mrow></msubsup>{tail}"
    if below:
        return f"<msub>{base}{below}</msub>{tail}"
    return f"<msup>{base}<mrow>{above}</mrow></msup>{tail}" if above else element


def _split(element: str) -> tuple[str, str]:
    """A function's name, and what joins its argument to it."""
    name = element.removesuffix(APPLIED)
    return (name, APPLIED) if name != element else (element, "")
