"""Makes others' text fit for a table: one line, short, and nothing that no file can hold."""

from ....cases.fields.text import no_formula
from . import limit

MOST = 300  # letters: a row is read


def spelled(text: object, most: int = MOST) -> str:
    """The text in one line, what cannot be printed spelled out, and no longer than so.

    In quotes where it begins as a formula does: a spreadsheet would compute it.
    """
    said = _as_text(text)
    size = len(said)
    # Of a megabyte only what can be shown is looked at.
    line = " ".join(said[: 4 * most].split())
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line)
    if size > 4 * most or len(line) > most:
        line = f"{line[:most]}… ({size} letters)"
    return line if no_formula(line or ".") is None else f"'{line}'"


def why(error: BaseException) -> str:
    """The error's type and message in one line, whatever they are, with the limit of memory."""
    held = limit.memory_limit_text() if isinstance(error, MemoryError) else ""
    most = f"its process may take {held}" if held else ""
    return spelled(f"{type(error).__name__}: {', '.join(filter(None, (_as_text(error), most)))}")


def _as_text(text: object) -> str:
    try:
        said = str(text)
    except BaseException as error:  # somebody's own __str__
        return f"(it cannot be said: {type(error).__name__})"
    return said
