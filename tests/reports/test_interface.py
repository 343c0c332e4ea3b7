"""The interface for Python: the frames, and the command's own words for what is wrong."""

import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from given.command import NEW
from given.command import textmech as command
from given.scenes.swing import SWING

import textmech.reports
from textmech.cases.mistake import CaseError
from textmech.reports import advise, load, run, solve

Ask = Callable[[], object]


@pytest.fixture
def swing(tmp_path: Path) -> Path:
    file = tmp_path / "swing.yaml"
    file.write_text(SWING, encoding="utf-8")
    return file


def test_load_takes_names_variants_and_files(swing: Path) -> None:
    assert [case.name for case in load("rolling_wheel")] == [
        "rolling_wheel.pushed",
        "rolling_wheel.downhill",
    ]
    (case,) = load("rolling_wheel.pushed")
    assert [c.name for c in load([case, swing, str(swing)])] == ["rolling_wheel.pushed", "swing"]


@pytest.mark.slow
def test_load_of_nothing_is_all() -> None:
    names = [case.name for case in load()]
    assert {"four_bar", "sliding_block.below", "creeping_block"} <= set(names)
    assert load([]) == load()


@pytest.mark.slow
def test_solve_gives_the_motion_with_its_units() -> None:
    """A block brakes as v0 - mu g t, and stops at v0/(mu g)."""
    found = solve("sliding_block.braking")
    assert list(found.motion) == ["block.x", "touch.slip", "block.y"]
    assert found.motion.index.name == "t"
    assert found.units == {"block.x": "m", "touch.slip": "m/s", "block.y": "m"}
    stop = 3.0 / (0.4 * 9.80665)
    t = np.minimum(found.motion.index, stop)
    np.testing.assert_allclose(found.motion["block.x"], 3.0 * t - 0.2 * 9.80665 * t**2, atol=1e-12)
    assert found.events.values.tolist() == [["stops", 1, pytest.approx(stop, abs=1e-12)]]
    assert found.checks.holds.all()
    assert found.checks.certified.max() < 1e-9


@pytest.mark.slow
def test_the_summary_is_that_of_the_command() -> None:
    found = run("bar_pendulum", engines=["mujoco.shipped"]).summary
    told = command("run", "bar_pendulum", "--engine", "mujoco.shipped", "--json").stdout
    assert found.cured.tolist() == [line["cured"] for line in json.loads(told)["summary"]]
    assert "RK4" in found.cured[0]


@pytest.mark.slow
def test_run_gives_the_reports_as_frames(swing: Path) -> None:
    own = {"mujoco": {"integrator": "RK4"}}
    found = run(swing, engines=["mujoco"], options=own)
    assert list(found.summary.setting) == ["mujoco.shipped", "mujoco.recommended", "mujoco.own"]
    rows = found.tolerance.set_index(["setting", "quantity"])
    assert set(rows.index) == {
        (setting, quantity)
        for setting in ("shipped", "recommended", "own", "tuned")
        for quantity in ("audit", "rod.angle")
    }
    fourth, first = (rows.error[setting, "rod.angle"] for setting in ("own", "shipped"))
    assert fourth < 1e-6 < first
    assert not found.fails
    assert set(found.convergence.ladder) <= {"held", "following"}
    assert found.events.empty
    assert (found.reference.verdict == "holds").all()


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: run("four_bra"), ["four_bra"]),
        (lambda: run("four_bar", engines=["book"]), ["four_bar", "--engine", "book"]),
    ],
)
def test_what_is_wrong_is_said_as_by_the_command(ask: Ask, words: list[str]) -> None:
    with pytest.raises(CaseError) as caught:
        ask()
    said = str(caught.value)
    assert said
    assert command("run", *words).stderr.startswith(f"{said}\n")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"mujoco": {"integratr": "RK4"}}, "options: mujoco.integratr: unknown option"),
        ({"mujoko": {}}, "options: mujoko: no such engine; did you mean 'mujoco'?"),
        ({"mujoco": 3}, "options: mujoco: should be a map of the engine's options"),
    ],
)
def test_wrong_options_are_named(options: dict, said: str) -> None:
    with pytest.raises(CaseError) as caught:
        run("four_bar", options=options)
    assert str(caught.value).startswith(said)


