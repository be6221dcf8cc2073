"""The calculator page in a browser: what a newcomer does with it, and what may go wrong.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
import web.served_page as seen
from closeness import close_to
from viscontact.cli import main
from viscontact.results.summary import summary_rows

pytest.importorskip("playwright")
pytestmark = pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")

# A ball of 10 mm radius pressed by 100 N onto a material with G = 1 GPa, nu = 0.5.
BALL = """\
title: Ball on rubber
indenter:
  shape: sphere
  radius: 10 mm   # of the ball
material:
  law: zener
  shear_modulus: 1 GPa
  delayed_modulus: 1 GPa
  viscosity: 10 GPa s
  poisson_ratio: 0.5
load:
  kind: step
  force: 100 N
time:
  end: 100 s
  steps: 12
grid:
  shape: [64, 64]
  size: [4 mm, 4 mm]
"""
# As above, and long enough to be interrupted: ten seconds, and one for its error bars.
LONG = (
    BALL.replace("[64, 64]", "[1536, 1536]").replace("steps: 12", "steps: 150")
    + """\
output: {fields: [0 s, 100 s]}
"""
)


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[seen.Server]:
    with seen.served(tmp_path_factory.mktemp("served")) as server:
        yield server


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with seen.opened_browser() as browser:
        yield browser


@pytest.fixture
def page(browser: Any, server: seen.Server) -> Iterator[Any]:
    """A new visitor's page; whatever goes wrong on it fails the test."""
    page, watched = seen.new_page(browser, server)
    yield page
    page.context.close()
    assert watched.faults == []
    assert watched.outside == []


@pytest.mark.slow  # a server and a browser
def test_a_case_is_changed_and_answered_in_seconds(page: Any, server: seen.Server) -> None:
    seen.visit(page, server, BALL)
    drawing = page.locator("#drawing-indenter img")
    before = drawing.get_attribute("src")
    seen.type_into(page, "indenter.radius", "20 mm")
    page.wait_for_function(
        "(old) => document.querySelector('#drawing-indenter img')?.src !== old", arg=before
    )
    seen.run(page, "#coarse")
    # Hertz with R = 20 mm, F = 100 N; in the end G is halved, E* = 4 G = 2 GPa: d = (9 F^2 /
    # (16 R E*^2))^(1/3) = 41.3 um. A coarse answer is meant to be right within two per cent.
    approach = seen.fact(page, "Approach")
    assert approach.endswith(" µm")
    assert float(approach.split()[0]) == close_to(41.27, rel=0.02)
    assert page.locator("#histories .panel").count() >= 5
    # What was written beside the numbers is still there.
    assert "radius: 20 mm   # of the ball" in page.evaluate("sessionStorage['viscontact.case']")


#: Keeps what the page says at the moment when it shows values without their error bars.
KEEP_EARLY = """
  window.said = () => ["facts", "numbers", "result-notes"].map(
    (id) => document.getElementById(id).innerText);
  new MutationObserver(() => { window.early = window.said(); }).observe(
    document, { subtree: true, attributeFilter: ["data-early"] });
"""


@pytest.mark.slow
def test_all_values_are_shown_before_their_error_bars(page: Any, server: seen.Server) -> None:
    page.add_init_script(KEEP_EARLY)
    seen.visit(page, server, LONG)
    seen.run(page, "#refine")
    before, after = page.evaluate("window.early"), page.evaluate("window.said()")
    # The same values, with their errors at the end.
    ours, final = (re.findall(r"^([-\d.]+) \S+$", facts, re.M) for facts, *_ in (before, after))
    assert len(ours) >= 3
    assert [float(value) for value in ours] == close_to([*map(float, final)], rel=0.01)
    assert ["±" in facts for facts, *_ in (before, after)] == [False, True]
    assert ["%" in numbers for _, numbers, _ in (before, after)] == [False, True]
    told = ["error bars are being estimated" in notes for *_, notes in (before, after)]
    assert told == [True, False]


