"""Layers on the calculator page: as values, and in the form in a browser.

What needs a browser is skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import web.served_page as seen
from viscontact.case import read_case_text
from viscontact.web.workspace.naming import suggested_title
from web.calculator_page import CASE, asking

COVER = """\
material:
  layers:
    - {thickness: 5 mm, law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.49}
    - {thickness: 2 mm, material: epdm-70-25c, bulk_modulus: 2 GPa}
  base: {material: pmma-paper, poisson_ratio: 0.3}
"""
COVERED = CASE[: CASE.index("material:")] + COVER + CASE[CASE.index("load:") :]


def test_values_of_layers_are_in_their_longest_spelling(tmp_path: Path) -> None:
    with asking(tmp_path) as client:
        values = client.post("/api/case", json={"yaml": COVERED}).json()["case"]
        written = client.post("/api/yaml", json={"case": values, "yaml": COVERED, "titled": True})
    material = values["material"]
    assert material["law"] == "layered"
    assert [set(layer) for layer in material["layers"]] == 2 * [{"thickness", "material"}]
    assert material["layers"][1]["material"]["law"] == "relaxation-series"
    assert "poisson_ratio" not in material["layers"][1]["material"]
    assert material["base"]["law"] == "creep-series"
    text = written.json()["yaml"]
    same = [read_case_text(each, "case.yaml").material for each in (COVERED, text)]
    assert same[0] == same[1]
    assert suggested_title(values).endswith("on 2 layers, 5 mm elastic 1 MPa, 4 N")


@pytest.mark.parametrize("broken", ["epdm-70-25c", "epdm"])
def test_values_of_invalid_layers_are_kept(broken: str, tmp_path: Path) -> None:
    text = COVERED.replace("epdm-70-25c", broken).replace("5 mm", "[1]")
    with asking(tmp_path) as client:
        values = client.post("/api/case", json={"yaml": text}).json()["case"]
    assert values["material"]["layers"][0]["thickness"] == [1]


@pytest.mark.slow  # a server and a browser
@pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")
def test_form_adds_and_removes_layers(tmp_path: Path) -> None:
    pytest.importorskip("playwright")
    with seen.served(tmp_path) as server, seen.opened_browser() as browser:
        page, watched = seen.new_page(browser, server)
        seen.visit(page, server, CASE)

        def changed(act: object) -> str:
            with page.expect_response("**/api/check"):
                act()  # type: ignore[operator]
            seen.until_checked(page)
            assert page.locator("#form .problems li").all_inner_texts() == []
            return str(page.evaluate("sessionStorage['viscontact.case']"))

        law = '[id="field-material.law"]'
        text = changed(lambda: page.select_option(law, "layered"))
        assert "base: rigid" in text
        text = changed(lambda: page.get_by_role("button", name="Add a layer").click())
        assert text.count("epdm-70-25c") == 2
        text = changed(lambda: seen.type_into(page, "material.layers[2].thickness", "2 mm"))
        text = changed(
            lambda: page.select_option('[id="field-material.layers[2].material.law"]', "elastic")
        )
        body = read_case_text(text, "case.yaml").material
        assert [each.thickness for each in body.layers] == [5e-3, 2e-3]
        remove = page.get_by_role("button", name="Remove this layer")
        text = changed(lambda: remove.first.click())
        assert [each.thickness for each in read_case_text(text, "case.yaml").material.layers] == [
            2e-3
        ]
        seen.run(page, "#coarse")
        assert page.locator("#numbers").is_visible()
        assert watched.faults == []
