"""The calculator page in Firefox: a case is written, checked, run, refined and cancelled.

Skipped where there is no Firefox. What the page does in detail is tested in Chromium.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

import web.served_page as seen
from web.calculator_page import CASE, LONG_CASE
from web.marionette import FIREFOX, Firefox, opened_firefox

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(FIREFOX is None, reason="there is no Firefox"),
]


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[seen.Server]:
    with seen.served(tmp_path_factory.mktemp("served")) as server:
        yield server


@pytest.fixture(scope="module")
def firefox(server: seen.Server, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Firefox]:
    with opened_firefox(tmp_path_factory.mktemp("firefox") / "profile") as firefox:
        firefox.tell("WebDriver:Navigate", url=server.address)
        firefox.until("'ready' in document.documentElement.dataset")
        yield firefox


CHECKS = "performance.getEntriesByType('resource').filter((e) => e.name.endsWith('/api/check'))"


@contextmanager
def checked(firefox: Firefox) -> Iterator[None]:
    """Wait until the server has checked what is written within the block."""
    before = firefox.script(f"return {CHECKS}.length")
    yield
    firefox.until(f"{CHECKS}.length > {before}")
    firefox.until("document.querySelector('#estimate[aria-busy=false]') !== null")


def write_case(firefox: Firefox, text: str) -> None:
    """Paste a case as YAML, and wait until it has been checked."""
    firefox.click("#as-text")
    with checked(firefox):
        firefox.script(
            "const box = document.getElementById('yaml'); box.value = arguments[0];"
            "box.dispatchEvent(new Event('input', { bubbles: true }))",
            text,
        )
    firefox.click("#as-form")
    firefox.until("(document.getElementById('field-load.force')?.offsetParent ?? null) !== null")


def answered(server: seen.Server, firefox: Firefox, button: str) -> dict[str, Any]:
    """Click a button that computes; return the status of the run once its results are drawn."""
    before = firefox.script("return document.documentElement.dataset.drawn ?? ''")
    firefox.click(button)
    run = firefox.until(
        f"document.documentElement.dataset.drawn !== {json.dumps(before)}"
        " && document.documentElement.dataset.drawn"
    )
    found: dict[str, Any] = server.ask(f"api/runs/{run}")
    return found


def test_a_case_is_written_run_and_refined(server: seen.Server, firefox: Firefox) -> None:
    write_case(firefox, CASE)
    with checked(firefox):
        firefox.type('[id="field-load.force"]', "8 N")
    coarse = answered(server, firefox, "#coarse")
    assert (coarse["state"], coarse["quality"]) == ("done", "coarse")
    shown = firefox.script("return document.getElementById('facts').innerText")
    assert coarse["scalars"]["peak_pressure"]["text"] in shown
    assert "±" not in shown
    full = answered(server, firefox, "#refine")
    assert (full["state"], full["quality"]) == ("done", "full")
    assert "±" in firefox.script("return document.getElementById('facts').innerText")
    # The map and the sections are drawn, and the page is no wider than its window.
    for name in ("map", "section-x", "section-y"):
        firefox.until(f"document.querySelector('#{name} .main-svg') !== null")
    for width in (500, 1280):  # Firefox has no narrower window
        firefox.tell("WebDriver:SetWindowRect", width=width, height=900)
        firefox.until("document.documentElement.scrollWidth <= window.innerWidth")
    assert firefox.faults() == []


def test_a_run_is_cancelled_and_what_it_has_computed_is_shown(
    server: seen.Server, firefox: Firefox
) -> None:
    write_case(firefox, LONG_CASE)
    firefox.click("#refine")
    firefox.until("document.getElementById('progress-text').textContent.startsWith('step')")
    firefox.click("#cancel")
    firefox.until("!document.getElementById('resume').hidden")
    assert "cancelled after step" in firefox.script(
        "return document.getElementById('progress-text').textContent"
    )
    assert firefox.faults() == []


def test_a_mistake_is_shown_beside_its_field(firefox: Firefox) -> None:
    write_case(firefox, CASE)
    with checked(firefox):
        firefox.type('[id="field-load.force"]', "8 mm")
    field = "document.querySelector('[id=\"field-load.force\"]')"
    firefox.until(f"{field}.getAttribute('aria-invalid') === 'true'")
    assert firefox.faults() == []


def test_the_token_opens_the_page_once_and_a_refusal_is_explained(
    server: seen.Server, firefox: Firefox
) -> None:
    assert firefox.script("return location.search + document.cookie") == ""
    firefox.tell("WebDriver:Navigate", url=f"{server.page}?token=wrong")
    firefox.until("'ready' in document.documentElement.dataset")  # the cookie is still valid
    firefox.tell("WebDriver:DeleteAllCookies")
    firefox.tell("WebDriver:Navigate", url=server.page)
    text = firefox.script("return document.body.innerText")
    assert "open the address that viscontact serve has printed" in text
    firefox.tell("WebDriver:Navigate", url=server.address)
    firefox.until("'ready' in document.documentElement.dataset")


def test_a_sweep_is_run(server: seen.Server, firefox: Firefox) -> None:
    write_case(firefox, CASE)
    firefox.click("#study summary")
    firefox.script(
        "const key = document.getElementById('study-key-1'); key.value = 'load.force';"
        "key.dispatchEvent(new Event('change', { bubbles: true }))"
    )
    firefox.type("#study-key-1-values", "2 N, 4 N")
    firefox.click("#study-go")
    name = firefox.until("document.documentElement.dataset.studied")
    assert server.ask(f"api/runs/{name}")["state"] == "done"
    assert firefox.script("return document.querySelectorAll('#study-table tbody tr').length") == 2
    firefox.until("document.documentElement.scrollWidth <= window.innerWidth")
    assert firefox.faults() == []
