"""A case with an element that a script adds from outside: its reference, and an engine's answer."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Engine, Plan
from textmech.reference.solve import solve


def solved(folder: Path, text: str) -> tuple[Case, Trajectory]:
    """The case of a text, and its certified motion."""
    path = folder / "outside.yaml"
    path.write_text(text, encoding="utf-8")
    (case,) = load(path)
    solution = solve(case)
    assert solution.holds, [check for check in solution.checks if not check.holds]
    return case, solution.trajectory


def answered(
    engine: Engine, case: Case, reference: Trajectory, forces: Sequence[str] = ()
) -> Trajectory:
    """The engine's motion from the reference's start, in its first way and at the case's step."""
    start = {name: tuple(rows[0].tolist()) for name, rows in reference.states.items()}
    plan, *_ = engine.plans(case.scene, start)  # type: ignore[arg-type]
    assert isinstance(plan, Plan), plan
    assert isinstance(case.step, Mapping)
    step = case.step[engine.name.partition(".")[0]]
    return engine.run(case.scene, start, case.times, step, plan, reactions=(*forces,), record=False)  # type: ignore[arg-type]
