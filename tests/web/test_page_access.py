"""What the page shows of a refusal, in a browser: no token, too large, too many.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import web.served_page as seen
from viscontact.web.access import TOKEN_NAME
from web.calculator_page import CASE
from web.pressed_ball import browser

__all__ = ["browser"]  # fixture

pytest.importorskip("playwright")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium"),
]


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[seen.Server]:
    with seen.served(tmp_path_factory.mktemp("served") / "page") as server:
        yield server


@pytest.fixture
def page(browser: Any, server: seen.Server) -> Iterator[Any]:
    page, _ = seen.new_page(browser, server)
    yield page
    page.context.close()


def test_the_token_opens_the_page_once_and_leaves_the_address(
    browser: Any, server: seen.Server
) -> None:
    page, watched = seen.new_page(browser, server)
    seen.visit(page, server, CASE)
    assert page.evaluate("location.search + document.cookie") == ""  # no script reads the cookie
    again = page.context.new_page()
    again.goto(server.page)
    seen.until_ready(again)
    assert watched.faults == []
    page.context.close()


def test_a_browser_without_the_token_is_told_what_to_do(page: Any, server: seen.Server) -> None:
    for address in (server.page, f"{server.page}?token=wrong", f"{server.page}api/runs"):
        assert page.goto(address).status == 401
        assert "open the address that viscontact serve has printed" in page.inner_text("body")
    page.goto(server.address)
    seen.until_ready(page)


def test_a_page_that_lost_its_token_says_so_and_continues_with_the_new_one(
    browser: Any, tmp_path: Path
) -> None:
    with seen.served(tmp_path / "page") as server:
        page, _ = seen.new_page(browser, server)
        seen.visit(page, server, CASE)
        server.stop()
        (server.folder / TOKEN_NAME).unlink()
        server.start()
        page.fill('[id="field-load.force"]', "8 N")
        page.wait_for_selector("#locked", state="visible")
        assert "asks for its token" in page.inner_text("#locked")
        assert page.is_hidden("#offline")
        other = page.context.new_page()
        other.goto(server.address)
        page.wait_for_selector("#locked", state="hidden")
        seen.until_checked(page)
        assert "force: 8 N" in page.input_value("#yaml")
        seen.run(page, "#coarse")
        page.context.close()


def test_a_full_queue_is_told_and_the_case_can_be_sent_again(
    page: Any, server: seen.Server
) -> None:
    seen.visit(page, server, CASE)
    why = "50 runs are waiting already; wait until one of them has begun, or cancel some"
    body = json.dumps({"problems": [{"message": why, "path": "", "line": None}]})
    refusal = {"status": 429, "content_type": "application/json", "body": body}
    page.route("**/api/runs", lambda route: route.fulfill(**refusal))
    seen.until_checked(page)
    page.click("#coarse")
    page.wait_for_selector("#notice p")
    assert why in page.inner_text("#notice")
    assert page.get_attribute("#coarse", "aria-disabled") == "false"
    page.unroute("**/api/runs")
    seen.run(page, "#coarse")


def test_a_file_that_is_too_large_is_refused_before_it_is_sent(
    page: Any, server: seen.Server, tmp_path: Path
) -> None:
    seen.visit(page, server, CASE)
    large = tmp_path / "large.csv"
    with large.open("wb") as file:
        file.truncate(65_000_000)
    page.set_input_files('#fit input[type="file"]', large)
    page.wait_for_selector("#notice p")
    assert "large.csv has 65 MB; files of up to 64 MB can be uploaded" in page.inner_text("#notice")
