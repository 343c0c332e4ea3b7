"""Each check and premise of the reference has a test that sees it fail: the list is complete.

Every call of `Check` and every mistake that a premise tells is found in the code, by its words. A
new one is red here until a test that has made it fail once is named beside it.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MUTANT, TOLD = "pytest.mark.mutant", ("raises", "refused", "what.startswith", "mistake")

BOTH = "certificate/test_two_answers.py::test_a_mistake_in_either_answer_is_seen"
OF_ONE_SIDE = "certificate/test_one_sided.py::test_what_all_answers_share_is_seen"
TOLD_BY_FILE = "certificate/test_as_the_file_says.py::test_what_all_answers_share_is_seen"
NEAREST = "certificate/test_as_the_file_says.py::test_the_other_way_is_seen"
OF_STATES = "certificate/test_bounds.py::test_a_check_of_states_fails_by_itself"
# By the code of the check's name, in the order of the files.
CHECKS = {
    "f'{ERROR}{name}'": BOTH,
    "'generated accelerations'": BOTH,
    "'generated reactions'": BOTH,
    "'generated motion'": BOTH,
    "'closed form'": BOTH,
    "'turns by their rates'": "motion/test_turns.py::test_a_lost_turn_is_seen",
    "'modes possible'": BOTH,
    "name": BOTH,  # of the events in another answer
    "'closed events'": BOTH,
    "'constraint drift'": BOTH,
    "f'accelerations by {by}'": BOTH,
    "'Lagrangian (2.51), (2.52)'": BOTH,
    "'power balance (2.51)'": BOTH,
    "'Newton-Euler balance (2.23), (2.27)'": BOTH,
    "'reactions by Newton-Euler'": BOTH,
    "f'accelerations by {name}'": BOTH,
    "'each island by itself'": "test_islands.py::test_a_joining_that_is_forgotten_is_seen",
    "'starts as it is given'": TOLD_BY_FILE,
    "'starts near what is said'": NEAREST,
    "'drives follow their laws'": TOLD_BY_FILE,
    "'driven points follow their laws'": TOLD_BY_FILE,
    "'forces follow their laws'": TOLD_BY_FILE,
    "'joints hold'": TOLD_BY_FILE,
    "'nothing slips'": TOLD_BY_FILE,
    "'nothing passes what holds it'": OF_ONE_SIDE,
    "'what presses touches'": OF_ONE_SIDE,
    '"friction is the file\'s"': OF_ONE_SIDE,
    '"blows are the file\'s"': OF_ONE_SIDE,
    "'springs act from their length on'": OF_ONE_SIDE,
    "'contacts move free bodies by (2.22)'": OF_ONE_SIDE,
    "NAME": "test_determined.py::test_what_is_open_and_is_taken_for_one_value_fails_by_itself",
    "'generated states'": "states/test_answer.py::test_a_mistake_in_a_law_is_seen",
    "'joints hold (2.10), (2.15)'": OF_STATES,
    "'coordinates read back'": OF_STATES,
    '"Lagrange (2.44) against d\'Alembert (2.39)"': (
        "states/test_answer.py::test_energy_against_virtual_work"
    ),
}
# By the function that tells them.
PREMISES = {
    "assumptions.py::_otherwise": "test_premises.py::test_a_written_system_starts_as_the_scene",
    "assumptions.py::_unsaid": "test_premises.py::test_a_contact_above_the_floor_has_to_say_so",
    "assumptions.py::_grazes": (
        "motion/test_touched.py::test_what_only_just_reaches_a_wall_is_refused"
    ),
    "assumptions.py::_past_ends": "mechanism/test_one_instant.py",
    "assumptions.py::_slipping": "test_premises.py::test_rolling_needs_enough_friction",
    "assumptions.py::_slipping_between": (
        "test_samples.py::test_a_premise_is_asked_between_the_steps"
    ),
    "assumptions.py::_motionless": "test_premises.py::test_what_rests_has_to_say_so",
    "assumptions.py::_blow_work": (
        "certificate/test_errors.py::test_work_of_a_drive_through_a_blow_is_refused"
    ),
    "assumptions.py::check_start": "test_premises.py::test_a_written_system_has_the_scenes_bodies",
    "assumptions.py::_beyond_law": "test_premises.py::test_a_muscle_is_not_pressed_beyond_its_law",
    "determined.py::check_determined": (
        "test_determined.py::test_its_forces_are_refused_with_their_interval"
    ),
    "certificate/errors.py::beyond": (
        "certificate/test_errors.py::test_a_bound_that_cannot_be_certified_is_a_mistake_in_its_place"
    ),
    "states/answer.py::_written": (
        "states/test_answer.py::test_a_system_of_other_coordinates_is_refused"
    ),
    "states/answer.py::_constant_mistakes": (
        "states/test_answer.py::test_what_is_the_same_in_every_state_is_no_claim"
    ),
}
JUDGES = ("assumptions.py", "determined.py", "certificate/*.py", "states/*.py")
"""The files of the reference that say what a motion, or states, contradict."""


def trees(*patterns: str) -> Iterator[tuple[str, ast.Module]]:
    here = ROOT / "reference"
    for pattern in patterns:
        for file in sorted(here.glob(pattern)):
            yield file.relative_to(here).as_posix(), ast.parse(file.read_text(encoding="utf-8"))


def checks() -> set[str]:
    """The code of all names that a `Check` is given."""
    calls = (
        node
        for _, tree in trees("**/*.py")
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "Check"
    )
    return {ast.unparse(call.args[0]) for call in calls}


def premises() -> set[str]:
    """The functions of `JUDGES` that tell a mistake."""
    return {
        f"{file}::{function.name}"
        for file, tree in trees(*JUDGES)
        for function in tree.body
        if isinstance(function, ast.FunctionDef) and "case.mistake(" in ast.unparse(function)
    }


def found(test: str) -> list[ast.FunctionDef]:
    """The tests of this name; without one, all of the file."""
    file, _, name = test.partition("::")
    tree = ast.parse((ROOT / "tests" / "reference" / file).read_text(encoding="utf-8"))
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    return [each for each in functions if name in ("", each.name)]


@pytest.mark.slow
def test_every_check_is_listed() -> None:
    """And nothing is that there is no more."""
    assert checks() == CHECKS.keys()


def test_every_premise_is_listed() -> None:
    assert premises() == PREMISES.keys()


@pytest.mark.parametrize("check", CHECKS)
def test_a_test_has_made_it_fail(check: str) -> None:
    """The test is there, and says what it plants."""
    (test,) = found(CHECKS[check])
    assert any(MUTANT in ast.unparse(mark) for mark in test.decorator_list)


@pytest.mark.parametrize("premise", PREMISES)
def test_a_case_is_refused_by_it(premise: str) -> None:
    tests = found(PREMISES[premise])
    assert any(word in ast.unparse(test) for test in tests for word in TOLD)


@pytest.mark.slow
def test_a_new_check_would_be_seen() -> None:
    """Names are found whatever they are made of, and in whichever file."""
    tree = ast.parse("yield Check(f'a {b}', 1.0, LAW)\nfound.append(Check('c', *d))")
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    names = {ast.unparse(c.args[0]) for c in calls if ast.unparse(c.func) == "Check"}
    assert names == {"f'a {b}'", "'c'"}
    assert len(checks()) > 25
