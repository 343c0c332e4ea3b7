"""The page as a person meets it, in a real browser: it works, and asks nobody for anything."""

import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.browser import Tab, browser, found

from textmech.cases.space.rotation import turned
from textmech.reports.page.pack import packed_by_size

WIDTHS = (390, 900, 1500)
SHEET = 794  # px: the width of A4

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
    address = (made.place / "index.html").as_uri()
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


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", WIDTHS)
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


def test_every_link_leads_somewhere(tab: Tab, page: str) -> None:
    look(tab, page)
    lost = tab.ask(
        """[...document.querySelectorAll('a[href]')].map((a) => a.getAttribute('href')).filter(
        (h) => !h.startsWith('#') || !document.getElementById(
        decodeURIComponent(h.slice(1).split(/[?/]/)[0])))"""
    )
    assert lost == []


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
    told = tab.ask(
        """(() => { const m = MOTIONS.swing, pose = poser(m.times, m.poses, m.axes);
        const bar = m.sketch.bodies.rod.lines[0], t = unpack(m.times);
        return Array.from(t, (at) => bar.map((p) => placed(pose(at).get('rod'), p))); })()"""
    )
    states = made.report.solutions["swing"].trajectory.states["rod"]
    for ((x0, y0), (x1, y1)), state in zip(told, states, strict=True):
        assert np.hypot(x0, y0) == pytest.approx(0.0, abs=1e-3)
        assert np.arctan2(y1, x1) == pytest.approx(state[2], abs=2e-3)


def test_the_script_reads_the_errors_that_were_packed(tab: Tab, page: str) -> None:
    look(tab, page)
    errors = np.array([0.0, 1e-7, -3.3, 2.0, -1e-3, 1e-12])
    found = tab.ask(f"Array.from(unpackBySize({json.dumps(packed_by_size(errors))}))")
    assert found == pytest.approx([*errors[:5], 0.0], rel=0.006)


def test_places_turn_with_their_part(tab: Tab, page: str) -> None:
    """The script's rotations, in the plane and in space, against those of the cases."""
    random = np.random.default_rng(3)
    look(tab, page)

    def told(pose: np.ndarray, place: np.ndarray) -> list[float]:
        return tab.ask(f"placed({json.dumps(pose.tolist())}, {json.dumps(place.tolist())})")

    for _ in range(5):
        x, y, angle, a, b = random.normal(size=5)
        turned_by = (a + 1j * b) * np.exp(1j * angle)
        found = told(np.array([x, y, angle]), np.array([a, b]))
        assert found == pytest.approx([x + turned_by.real, y + turned_by.imag])
        q = random.normal(size=4)
        q /= np.linalg.norm(q)
        place, centre = random.normal(size=(2, 3))
        found = told(np.concatenate([centre, q]), place)
        assert found == pytest.approx(centre + turned(q, place))


def test_every_shipped_case_opens(tab: Tab, whole: Path) -> None:
    tab.errors.clear()
    look(tab, whole.as_uri(), width=390, prefers_reduced_motion="reduce")
    assert tab.ask("document.documentElement.scrollWidth") <= 390
    count = tab.ask(
        """(() => { const all = [...document.querySelectorAll('details.case')];
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
    look(tab, page)
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
