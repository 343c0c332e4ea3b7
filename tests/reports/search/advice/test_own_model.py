"""Advice on users' models: what is seen is what a run shows, and what is to be pasted cures."""

import re
from dataclasses import replace
from typing import Any

import pytest
from given.otherwise import otherwise

from textmech.cases import find
from textmech.cases.load_model import load_model
from textmech.cases.model_case import ModelCase, of_model
from textmech.engines.own_model import seen, static
from textmech.engines.own_model.model import compiled_text
from textmech.engines.own_model.opened import opened
from textmech.engines.own_model.static import suspicions
from textmech.reports.compare.own_steps import OWN, steps
from textmech.reports.search.advice.own_model import Recipe, advised

WRIST = find.models()["stiff_wrist"]


def case(name: str = "stiff_wrist") -> ModelCase:
    return load_model(find.models()[name])[0]


def pasted(lines: list[str], text: str) -> str:
    """The file with the lines: an option at its end, attributes in the element that is named."""
    for line in lines:
        if option := re.search(r"<option [^>]*/>", line):
            text = text.replace("</mujoco>", f"{option[0]}</mujoco>")
        else:
            place = re.fullmatch(r'in <joint name="(\w+)" …> write (armature="[\d.e-]+")', line)
            assert place is not None, line
            text = text.replace(f'name="{place[1]}"', f'name="{place[1]}" {place[2]}', 1)
    return text


def own_ratio(text: str) -> float:
    """The worst error of the model's own setting over what is allowed."""
    wrist = replace(case(), given=text)
    result = steps(wrist, opened(wrist), ())
    own = next(each for each in result.settings if each.setting.name == OWN)
    assert own.y is not None
    return max(
        float(error.off.max()) / result.bars[quantity]
        for quantity, error in own.errors.items()
        if error.off is not None
    )


def test_a_stiff_wrist_shakes_and_every_pasted_line_cures_it() -> None:
    (tried,) = advised(case(), None, 2.0).tried
    assert tried.seen[0].startswith("wrist shakes at ")
    assert "stays 0.30 rad short of its target; its own equations bring it there" in tried.seen[0]
    assert any(number.startswith("wrist: (kv + damping) h / M_eff") for number in tried.suspected)
    text = WRIST.with_suffix(".xml").read_text("utf-8")
    assert own_ratio(text) > 100
    armature = next(cure for cure in tried.cures if cure.change.startswith("armature"))
    assert own_ratio(pasted([*armature.lines], text)) < 10
    assert armature.then is not None
    both: list[Recipe] = [armature, armature.then]
    assert own_ratio(pasted([line for each in both for line in each.lines], text)) < 0.5
    assert tried.cheapest is not None
    assert own_ratio(pasted([*tried.cheapest.lines], text)) < 0.5


@pytest.mark.parametrize("name", ["acrobot", "hopper", "closed_loop"])
def test_nothing_is_seen_of_what_only_needs_a_finer_step(name: str) -> None:
    for tried in advised(case(name), None, 2.0).tried:
        assert [*tried.seen] == []


def test_a_model_that_keeps_its_tolerance_needs_no_cure() -> None:
    (tried,) = advised(case("acrobot"), None, 2.0).tried
    assert [*tried.cures] == []
    assert tried.cheapest is not None
    assert tried.cheapest.integrator == "RK4"


def test_a_tolerance_is_of_all_joints() -> None:
    rough = advised(case("closed_loop"), 0.1, 2.0).tried[0]
    assert [*rough.cures] == []


@pytest.mark.mutant("{what}")
@pytest.mark.parametrize(
    ("what", "was", "now"),
    [
        ("a mass that others hold", "1.0 / np.diag(np.linalg.inv(mass_matrix(m, data)))",
         "np.diag(mass_matrix(m, data))"),
        ("a step that plays no part", "(kv + tree.damping) * h / mass",
         "(kv + tree.damping) / mass"),
    ],
)  # fmt: skip
def test_a_static_number_is_that_of_the_formula(what: str, was: str, now: str) -> None:
    """Two masses in a row, 3 and 1 kg: M_eff of the second is 3/4 kg."""
    text = """<mujoco><worldbody><body><joint type="slide" axis="1 0 0"/><geom size=".1" mass="3"/>
    <body><joint name="last" type="slide" axis="1 0 0" damping="2000"/><geom size=".1" mass="1"/>
    </body></body></worldbody></mujoco>"""
    own = compiled_text(text)
    wrong: Any = otherwise(static, was, now)

    def words(module: Any) -> str:
        return next(each.words for each in module.suspicions(own) if each.words.startswith("last"))

    assert f"= {2000 * 0.002 / 0.75:.3g}, above 2" in words(static)
    assert words(wrong) != words(static)


@pytest.mark.mutant("a turn of a motion that is called a shake")
def test_a_swing_is_no_shake(monkeypatch: pytest.MonkeyPatch) -> None:
    hopper = opened(case("hopper")).own
    moved = seen.motion_at_steps(hopper, 0.6)
    assert moved is not None
    bars = [1e-3] * hopper.model.nv
    assert seen.shaking(hopper, *moved, bars) == {}  # type: ignore[arg-type]
    wrong: Any = otherwise(seen, "rate[1:] * rate[:-1] < 0", "rate[1:] * rate[:-1] != 7")
    assert wrong.shaking(hopper, *moved, bars)


def test_what_does_not_move_is_told() -> None:
    advice = advised(of_model("", "MJCF", "still", "<mujoco/>"), None, 2.0)
    assert advice.because == "nothing moves"
    assert not suspicions(compiled_text("<mujoco/>"))