@pytest.mark.slow
def test_another_shape_can_be_run_at_once(page: Any, server: seen.Server) -> None:
    """The page begins with a roller, on whose grid a ball's contact would not lie."""
    seen.visit(page, server)
    # A punch is round or rectangular: of the roller's radius and length it takes the first.
    page.select_option('[id="field-indenter.shape"]', "flat-punch")
    seen.until_checked(page)
    assert page.is_hidden("#to-problem")
    page.select_option('[id="field-indenter.shape"]', "sphere")
    seen.type_into(page, "indenter.radius", "20 mm")
    seen.run(page, "#coarse")
    # Hertz with the paper's Phi = 1/(2 G) = 7e-4 / MPa in the end, E* = 2 G / (1 - nu):
    # d = (9 F^2 / (16 R E*^2))^(1/3) = 809 um, of a paraboloid; a true ball sinks in a little more.
    approach = seen.fact(page, "Approach")
    assert float(approach.split()[0]) == close_to(809, rel=0.03)


@pytest.mark.slow
def test_a_changed_case_gets_a_name_of_its_own_until_one_is_typed(
    page: Any, server: seen.Server
) -> None:
    seen.visit(page, server)
    title = page.locator('[id="field-title"]')
    assert title.input_value() == "Crowned roller on PMMA, centred load"
    page.select_option('[id="field-indenter.shape"]', "sphere")
    seen.type_into(page, "indenter.radius", "20 mm")
    seen.type_into(page, "load.force", "1 kN")
    named = "Sphere, radius 20 mm, on creep series, 1 kN"
    assert title.input_value() == named
    seen.run(page, "#coarse")
    assert page.inner_text("#result-title") == named
    # What the name leaves out tells the next run from this one.
    page.click("#keep")
    seen.type_into(page, "material.poisson_ratio", "0.3")
    seen.run(page, "#coarse")
    assert page.inner_text("#result-title") == f"{named}, poisson ratio 0.3"
    assert page.inner_text("#reference-text") == f"Dashed: {named}, coarse answer"
    # As text it gets its new name when it is run, after a reload as well.
    page.reload()
    seen.until_ready(page)
    seen.write_case(page, page.evaluate("sessionStorage['viscontact.case']").replace("20", "30"))
    seen.run(page, "#coarse")
    assert page.inner_text("#result-title") == named.replace("20", "30")
    seen.type_into(page, "title", "Mine")
    seen.type_into(page, "load.force", "2 kN")
    assert title.input_value() == "Mine"
    seen.type_into(page, "title", "")
    title.blur()
    page.wait_for_function("() => document.getElementById('field-title').value.includes('2 kN')")


