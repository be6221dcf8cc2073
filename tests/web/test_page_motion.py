"""A moving contact on the calculator page in a browser: from the form to map, loop and histories.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

import web.served_page as seen
from closeness import close_to

pytest.importorskip("playwright")
pytestmark = [
    pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium"),
    pytest.mark.slow,  # a server and a browser
]

# A pad of 20 mm radius on rubber, at rest.
PAD = """\
title: Pad
indenter: {shape: sphere, radius: 20 mm}
material:
  law: zener
  shear_modulus: 9 MPa
  delayed_modulus: 1 MPa
  viscosity: 1 MPa s
  poisson_ratio: 0.5
load: {kind: step, force: 2 N}
time: {end: 4 s, steps: 12}
output: {errors: false}
"""


@pytest.fixture
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """The page with the pad; whatever goes wrong on it fails the test."""
    with seen.served(tmp_path_factory.mktemp("served")) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, PAD)
        yield page
        assert watched.faults == []
        assert watched.outside == []


def _case(page: Any) -> str:
    return str(page.evaluate("sessionStorage['viscontact.case']"))


def _choose(page: Any, kind: str) -> None:
    with page.expect_response("**/api/check"):
        page.select_option('[id="field-motion.kind"]', kind)
    seen.until_checked(page)


def test_form_expresses_a_motion_and_puts_back_what_went_with_it(page: Any) -> None:
    _choose(page, "travel")
    written = _case(page)
    for line in ("kind: travel", "spacing: cells", "tilt_y: 0"):
        assert line in written
    assert "steps" not in written
    _choose(page, "")
    assert all(each not in _case(page) for each in ("motion", "cells", "tilt_y"))
    assert "steps: 12" in _case(page)


def test_answer_shows_the_motion(page: Any) -> None:
    _choose(page, "reciprocating")
    for key, value in {"amplitude": "1.5 mm", "period": "2 s", "cycles": "2"}.items():
        seen.type_into(page, f"motion.{key}", value)
    seen.run(page, "#coarse")
    assert 0 < float(seen.fact(page, "Friction coefficient").splitlines()[0]) < 1
    panels = page.locator("#histories [data-panel]")
    names = panels.evaluate_all("(boxes) => boxes.map((box) => box.dataset.panel)")
    shown = {"position_y", "resistance_y", "friction_coefficient", "motion_work", "heat"}
    assert shown <= set(names)
    title = page.locator('#histories [data-panel="friction_coefficient"] h4').inner_text()
    assert title == "Friction coefficient"  # without empty brackets
    # The loop: its last cycle ends where it begins.
    x, y = page.evaluate(
        "(({x, y}) => [[...x], [...y]])(document.querySelector('#loops .plot')._fullData[1])"
    )
    assert abs(x[-1] - x[0]) < 0.1 * (max(x) - min(x))
    assert max(y) > 0 > min(y)
    # The arrow is 34 pixels long and points from the axis to the leading edge.
    page.locator("#instant-slider").fill("4")
    map_of = "document.getElementById('map')"
    cross, arrow = page.evaluate(f"[{map_of}.data.at(-1), {map_of}.layout.annotations[0]]")
    edges = page.evaluate("document.getElementById('section-y').data.at(-1).x")
    assert (abs(arrow["yshift"]), arrow["xshift"]) == (close_to(34), 0)
    assert (edges[0] - cross["y"][0]) * arrow["yshift"] > 0
    assert (edges[1] - cross["y"][0]) * arrow["yshift"] < 0
