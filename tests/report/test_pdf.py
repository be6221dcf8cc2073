"""Reports as PDF."""

from __future__ import annotations

import builtins
import json
import sys
from pathlib import Path
from typing import Any

import pytest
import typst
import xarray as xr

import viscontact as vc
from synthetic_sweeps import hertz_sweep
from viscontact import plot
from viscontact.cli import main
from viscontact.drawing.matplotlib.histories.history import history_with_load
from viscontact.drawing.svg.html import element
from viscontact.report import pdf
from viscontact.report.pdf import write_pdf, write_sweep_pdf
from viscontact.report.pdf_content import blocks

#: Text that would be code, mathematics, a label, a reference or emphasis in a source of typst.
HOSTILE = '#panic("x") $1/0 <label> @ref *bold* _em_ \\ `raw` // "quoted" {a: 1} µ ± ²'


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    """A small run with everything that a report can have."""
    rubber, grid = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.45), vc.Grid((24, 24), (6e-3, 6e-3))
    load = vc.harmonic(0.6, 0.4, 1.0, 2)
    times = vc.uniform_times(2.0, 24)
    found = vc.simulate(vc.Sphere(0.01), rubber, load, grid, times, errors=False)
    block = {"project": HOSTILE, "operator": HOSTILE, "revision": "B"}
    limits = {"peak_pressure": {"limit": 1e5}}
    attributes = {"title_block": json.dumps(block), "allowable": json.dumps(limits)}
    return found.assign_attrs(title=HOSTILE, **attributes)


@pytest.fixture
def given(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What is given to typst, by name."""
    found: dict[str, Any] = {}
    compiled = typst.compile

    def compile_(*args: Any, **options: Any) -> Any:
        found.update(json.loads(options["sys_inputs"]["data"]))
        return compiled(*args, **options)

    monkeypatch.setattr(pdf.typst, "compile", compile_)
    return found


def kinds(data: dict[str, Any], kind: str) -> list[dict[str, Any]]:
    """Blocks of a kind."""
    return [each for each in data["blocks"] if each["kind"] == kind]


@pytest.mark.slow
def test_command_writes_the_chapters_and_figures_of_the_page(
    ds: xr.Dataset, given: dict[str, Any], tmp_path: Path
) -> None:
    vc.save(ds, tmp_path / "run.nc")
    out = tmp_path / "r.PDF"
    assert main(["report", str(tmp_path / "run.nc"), "-o", str(out)]) == 0
    assert out.read_bytes().startswith(b"%PDF-")
    # Texts of the user are no markup: evaluated, this one would have stopped typst.
    assert given["title"] == f"{HOSTILE} (run)"
    assert ["Project", HOSTILE] in kinds(given, "pairs")[0]["rows"]
    headings = [each["text"] for each in kinds(given, "heading") if each["level"] == 2]
    wanted = ["Allowable values", "Pressure", "Stress below the surface", "Over time", "Inputs"]
    wanted += ["Geometry", "Material", "Accuracy", "Limits of the theory", "Versions and citation"]
    assert headings == wanted
    drawn = [each["about"] for each in kinds(given, "image")]
    assert drawn[:3] == ["Pressure", "Section through the pressure", "Outline of the contact"]
    assert "Loops" in drawn  # the load is cyclic
    assert not [each for each in kinds(given, "text") if "Not drawn" in each["text"]]
    assert [row[0] for row in kinds(given, "table")[0]["rows"]] == ["Peak pressure"]


def test_the_history_has_a_constant_force(ds: xr.Dataset) -> None:
    held = ds.assign(force=0 * ds["force"] + 0.6)
    labels = [axes.get_ylabel() for axes in history_with_load(held).axes]
    assert labels[0] == "Force [mN]"
    assert labels[1:] == [axes.get_ylabel() for axes in plot.history(held).axes]
    assert len(history_with_load(ds).axes) == len(plot.history(ds).axes) == len(labels)


@pytest.mark.slow
def test_a_result_over_speed_has_its_figures(given: dict[str, Any], tmp_path: Path) -> None:
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    load = vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    grid = vc.Grid((32, 32), (4e-3, 4e-3))
    ball = vc.Paraboloid(0.01, 0.01)
    write_pdf(vc.steady(ball, rubber, load, [0.01, 0.1], grid=grid), tmp_path / "r.pdf")
    drawn = [each["about"] for each in kinds(given, "image")]
    assert "Friction coefficient over speed" in drawn
    assert "Pressure along the motion" in drawn
    assert not [each for each in kinds(given, "text") if "Not drawn" in each["text"]]


def test_sweep_has_its_figure_and_table_and_equal_ones_give_equal_files(
    given: dict[str, Any], tmp_path: Path
) -> None:
    sweep = hertz_sweep(load__force=([1.0, 2.0, 4.0], "N"))
    for name in ("one.pdf", "two.pdf"):
        write_sweep_pdf(sweep, tmp_path / name, title=HOSTILE)
    one = (tmp_path / "one.pdf").read_bytes()
    assert one.startswith(b"%PDF-")
    assert one == (tmp_path / "two.pdf").read_bytes()
    assert [each["text"] for each in kinds(given, "heading")] == [HOSTILE, "Response", "Runs"]
    [table] = kinds(given, "table")
    assert len(table["rows"]) == 3


def test_interactive_parts_are_left_out_and_remarks_kept() -> None:
    part = element(
        "section",
        element("nav", element("a", "Inputs")),
        element(
            "figure", element("div", "", id="map", class_="plot"), element("figcaption", "Map")
        ),
        element("dl", element("dt", "Peak"), element("dd", "5 MPa", element("small", "most: 6"))),
    )
    assert list(blocks(part)) == [
        {"kind": "text", "faint": True, "text": "Map"},
        {"kind": "pairs", "boxed": True, "rows": [["Peak", "5 MPa (most: 6)"]]},
    ]


def test_without_typst_the_command_names_the_extra(
    ds: xr.Dataset,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    vc.save(ds, tmp_path / "run.nc")
    imported = builtins.__import__

    def without(name: str, *args: Any, **options: Any) -> Any:
        if name == "typst":
            raise ModuleNotFoundError("No module named 'typst'", name="typst")
        return imported(name, *args, **options)

    monkeypatch.delitem(sys.modules, "viscontact.report.pdf")
    monkeypatch.delattr("viscontact.report.pdf")
    monkeypatch.setattr(builtins, "__import__", without)
    assert main(["report", str(tmp_path / "run.nc"), "-o", str(tmp_path / "r.pdf")]) == 2
    assert "pip install 'viscontact[pdf]'" in capsys.readouterr().err