@pytest.mark.slow
def test_a_newcomer_leaves_with_case_report_and_result(
    page: Any, server: seen.Server, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    seen.visit(page, server)
    assert page.input_value('[id="field-indenter.shape"]') == "roller"  # what it begins with
    page.select_option("#examples", "sphere-zener")
    page.wait_for_selector('[id="field-material.viscosity"]')
    page.select_option('[id="field-indenter.shape"]', "sphere")
    seen.type_into(page, "indenter.radius", "12 mm")
    seen.run(page, "#coarse")
    assert "coarse" in page.inner_text("#quality")
    assert "±" not in page.inner_text("#facts")
    seen.run(page, "#refine")
    assert "full" in page.inner_text("#quality")
    assert "±" in page.locator("#numbers").inner_text()
    files = {}
    for text in ("Case (YAML)", "Report (HTML)", "Result (netCDF)", "Histories (CSV)"):
        with page.expect_download() as coming:
            page.click(f'#downloads a:text-is("{text}")')
        name = coming.value.suggested_filename
        files[name.split(".")[-1]] = tmp_path / name
        coming.value.save_as(tmp_path / name)
    assert main(["check", str(files["yaml"])]) == 0
    assert "12 mm" in files["yaml"].read_text(encoding="utf-8")
    assert "<!DOCTYPE html>" in files["html"].read_text(encoding="utf-8")[:20]
    with vc.open_results(files["nc"]) as ds:
        approach = float(ds["approach"][-1])
        assert len(files["csv"].read_text(encoding="utf-8").splitlines()) > ds.sizes["time"]
        rows = summary_rows(ds)
    # To the letter what the command line and the report say; here, words are kept together.
    cells = [
        [text.replace("\xa0", " ") for text in row.locator("td").all_inner_texts()]
        for row in page.locator("#numbers tbody tr").all()
    ]
    assert cells == [[row.first, row.last, row.largest, row.largest_error] for row in rows]
    assert float(seen.fact(page, "Approach").split()[0]) == close_to(approach * 1e6, rel=1e-3)
    with page.expect_download() as coming:
        page.click("#save")
    coming.value.save_as(tmp_path / "again.yaml")
    assert main(["check", str(tmp_path / "again.yaml")]) == 0
    capsys.readouterr()


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
def test_results_change_units_and_show_a_reference(page: Any, server: seen.Server) -> None:
    seen.visit(page, server, BALL)
    seen.run(page, "#coarse")
    megapascals, unit = seen.fact(page, "Peak pressure").splitlines()[0].split()
    assert unit == "MPa"
    page.select_option("#units", "si")
    pascals, unit = seen.fact(page, "Peak pressure").splitlines()[0].split()
    assert unit == "Pa"
    assert float(pascals) == close_to(1e6 * float(megapascals), rel=1e-3)
    page.select_option("#units", "auto")
    page.click("#keep")
    seen.type_into(page, "load.force", "800 N")
    page.wait_for_selector("#stale", state="visible")
    seen.run(page, "#coarse")
    # Hertz: the peak pressure grows with the cubic root of the force, twice as large.
    change = page.locator('#numbers tr:has(th:text("Peak pressure")) td').last.inner_text()
    assert float(change.strip("+ %")) == close_to(100, abs=3)
    dashed = (
        page.locator("#histories .panel")
        .first.locator("path.js-line")
        .evaluate_all("lines => lines.filter((line) => line.style.strokeDasharray !== '').length")
    )
    assert dashed == 1
    page.click("#unkeep")
    assert page.locator("#numbers th").all_inner_texts()[-1] != "change"


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


# A roller with sharp ends: its contact is long, and its peak pressure has no limit.
SHARP_ROLLER = """\
indenter:
  shape: roller
  radius: 5 mm
  half_length: 3 mm
  profile: cylindrical
material: {law: maxwell, shear_modulus: 1 GPa, viscosity: 100 GPa s, poisson_ratio: 0.4}
load: {kind: step, force: 200 N}
time: {end: 10 s, steps: 3}
grid: {shape: [72, 32], size: [8 mm, 1.2 mm]}
"""


@pytest.mark.slow
def test_the_line_load_of_a_long_contact_is_drawn(page: Any, server: seen.Server) -> None:
    seen.visit(page, server, SHARP_ROLLER)
    seen.run(page, "#refine")
    page.wait_for_selector("#line-load svg")
    assert "Line load [kN/m]" in page.inner_text("#line-load")
    width, drawn = page.evaluate(
        "[...document.querySelectorAll('#line-load, #line-load svg')].map((e) => e.clientWidth)"
    )[:2]
    assert width == drawn > 0
    heading = page.evaluate(
        "document.getElementById('line-load').previousElementSibling.textContent"
    )
    assert heading == "Line load along x: the pressure integrated over y"
    # The curve holds the whole force.
    x, load = page.evaluate(
        "(({ x, y }) => [[...x], [...y]])(document.getElementById('line-load')._fullData.at(-1))"
    )
    assert sum(load) * (x[1] - x[0]) == close_to(200.0, rel=1e-4)  # kN/m times mm
    # Its peak pressure depends on the mesh: tile, table and map say so, and it has no curve.
    at_end, largest = seen.fact(page, "Peak pressure").splitlines()
    assert re.fullmatch(r"> [\d.]+ MPa", at_end)
    assert re.fullmatch(r"largest: > [\d.]+ MPa at t = 0 s", largest)
    assert re.match(r"Largest pressure >[\d.]+ MPa", page.inner_text("#map-text"))
    cells = page.locator('#numbers tr:has(th:text("Peak pressure")) td').all_inner_texts()
    assert all(text.startswith(">") for text in cells[:-1])
    assert cells[-1] == "depends on the mesh"
    panel = page.locator('#histories [data-panel="peak_pressure"]')
    assert "not drawn: smaller cells give more" in panel.inner_text()
    assert page.evaluate(
        """document.querySelector('#histories [data-panel="peak_pressure"] .plot')
          ._fullData.every((trace) => trace.y.every(Number.isNaN))"""
    )
    assert "not drawn" not in page.inner_text('#histories [data-panel="peak_line_load"]')
    seen.write_case(page, BALL)
    seen.run(page, "#coarse")
    page.wait_for_selector("#line-load", state="hidden")
    assert page.locator("#section-y svg").first.is_visible()


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
