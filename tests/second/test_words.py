"""No word of the grammar goes unread without a line that says why, and each is compared."""

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from second import both, drawn_plane, drawn_space, drawn_switching, read

# What of the grammar the second reading does not know, and why; all else it has to read.


UNREAD = {
    # of the top of a file: nothing of them moves anything
    "title": "a claim in words",
    "source": "a place in the book",
    "equations": "a place in the book",
    "example": "a place in the book",
    "exercise": "a place in the book",
    "figure": "a place in the book",
    "section": "a place in the book",
    "thread": "a public question",
    "system": "which hand-written system answers",
    "drops_out": "said of parameters",
    "rests": "said of what is claimed",
    "stays": "said of what is claimed",
    "step": "of engines; as a law in time it is read",
    "reach": "of engines",
    "deviates": "of engines",
    "limit": "of engines",
    "by": "of engines",
    "because": "of engines",
    "tube": "of engines: the one case that has it asks nothing beside its events but times",
    # states
    "states": "how a seed draws is not said: `test_random.py` takes what the reference drew",
    "random": "as states",
    "seed": "as states",
    "q": "as states",
    "q_dot": "as states",
    "q_ddot": "as states",
    # the smooth law of dry friction
    "smooth": "(2.95) stands in the book and not in the README; it is compared with the exact law",
    "band": "as smooth",
    "sharpness": "as smooth",
    **dict.fromkeys(
        (
            "model",
            "control",
            "keyframe",
            "rates",
            "random_rates",
            "most",
            "held",
            "between",
            "lines",
            "on",
            "off",
        ),
        "of a model of a user's own, which an engine compiles",
    ),
}
"""Words of the grammar that are not read, with the reason."""

UNDRAWN = {
    "ahead_of": "only two walkers have it",
    "spokes": "only the rimless wheel has it",
    "number": "of spokes",
}
"""Words that no random scene has, though shipped cases do, with the reason."""


HERE = Path(__file__).parent
CASES = HERE.parents[1] / "cases"
ENGINES = {"mujoco", "pymunk"}


def literals() -> set[str]:
    """All strings that stand in the files that read."""
    found = set()
    for file in HERE.glob("*.py"):
        if not file.name.startswith(("test_", "drawn", "both")):
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found.add(node.value)
    return found


def said(told: Any) -> Iterator[str]:
    """The keys of a schema's properties, and the words that a value can be, to any depth."""
    if isinstance(told, dict):
        if isinstance(told.get("properties"), dict):
            yield from told["properties"]
        yield from (word for word in told.get("enum", []) if isinstance(word, str))
        if isinstance(told.get("const"), str):
            yield told["const"]
        told = list(told.values())
    if isinstance(told, list):
        for each in told:
            yield from said(each)


def grammar() -> set[str]:
    """Every word of the grammar."""
    schema = json.loads((CASES / "case.schema.json").read_text(encoding="utf-8"))
    return set(said(schema)) - ENGINES


def fields() -> set[str]:
    """The last words of all quantities in the README's tables."""
    readme = (CASES / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ((?:`[a-z]+[._][^|]*`(?:, )?)+) \|", readme, flags=re.MULTILINE)
    names = [name for row in rows for name in re.findall(r"`([^`]+)`", row)]
    return {n.split(".")[-1] for n in names if re.fullmatch(r"[a-z_]+(\.[a-z_0-9]+)*", n)}


MADE = {
    "theta": "a name of its own", "theta_dot": "a name of its own", "s": "a name of its own",
    "s_dot": "a name of its own", "theta_torque": "made of a name", "s_force": "made of a name",
    "vx": "v and an axis", "vy": "v and an axis", "vz": "v and an axis", "ax": "a and an axis",
    "ay": "a and an axis", "az": "a and an axis", "fx": "f and an axis", "fy": "f and an axis",
    "fz": "f and an axis", "mx": "m and an axis", "my": "m and an axis", "mz": "m and an axis",
    "alpha_x": "alpha_ and an axis", "alpha_y": "alpha_ and an axis",
    "alpha_z": "alpha_ and an axis", "time": "of answer.times", "count": "of answer.times",
    "mass_matrix": "of test_random",
    **{f"angular_{axis}": "angular_ and an axis" for axis in "xyz"},
    **{f"omega_{i}": "omega_ and a number" for i in (1, 2, 3)},
    **{f"inertia_{i}": "inertia_ and two" for i in ("11", "22", "33", "12", "13", "23")},
}  # fmt: skip
"""Fields that are put together when they are read, and so stand nowhere as they are."""


def unread(every: set[str], known: set[str]) -> set[str]:
    """Words that are neither read nor said to be not."""
    return every - known - set(UNREAD)


def keys(told: Any) -> Iterator[str]:
    """All keys and words of a file."""
    if isinstance(told, dict):
        for key, value in told.items():
            yield key
            yield from keys(value)
    elif isinstance(told, list):
        for each in told:
            yield from keys(each)
    elif isinstance(told, str):
        yield told


@pytest.mark.slow
def test_every_word_of_the_grammar_is_read_or_has_a_line() -> None:
    assert unread(grammar(), literals()) == set()
    assert unread(fields(), literals() | set(MADE)) == set()


def test_no_line_is_about_what_is_no_word() -> None:
    assert set(UNREAD) <= grammar()
    assert set(UNDRAWN) <= grammar()


@pytest.mark.slow
@pytest.mark.mutant("a new word of the grammar that the second reading passes over")
def test_a_new_word_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    assert unread(grammar() | {"gearbox"}, literals()) == {"gearbox"}
    monkeypatch.delitem(UNREAD, "smooth")
    assert unread(grammar(), literals()) == {"smooth"}


@pytest.mark.slow
def test_every_word_that_is_read_is_compared() -> None:
    """By a shipped case, or by one of the first random scenes."""
    used = {word for file in both.FILES for word in keys(read.text(file.read_text("utf-8")))}
    for seed in range(20):
        used |= set(keys(drawn_switching.drawn(seed)))
    for seed in range(33):
        used |= set(keys(drawn_plane.drawn(seed)))
    for seed in range(27):
        used |= set(keys(drawn_space.drawn(seed)))
    assert grammar() - used - set(UNREAD) == set()


@pytest.mark.slow
def test_a_file_has_the_cases_that_the_suite_reads() -> None:
    """Which the other tests here go by, so that none is left out."""
    twice = {n: "states" in case for file in both.FILES for n, case in read.file(file).items()}
    assert twice == {name: case.states is not None for name, case in both.EVERY.items()}
