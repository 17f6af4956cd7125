# SPDX-License-Identifier: GPL-3.0-or-later
"""The page in headless Chromium: loads clean, sliders move, pictures change, tables sort, nothing is cut off."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import conftest
import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from bench.result import save
from report import collect, page

CHROMIUM = "/usr/bin/chromium"
SHOTS = Path(__file__).resolve().parents[2] / "build" / "report"


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Debian's Chromium, without its sandbox, which root and most containers do not have: the page is our own."""
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture(scope="module")
def html(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built page."""
    folder = tmp_path_factory.mktemp("page")
    save(conftest.peers(folder), folder)
    path = folder / "index.html"
    path.write_text(page.build(collect.collect(folder)).html)
    return path


class Opened:
    """A page in the browser, what it complained about, and what it asked for."""

    def __init__(self, browser: Browser, html: Path, width: int = 1400, **context) -> None:
        self.page: Page = browser.new_page(viewport={"width": width, "height": 900}, **context)
        self.complaints: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("dialog", lambda dialog: (self.complaints.append("a dialog"), dialog.dismiss()))
        self.page.on("requestfailed", lambda request: self.complaints.append(f"failed: {request.url[:80]}"))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(html.as_uri())

    def stage(self):
        """Of the comparison that is seen."""
        return self.page.locator(".stage:visible").first

    def cut(self) -> tuple[int, str]:
        """The border's place as told to screen readers, and the left picture's computed clip."""
        now = int(self.stage().locator(".handle").get_attribute("aria-valuenow"))
        return now, self.stage().locator("img.left").evaluate("e => getComputedStyle(e).clipPath")


@pytest.fixture
def opened(browser: Browser, html: Path) -> Iterator[Opened]:
    made = Opened(browser, html)
    yield made
    made.page.close()


def shown(opened: Opened, side: str) -> tuple[str, str]:
    """The picture of a side of the slider, and the name on it."""
    stage = opened.stage()
    return stage.locator(f"img.{side}").get_attribute("src"), stage.locator(f".tag.{side}").inner_text()


@pytest.mark.parametrize(
    ("name", "width", "scheme"), [("wide", 1400, "light"), ("dark", 1400, "dark"), ("phone", 400, "light")]
)
def test_it_loads_clean_at_every_width(browser: Browser, html: Path, name: str, width: int, scheme: str) -> None:
    opened = Opened(browser, html, width, color_scheme=scheme)
    opened.page.evaluate("document.querySelectorAll('img').forEach(e => e.loading = 'eager')")
    opened.page.wait_for_function("[...document.images].every(e => !e.src || e.complete)")
    broken = opened.page.evaluate("[...document.images].filter(e => !e.naturalWidth).map(e => e.alt)")
    assert broken == []
    assert opened.complaints == []
    assert [url for url in opened.asked if not url.startswith(("data:", "file:"))] == []
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= width
    SHOTS.mkdir(parents=True, exist_ok=True)
    opened.page.screenshot(path=SHOTS / f"test-{name}.png", full_page=True)
    opened.page.close()


def test_the_mouse_moves_the_border(opened: Opened) -> None:
    stage = opened.stage()
    stage.scroll_into_view_if_needed()
    before = opened.cut()
    box = stage.bounding_box()
    middle = box["y"] + box["height"] / 2
    opened.page.mouse.move(box["x"] + box["width"] * 0.5, middle)
    opened.page.mouse.down()
    opened.page.mouse.move(box["x"] + box["width"] * 0.25, middle, steps=4)
    opened.page.mouse.up()
    after = opened.cut()
    opened.page.mouse.move(box["x"] + box["width"] * 0.9, middle)
    assert before[0] == 50
    assert abs(after[0] - 25) <= 1
    assert after[1] != before[1]
    assert opened.cut() == after


def test_pixels_left_of_the_border_are_the_left_picture(opened: Opened) -> None:
    stage = opened.stage()
    stage.locator(".handle").press("End")
    left = stage.screenshot()
    stage.locator(".handle").press("Home")
    assert stage.screenshot() != left


def test_a_finger_moves_the_border(browser: Browser, html: Path) -> None:
    opened = Opened(browser, html, 400, has_touch=True)
    stage = opened.stage()
    stage.scroll_into_view_if_needed()
    box = stage.bounding_box()
    opened.page.touchscreen.tap(box["x"] + box["width"] * 0.8, box["y"] + 20)
    assert abs(opened.cut()[0] - 80) <= 1
    opened.page.close()


def test_keys_move_the_border(opened: Opened) -> None:
    handle = opened.stage().locator(".handle")
    handle.focus()
    places = []
    for key in ("ArrowLeft", "ArrowRight", "Shift+ArrowRight", "PageDown", "End", "ArrowRight", "Home", "ArrowLeft"):
        opened.page.keyboard.press(key)
        places.append(opened.cut()[0])
    assert places == [48, 50, 60, 50, 100, 100, 0, 0]
    assert "0 % Cycles 3.4.1, 100 % Cardioid" in handle.get_attribute("aria-valuetext")


def whole(opened: Opened, index: int) -> str:
    """The picture of the scene's card of this index: reference, Cycles, Cardioid."""
    return opened.page.locator(".scene:not(.away) .whole").nth(index).get_attribute("src")


def test_dropdowns_change_pictures_and_figures(opened: Opened) -> None:
    assert len({whole(opened, index) for index in range(3)}) == 3
    assert shown(opened, "left") == (whole(opened, 1), "Cycles 3.4.1")
    assert shown(opened, "right") == (whole(opened, 2), "Cardioid")
    side = opened.page.locator(".scene:not(.away) .side.left").first
    assert all(text in side.inner_text() for text in ("0.457", "0.913", "30.5 s", "24 samples"))
    assert side.locator(".off").inner_text().split() == ["energy", "0.913"]
    side.locator("select").select_option(label="Cardioid")
    assert shown(opened, "left") == (whole(opened, 2), "Cardioid")
    assert all(text in side.inner_text() for text in ("0.0123", "0.999", "30.1 s", "16 samples"))


def test_crops_stand_side_by_side_at_four_times_their_size(opened: Opened) -> None:
    shots = opened.page.locator(".scene:not(.away) .shot")
    assert shots.count() == 3
    assert "reference" in shots.nth(0).get_attribute("class")
    tops = []
    for index in range(3):
        crop = shots.nth(index).locator(".crop").first
        assert crop.evaluate("e => e.width === 4 * e.naturalWidth && e.naturalWidth >= 40")
        tops.append(crop.bounding_box()["y"])
    assert len(set(tops)) == 1
    assert opened.page.locator(".scene:not(.away) .place").count() >= 1


def test_scenes_are_tabs(opened: Opened) -> None:
    tabs = opened.page.locator(".jump [role=tab]")
    assert opened.page.locator(".scene:visible h3").all_inner_texts() == ["Cornell"]
    tabs.nth(1).click()
    assert opened.page.locator(".scene:visible h3").all_inner_texts() == ["Wine glass"]
    opened.page.keyboard.press("ArrowRight")
    assert opened.page.locator(".scene:visible h3").all_inner_texts() == ["Cornell"]
    assert tabs.nth(0).get_attribute("aria-selected") == "true"


def test_comparisons_of_one_scene_are_tabs_within_it(opened: Opened) -> None:
    opened.page.locator(".jump [role=tab]").nth(1).click()
    picks = opened.page.locator(".picks:visible [role=tab]")
    assert picks.all_inner_texts() == ["peers", "peers: direct light"]
    assert opened.page.locator(".compare:visible").count() == 1
    picks.nth(1).click()
    assert "direct light" in opened.page.locator(".compare:visible").inner_text()


def test_tables_sort_by_number_both_ways_with_gaps_last(opened: Opened) -> None:
    table = opened.page.locator("#peers ~ .scroll table.sortable")

    def first_column() -> list[str]:
        return [text.split("\t")[0] for text in table.locator("tbody tr").all_inner_texts()]

    assert first_column() == ["Cycles", conftest.HTML, "Cardioid"]
    heads = table.locator("th")
    heads.nth(1).locator("button").click()
    assert first_column() == ["Cardioid", "Cycles", conftest.HTML]
    assert heads.nth(1).get_attribute("aria-sort") == "ascending"
    heads.nth(1).locator("button").click()
    assert first_column() == ["Cycles", "Cardioid", conftest.HTML]
    heads.nth(2).locator("button").click()
    assert first_column() == [conftest.HTML, "Cardioid", "Cycles"]
    assert heads.nth(1).get_attribute("aria-sort") == "none"


def test_every_verdict_is_in_the_table_and_sorts(opened: Opened) -> None:
    table = opened.page.locator("table.verdicts")
    badges = table.locator("tbody .badge")
    assert badges.all_inner_texts() == ["holds", "does not hold", "cannot be told"]
    assert "30.1 s against 12.3 s" in table.locator("tr.no").inner_text()
    table.locator("th button").first.click()
    assert badges.all_inner_texts() == ["cannot be told", "does not hold", "holds"]


def test_the_button_turns_the_scheme(opened: Opened) -> None:
    paper = "getComputedStyle(document.body).backgroundColor"
    before = opened.page.evaluate(paper)
    opened.page.locator("button.theme").click()
    assert opened.page.evaluate(paper) != before
    assert opened.page.locator("button.theme").get_attribute("aria-pressed") == "true"


def test_on_paper_every_scene_is_there(opened: Opened) -> None:
    opened.page.emulate_media(media="print")
    assert opened.page.locator(".scene:visible").count() == 2
    assert opened.page.locator(".compare:visible").count() == 3
