"""Nothing vacuous: every parameter matters to what a case observes, or is said to drop out."""

import re
from collections.abc import Iterator, Mapping
from functools import cache, partial
from math import ceil, inf
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene.frame import PLANE
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.mechanism.modes.mechanism import BadStart
from textmech.reference.mechanism.modes.mode_selection import Undetermined
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import either, follow
from textmech.reference.motion.stuck import Stuck
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.states.answer import answered

CHANGED = 1.05  # 5 %, or 0.05 where a parameter is zero
STAYS = 0.1  # of a tolerance: what a parameter that drops out may move by 5 % of it
TOLERANCE = 1e-9  # of the integrator: far below STAYS
PARTS = (0.25, 1.0)  # of the duration: what is seen in the first needs no other

FIRST = {Path(case.source.file): case for case in reversed(scenes.EVERY.values())}
PARAMETERS = [(file, name) for file in shipped().values() for name in FIRST[file].parameters]


def observed(case: Case, trajectory: Trajectory) -> Mapping[str, Array]:
    """What the case observes of a motion, or of states."""
    known = case.quantities
    return {name: observe(case.scene, trajectory, name) for name in case.allow if name in known}


@cache
def as_written(file: Path) -> list[tuple[Case, Mapping[str, Array]]]:
    """The file's variants, and what each observes before anything is changed."""
    return [(case, observed(case, scenes.solved(case.name).trajectory)) for case in load(file)]


def samples(case: Case, part: float) -> Mapping[str, Array]:
    """What the case observes in the first part of its duration, by the generated mechanism."""
    if case.states is not None:
        return observed(case, answered(case)[0])
    times = case.times[: ceil(part * len(case.times))]
    mechanism = scenes.mechanism(case)
    followed = follow(mechanism, times, by=partial(either, tolerance=TOLERANCE))
    asked = case.scene.frame is PLANE  # in space no quantity is an acceleration
    return observed(case, Answer(mechanism, followed, accelerates=asked).trajectory(times))


def changed(file: Path, case: Case, name: str, folder: Path) -> Case:
    """The same variant with one parameter changed by 5 %, through the file's own text."""
    value = case.parameters[name] * CHANGED or CHANGED - 1
    text = file.read_text(encoding="utf-8")
    pattern = rf"(\bparameters: {{[^}}]*\b{name}: )[^,}}]+"
    text = re.sub(pattern, rf"\g<1>{value!r}", text)
    copy = folder / file.name
    copy.write_text(text, encoding="utf-8")
    return next(other for other in load(copy) if other.name == case.name)


def ratios(file: Path, name: str, folder: Path, part: float) -> Iterator[float]:
    """How far each quantity of each variant moves, over its tolerance, one after the other."""
    for case, before in as_written(file):
        try:
            after = samples(changed(file, case, name, folder), part)
        except (CaseError, BadStart, ZenoError, Stuck, Undetermined):  # bound to another parameter
            yield inf
            continue
        for quantity, values in after.items():
            apart = np.abs(values - before[quantity][: len(values)])
            yield float(np.max(apart)) / (case.allow[quantity] or inf)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "name"), PARAMETERS, ids=[f"{file.stem}-{name}" for file, name in PARAMETERS]
)
def test_a_parameter_matters_or_drops_out(file: Path, name: str, tmp_path: Path) -> None:
    if name in as_written(file)[0][0].drops_out:
        assert max(ratios(file, name, tmp_path, 1.0)) <= STAYS, f"the motion depends on {name}"
    else:
        found = (ratio for part in PARTS for ratio in ratios(file, name, tmp_path, part))
        assert any(ratio > 1 for ratio in found), f"5 % of {name} stays within every tolerance"
