"""From a changed case to its answer on the calculator page: values, names, reports, units.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
import web.served_page as seen
from closeness import close_to
from viscontact.cli import main
from viscontact.results.summary import summary_rows
from web.pressed_ball import BALL, LONG, browser, page, server

__all__ = ["browser", "page", "server"]  # fixtures

pytest.importorskip("playwright")

pytestmark = pytest.mark.skipif(seen.BROWSER is None, reason="there is no Chromium")


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
