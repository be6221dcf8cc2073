"""A temperature over time on the calculator page in a browser: form, drawing and histories.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

import web.served_page as seen

pytest.importorskip("playwright")
pytestmark = [
    pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium"),
    pytest.mark.slow,  # a server and a browser
]

FOOT = """\
title: Foot
indenter: {shape: sphere, radius: 20 mm}
material:
  law: zener
  shear_modulus: 9 MPa
  delayed_modulus: 9 MPa
  viscosity: 1e5 MPa s
  poisson_ratio: 0.5
  shift: {kind: wlf, reference_temperature: 20 degC, c1: 8.86, c2: 101.6 K}
load: {kind: step, force: 2 N}
temperature: 40 degC
time: {end: 24 h, steps: 12}
output: {errors: false}
"""


@pytest.fixture
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """The page with the foot; whatever goes wrong on it fails the test."""
    with seen.served(tmp_path_factory.mktemp("served")) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, FOOT)
        yield page
        assert watched.faults == []
        assert watched.outside == []


def _case(page: Any) -> str:
    return str(page.evaluate("sessionStorage['viscontact.case']"))


def test_form_has_every_kind_of_temperature_and_results_show_it(page: Any) -> None:
    assert page.input_value('[id="field-temperature.kind"]') == "constant"
    assert page.input_value('[id="field-temperature.value"]') == "40 degC"
    with page.expect_response("**/api/check"):
        page.select_option('[id="field-temperature.kind"]', "harmonic")
    seen.until_checked(page)
    for key in ("mean", "amplitude", "period", "cycles"):
        assert f"{key}:" in _case(page)
    seen.run(page, "#coarse")
    panels = page.locator("#histories [data-panel]")
    names = panels.evaluate_all("(boxes) => boxes.map((box) => box.dataset.panel)")
    assert {"force", "temperature", "approach"} <= set(names)
    plot = "document.querySelector('#histories [data-panel=\"approach\"] .plot')"
    right = page.evaluate(f"{plot}._fullLayout.yaxis2.title.text")
    assert right == "Temperature [°C]"
