"""Studies on the calculator page in a browser: their form, progress and answers.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

import web.served_page as seen
from web.calculator_page import CASE
from web.test_web_studies import LONG

pytest.importorskip("playwright")
pytestmark = [
    pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium"),
    pytest.mark.slow,  # a server and a browser
]


@pytest.fixture
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """The page; whatever goes wrong on it fails the test."""
    with seen.served(tmp_path_factory.mktemp("served")) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        page.server = server
        yield page
        assert watched.faults == []
        assert watched.outside == []


def until_studied(page: Any) -> str:
    """Wait until the whole answer of a study is drawn; return the study."""
    found = page.wait_for_function(
        "() => document.documentElement.dataset.studied || ''", timeout=90_000
    )
    return str(found.json_value())


def test_a_sweep_is_typed_run_and_a_case_of_it_opened(page: Any) -> None:
    seen.visit(page, page.server, CASE)
    page.click("#study summary")
    page.select_option("#study-key-1", "load.force")
    assert page.get_attribute("#study-key-1-values", "placeholder") == "e.g. 2 N, 4 N, 8 N"
    assert "now 4 N; units: mN, N, kN" in page.inner_text("#study-form")
    # A mistake, as the command line words it, and no error in the console.
    page.fill("#study-key-1-values", "5, 6 N")
    page.press("#study-key-1-values", "Enter")
    page.wait_for_selector("#study-key-1-values[aria-invalid=true]")
    assert "load.force: 5 has no unit" in page.inner_text("#study-key-1-problems")
    page.fill("#study-key-1-values", "2 N, 8 N")
    page.press("#study-key-1-values", "Enter")
    until_studied(page)
    assert page.inner_text("#study-key-1-problems") == ""
    assert page.locator("#study-figures .plot .main-svg").count() > 0
    assert "±" in page.inner_text("#study-table tbody")
    rows = page.locator("#study-table tbody tr")
    assert rows.count() == 2
    rows.nth(1).get_by_role("button", name="Open the case of run 1 in the form").click()
    page.wait_for_function("() => document.getElementById('field-load.force').value === '8 N'")
    with page.expect_download() as saved:
        page.click("#study-downloads a >> nth=0")
    assert saved.value.suggested_filename == "zener-sphere-force-2-n-8-n.csv"
    for width in (390, 1280):
        page.set_viewport_size({"width": width, "height": 844})
        assert page.evaluate("document.documentElement.scrollWidth") == width
    assert "study" in page.inner_text("#runs li >> nth=0")


def test_a_study_survives_a_reload_and_is_cancelled_and_continued(page: Any) -> None:
    # Long enough for a reload and a click before the third run ends.
    seen.visit(page, page.server, LONG.replace("steps: 600", "steps: 6000"))
    page.click("#study summary")
    page.select_option("#study-key-1", "load.force")
    page.fill("#study-key-1-values", "2 N, 3 N, 4 N")
    page.click("#study-go")
    done = "() => document.getElementById('progress-text').textContent.startsWith('1 of 3 runs')"
    page.wait_for_function(done, timeout=60_000)
    page.reload()
    seen.until_ready(page)
    assert page.inner_text("#progress-title").startswith("Study: ")
    page.click("#cancel")
    page.wait_for_selector("#resume:visible", timeout=30_000)
    assert "cancelled after" in page.inner_text("#progress-text")
    page.wait_for_selector("#study-table tbody tr")
    page.click("#resume")
    page.wait_for_function(
        "() => [...document.querySelectorAll('#study-table td:nth-child(2)')]"
        ".every((cell) => cell.textContent === 'done')",
        timeout=90_000,
    )
    page.wait_for_selector("#progress", state="hidden")


def test_a_design_minimises_a_key_that_keeps_a_limit(page: Any) -> None:
    seen.visit(page, page.server, CASE)
    page.click("#study summary")
    page.click("#study-as-design")
    page.select_option("#study-key-1", "indenter.radius")
    page.fill("#study-key-1-values", "5 mm:20 mm")
    page.select_option("#study-goal", "indenter.radius")
    page.click("#study-go")
    page.wait_for_selector("#study-goal[aria-invalid=true]")
    assert "give a constraint" in page.inner_text("#study-goal-problems")
    page.click("#study-add-limit")
    page.fill("#study-limit-1-bound", "2 MPa")
    page.fill("#study-runs", "10")
    page.click("#study-go")
    until_studied(page)
    assert page.inner_text("#study-headline").startswith("least indenter.radius: ")
    assert page.locator("#study-drawings img").count() == 1
    assert page.locator("#study-table tr.best").count() == 1
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") == 390
