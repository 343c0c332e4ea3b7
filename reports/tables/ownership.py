"""Whether a file is one that we wrote: a stranger's is never overwritten unasked."""

import errno
import re
from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path

from . import run_list
from .file_content import content
from .model_line import ModelLine
from .row import Advice, Cause, Certificate, Comparison, Instant, Rungs, StepError

TITLE = "<title>textmech: "
"""In the head of a page."""
OURS = "textmech"
"""What a picture says of who drew it."""
_PICTURES = {
    ".svg": f"<dc:title>{OURS}</dc:title>".encode(),
    ".png": f"tEXtSoftware\0{OURS}".encode(),
}
"""What stands in the head of a picture."""
_REPORTS = {
    ",".join(column.name for column in fields(kind))
    for kind in (Comparison, Rungs, StepError, Certificate, Instant, Cause, Advice, ModelLine)
} | {",".join(run_list.HEAD), "kind,number,cases,otherwise", "room,planted,seen_by,loop"}
"""The first lines of reports."""
_TABLES = {
    "releases": re.compile(r"case,theme,engine,version,setting,realised,quantity,"),
    "times of events": re.compile(r"engine,setting,realised,event,k,"),
    "poses": re.compile(r"engine,setting,realised,body,field,unit,t \[s\],value"),
    "motions": re.compile(r"(t \[s\]|state),[^\r\n]* reference"),
}
"""How the first lines begin of what `--keep` and `versions` write."""
_PARQUET = b"PAR1"
_HEAD = 4000  # bytes
HERE = Path(__file__).parents[1]  # where the committed tables lie
OVERWRITE = "overwrite"


def is_checkout() -> bool:
    """Whether this is a checkout, whose tables are our own, and no installed package."""
    return (HERE.parent / "pyproject.toml").is_file()


def unasked(folder: Path, names: Iterable[str], *, overwrite: bool) -> None:
    """Raises FileExistsError unless each name is free, a file of ours, or may be overwritten.

    The committed reports of a checkout are ours whatever they hold. Raises FileExistsError.
    """
    if overwrite or (folder.resolve() == HERE and is_checkout()):
        return
    for name in names:
        if (what := _strange(folder / name)) is not None:
            what = f"{what}, and would be overwritten: name another folder, or say --{OVERWRITE}"
            raise FileExistsError(errno.EEXIST, what, str(folder / name))


def _strange(file: Path) -> str | None:
    """Returns why a file is not ours, or nothing; what is no file is refused when written."""
    if file.is_symlink():
        return "is a link"
    if not file.is_file():
        return None
    try:
        return None if _ours(content(file), file.suffix.lower()) else "was not written by textmech"
    except OSError as error:
        return f"cannot be read ({error.strerror})"


def _ours(held: bytes, ending: str) -> bool:
    if ending == ".parquet":
        columns = (b"realised", b"field", b"t [s]", b"value")
        return held.startswith(_PARQUET) and all(column in held for column in columns)
    if ending in _PICTURES:
        return _PICTURES[ending] in held[:_HEAD]
    head = held[:_HEAD].decode(errors="replace")
    if ending == ".html":
        return TITLE in head
    first = held.partition(b"\n")[0].decode(errors="replace").rstrip("\r").removeprefix("\ufeff")
    return first in _REPORTS or any(table.match(first) for table in _TABLES.values())
