"""Two tabs, reloads and a server that dies: no run of the calculator page is lost.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import web.served_page as seen
from closeness import close_to
from web.pressed_ball import BALL, LONG, browser, page, server

__all__ = ["browser", "page", "server"]  # fixtures

pytest.importorskip("playwright")

pytestmark = pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")


@pytest.mark.slow
def test_two_tabs_do_not_disturb_each_other(browser: Any, server: seen.Server) -> None:
    one, watched = seen.new_page(browser, server)
    seen.visit(one, server, BALL)
    two = one.context.new_page()
    watched.watch(two)
    seen.visit(two, server)
    seen.write_case(two, BALL)
    seen.type_into(two, "load.force", "800 N")
    first, second = seen.run(one, "#coarse"), seen.run(two, "#coarse")
    # d ~ F^(2/3): four times as deep.
    shallow, deep = (float(seen.fact(tab, "Approach").split()[0]) for tab in (one, two))
    assert deep == close_to(4 * shallow, rel=0.03)
    for tab, run, force in ((one, first, "100 N"), (two, second, "800 N")):
        tab.reload()
        seen.until_ready(tab)
        seen.until_drawn(tab, run)
        assert tab.input_value('[id="field-load.force"]') == force
    one.context.close()
    assert watched.faults == []


@pytest.mark.slow
def test_a_reload_in_mid_run_finds_the_run_and_it_can_be_cancelled(
    page: Any, server: seen.Server
) -> None:
    seen.visit(page, server, LONG)
    page.click("#refine")
    page.wait_for_function(
        "() => document.getElementById('progress-text').textContent.includes('step')",
        timeout=60_000,
    )
    page.reload()
    seen.until_ready(page)
    page.wait_for_function("() => document.getElementById('progress-bar').value > 0")
    # Area, approach and peak pressure grow, those of before the reload included.
    grown = """() => [...document.querySelectorAll("#growing .plot")].map(
      (each) => each.calcdata?.[0].length ?? 0)"""
    page.wait_for_function(f"() => Math.min(...({grown})(), 3) > 2", timeout=60_000)
    assert len(page.evaluate(grown)) == 3
    ends = "[...document.querySelectorAll('#growing .plot')].map((each) => each.layout.xaxis.range)"
    assert page.evaluate(ends) == 3 * [[0, 100]]
    assert page.is_visible("#cancel")
    page.click("#cancel")
    page.wait_for_selector("#resume", state="visible")
    # What had been computed is shown.
    page.wait_for_selector("#results", state="visible")
    page.wait_for_selector("#histories .plot svg")


@pytest.mark.slow
def test_a_server_that_dies_in_mid_run_is_missed_and_continued(
    browser: Any, tmp_path: Path
) -> None:
    with seen.served(tmp_path) as server:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, LONG)
        page.click("#refine")
        seen.until_at_work(page)
        server.kill()
        page.wait_for_selector("#offline", state="visible")
        assert page.input_value('[id="field-load.force"]') == "100 N"
        server.start()
        page.wait_for_selector("#offline", state="hidden")
        page.wait_for_selector("#resume", state="visible")
        page.click("#resume")
        # What had been computed is shown at once; error bars come when the run is whole.
        page.locator("#numbers", has_text="%").wait_for(timeout=90_000)
        assert page.is_hidden("#progress")
        page.context.close()
    broken = [fault for fault in watched.faults if "ERR_" not in fault]
    assert all(fault.startswith("Failed to load resource") for fault in broken), broken
    assert watched.outside == []
