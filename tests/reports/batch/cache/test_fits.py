"""An entry of the store may be whole and say something else: it is what was asked for, or none."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given import scenes
from given.report_folders import ROW

from textmech.cases.trajectory import Array
from textmech.engines.engine import Realised
from textmech.reference.solve import Solution
from textmech.reports.batch.cache import store
from textmech.reports.batch.cache.store import Store
from textmech.reports.compare.judge.compare import Outcome

KEY = "ab" + "0" * 62


@pytest.fixture
def kept(tmp_path: Path) -> Store:
    return Store(tmp_path)


WRONG = [3, "text", [], {}, {"a": 1}, (1, "x"), [[]], None, 1.5, ("native", "other")]


@pytest.mark.mutant("an entry of another kind is believed")
@pytest.mark.parametrize("wrong", WRONG, ids=str)
@pytest.mark.parametrize("kind", [Solution, Outcome, tuple[Realised, ...], Mapping[str, Array]])
def test_a_whole_entry_of_another_kind_is_none(kind: Any, wrong: Any, kept: Store) -> None:
    kept.put(KEY, wrong)
    sound = {tuple[Realised, ...]: ((),), Mapping[str, Array]: ({},)}
    assert kept.get(KEY, kind) is None or wrong in sound[kind]


@pytest.mark.slow
def test_what_it_holds_is_looked_at_too(kept: Store) -> None:
    """A solution whose checks are none, rows whose numbers are words."""
    solution = scenes.solved("bar_pendulum")
    kept.put(KEY, solution)
    assert kept.get(KEY, Solution) is not None
    no_states = replace(solution.trajectory, states=[1])
    for wrong in (
        replace(solution, checks=(3,)),
        replace(solution, equations=frozenset({1.5})),
        replace(solution, trajectory=None),
        replace(solution, trajectory=no_states),
    ):
        kept.put(KEY, wrong)
        assert kept.get(KEY, Solution) is None
    for row, sound in ((ROW, True), (replace(ROW, error="much"), False)):
        kept.put(KEY, Outcome([row]))
        assert (kept.get(KEY, Outcome) is not None) == sound


HEADS = [
    b"", b"[", b"[" * 100_000, b"[[], []]", b'[{"array": 5}, []]', b'[{"array": 0}, [["<f8", -1]]]',
    b'[{"array": 0}, [["<f8", 1000000000000]]]', b'[{"Solution": {}}, []]', b"[1]",
    b'[{"x": 1, "y": 2}, []]',
    b'[{"map": [[[], 1]]}, []]', b'[{"Outcome": {"rows": []}}, [["nonsense", 1]]]', b"null",
    b'[{"set": [[]]}, []]', b'[{"tuple": 3}, []]', b'[{"array": 0}, [["<f8", "x"]]]',
]  # fmt: skip


@pytest.mark.parametrize("head", HEADS, ids=lambda head: head[:30].decode())
def test_bytes_of_the_right_digest_that_say_nonsense_are_none(head: bytes, kept: Store) -> None:
    for length in (len(head), 0, 2**62):
        data = length.to_bytes(8) + head
        kept.put(KEY, 1)
        (kept.folder / KEY[:2] / KEY).write_bytes(store._digest(KEY, data) + data)
        found = kept.get(KEY, Outcome)
        assert found is None or found == Outcome([])
