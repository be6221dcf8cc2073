"""The worst values of a run beside its end: in the headline, in report and page, and as a loop."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from reports_without_pictures import without_pictures
from synthetic_results import maxwell_sphere
from viscontact.case import read_case
from viscontact.drawing.content.look import LIGHT
from viscontact.drawing.content.loop import loops_of
from viscontact.drawing.plotly.loops import loops
from viscontact.report.page import report_page
from viscontact.report.run_data import run_data
from viscontact.results.last_cycle_values import last_cycle, worst_notes, worst_places
from viscontact.results.summary import headline

__all__ = ["without_pictures"]  # a fixture

pytestmark = [
    # The punch has a sharp edge.
    pytest.mark.filterwarnings("ignore:the contact reaches the end"),
    pytest.mark.usefixtures("without_pictures"),
]

RUBBER = vc.Material(vc.Zener(1e7, 1e7, 2e6), poisson_ratio=0.5)
PERIOD, CYCLES = 0.5, 3


@pytest.fixture(scope="module")
def cyclic() -> xr.Dataset:
    """A flat punch under a harmonic load, of which half a cycle follows the last whole one."""
    load = vc.harmonic(20.0, 10.0, PERIOD, CYCLES)
    times = np.linspace(0.0, 2.75 * PERIOD, 89)
    punch, grid = vc.FlatPunch(5e-3), vc.Grid((14, 14), (12e-3, 12e-3))
    return vc.simulate(punch, RUBBER, load, grid, times, errors=False, fields=[0.0])


def described(ds: xr.Dataset) -> xr.Dataset:
    """A result written down, with what the page of a run states."""
    plain = {"residual": 1e-7, "time_error": 1e-4, "work": 1e-3, "loss_per_cycle": np.nan}
    for name, value in {**plain, "iterations": 9, "cells_across": 40, "outcome": 0}.items():
        ds[name] = "time", np.full(ds.sizes["time"], value), {"units": "1"}
    return ds.assign_attrs(wall_time=2.0)


def test_the_largest_peak_pressure_stands_beside_that_of_the_end() -> None:
    ds = described(maxwell_sphere(cells=40))  # its pressure decreases from t = 0
    first, last = (float(ds.peak_pressure[k]) * 1e-6 for k in (0, -1))
    assert first > 1.2 * last
    said = headline(ds)
    assert f"the peak pressure {last:.4g}" in said
    assert re.search(rf"The peak pressure is largest at t = 0 s: {first:.4g}\d* ", said)
    [note] = worst_notes(ds, "peak_pressure", -1)
    assert note.startswith(f"largest: {first:.4g}")
    assert note.endswith(" at t = 0 s")
    assert worst_notes(ds, "contact_area", -1) == []  # it grows
    page = report_page(ds).replace("\N{NO-BREAK SPACE}", " ")
    assert f'<small class="worst">{note}</small>' in page
    worst = run_data(ds)["worst"]
    assert worst["peak_pressure"] == {"cycle": None, "largest": 0}
    assert worst["contact_area"] == {"cycle": None, "largest": None}


def test_the_last_whole_cycle_gives_least_and_largest_values(cyclic: xr.Dataset) -> None:
    cycle = last_cycle(cyclic)
    assert cycle is not None
    assert (cycle.begin, cycle.end) == (PERIOD, 2 * PERIOD)
    assert cyclic.time[cycle.first] == close_to(PERIOD)
    assert cyclic.time[cycle.last] == close_to(2 * PERIOD)
    # The force is 10 N to 30 N, at three quarters and at a quarter of the cycle.
    least, largest = worst_places(cyclic, "force", -1)["cycle"]
    assert cyclic.time[[least, largest]].values == close_to([1.75 * PERIOD, 1.25 * PERIOD])
    assert "In the last cycle, t = 500 ms to 1 s: the force 10 N to 30 N, " in headline(cyclic)
    assert worst_notes(cyclic, "force", -1) == ["last cycle: 10 N to 30 N"]


def test_the_loss_of_the_headline_is_the_area_of_the_drawn_loop(cyclic: xr.Dataset) -> None:
    [figure] = loops(cyclic, replace(LIGHT, system="si"))
    assert figure.layout.meta["title"] == "Force over approach [N]"
    assert figure.layout.meta["note"].endswith("The area inside is the loss of a cycle.")
    _, last, _ = figure.data
    area = np.trapezoid(last.y, last.x)
    found = re.search(r"the loss per cycle is ([\d.]+) µJ", headline(cyclic))
    assert found is not None
    # A polygon of 32 corners in an ellipse has this part of its area.
    assert area * 1e6 == close_to(np.sinc(2 / 32) * float(found[1]), rel=5e-3)
    assert 'id="loop-force"' in report_page(cyclic)


def test_a_single_cycle_is_a_loop_but_no_last_cycle() -> None:
    ds = vc.simulate(
        vc.FlatPunch(5e-3),
        RUBBER,
        vc.triangle(10.0, 1.0),
        vc.Grid((16, 16), (12e-3, 12e-3)),
        np.linspace(0, 2, 41),
        errors=False,
    )
    assert last_cycle(ds) is None
    assert "last cycle" not in headline(ds)
    assert [loop.name for loop in loops_of(ds)] == ["loop-force"]


def test_the_fields_of_the_end_are_kept_and_early_ones_are_noted(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "indenter: {shape: sphere, radius: 10 mm}\n"
        "material: {law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}\n"
        "load: {kind: step, force: 1 N}\ntime: {end: 168 h, steps: 4}\n"
        "output: {fields: [0 s, 1000 s]}\n",
        encoding="utf-8",
    )
    case = read_case(path)
    assert case.fields == (0.0, 1000.0, 604800.0)
    note = "output.fields ends at 1000 s, before the run at 7 d; the fields of its end are kept"
    assert [each.startswith(note) for each in case.notes] == [True]
    path.write_text(path.read_text().replace("1000 s", "168 h"), encoding="utf-8")
    assert read_case(path).notes == ()


def test_strain_is_a_fifth_of_contact_radius_over_ball_radius_at_one_instant() -> None:
    ds = described(maxwell_sphere(cells=40))
    extents = float(ds.contact_length[-1]), float(ds.contact_width[-1])  # largest at the end
    half, radius = max(extents) / 2, 0.01
    text = report_page(ds).replace("\N{NO-BREAK SPACE}", " ")
    assert f"radius of curvature R of the body: {0.2 * half / radius:.2g}, at t = 300 s" in text


def test_strain_below_a_flat_punch_is_pressure_times_compliance_at_one_instant(
    cyclic: xr.Dataset,
) -> None:
    law = RUBBER.law
    product = [
        float(p) * float(law(t))
        for p, t in zip(cyclic.mean_pressure.values, cyclic.time.values, strict=True)
    ]
    at = int(np.argmax(product))
    text = report_page(cyclic).replace("\N{NO-BREAK SPACE}", " ")
    when = float(cyclic.time[at])
    found = re.search(r"at the same instant: ([\d.]+), at t = ([\d.]+) (m?s)", text)
    assert found is not None
    assert float(found[1]) == close_to(max(product), rel=0.05)
    assert float(found[2]) * {"s": 1.0, "ms": 1e-3}[found[3]] == close_to(when, rel=1e-3)
