"""The calculator page as it is seen: drawings announced, everything fits and has a name.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from typing import Any

import pytest

import web.served_page as seen
from web.pressed_ball import browser, server

__all__ = ["browser", "server"]  # fixtures

pytest.importorskip("playwright")

pytestmark = pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")


def test_an_empty_place_announces_the_drawing_until_it_is_made(
    browser: Any, server: seen.Server
) -> None:
    page, _ = seen.new_page(browser, server)
    held: list[Any] = []
    page.route("**/api/drawing", lambda route: held.append(route))
    page.goto(server.address)
    page.wait_for_selector(".drawing.chosen .pictures", state="attached")
    empty = "getComputedStyle(document.querySelector('.drawing.chosen .pictures'), '::before')"
    page.wait_for_function(f"() => {empty}.content === '\"Drawing…\"'")
    for route in held:
        route.continue_()
    page.unroute("**/api/drawing")
    page.wait_for_selector("#drawing-indenter img")
    assert page.evaluate(f"{empty}.content") == "none"


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1440])
def test_everything_fits_and_has_a_name(width: int, browser: Any, server: seen.Server) -> None:
    page, watched = seen.new_page(browser, server)
    page.set_viewport_size({"width": width, "height": 844})
    for name in ("rough-ball", "roller-sentences", "roller-dogbone"):
        seen.visit(page, server)
        with page.expect_response("**/api/check"):
            page.select_option("#examples", name)
        page.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")
        wide = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
        assert page.evaluate(wide) <= 0, name
        page.wait_for_function(
            "() => !document.querySelector('.drawing[aria-busy]') && "
            "document.querySelector('#drawing-indenter img')?.naturalWidth > 0"
        )
        cut = """[...document.querySelectorAll(".drawing .scroll")].filter((each) =>
          each.scrollWidth > each.clientWidth + 1).map((each) => each.closest('.drawing').id)"""
        assert page.evaluate(cut) == [], name
        nameless = page.evaluate(
            """[...document.querySelectorAll("input, select, textarea, button")].filter((each) =>
              each.offsetParent && !each.labels?.length && !each.getAttribute("aria-label") &&
              !/[a-z]/i.test(each.textContent)).map((each) => each.outerHTML)"""
        )
        assert nameless == []
        beyond = page.evaluate(
            """[...document.querySelectorAll("#form input, #form select")].filter((each) =>
              each.offsetParent && each.getBoundingClientRect().right >
              each.closest(".case").getBoundingClientRect().right).map((each) => each.id)"""
        )
        assert beyond == []
    page.context.close()
    assert watched.faults == []
