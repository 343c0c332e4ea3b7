"""A house rule: within each of the four folders, imports never run back up between rooms."""

import pytest
from given.tree import FILES, imported, module

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
        "case find language.read language.parse",
        "observe language.check language.resolve theme",
        "load",
    ],
    "reference": [
        "lapack",
        "system coverage integrators",
        "laws stated",
        "formalisms",
        "systems generated motion",
        "start",
        "approximations certificate premises refusal",
        "determined",
        "states islands",
        "solve",
    ],
    "engines": [
        "engine+knobs law signal stride tied told quiet+probe",
        "begun heading",
        "mujoco pymunk",
    ],
    "reports": [
        "own_settings spelled limit amount content",
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
        ("reference.laws.force", "reference.generated.mode"),
        ("reference.systems.four_bar", "reference.generated.mode"),
        ("reference.generated.mode", "reference.start.closure"),
        ("reference.motion.follow", "reference.certificate.certify"),
        ("reference.certificate.laws", "reference.solve"),
        ("reference.system", "reference.systems"),
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
