"""Nothing vacuous: every parameter matters to what a case observes, or is said to drop out."""

import re
from collections.abc import Mapping
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.observe import observe
from textmech.cases.quantity import table
from textmech.cases.trajectory import Array
from textmech.reference.generated.mechanism import Mechanism
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import either, follow
from textmech.reference.motion.stuck import Stuck
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.start.assembly import assemble
from textmech.reference.start.closure import Closure

CHANGED = 1.05  # 5 %, or 0.05 where a parameter is zero
STAYS = 0.1  # of a tolerance: what a parameter that drops out may move by 5 % of it
TOLERANCE = 1e-9  # of the integrator: far below STAYS

PARAMETERS = [(file, name) for file in shipped().values() for name in load(file)[0].parameters]


def samples(case: Case) -> Mapping[str, Array]:
    """What the case observes, by the generated mechanism."""
    mechanism = Mechanism(case.scene, assemble(case), Closure(case).size)
    by = partial(either, tolerance=TOLERANCE)
    trajectory = Answer(mechanism, follow(mechanism, case.times, by=by)).trajectory(case.times)
    known = table(case.scene)
    return {name: observe(case.scene, trajectory, name) for name in case.allow if name in known}


@cache
def as_written(file: Path) -> list[tuple[Case, Mapping[str, Array]]]:
    """The file's variants, and what each observes before anything is changed."""
    return [(case, samples(case)) for case in load(file)]


def changed(file: Path, case: Case, name: str, folder: Path) -> Case:
    """The same variant with one parameter changed by 5 %, through the file's own text."""
    value = case.parameters[name] * CHANGED or CHANGED - 1
    text = file.read_text(encoding="utf-8")
    pattern = rf"(\bparameters: {{[^}}]*\b{name}: )[^,}}]+"
    text = re.sub(pattern, rf"\g<1>{value!r}", text)
    copy = folder / file.name
    copy.write_text(text, encoding="utf-8")
    return next(other for other in load(copy) if other.name == case.name)


@pytest.mark.whole
@pytest.mark.parametrize(
    ("file", "name"), PARAMETERS, ids=[f"{file.stem}-{name}" for file, name in PARAMETERS]
)
def test_a_parameter_matters_or_drops_out(file: Path, name: str, tmp_path: Path) -> None:
    ratios: list[float] = []
    for case, before in as_written(file):
        try:
            after = samples(changed(file, case, name, tmp_path))
        except (CaseError, ZenoError, Stuck):  # bound to another parameter
            ratios.append(np.inf)
            continue
        ratios += [
            float(np.max(np.abs(after[quantity] - values))) / (case.allow[quantity] or np.inf)
            for quantity, values in before.items()
        ]
    if name in as_written(file)[0][0].drops_out:
        assert max(ratios) <= STAYS, f"the motion depends on {name}"
    else:
        assert max(ratios) > 1, f"5 % of {name} stays within every tolerance"
