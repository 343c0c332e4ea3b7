"""The page in a real browser: it works, asks nobody for anything, and draws joints closed."""

import json
import re
from base64 import b64decode
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mujoco as native
import numpy as np
import pytest
from given.command.browser import Tab, browser, found

from textmech.cases.case import Case
from textmech.cases.scene.point import GROUND
from textmech.engines.own_model import opened as cases_of_models
from textmech.engines.own_model.drawing import outlines
from textmech.reports.front.page.page import NAME, write_measured
from textmech.reports.front.page.page import page as drawn_page
from textmech.reports.runs import suite
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_cases, choose_engines

# The page as a person meets it, in a real browser: it works, and asks nobody for anything.

mujoco: Any = native  # whose functions no type checker sees
WIDTHS = (390, 900, 1440)
SHEET = 794  # px: the width of A4
STOPS = 60  # of the tab key: ten sections, their links, three motions, one choice
SHEETS = {"": 2, "#swing": 2, "#heat": 6}
"""What is printed at most of a choice: with nothing open, the first screen."""

pytestmark = [
    pytest.mark.skipif(found() is None, reason="there is no Chromium on this machine to look with"),
    pytest.mark.slow,
]


@pytest.fixture(scope="module")
def tab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tab]:
    with browser(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


@pytest.fixture
def page(tab: Tab, made: SimpleNamespace) -> Iterator[str]:
    """Its address; whatever was done with it, it said no error and asked for nothing else."""
    yield from quiet(tab, made.place / "index.html")


@pytest.fixture
def of_models(tab: Tab, models_page: Path) -> Iterator[str]:
    """The address of the page of models, which says no error either."""
    yield from quiet(tab, models_page)


def quiet(tab: Tab, file: Path) -> Iterator[str]:
    address = file.as_uri()
    tab.errors.clear()
    tab.requests.clear()
    yield address
    assert tab.errors == []
    asked = [url for url in tab.requests if not url.startswith(("about:", "data:"))]
    assert {url.partition("#")[0] for url in asked} <= {address}


def look(tab: Tab, address: str, **how: Any) -> None:
    """Opens the page, and waits until its data are unpacked."""
    tab.open(address, **how)
    tab.until("document.documentElement.dataset.ready")


def each(selector: str, field: str) -> str:
    """A script: the field of every element that the selector finds."""
    return f"[...document.querySelectorAll('{selector}')].map((one) => one.{field})"


def test_an_error_and_a_request_would_be_seen(tab: Tab, tmp_path: Path) -> None:
    bad = tmp_path / "bad.html"
    bad.write_text('<img src="other.png"><script>nowhere()</script>', encoding="utf-8")
    tab.errors.clear()
    tab.requests.clear()
    tab.open(bad.as_uri())
    assert any("nowhere" in said for said in tab.errors)
    assert any("other.png" in url for url in tab.requests)


def test_the_first_picture_can_be_read_on_a_telephone(tab: Tab, page: str) -> None:
    """Its letters, and those of its legend, are 9 pixels high at least."""
    look(tab, page, width=390)
    assert tab.ask("document.querySelectorAll('#first .keys li').length") == 5
    sizes = """(() => { const size = (one) => parseFloat(getComputedStyle(one).fontSize);
        const scale = ({a, b}) => Math.hypot(a, b), all = (s) => [...document.querySelectorAll(s)];
        return [...all('#first .keys span').map(size),
            ...all('#first .picture text').map((t) => size(t) * scale(t.getScreenCTM()))]; })()"""
    assert min(tab.ask(sizes)) >= 9


def test_the_page_of_one_case_has_no_shares(tab: Tab, made: SimpleNamespace) -> None:
    """Its motion stands in place of the picture, and is seen at once."""
    (case,) = (case for case in made.cases if case.name == "swing")
    rows = [row for row in made.folder.comparisons if row.case == "swing"]
    alone = replace(made.folder, comparisons=rows)
    file = made.place / "alone.html"
    file.write_text(drawn_page(alone, [case], {"swing": made.motions["swing"]}), encoding="utf-8")
    look(tab, file.as_uri())
    assert "all quantities of swing" in tab.ask("document.getElementById('result').textContent")
    assert tab.ask("document.querySelectorAll('#first .picture').length") == 0
    assert tab.ask("document.querySelectorAll('#in-motion svg.mechanism').length") == 1


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (1440, "dark")])
def test_nothing_is_wider_than_the_window(tab: Tab, page: str, width: int, scheme: str) -> None:
    look(tab, f"{page}#swing", width=width, prefers_color_scheme=scheme)
    tab.until("document.querySelector('#swing svg.mechanism')")
    assert tab.ask("document.documentElement.scrollWidth") <= width
    dark = tab.ask("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)"
    assert dark == (scheme == "dark")


def test_text_of_a_case_is_never_markup(tab: Tab, page: str, made: SimpleNamespace) -> None:
    """Its title, and the name of its file, by which it is also found."""
    look(tab, page)
    tab.ask("document.querySelector('#heat-map tbody a').click()")
    tab.until("document.querySelector('details.case[open] svg.mechanism')")
    assert tab.ask("document.querySelector('details.case[open]').id") == made.odd
    assert tab.ask("window.struck") is None
    titles = tab.ask("[...document.querySelectorAll('article h3')].map((h) => h.textContent)")
    assert any("<script>window.struck" in title for title in titles)


def test_a_case_opens_by_its_address_and_moves(tab: Tab, page: str) -> None:
    look(tab, f"{page}#swing/rod.angle")
    tab.until("document.querySelector('#swing svg.mechanism')")
    assert tab.ask("document.getElementById('swing').open")
    assert tab.ask("document.querySelector('#swing select').value") == "rod.angle"
    points = "document.querySelector('#swing .reference .body').getAttribute('points')"
    first = tab.ask(points)
    tab.until(f"{points} !== {first!r}")
    tab.ask("document.querySelector('#swing .play').click()")
    assert tab.ask("document.querySelector('#swing .play').textContent") == "Play"
    still = tab.ask(points)
    tab.ask("new Promise((done) => setTimeout(done, 200))")
    assert tab.ask(points) == still


def test_who_wants_no_motion_gets_a_picture(tab: Tab, page: str) -> None:
    look(tab, f"{page}#swing", prefers_reduced_motion="reduce")
    tab.until("document.querySelector('#swing .play')")
    assert tab.ask("document.querySelector('#swing .play').textContent") == "Play"


def test_the_drawn_bar_is_where_the_reference_is(
    tab: Tab, page: str, made: SimpleNamespace
) -> None:
    """The script's places, against the trajectory itself: hinge at O, the bar at its angle."""
    look(tab, f"{page}#swing", prefers_reduced_motion="reduce")
    tab.until("document.querySelector('#swing .play')")
    (case,) = (case for case in made.cases if case.name == "swing")
    times = case.times.tolist()
    told = tab.ask(
        """((t) => { const m = MOTIONS.swing, pose = poser(m);
        const bar = m.sketch.bodies.rod.lines[0];
        return Array.from(t, (at) => bar.map((p) => placed(pose(at).get('rod'), p))); })"""
        f"({times})"
    )
    states = made.report.solutions["swing"].trajectory.states["rod"]
    for ((x0, y0), (x1, y1)), state in zip(told, states, strict=True):
        assert np.hypot(x0, y0) == pytest.approx(0.0, abs=1e-3)
        assert np.arctan2(y1, x1) == pytest.approx(state[2], abs=2e-3)


def test_models_open_by_their_rows_and_no_name_of_theirs_is_run(tab: Tab, of_models: str) -> None:
    """Whatever they are called; of each that has a limit a drawing moves."""
    look(tab, of_models, prefers_reduced_motion="reduce")
    rows = "#models-table tbody a"
    for k in range(tab.ask(f"document.querySelectorAll('{rows}').length")):
        link = f"document.querySelectorAll('{rows}')[{k}]"
        tab.ask(f"{link}.click()")
        section = f"document.getElementById(decodeURIComponent({link}.hash.slice(1)))"
        tab.until(f"{section}.open && {section}.dataset.full")
        assert tab.ask(f"{section}.dataset.name") == tab.ask(f"{link}.textContent")
    assert tab.ask("document.querySelectorAll('#models svg.mechanism').length") == 4
    assert tab.ask("window.struck") is None
    assert tab.ask("document.querySelectorAll('#models .later').length") == 2  # tube and error
    late = "document.getElementById('models').textContent"
    assert "Later than 0.2 s, where it is grey, nothing is judged." in tab.ask(late)
    text = tab.ask(late).replace("from the reference by our own equations", "")
    assert "reference" not in text  # a limit is called none
    look(tab, f"{of_models}#models?words=sub", width=390)
    assert tab.ask(each("#models-table tbody tr:not([hidden])", "dataset.words")) == [
        "sub/arm v1.2"
    ]
    assert tab.ask("document.documentElement.scrollWidth") <= 390


def test_a_models_body_is_drawn_where_mujoco_has_it(
    tab: Tab, of_models: str, arms: SimpleNamespace
) -> None:
    """The script's places of its lines, against MuJoCo's of the body in the limit's states."""
    look(tab, f"{of_models}#constructor", prefers_reduced_motion="reduce")
    model, body = arms.models[1], "__proto__"
    times = model.limit.times.tolist()
    shown = tab.ask(
        """((t, body) => { const m = MOTIONS.constructor, pose = poser(m);
        const lines = m.sketch.bodies[body].lines.flat();
        return Array.from(t, (at) => lines.map((p) => placed(pose(at).get(body), p))); })"""
        f"({times}, {body!r})"
    )
    own = cases_of_models.opened(model.case).own
    lines = np.concatenate(outlines(own.model)[body])
    data = own.start()
    for places, q in zip(shown, model.limit.q, strict=True):
        data.qpos[:] = q
        mujoco.mj_forward(own.model, data)
        k = own.model.body(body).id
        right = data.xpos[k] + lines @ data.xmat[k].reshape(3, 3).T
        assert np.abs(np.array(places) - right).max() < 1e-3


def test_every_shipped_case_opens(tab: Tab, whole: Path) -> None:
    tab.errors.clear()
    look(tab, whole.as_uri(), width=390, prefers_reduced_motion="reduce")
    count = tab.ask(
        """(() => { const all = [...document.querySelectorAll('details.case')];
        document.getElementById('cases').open = true;
        for (const one of all) { one.open = true; fill(one); }
        return all.filter((one) => one.querySelector('table, svg, select')).length; })()"""
    )
    assert count == tab.ask("document.querySelectorAll('details.case').length") > 100
    assert tab.ask("document.documentElement.scrollWidth") <= 390
    assert tab.errors == []


def test_filters_choose_rows_and_stand_in_the_address(
    tab: Tab, page: str, made: SimpleNamespace
) -> None:
    look(tab, page)
    shown = each("#heat-map tbody tr:not([hidden]) th", "textContent")
    assert tab.ask(shown) == [made.odd, "swing"]
    tab.ask(
        """(() => { const field = document.querySelector('#heat [name=words]');
        field.value = 'swing hos';
        field.dispatchEvent(new Event('input', {bubbles: true})); })()"""
    )
    assert tab.ask(shown) == [made.odd]  # its title is searched too
    assert tab.ask("document.querySelector('#heat .count').textContent") == "1 of 2"
    address = tab.ask("location.href")
    assert "heat?words=swing" in address
    look(tab, address)
    assert tab.ask(shown) == [made.odd]
    look(tab, f"{page}#heat?column=pymunk&kind=beyond")
    heads = each("#heat-map thead th[data-column]:not([hidden])", "dataset.column")
    assert set(tab.ask(heads)) == {"pymunk"}


def test_advice_is_chosen_and_copied(tab: Tab, page: str) -> None:
    look(tab, f"{page}#need?engine=pymunk")
    row = "#advice-themes tbody tr:not([hidden])"
    assert tab.ask(each(row, "dataset.engine")) == ["pymunk"]
    button = f"document.querySelector('{row} .copy')"
    tab.ask(f"{button}.click()")
    tab.until(f"['copied', 'marked'].includes({button}.textContent)")


def test_a_case_is_opened_by_keyboard(tab: Tab, page: str) -> None:
    look(tab, f"{page}#cases")
    tab.ask("document.querySelector('#swing summary').focus()")
    tab.press("Enter")
    tab.until("document.querySelector('#swing svg.mechanism')")
    tab.press("Tab")
    assert tab.ask("document.activeElement.tagName") == "SELECT"


def test_on_paper_nothing_is_cut_off(tab: Tab, page: str) -> None:
    look(tab, f"{page}#swing", width=SHEET)
    tab.call("Emulation.setEmulatedMedia", media="print")
    try:
        assert tab.ask("document.documentElement.scrollWidth") <= SHEET
        tall = "[...document.querySelectorAll('.tall')].map((t) => getComputedStyle(t).maxHeight)"
        assert set(tab.ask(tall)) == {"none"}
        assert tab.ask("getComputedStyle(document.querySelector('nav')).display") == "none"
    finally:
        tab.call("Emulation.setEmulatedMedia", media="")


def test_a_browser_that_cannot_unpack_says_so_and_shows_the_tables(tab: Tab, page: str) -> None:
    without = "delete globalThis.DecompressionStream"
    script = tab.call("Page.addScriptToEvaluateOnNewDocument", source=without)
    try:
        tab.open(f"{page}#heat?words=swing")
        said = "document.querySelector('#old')"
        tab.until(f"{said}.checkVisibility() && {said}.textContent.includes('cannot unpack')")
        tab.until("document.querySelector('#heat .count').textContent")
    finally:
        tab.call("Page.removeScriptToEvaluateOnNewDocument", **script)
    look(tab, page)
    assert not tab.ask("document.querySelector('#old').checkVisibility()")


def test_the_first_screen_says_the_result_moves_and_answers(tab: Tab, whole: Path) -> None:
    """On a usual screen: a sentence with its picture, three motions, and a setting to copy."""
    look(tab, whole.as_uri(), width=1440, height=900)
    sentence = tab.ask("document.getElementById('result').textContent")
    assert re.match(
        r"mujoco keeps every quantity within .* in \d+ of \d+ cases as shipped", sentence
    )
    assert sentence.count(".") == 1
    parts = {
        "#result": 1,
        "#first .picture svg": 1,
        "#in-motion svg.mechanism": 3,
        "#answer code": 1,
    }
    for part, count in parts.items():
        bottoms = (
            f"[...document.querySelectorAll('{part}')].map((e) => e.getBoundingClientRect().bottom)"
        )
        found = tab.ask(bottoms)
        assert len(found) == count, part
        assert 0 < max(found) <= 900, part
    moving = "document.querySelector('#in-motion .reference .body').getAttribute('points')"
    tab.until(f"{moving} !== {tab.ask(moving)!r}")


def test_all_else_is_folded_and_few_stops_of_the_tab_key_are_left(tab: Tab, whole: Path) -> None:
    look(tab, whole.as_uri())
    assert tab.ask("document.querySelectorAll('details[open]').length") == 0
    stops = "a[href], button, input, select, summary, [tabindex]"
    reached = f"""[...document.querySelectorAll('{stops}')].filter((one) =>
        one.tabIndex >= 0 && one.checkVisibility()).length"""
    assert 20 < tab.ask(reached) <= STOPS
    tab.ask("document.getElementById('heat').open = true")
    assert tab.ask(reached) <= STOPS + 10  # its filters, and the map as one


@pytest.mark.parametrize(
    ("address", "opened"),
    [
        ("#heat?theme=pins", ["heat"]),
        ("#need?engine=pymunk", ["need"]),
        ("#each", ["need", "each"]),
        ("#swing/rod.angle", ["cases", "swing"]),
    ],
)
def test_an_address_opens_what_is_folded(
    tab: Tab, page: str, address: str, opened: list[str]
) -> None:
    look(tab, page + address)
    assert tab.ask(each("details[open]", "id")) == opened
    look(tab, page)
    tab.ask(f"location.hash = '{address}'")  # as a link does
    tab.until(f"document.querySelectorAll('details[open]').length === {len(opened)}")


def test_what_is_opened_stands_in_the_address(tab: Tab, page: str) -> None:
    look(tab, page)
    tab.ask("document.querySelector('#trust > summary').click()")
    assert tab.ask("location.hash") == "#trust"


@pytest.mark.parametrize("width", WIDTHS)
def test_no_figure_and_no_section_hangs_out(tab: Tab, whole: Path, width: int) -> None:
    """With all sections open, and the fullest of the cases."""
    look(tab, f"{whole.as_uri()}#dynamometer", width=width, prefers_reduced_motion="reduce")
    tab.ask("for (const one of document.querySelectorAll('details.fold, #each')) one.open = true")
    tab.until("document.querySelector('#work-figures svg')")
    assert tab.ask("document.documentElement.scrollWidth") <= width
    wide = f"""[...document.querySelectorAll('figure, svg')].filter((one) => one.checkVisibility()
        && one.getBoundingClientRect().right > {width}).length"""
    assert tab.ask(wide) == 0
    right = "getBoundingClientRect().right"
    over = f"""[...document.querySelectorAll('#heat-map tbody th')].filter((th) =>
        th.firstChild.{right} > th.{right} + 1).length"""
    assert tab.ask(over) == 0  # no name lies on a number


@pytest.mark.parametrize("address", SHEETS)
def test_what_is_printed_is_what_is_open(
    tab: Tab, whole: Path, made: SimpleNamespace, address: str
) -> None:
    text = whole if address != "#swing" else made.place / "index.html"
    look(tab, text.as_uri() + address, width=SHEET)
    paper = tab.call("Page.printToPDF", preferCSSPageSize=True)["data"]
    sheets = len(re.findall(rb"/Type ?/Page\b", b64decode(paper)))
    assert 1 <= sheets <= SHEETS[address]


def test_every_table_has_a_caption_and_every_picture_a_name(tab: Tab, page: str) -> None:
    look(tab, f"{page}#swing")
    tab.ask("for (const one of document.querySelectorAll('details')) one.open = true")
    tab.until("document.querySelectorAll('#swing table').length > 2")
    assert tab.ask("[...document.querySelectorAll('table')].filter((t) => !t.caption).length") == 0
    bare = """[...document.querySelectorAll('svg')].filter((one) => !one.closest('[aria-hidden]')
        && !(one.getAttribute('role') === 'img' && one.getAttribute('aria-label'))).length"""
    assert tab.ask(bare) == 0
    assert tab.ask("document.querySelectorAll('svg[role=img]').length") > 5


def test_the_words_of_the_heat_map_come_by_key_and_by_finger(tab: Tab, page: str) -> None:
    look(tab, f"{page}#heat")
    words = "document.getElementById('heat-words').textContent"
    tab.ask("document.querySelector('#heat-map [tabindex=\"0\"]').focus()")
    tab.press("ArrowRight")
    first = tab.ask(words)
    assert "mujoco shipped: " in first
    assert "of what is allowed" in first
    tab.press("ArrowDown")
    assert tab.ask(words).startswith("swing, mujoco shipped: ")
    tab.ask("document.querySelector('#heat-map tbody td').click()")  # as a finger does
    assert tab.ask(words) == first
    tab.press("Enter")
    tab.until("document.querySelector('#cases details.case[open] svg.mechanism')")


def test_the_heat_map_goes_by_the_worst(tab: Tab, whole: Path) -> None:
    look(tab, f"{whole.as_uri()}#heat?order=worst&column=pymunk")
    rows = "#heat-map tbody tr"
    cells = f"[...document.querySelectorAll('{rows}')].map(badness)"
    worst = [float("inf") if w is None else w for w in tab.ask(cells)]  # JSON has no infinity
    assert worst == sorted(worst, reverse=True)
    assert worst[0] > worst[-1]
    tab.ask("location.hash = '#heat?column=pymunk'")
    names = f"[...document.querySelectorAll('{rows} th')].map((one) => one.textContent)"
    tab.until(f"String({names}) === String({names}.sort())")


def test_a_setting_is_chosen_on_the_first_screen(tab: Tab, page: str) -> None:
    look(tab, page)
    assert tab.ask("document.querySelector('#answer code').textContent") == (
        "mujoco: {integrator: RK4}"
    )
    look(tab, f"{page}#choose?engine=pymunk&tolerance=1e-3")
    answer = "document.getElementById('answer')"
    assert "pymunk: {error_bias: 0.0}" in tab.ask(f"{answer}.textContent")
    assert "at 0.63 ms keeps 1 of 1 case about pins" in tab.ask(f"{answer}.textContent")
    tab.ask(f"{answer}.querySelector('.copy').click()")
    tab.until(f"['copied', 'marked'].includes({answer}.querySelector('.copy').textContent)")
    assert "engine=pymunk" in tab.ask(f"{answer}.querySelector('a').getAttribute('href')")
    none = "#choose?engine=pymunk&tolerance=as the case allows"
    tab.ask(f"location.hash = '{none}'")
    tab.until(f"{answer}.textContent.startsWith('No case about pins was asked in pymunk')")


def test_numbers_are_written_in_one_style_and_on_one_line(tab: Tab, page: str) -> None:
    look(tab, page)
    told = [0.00000179, 1e-8, 2.05e-7, 0.5, 1234.5, 3e7, 0]
    found = [tab.ask(f"few({number!r})") for number in told]
    assert found == ["1.79e-6", "1e-8", "2.05e-7", "0.5", "1230", "3e7", "0"]
    tab.ask("location.hash = '#swing'")
    tab.ask("for (const one of document.querySelectorAll('#swing details')) one.open = true")
    tab.until("document.querySelector('#swing td.num')")
    spaces = "[...document.querySelectorAll('td.num')].map((c) => getComputedStyle(c).whiteSpace)"
    assert set(tab.ask(spaces)) == {"nowrap"}
    assert tab.ask("document.querySelectorAll('#swing td .chip').length") > 0  # verdicts


# What is certified closed is drawn closed: places of the drawing, at times between its poses.

HALF_A_PIXEL = 0.5  # px: what nobody sees
LOOPS = ("four_bar", "slider_crank", "skew_chain", "heavy_top.loops")
OWN_LOOP = """
title: A four-bar whose crank turns by ten radians from sample to sample
scene:
  points: {O: [0, 0], Q: [1.2, 0.1]}
  bodies:
    crank: {bar: {mass: 0.5, length: 0.35}}
    coupler: {bar: {mass: 1.0, length: 1.1}}
    rocker: {bar: {mass: 0.8, length: 0.7}}
  joints:
    A: {pin: [ground.O, crank.start]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
  forces: {engine: {torque: crank, constant: 6.0}}
initial: {crank: {angle: 50 deg, omega: 10.0}}
near: {rocker: {angle: 100 deg}}
duration: 1.0
samples: 11
allow: {crank.angle: 1.0e-2, C.gap: 1.0e-4}
"""


@pytest.fixture(scope="module")
def made_of_loops(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A page of these cases and of one of a user's own, by their names."""
    place = tmp_path_factory.mktemp("closed")
    (place / "own_four_bar.yaml").write_text(OWN_LOOP, encoding="utf-8")
    cases = choose_cases([*LOOPS, str(place / "own_four_bar.yaml")])
    engines = choose_engines(["mujoco"], ["shipped"])
    report = suite.measure(Request(cases, engines))
    assert not report.mistakes
    write_measured(report, place / "page")
    address = (place / "page" / NAME).as_uri()
    return SimpleNamespace(address=address, cases={case.name: case for case in cases})


def opened(tab: Tab, made_of_loops: SimpleNamespace, name: str) -> None:
    tab.open(f"{made_of_loops.address}#{name}", width=1440, prefers_reduced_motion="reduce")
    tab.until(f"document.getElementById({name!r}).querySelector('svg.mechanism')")


def joint_ends(case: Case) -> dict[str, list[Any]]:
    """Of each joint that lets nothing shift its two places, each on its part."""

    def place(at: Any) -> list[Any]:
        if at.body == GROUND:
            return ["", [float(x) for x in case.scene.points[at.point].at]]
        return [at.body, [float(x) for x in case.scene.bodies[at.body].points[at.point]]]

    joints = {name: joint for name, joint in case.scene.joints.items() if not joint.shifts}
    return {name: [place(at) for at in joint.refers()] for name, joint in joints.items()}


APART = """((name, joints, straight) => {
    const motion = MOTIONS[name], pose = poser(motion), t = motion.times;
    const window = frame(motion, camera(motion, 35), pose, t), last = t[t.length - 1];
    const width = document.getElementById(name).querySelector('svg.mechanism')
        .getBoundingClientRect().width / CANVAS.width;
    const line = (time) => {
        const k = Math.max(1, t.findIndex((at) => at >= time)), [from, to] = [t[k - 1], t[k]];
        const [a, b] = [pose(from), pose(to)], s = (time - from) / (to - from);
        const between = (part, c) => c.map((v, i) => v + s * (b.get(part)[i] - v));
        return new Map([...a].map(([part, c]) => [part, between(part, c)]));
    };
    return joints.map((ends) => Array.from({length: 1500}, (_, k) => {
        const time = last * (k + .5) / 1500, now = straight ? line(time) : pose(time);
        const [[x, y], [u, v]] = ends.map(([part, place]) => window(placed(now.get(part), place)));
        return width * Math.hypot(x - u, y - v);
    })); })"""


@pytest.mark.mutant("straight lines between the poses of the animation")
@pytest.mark.parametrize("name", [*LOOPS, "own_four_bar"])
def test_no_joint_is_drawn_open(tab: Tab, made_of_loops: SimpleNamespace, name: str) -> None:
    """By the page's own functions, in pixels of its drawing, at 1500 times; a rod stays long."""
    case = made_of_loops.cases[name]
    opened(tab, made_of_loops, name)
    joints = joint_ends(case)

    def opens(straight: str) -> float:
        asked = json.dumps([*joints.values()])
        apart = np.array(tab.ask(f"{APART}({name!r}, {asked}, {straight})"))
        rods = [getattr(case.scene.joints[joint], "swings", False) for joint in joints]
        return float(np.max(np.where(rods, np.ptp(apart, axis=1), np.max(apart, axis=1))))

    assert opens("false") < HALF_A_PIXEL
    if name in ("four_bar", "own_four_bar"):
        assert opens("true") > 2 * HALF_A_PIXEL


BARS = """((name) => {
    const section = document.getElementById(name), root = section.querySelector('svg.mechanism');
    const slider = section.querySelector('[aria-label=time]');
    const width = root.getBoundingClientRect().width / CANVAS.width;
    const number = (text) => width * Number(text);
    const bars = [...root.querySelectorAll('.reference .body')];
    return Array.from({length: 334}, (_, k) => {
        slider.value = 3 * k;
        slider.dispatchEvent(new Event('input', {bubbles: true}));
        return bars.map((bar) => bar.getAttribute('points').split(' ').map(
            (point) => point.split(',').map(number)));
    }); })"""


@pytest.mark.parametrize("name", ["four_bar", "own_four_bar"])
def test_the_bars_that_are_drawn_hang_together(
    tab: Tab, made_of_loops: SimpleNamespace, name: str
) -> None:
    """Read from the drawing itself, at 334 places of its slider; no bar is drawn shorter."""
    opened(tab, made_of_loops, name)
    bars = np.array(tab.ask(f"{BARS}({name!r})"))  # time, bar, end, axis
    crank, coupler, rocker = np.moveaxis(bars, 1, 0)
    gaps = [crank[:, 1] - coupler[:, 0], coupler[:, 1] - rocker[:, 1]]
    gaps += [end - end[0] for end in (crank[:, 0], rocker[:, 0])]  # on the ground
    assert np.max(np.linalg.norm(gaps, axis=-1)) < HALF_A_PIXEL
    lengths = np.linalg.norm(bars[:, :, 1] - bars[:, :, 0], axis=-1)
    assert np.max(np.ptp(lengths, axis=0)) < HALF_A_PIXEL
    angle = np.unwrap(np.arctan2(*(crank[:, 1] - crank[:, 0]).T))
    assert np.ptp(angle) > 0.5  # it moves
