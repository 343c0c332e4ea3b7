"""The difference for a pull request: regressions open, all else folded."""

from collections.abc import Iterator, Sequence

from .change import KINDS, WORSE, Change
from .compare import Difference
from .words import TITLES, by_place, head, looked_at, summary

MOST = 50  # of a kind: a comment holds 65 000 letters
HEAD = ("case", "engine", "what", "OLD → NEW", "file")
SPECIAL = str.maketrans(
    {c: f"\\{c}" for c in "\\`*_[]|~"} | {"<": "&lt;", ">": "&gt;", "&": "&amp;"}
)


def markdown(found: Difference, *, most: int | None = MOST) -> str:
    """most: how many changes of a kind are shown; None: all."""
    mark = "❌" if found.regressed else "✅"
    lines = [f"### {mark} textmech: {summary(found)}", ""]
    told = (head("OLD", found.old), head("NEW", found.new), *looked_at(found))
    lines += [f"- {_plain(line)}" for line in told]
    for kind in KINDS:
        if changes := found.of(kind):
            lines += ["", *_section(kind, changes, most)]
    return "\n".join([*lines, ""])


def _section(kind: str, changes: Sequence[Change], most: int | None) -> Iterator[str]:
    title = f"{TITLES[kind]} ({len(changes)})"
    yield f"**{title}**" if kind == WORSE else f"<details><summary>{title}</summary>"
    yield ""
    yield _line(HEAD)
    yield _line(["---"] * len(HEAD))
    for case, column, file, told in by_place(changes[:most]):
        for names, said in told:
            yield _line([_plain(cell) for cell in (case, column, names, said, file)])
    if len(changes[:most]) < len(changes):
        yield ""
        yield f"and {len(changes) - len(changes[:most])} more"
    if kind != WORSE:
        yield ""
        yield "</details>"


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _plain(text: str) -> str:
    """Text of a report is text, never markup."""
    return " ".join(text.split()).translate(SPECIAL)
