"""A house rule: data flows one way, so no imports among rooms stand in a circle.

In `reference` every folder holds it: its folders and files import one another along a tree.
In the three others a table says which room may know which, until they hold it too.
"""

from collections import defaultdict
from graphlib import CycleError, TopologicalSorter
from itertools import takewhile

import pytest
from given.tree import FILES, imported, module

TREES = ("reference",)  # in which no folder has a circle

# Which room may know which: those of a line know all lines above it, and not each other. What is
# joined by + is one room.
NOUNS = (
    "body+constraint+contact+couple+difference+drag+element+event+force+frame+friction+islands+joint"
    "+kind+magnetic+motion+muscle+pair+pieces+plane+point+power+quantity+rope+scene+shape+signal"
    "+space+states+stops+trajectory+turning"
)
ROOMS = {
    "cases": [
        "mistake",
        f"{NOUNS}+language.grammar",  # nouns declare their numbers in the words of the grammar
        "case find language.read language.parse passages",
        "observe language.check language.resolve theme",
        "still",
        "load",
    ],
    "engines": [
        "engine+knobs law signal stride tied told quiet+probe",
        "begun heading",
        "mujoco pymunk",
    ],
    "reports": [
        "limit amount content",
        "own_settings spelled",
        "row runs pins selection coverage events lock ending cluster pytest_short pytest_options",
        "processes child trial replace passing ours promised",
        "diff",
        "pool judge asking",
        "cache",
        "unit results likely",
        "grades",
        "trials search",
        "suite",
        "poses",
        "write keep session",
        "show",
        "committed bench page",
        "versions",
        "command interface collecting",
        "cli pytest_plugin",
        "start",
    ],
}


def place(name: str) -> tuple[int, str]:
    """Line and room of a module in the table; before all of them for the folder itself."""
    package, _, inner = name.partition(".")
    if package in TREES:
        return -1, ""
    for line, rooms in enumerate(ROOMS[package]):
        for room in rooms.split():
            for part in room.split("+"):
                if f"{inner}.".startswith(f"{part}."):
                    return line, room
    assert inner in ("", "language"), f"{name} stands in no room"
    return -1, ""


def climbs(one: str, other: str) -> bool:
    """Whether an import of `other` in `one` runs back up between the rooms of their folder."""
    if one.split(".")[0] != other.split(".")[0]:
        return False  # another test's
    (here, room), (there, other_room) = place(one), place(other)
    if not room:  # the folder itself knows what is in its first line
        return there > 0
    return room != other_room and not there < here


Arrows = dict[str, dict[str, set[str]]]
"""By folder: what each of its folders and files imports of its others."""


def arrows(imports: dict[str, set[str]]) -> Arrows:
    """Sorts the imports among modules by the innermost folder that holds both."""
    found: Arrows = defaultdict(lambda: defaultdict(set))
    for one, others in imports.items():
        for other in others:
            here, there = one.split("."), other.split(".")
            both = zip(here, there, strict=False)
            depth = len([*takewhile(lambda names: names[0] == names[1], both)])
            if 0 < depth < min(len(here), len(there)):
                found[".".join(here[:depth])][here[depth]].add(there[depth])
    return found


def circles(imports: dict[str, set[str]]) -> list[str]:
    """Folders whose folders and files import one another in a circle, with the circle."""
    found = []
    for folder, inside in arrows(imports).items():
        try:
            TopologicalSorter(inside).prepare()
        except CycleError as error:
            found.append(f"{folder}: {' → '.join(error.args[1])}")
    return found


@pytest.mark.slow
@pytest.mark.parametrize("tree", TREES)
def test_the_folders_of_a_tree_have_no_circle(tree: str) -> None:
    modules = {module(file): file for file in FILES if module(file).partition(".")[0] == tree}
    imports = {name: imported(file) & set(modules) for name, file in modules.items()}
    assert len(arrows(imports)) > 5
    assert circles(imports) == []


@pytest.mark.mutant("an import that closes a circle among folders")
def test_a_circle_among_folders_is_seen() -> None:
    """Though none among files is closed."""
    sound = {"a.b.x": {"a.c.x"}, "a.b.y": {"a.b.x"}, "a.d": {"a.b.y", "a.c.y"}}
    assert circles(sound) == []
    assert circles(sound | {"a.c.y": {"a.b.z"}}) == ["a: b → c → b"]
    assert circles({"a.b.x": {"a.b.y"}, "a.b.y": {"a.b.x"}}) == ["a.b: x → y → x"]


@pytest.mark.slow
def test_no_import_runs_back_up_between_rooms() -> None:
    modules = {module(file) for file in FILES}
    wrong = [
        f"{module(file)} imports {name}"
        for file in FILES
        for name in sorted(imported(file) & modules)
        if climbs(module(file), name)
    ]
    assert not wrong


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("engines.mujoco.scene", "engines.pymunk.scene"),
        ("engines.law", "engines.mujoco"),
        ("engines", "engines.mujoco"),
        ("reports.events.times", "reports.judge.compare"),
        ("reports.suite", "reports.write"),
        ("cases.scene", "cases.load"),
        ("cases.language.parse", "cases.language.check.check"),
    ],
)
def test_an_import_that_runs_back_up_is_seen(one: str, other: str) -> None:
    assert climbs(one, other)


def test_every_room_of_the_table_exists() -> None:
    modules = {module(file) for file in FILES}
    listed = [
        f"{package}.{part}"
        for package, lines in ROOMS.items()
        for part in "+".join(lines).replace(" ", "+").split("+")
    ]
    assert set(listed) <= modules
    assert len(listed) == len(set(listed))