LOOP: dict[str, Any] = {}
LOOP["mujoco"] = LOOP
WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "a number for a case": (
        lambda: load(5),
        "cases: should be str or Path or Case or ModelCase, or several",
    ),
    "no case": (lambda: load(None), "cases: should be str or Path or Case"),
    "one of several is none": (lambda: run(["four_bar", 3]), "cases: should be str or Path"),
    "an empty name": (lambda: load(""), "'': no such case: the name is empty"),
    "nothing to solve": (lambda: solve([]), "cases: none is named; one can be solved"),
    "nothing to advise": (lambda: advise([]), "cases: none is named"),
    "options in a list": (lambda: run("four_bar", options=[1]), "options: should be as {"),
    "an option that is no text": (
        lambda: run("four_bar", options={"mujoco": {1: 2}}),
        "options: should be as {",
    ),
    "text for a number": (
        lambda: run("four_bar", jobs="2"),
        "jobs: should be a whole number up to 1024, from 1 on, is '2'",
    ),
    "part of a process": (lambda: run("four_bar", jobs=1.5), "jobs: should be a whole number"),
    "too many": (lambda: run("four_bar", jobs=1025), "jobs: should be a whole number up to 1024"),
    "more than any double": (lambda: run("four_bar", jobs=10**400), "jobs: should be a whole"),
    "a part of more": (
        lambda: advise("four_bar", margin=Fraction(10**400)),
        "margin: should be a number from 1 on",
    ),
    "no margin": (lambda: advise("four_bar", margin=None), "margin: should be a number from 1 on"),
    "options in themselves": (lambda: run("four_bar", options=LOOP), "options: should be as {"),
    "an empty generator": (lambda: solve(x for x in ()), "cases: none is named"),
    "a truth": (lambda: run("four_bar", jobs=True), "jobs: should be a whole number"),
    "no number": (
        lambda: advise("four_bar", tolerance="x"),
        "tolerance: should be a number above 0, is 'x'",
    ),
    "a margin of text": (lambda: advise("four_bar", margin="2"), "margin: should be a number from"),
    "engines by number": (lambda: run("four_bar", engines=3), "engines: should be str, or several"),
    "bytes": (lambda: run("four_bar", settings=b"tuned"), "settings: should be str or Path"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_of_a_wrong_kind_is_a_mistake_and_no_traceback(name: str) -> None:
    ask, said = WRONG[name]
    with pytest.raises(CaseError) as caught:
        ask()
    assert str(caught.value).startswith(said)


@pytest.mark.slow
def test_one_engine_and_one_setting_need_no_list(swing: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_text("mujoco: {integrator: RK4}\n", encoding="utf-8")
    found = run(swing, engines="mujoco", settings=mine).summary
    assert list(found.setting) == ["mujoco.shipped", "mujoco.recommended", "mujoco.mine"]


@pytest.mark.slow
def test_what_numpy_and_pandas_have_is_taken(swing: Path) -> None:
    assert solve(np.array([str(swing)])).checks.holds.all()
    assert [case.name for case in load(pd.Series([str(swing)] * 2))] == ["swing"]
    with pytest.raises(CaseError, match=r"swing\.yaml, rolling_wheel: has variants; solve one of"):
        solve(pd.Series([str(swing), "rolling_wheel"]))
    numbers = {"iterations": np.int64(50), "step": np.float32(1e-3), "solref": np.array([0.02, 1])}
    found = run(swing, engines="mujoco", options={"mujoco": numbers}).summary
    assert list(found.setting)[-1] == "mujoco.own"


def test_a_file_with_mistakes_is_no_run(tmp_path: Path) -> None:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW.replace("mass: 2.0", "mass: -2.0"), encoding="utf-8")
    for ask in (load, solve, run):
        with pytest.raises(CaseError, match=r"cart\.yaml:5:20"):
            ask(file)


@pytest.mark.slow
def test_a_mistake_that_only_solving_finds_is_raised(tmp_path: Path) -> None:
    file = tmp_path / "cart.yaml"
    events = "events: {stops: {cart.vx: {rises to: 1.0e+3}}}\n"
    text = NEW.replace("allow:", f"{events}allow:").replace("1.0e-2}", "1.0e-2, stops.time: 1.0}")
    file.write_text(text, encoding="utf-8")
    for ask in (solve, run):
        with pytest.raises(CaseError, match="stops"):
            ask(file)


def test_what_there_is_not_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'sovle'"):
        _ = textmech.reports.sovle


@pytest.mark.slow
def test_the_readmes_python_runs_and_prints_what_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a terminal of any width."""
    monkeypatch.setenv("COLUMNS", "60")
    text = (Path(textmech.reports.__file__).parents[1] / "README.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    exec(compile(code, "README.md", "exec"), {})
    told = [line[2:] for line in code.splitlines() if line.startswith("# ")]
    assert capsys.readouterr().out.splitlines() == told


@pytest.mark.slow
def test_a_run_has_the_motions_behind_its_rows(swing: Path) -> None:
    """What an engine's motion is off the reference's is its row's error."""
    found = run(swing, engines=["mujoco"])
    (motions,) = found.motions.values()
    assert motions.index.names == ["engine", "setting", "realised", "t"]
    exact = solve(swing)
    right = motions.loc["reference", "", ""]
    pd.testing.assert_frame_equal(right, exact.motion)
    rows = found.tolerance.set_index(["setting", "quantity"])
    for setting in ("shipped", "tuned"):
        own = motions.loc["mujoco", setting, "native"]
        off = (own["rod.angle"] - right["rod.angle"]).abs().max()
        assert off == pytest.approx(rows.error[setting, "rod.angle"], rel=1e-3, abs=1e-11)
        assert not own.isna().any().any()


@pytest.mark.slow
def test_an_attitude_is_told_of_an_engine_as_of_the_reference() -> None:
    motions = run("spinning_body", engines=["mujoco.tuned"]).motions["spinning_body"]
    turned = [motions.loc[way]["body.attitude"] for way in
              (("reference", "", ""), ("mujoco", "tuned", "native"))]  # fmt: skip
    assert turned[0].max() > 1
    assert turned[1].to_numpy() == pytest.approx(turned[0].to_numpy(), abs=1e-3)


@pytest.mark.slow
def test_a_figure_has_the_reference_its_tolerance_and_each_engine(swing: Path) -> None:
    found = run(swing, engines=["mujoco"])
    (axes,) = found.plot().axes
    labels = [line.get_label() for line in axes.lines]
    assert labels == ["reference", "mujoco shipped", "mujoco recommended", "mujoco tuned"]
    (band,) = axes.collections
    low, high = band.get_datalim(axes.transData).intervaly
    right = solve(swing).motion["rod.angle"]
    assert (low, high) == pytest.approx((right.min() - 0.01, right.max() + 0.01), abs=1e-3)
    assert len(solve(swing).plot(["rod.angle", "rod.x"]).axes) == 2
    with pytest.raises(CaseError, match=r"no such one: 'rod.angel'; did you mean 'rod.angle'"):
        found.plot(quantities="rod.angel")
    with pytest.raises(CaseError, match="no such one: 'swung'"):
        found.plot("swung")


@pytest.mark.slow
def test_a_notebook_shows_each_answer(swing: Path) -> None:
    """As HTML, in which nothing is cut short and a title is text, and as a picture."""
    hostile = swing.read_text(encoding="utf-8").replace("title: ", "title: <b>x</b> ")
    swing.write_text(hostile, encoding="utf-8")
    (case,) = load(swing)
    shown = case._repr_html_()
    assert "&lt;b&gt;x&lt;/b&gt;" in shown
    assert "rod.angle" in shown
    found, exact = run(case, engines=["mujoco.shipped"]), solve(case)
    assert "certified: rod.angle to" in exact._repr_html_()
    assert all(cell in found._repr_html_() for cell in found.summary.iloc[0] if cell)
    for answer in (found, exact):
        assert "data:image/png;base64,iVBOR" in answer._repr_html_()
        assert answer.plot()._repr_png_().startswith(b"\x89PNG")
