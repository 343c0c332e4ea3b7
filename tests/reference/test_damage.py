"""Whatever numbers a person types into a sound scene: a motion, or a mistake with a place."""

from collections import Counter
from pathlib import Path

import pytest
from given.same_examples import examples
from given.scenes.pendulum import pendulum
from hypothesis import given
from hypothesis import strategies as st

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.reference import refusal
from textmech.reference.solve import solve

FORCES = (
    "{{coil: {{spring: [rod.end, ground.O], stiffness: {c}, rest_length: {l}}}, "
    "oil: {{damper: [rod.end, ground.O], damping: {d}}}, "
    "wind: {{push: rod.end, sine: {{amplitude: [{a}, {b}], angular_frequency: {w}}}}}}}"
)
SOUND = {"c": "40", "l": "0.2", "d": "0.1", "a": "1", "b": "0", "w": "5"}
SIZES = st.floats(-29, 29).map(lambda e: f"{10.0**e:.3e}") | st.sampled_from(["0", "1", "1e3"])


@st.composite
def scenes(draw: st.DrawFn) -> str:
    """One or two numbers of any size, the others as they were."""
    sound = dict(SOUND)
    other = {"length": "0.5", "angle": "0.3", "duration": "0.2", "step": "1.0e-3"}
    for key in draw(st.lists(st.sampled_from([*sound, *other]), min_size=1, max_size=2)):
        (sound if key in sound else other)[key] = draw(SIZES)
    return pendulum(forces=FORCES.format(**sound), samples=6, **other)


@pytest.mark.slow
def test_any_numbers_give_a_motion_or_a_mistake_with_a_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(refusal, "LIMIT", 3.0)  # s: a motion of this scene takes 0.1
    file, seen = tmp_path / "case.yaml", Counter[str]()

    @examples(60)
    @given(scenes())
    def each(text: str) -> None:
        file.write_text(text, encoding="utf-8")
        try:
            (case,) = load(file)
            solve(case)
            seen["solved"] += 1
        except CaseError as error:
            found = error.mistakes
            seen["refused"] += 1
        else:
            return
        assert found
        assert all(mistake.line > 0 for mistake in found)

    each()
    assert min(seen["solved"], seen["refused"]) >= 5


def test_a_force_beyond_all_numbers_is_not_taken_for_a_spring_without_length(
    tmp_path: Path,
) -> None:
    file = tmp_path / "case.yaml"
    strong = pendulum(forces=FORCES.format(**(SOUND | {"a": "1e29"})), samples=6)
    file.write_text(strong, encoding="utf-8")
    with pytest.raises(CaseError, match="cannot be followed beyond"):
        solve(load(file)[0])
