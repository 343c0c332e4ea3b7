"""`textmech check-engine`: what it says, and with which exit code."""

import json
from collections.abc import Mapping
from dataclasses import fields, replace
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock

import pytest
from given.adapters import faulty, mistaken
from given.command import textmech

from textmech import engines
from textmech.cases.case import Case
from textmech.reports.compare import adapter_check
from textmech.reports.tables.row import AGREES, DEVIATES, Comparison


class Bare(faulty.Faulty):
    """Neither runs nor shows anything."""

    run = script = property()  # type: ignore[assignment]


class Versionless:
    """A maker of engines without a version."""

    offers = ("tuned",)

    def __call__(self, setting: str, options: Mapping[str, Any]) -> faulty.Faulty:
        return faulty.Faulty(setting=setting, version="")


def maker(monkeypatch: pytest.MonkeyPatch, engine: Any) -> None:
    """What the name `faulty` makes."""
    monkeypatch.setattr(engines, "settings", lambda name: ("tuned",))
    monkeypatch.setattr(engines, "make", lambda name, setting: engine)


def asked(*words: str) -> tuple[Mapping[str, Any], int]:
    done = textmech("check-engine", *words, "--json", "--jobs", "1")
    return json.loads(done.stdout), done.returncode


@pytest.mark.slow
def test_an_engine_that_is_none_is_a_mistake() -> None:
    done = textmech("check-engine", "pymunc")
    assert done.returncode == 2
    assert "pymunc: no such engine; did you mean 'pymunk'?" in done.stderr
    done = textmech("check-engine", "pymunk.tunde")
    assert done.returncode == 2
    assert "did you mean 'pymunk.tuned'?" in done.stderr
    done = textmech("check-engine", "pymunk", "pendulun")
    assert done.returncode == 2
    assert "pendulun: no such grade; did you mean 'pendulum'?" in done.stderr


@pytest.mark.slow
def test_what_works_or_is_refused_ends_with_0() -> None:
    found, code = asked("pymunk", "falls", "space: free")
    assert (found["engine"], found["setting"], found["exit_code"], code) == (
        "pymunk",
        "tuned",
        0,
        0,
    )
    assert [mark["outcome"] for mark in found["marks"]] == [*["works"] * 5, "refused"]
    assert found["marks"][-1]["what"].startswith("engine: ")


@pytest.mark.slow
def test_what_is_wrong_ends_with_1(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "names", lambda: ("faulty",))
    maker(monkeypatch, mistaken.Mistaken("y and vy down"))
    done = textmech("check-engine", "faulty", "rod", "--jobs", "1")
    assert done.returncode == 1
    assert "wrong      rod" in done.stdout
    assert "as if y and vy have the opposite sign" in done.stdout
    assert "textmech run particle_pendulum --engine faulty" in done.stdout
    assert "not there  Tunable" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize("act", ["raises", "aborts", "ends"])
def test_what_crashes_costs_its_grade(act: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "names", lambda: ("faulty",))
    maker(monkeypatch, faulty.Faulty(verb="plans", act=act))
    found, code = asked("faulty", "falls")
    assert code == 1
    assert found["marks"][-1]["outcome"] == "crashed"


def test_an_engine_without_its_members_is_not_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "names", lambda: ("bare",))
    maker(monkeypatch, Bare())
    found, code = asked("bare")
    assert code == 1
    assert found["marks"][0]["what"] == "it has no run"
    assert [mark["grade"] for mark in found["marks"][:2]] == ["protocol", "script"]
    assert len(found["marks"]) == 5  # and what it may offer: Tunable, Claims, Paced


def test_an_engine_that_cannot_be_made_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engines, "names", lambda: ("faulty",))
    monkeypatch.setattr(engines, "_maker", lambda name: Versionless())
    found, code = asked("faulty")
    assert (code, found["setting"]) == (1, None)
    assert found["marks"][0]["what"].startswith("faulty cannot be used: its version should be")


@pytest.mark.mutant("what deviates as declared is told of all others")
def test_of_a_claim_about_states_what_deviates_is_told(
    moving: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One quantity agrees, one deviates as the case declares, and the audit agrees."""
    row = Comparison(**dict.fromkeys((f.name for f in fields(Comparison)), ""))  # type: ignore
    agrees = replace(row, verdict=AGREES, ratio=0.5, because="it is right")
    deviates = replace(row, verdict=DEVIATES, ratio=9.0, because="it is soft")
    outcome = SimpleNamespace(rows=[agrees, agrees, deviates], samples={})
    monkeypatch.setattr(adapter_check, "answered", lambda *_: outcome)
    for name in ("solve", "first", "Trial", "climbed"):
        monkeypatch.setattr(adapter_check, name, Mock())
    monkeypatch.setattr(adapter_check.states, "ways", lambda *_: [faulty.NATIVE])
    monkeypatch.setattr(adapter_check.states, "rung", Mock())
    attempt = adapter_check.Attempt(adapter_check.Grade("states", ""), moving, faulty.Faulty())
    found = adapter_check._states(attempt)
    assert (found.outcome, found.what) == ("works", "1 quantities; but it is soft")
