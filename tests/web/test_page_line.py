"""A line contact on the calculator page in a browser: chosen in the form, at rest and rolling.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import web.served_page as seen
from closeness import close_to
from viscontact.case import read_case_text
from web.calculator_page import CASE

pytest.importorskip("playwright")
pytestmark = [
    pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium"),
    pytest.mark.slow,  # a server and a browser
]


def test_a_cylinder_is_chosen_loaded_per_length_and_rolled(tmp_path: Path) -> None:
    with seen.served(tmp_path) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, CASE)  # a ball on a grid, under a force
        with page.expect_response("**/api/check"):
            page.select_option('[id="field-indenter.shape"]', "cylinder")
        seen.until_checked(page)
        assert page.input_value('[id="field-load.line_load"]') == "40 N/mm"
        assert page.input_value('[id="field-load.force"]') == ""
        # Both rolls by their diameters.
        page.get_by_label("Write the radius as a diameter", exact=True).click()
        assert page.input_value('[id="field-indenter.diameter"]') == "20 mm"
        page.get_by_label("Write the counter radius as a counter diameter").click()
        seen.type_into(page, "indenter.counter_diameter", "40 mm")
        text = page.evaluate("sessionStorage['viscontact.case']")
        case = read_case_text(text, "case.yaml")
        assert case.grid is None
        assert case.indenter.radius_y == close_to(1 / (1 / 10e-3 + 1 / 20e-3))
        seen.run(page, "#refine")
        assert seen.fact(page, "Force per length") == "40 kN/m"
        assert seen.fact(page, "Width of the strip").startswith("8.2")
        assert page.is_visible("#section-y")
        assert page.is_hidden("#section-x")  # nothing varies along it
        with page.expect_response("**/api/check"):
            page.select_option('[id="field-motion.kind"]', "steady")
        seen.until_checked(page)
        seen.run(page, "#coarse")
        assert seen.fact(page, "Dissipation per length").endswith("W/m")
        with page.expect_response("**/api/check"):
            page.select_option('[id="field-indenter.shape"]', "sphere")
        seen.until_checked(page)
        assert page.input_value('[id="field-load.force"]') != ""
        assert page.inner_text("#estimate-text").endswith("MB")
        assert watched.faults == []
