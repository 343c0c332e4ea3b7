"""The difference as JUnit XML: a test for each case in each engine's column.

A regression is a failure; what was not looked at is skipped, and says so. Properties carry the
runs, the versions, the rule and every compared error over what is allowed, for a chart over builds.
"""

from collections import defaultdict
from collections.abc import Iterable
from xml.etree import ElementTree as ET

from .change import WORSE, Change
from .compare import Difference
from .errors import place
from .file import number
from .folder import Folder
from .table import Row
from .words import alike, summary

Cell = tuple[str, str]
"""A case and a column."""


def junit(found: Difference) -> str:
    """The document."""
    changes, rows = _by_cell(found), _rows(found.new, found)
    left = {side: _left(found, side) for side in ("OLD", "NEW")}
    root = ET.Element("testsuites")
    suite = ET.SubElement(root, "testsuite", name="textmech diff")
    _properties(suite, _about(found))
    for cell in sorted({*changes, *rows, *left["OLD"], *left["NEW"]}):
        case, column = map(_clean, cell)
        test = ET.SubElement(suite, "testcase", classname=case or "chapter", name=column)
        _fill(test, rows.get(cell, []), changes.get(cell, []))
        for side, cells in left.items():
            if cell in cells:
                ET.SubElement(test, "skipped", message=f"not looked at: only {side} has it")
    for name, tag in (("tests", "testcase"), ("failures", "failure"), ("skipped", "skipped")):
        suite.set(name, str(len([*suite.iter(tag)])))
    ET.indent(root, " ")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ET.tostring(root, encoding="unicode")}\n'


def _by_cell(found: Difference) -> dict[Cell, list[Change]]:
    cells: dict[Cell, list[Change]] = defaultdict(list)
    for change in found.changes:
        cells[change.place.case, change.place.column].append(change)
    return dict(cells)


def _rows(folder: Folder, found: Difference) -> dict[Cell, list[Row]]:
    """Returns by case and column the rows of tolerance.csv that are compared."""
    cells: dict[Cell, list[Row]] = defaultdict(list)
    for row in folder.errors.rows:
        if found.scope.within(row) is not None:
            cells[place(row).case, place(row).column].append(row)
    return dict(cells)


def _left(found: Difference, side: str) -> set[Cell]:
    folder = found.old if side == "OLD" else found.new
    rows = [row for row in folder.errors.rows if found.scope.within(row) is None]
    return {(place(row).case, place(row).column) for row in rows}


def _about(found: Difference) -> dict[str, str]:
    told = {"summary": summary(found)}
    for side, folder in (("old", found.old), ("new", found.new)):
        told |= {f"{side}.folder": folder.name, f"{side}.run": folder.run}
        told |= {f"{side}.{engine}": version for engine, version in folder.versions.items()}
    rule = found.rule
    numbers = {"moved": rule.moved, "floor": rule.floor, "worse": rule.worse}
    return told | {f"rule.{k}": f"{v:g}" for k, v in (numbers | {"matters": rule.matters}).items()}


def _fill(test: ET.Element, rows: list[Row], changes: list[Change]) -> None:
    measured = {
        f"{row['quantity']} error/allowed": f"{error / allowed:.3g}"
        for row in rows
        if (error := number(row, "error")) is not None and (allowed := number(row, "allowed"))
    }
    _properties(test, measured)
    worse = _lines(change for change in changes if change.kind == WORSE)
    if worse:
        failure = ET.SubElement(test, "failure", type="regression", message=worse[0])
        failure.text = "\n".join(worse)
    others = _lines(change for change in changes if change.kind != WORSE)
    if others:
        ET.SubElement(test, "system-out").text = "\n".join(others)


def _lines(changes: Iterable[Change]) -> list[str]:
    return [_clean(f"{names}: {said}") for names, said in alike(changes)]


def _properties(element: ET.Element, told: dict[str, str]) -> None:
    if told:
        properties = ET.SubElement(element, "properties")
        for name, value in told.items():
            ET.SubElement(properties, "property", name=_clean(name), value=_clean(value))


def _clean(text: str) -> str:
    """Without the characters that XML cannot hold."""
    return "".join(c if c in "\n\t" or _held(ord(c)) else f"\\x{ord(c):02x}" for c in text)


def _held(code: int) -> bool:
    return 0x20 <= code < 0xD800 or 0xE000 <= code < 0xFFFE or code >= 0x10000
