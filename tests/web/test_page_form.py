"""The form of the calculator page: fields, rows, choices, and what is wrong at a field.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import web.served_page as seen
from closeness import close_to
from viscontact.cli import main
from web.pressed_ball import BALL, browser, page, server

__all__ = ["browser", "page", "server"]  # fixtures

pytest.importorskip("playwright")

pytestmark = pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")


@pytest.mark.slow
def test_bad_input_is_reported_at_its_field_in_the_words_of_the_command_line(
    browser: Any, server: seen.Server, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page, watched = seen.new_page(browser, server)
    seen.visit(page, server, BALL)
    seen.type_into(page, "load.force", "10 MPa")
    seen.type_into(page, "material.poisson_ratio", "0.7")
    beside = page.locator('[data-path="load.force"] .problems')
    beside.locator("li").wait_for()
    bad = BALL.replace("100 N", "10 MPa").replace("0.5\n", "0.7\n")
    (tmp_path / "bad.yaml").write_text(bad, encoding="utf-8")
    assert main(["check", str(tmp_path / "bad.yaml")]) == 2
    messages = dict(re.findall(r"bad\.yaml:\d+: ([\w.]+): (.*)", capsys.readouterr().err))
    assert set(messages) == {"load.force", "material.poisson_ratio"}
    for path, message in messages.items():
        assert page.inner_text(f'[data-path="{path}"] .problems') == message
        assert page.get_attribute(f'[id="field-{path}"]', "aria-invalid") == "true"
    # Nothing is run; the first problem gets the focus.
    page.keyboard.press("Control+Enter")
    assert page.evaluate("document.activeElement.id") == "field-material.poisson_ratio"
    seen.type_into(page, "load.force", "10 N")
    seen.type_into(page, "material.poisson_ratio", "0.4")
    page.wait_for_selector("#to-problem", state="hidden")
    assert page.locator("[aria-invalid]").count() == 0
    # Text that is no YAML: the form waits, and a page that is opened with it shows the text.
    page.click("#as-text")
    page.fill("#yaml", "title: [")
    page.locator("#text-problems li").wait_for()
    page.click("#as-form")
    (tmp_path / "bad.yaml").write_text("title: [", encoding="utf-8")
    assert main(["check", str(tmp_path / "bad.yaml")]) == 2
    message = capsys.readouterr().err.strip().split("bad.yaml:")[1]
    assert page.inner_text("#text-problems") == f"line {message}"
    assert page.is_hidden("#form")
    page.reload()
    seen.until_ready(page)
    assert page.input_value("#yaml") == "title: ["
    page.context.close()
    assert watched.faults == []


@pytest.mark.slow
def test_choices_begin_with_values_that_go_together(browser: Any, server: seen.Server) -> None:
    page, watched = seen.new_page(browser, server)
    seen.visit(page, server)

    def choose(key: str, name: str) -> None:
        page.select_option(f'[id="field-{key}"]', name)
        seen.until_checked(page)
        assert page.is_hidden("#to-problem"), page.inner_text("#form .problems li")

    # The roller's crown radius means nothing with another crown.
    choose("indenter.profile.kind", "logarithmic")
    assert page.input_value('[id="field-indenter.crown_radius"]') == ""
    choose("time.spacing", "adaptive")
    assert page.input_value('[id="field-time.steps"]') == ""
    choose("time.spacing", "log")
    assert page.input_value('[id="field-time.steps"]') == "120"
    # With the roller's radius of 5 mm dimples would overlap; they lie on a ball.
    page.select_option('[id="field-indenter.shape"]', "dimples")
    seen.until_checked(page)
    assert page.input_value('[id="field-indenter.radius"]') == "50 um"
    page.context.close()
    assert watched.faults == []


@pytest.mark.slow
def test_a_wrong_force_does_not_hide_the_shape(browser: Any, server: seen.Server) -> None:
    page, watched = seen.new_page(browser, server)
    seen.visit(page, server, BALL)
    seen.type_into(page, "load.force", "100 Pa")
    before = page.locator("#drawing-indenter img").get_attribute("src")
    page.fill('[id="field-indenter.radius"]', "20 mm")
    page.wait_for_function(
        "(old) => document.querySelector('#drawing-indenter img')?.src !== old", arg=before
    )
    assert page.locator("#drawing-indenter.stale").count() == 0
    page.click("#tab-load")
    page.wait_for_selector("#drawing-load.stale")
    # A file that is missing is a problem as any other, and no error of the browser.
    page.click("#as-text")
    head, tail = BALL.split("material:")[0], BALL.partition("load:")[2]
    material = "material: {law: table, file: none.csv, poisson_ratio: 0.4}"
    page.fill("#yaml", f"{head}{material}\nload:{tail}")
    page.locator("#text-problems li", has_text="no such file none.csv").wait_for()
    page.context.close()
    assert watched.faults == []


@pytest.mark.slow
def test_a_new_key_of_the_schema_appears_by_itself(page: Any, server: seen.Server) -> None:
    def with_more(route: Any) -> None:
        schema = route.fetch().json()
        properties = schema["$defs"]["Sphere"]["properties"]
        properties["coating"] = {
            "anyOf": [{"enum": ["none", "gold-leaf"], "type": "string"}, {"type": "null"}],
            "default": "none",
            "description": "what it is covered with",
        }
        properties["wall"] = {
            "type": "string",
            "description": "thickness of the wall",
            "examples": ["0.3 mm"],
            "x-dimension": "length",
        }
        schema["$defs"]["Sphere"]["required"].append("wall")
        schema["properties"]["remark"] = {"type": "string", "description": "for the archive"}
        route.fulfill(json=schema)

    page.route("**/api/schema", with_more)
    seen.visit(page, server, BALL)
    coating = page.locator('[data-path="indenter.coating"]')
    assert coating.locator("label").inner_text() == "Coating"
    assert coating.locator("option").all_inner_texts() == ["None", "Gold leaf"]
    assert "what it is covered with" in coating.inner_text()
    wall = page.locator('[id="field-indenter.wall"]')
    assert wall.get_attribute("placeholder") == "e.g. 0.3 mm"
    assert page.is_visible('[id="field-remark"]')
    wall.focus()
    # The server does not know it: only what is offered is looked at here.
    page.evaluate(
        "input => { input.value = '2'; input.dispatchEvent(new Event('focus')); }",
        wall.element_handle(),
    )
    assert "2 mm" in page.locator('[id="field-indenter.wall-options"] option').evaluate_all(
        "options => options.map((option) => option.value)"
    )


@pytest.mark.slow
def test_terms_are_rows_and_variants_bring_their_own_fields(page: Any, server: seen.Server) -> None:
    seen.visit(page, server, BALL)
    page.select_option('[id="field-material.law"]', "relaxation-series")
    assert page.input_value('[id="field-material.poisson_ratio"]') == "0.5"  # what both have
    page.click('[data-add="material"]')
    # Three terms copied from a spreadsheet, without units.
    page.evaluate(
        """(text) => {
          const data = new DataTransfer();
          data.setData("text/plain", text);
          document.getElementById("field-material.moduli[1]").dispatchEvent(
            new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
        }""",
        "300\t0.1\n200\t1\n100\t10",
    )
    page.click('[aria-label="Remove term 2"]')
    seen.until_checked(page)
    text = page.evaluate("sessionStorage['viscontact.case']")
    assert re.search(r"moduli: *(\[|\n *- )300 MPa(, |\n *- )100 MPa", text), text
    assert re.search(r"times: *(\[|\n *- )0.1 s(, |\n *- )10 s", text), text
    page.select_option('[id="field-material.law"]', "zener")
    assert page.input_value('[id="field-material.viscosity"]') == "10 GPa s"  # as it was left


@pytest.mark.slow
def test_every_example_stands_in_the_form_as_it_is_written(page: Any, server: seen.Server) -> None:
    seen.visit(page, server)
    examples = page.evaluate("fetch('/api/examples').then((answer) => answer.json())")
    assert len(examples) > 10
    for example in examples:
        with page.expect_response("**/api/check") as checked:
            page.select_option("#examples", example["name"])
        assert checked.value.ok, example["name"]
        page.wait_for_function(
            "(title) => document.getElementById('field-title').value === title",
            arg=example["title"],
        )
        shown = {
            box["path"]: box["value"]
            for box in page.evaluate(
                """[...document.querySelectorAll("#form :is(input, select)[id^=field-]")].map(
                  (each) => ({ path: each.id.replace("field-", ""), value:
                    each.type === "checkbox" ? each.checked : each.value }))"""
            )
        }
        for path, value in _leaves(example["case"]):
            if path in shown:
                assert _same(shown[path], value), (example["name"], path)
        named = [path for path, _ in _leaves(example["case"]) if path in shown]
        assert len(named) >= 8, example["name"]


def _leaves(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for key, part in value.items():
            yield from _leaves(part, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for index, part in enumerate(value):
            yield from _leaves(part, f"{path}[{index + 1}]")
    else:
        yield path, value


def _same(shown: object, value: object) -> bool:
    if isinstance(value, bool):  # a box, or a choice where neither is the default
        return shown in (value, "yes" if value else "no")
    if isinstance(value, int | float):
        return float(json.loads(str(shown))) == float(value)
    return shown == value


# A row of balls along x.
ROW = """\
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.1 N}
time: {end: 1 s, steps: 1}
grid:
  shape: [24, 64]
  size: [1 mm, 2.4 mm]
  periodic: [true, false]
"""


@pytest.mark.slow
def test_each_axis_of_a_period_has_a_box(page: Any, server: seen.Server) -> None:
    def written() -> str:
        seen.until_checked(page)
        return str(page.evaluate("sessionStorage['viscontact.case']"))

    seen.visit(page, server, ROW)
    boxes = page.locator('[id="field-grid.periodic"] input')
    assert [box.is_checked() for box in boxes.all()] == [True, False]
    boxes.nth(1).check()
    assert "periodic: true" in written()
    boxes.nth(0).uncheck()
    assert re.search(r"periodic: \[false, true\]|periodic:\n *- false\n *- true", written())
    boxes.nth(1).uncheck()
    assert "periodic" not in written()
    boxes.nth(0).check()
    # A cylinder: Hertz with E* = 4 MPa and 100 N/m, 2 b = 1.128 mm on a period of 1 mm.
    seen.type_into(page, "indenter.radius_x", "infinite")
    seen.run(page, "#coarse")
    assert float(seen.fact(page, "Contact area").split()[0]) == close_to(1.128, rel=0.02)
