"""A steady motion on the calculator page in a browser: from the form to friction over speed.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

import web.served_page as seen
from closeness import close_to
from web.test_web_steady import BALL, LONG, ON_A_RANGE

pytest.importorskip("playwright")
pytestmark = [
    pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium"),
    pytest.mark.slow,  # a server and a browser
]

FRICTION = "document.getElementById('friction')"


@pytest.fixture
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """The page with the ball; whatever goes wrong on it fails the test."""
    with seen.served(tmp_path_factory.mktemp("served")) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        page.server = server
        yield page
        assert watched.faults == []
        assert watched.outside == []


def _read(page: Any, place: str) -> str:
    return str(page.inner_text(place))


def test_answer_is_shown_over_speed(page: Any) -> None:
    seen.visit(page, page.server, BALL)
    assert page.input_value('[id="field-motion.speed"]').startswith("{from: 1 m/s")
    assert "3 speeds" in _read(page, "#estimate-text")
    seen.run(page, "#refine")
    # The worst over speed: friction is largest between the limits of slow and fast motion.
    value, bar, place = seen.fact(page, "Friction coefficient").split("\n")
    assert 0.01 < float(value) < 0.1
    assert bar.startswith("±")
    assert place == "at 100 mm/s"
    assert seen.fact(page, "Contact area").endswith("at 10 mm/s")
    names = page.evaluate(f"{FRICTION}.data.map((each) => each.name)")
    assert names == ["limit of slow motion", "limit of fast motion", "Ball"]
    assert page.evaluate(f"[...{FRICTION}._fullData.at(-1).x]") == close_to([0.01, 0.1, 1.0])
    panels = page.locator("#histories [data-panel]")
    shown = panels.evaluate_all("(boxes) => boxes.map((box) => box.dataset.panel)")
    assert {"approach", "contact_width", "peak_pressure", "resistance_y", "dissipation"} <= {*shown}
    assert "friction_coefficient" not in shown  # it has a figure of its own
    assert _read(page, "#histories-title") == "Over speed"
    # The slider goes from the slowest to the fastest; the arrow points to the leading edge.
    for index, label in enumerate(["10 mm/s", "100 mm/s", "1 m/s"]):
        page.locator("#instant-slider").fill(str(index))
        assert _read(page, "#instant") == label
        leading, trailing = page.evaluate("document.getElementById('section-y').data.at(-1).x")
        assert leading > trailing
        arrow = page.evaluate("document.getElementById('map').layout.annotations[0]")
        assert (arrow["xshift"], arrow["yshift"]) == (0, close_to(34))
    heads = page.locator("#numbers th[scope=col]").all_inner_texts()
    assert heads == ["Quantity", "largest", "at", "largest error"]
    page.set_viewport_size({"width": 390, "height": 844})
    # Figures follow the window a moment later; then nothing is wider.
    page.wait_for_function("() => document.documentElement.scrollWidth <= window.innerWidth")


def test_references_over_speed_are_drawn_and_others_refused_in_a_line(page: Any) -> None:
    seen.visit(page, page.server, BALL)
    seen.run(page, "#coarse")
    page.click("#keep")
    seen.type_into(page, "load.force", "3 N")
    seen.run(page, "#coarse")
    assert page.evaluate(f"{FRICTION}.data.map((each) => each.line.dash)")[-2] == "dash"
    heads = page.locator("#numbers th[scope=col]").all_inner_texts()
    assert heads[-2:] == ["reference, largest", "change"]
    # Without the motion the run is over time, and has nothing in common with the reference.
    motion = next(line for line in BALL.splitlines() if line.startswith("motion:"))
    seen.write_case(page, BALL.replace(motion, "time: {end: 1 s, steps: 4}"))
    seen.run(page, "#coarse")
    said = "Not compared: Ball is over speed, this result over time."
    assert _read(page, "#reference-text") == said
    assert page.locator("#friction").is_hidden()
    assert _read(page, "#histories-title") == "Over time"


def test_nothing_is_drawn_over_a_single_speed(page: Any) -> None:
    seen.visit(page, page.server, BALL.replace(ON_A_RANGE, "0.5 m/s"))
    seen.run(page, "#coarse")
    assert _read(page, "#facts-when") == "At 500 mm/s"
    assert page.locator("#histories-chapter").is_hidden()
    assert page.locator("#map-controls").is_hidden()
    assert page.locator("#numbers tbody tr").count() > 5


def test_run_grows_speed_by_speed_and_is_cancelled(page: Any) -> None:
    seen.visit(page, page.server, LONG)
    page.click("#refine")
    page.wait_for_function(
        "() => /^speed [2-9]\\d* of 40 · .*m\\/s · .* left$/.test("
        "document.getElementById('progress-text').textContent)",
        timeout=60_000,
    )
    page.wait_for_selector("#growing .plot .scatterlayer .trace")
    ends = "[...document.querySelectorAll('#growing .plot')].map((each) => each.layout.xaxis.range)"
    assert page.evaluate(ends) == 4 * [[-2, 0]]  # 10 mm/s to 1 m/s
    assert "Friction coefficient" in _read(page, "#growing")
    page.click("#cancel")
    page.wait_for_selector("#resume", state="visible")
    page.wait_for_selector("#friction svg")
    assert "of 40 speeds" in _read(page, "#result-notes")
