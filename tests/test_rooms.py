"""A house rule: data flows one way, so no imports among folders stand in a circle.

The folders and files within every folder import one another along a tree.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable
from graphlib import CycleError, TopologicalSorter
from itertools import takewhile
from pathlib import Path

import pytest
from given.command.tree import FILES, imported, module

TREES = ("cases", "engines", "reference", "reports")

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
def test_no_engine_knows_another() -> None:
    """Nor does what all engines share know one of them: that would be a circle."""
    engines = {"engines.mujoco", "engines.pymunk"}
    for file in FILES:
        own = ".".join(module(file).split(".")[:2])
        if own in engines:
            others = tuple(f"{engine}." for engine in engines - {own})
            assert not [name for name in imported(file) if f"{name}.".startswith(others)], file


ROOMS = 10  # folders of a folder: as many as a newcomer can keep in mind


def crowded(folders: Iterable[Path]) -> set[Path]:
    """Returns the folders with more than ROOMS folders."""
    return {
        above for above, rooms in Counter(each.parent for each in folders).items() if rooms > ROOMS
    }


@pytest.mark.mutant("an eleventh room in a folder")
def test_a_folder_has_few_rooms() -> None:
    folders = {file.parent for file in FILES}
    assert crowded(folders) == set()
    assert crowded({*folders, *(Path("a", str(n)) for n in range(ROOMS + 1))}) == {Path("a")}
