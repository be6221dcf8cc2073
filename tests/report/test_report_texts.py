"""Texts of the report: changes, limits of the theory, measured tables, headings, title block."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import pytest
import xarray as xr

from synthetic_results import ellipse
from viscontact.report.accuracy import accuracy_lines
from viscontact.report.creep_gains import gains_over_a_year, relative_change
from viscontact.report.input_chapters import about_chapter
from viscontact.report.limits import assumptions
from viscontact.report.measured import measured_figure, measured_text
from viscontact.report.result_chapters import heading_of
from viscontact.report.title_block import title_entries


def text_of(parts: Iterable[Element]) -> str:
    return "".join(piece for part in parts for piece in part.itertext())


def test_relative_change_of_zero_is_empty() -> None:
    assert relative_change(400e6, 300e6) == "−25 %"
    assert relative_change(0.0, 1.0) == ""


def test_gains_over_a_year_are_in_the_order_of_time_with_the_end_of_the_case_among_them() -> None:
    times = [0.0, 3600.0, 5e4, 86400.0, 7 * 86400.0]
    sizes = {"peak_pressure": ("time", [5e6, 4e6, 3.5e6, 3e6, 2e6])}
    year = xr.Dataset(sizes, {"time": times})
    case = year.isel(time=[0, 1, 2])
    parts = gains_over_a_year(year, {"case": case}, {"case": year, "best": year}, ["peak_pressure"])
    labels = ("0 s", "1 h", "end of the case", "1 day", "1 week")
    page = text_of(parts)
    places = [page.index(label) for label in labels]
    assert places == sorted(places)


def test_iterations_of_all_steps_are_added_up() -> None:
    ds = ellipse().assign_attrs(wall_time=2.0)
    ds["iterations"][:] = [3, 4, 5]
    assert "3 instants in 2 s, 12 iterations" in text_of(about_chapter(ds))


def test_cells_are_counted_across_the_largest_contact() -> None:
    ds = ellipse()
    ds["cells_across"][:] = [20, 26, 30]
    found = dict(accuracy_lines(ds))["Cells"]
    assert found.startswith("48 × 54 cells of 20 µm × 40 µm; 30 across the shorter side of the la")


def test_balance_of_a_load_program_is_that_of_its_segments() -> None:
    found = dict(accuracy_lines(with_case(ellipse(), load={"type": "MixedHistory"})))["Balance"]
    assert found.startswith("segments prescribe force or approach; under a force, ")


def test_measured_values_over_decades_are_drawn_on_a_logarithmic_axis() -> None:
    for last, scale in ((1e4, "log"), (20.0, "linear")):
        over = {"quantity": "time", "units": "s", "values": [1.0, 2.0, last]}
        of = {"quantity": "creep_compliance", "units": "1/Pa", "values": [1e-9, 2e-9, 3e-9]}
        figure = measured_figure({"columns": [over, of], "data": "shear"})
        assert figure.axes[0].get_xscale() == scale


def test_measured_table_is_described_with_file_columns_and_test() -> None:
    columns = [{"heading": "time [s]", "values": [1.0]}, {"heading": "D [1/GPa]"}]
    found = measured_text({"file": "pom.csv", "rows": 1, "columns": columns, "data": "uniaxial"})
    assert (
        found
        == "As measured: 1 row of pom.csv, columns “time [s]” and “D [1/GPa]” (uniaxial test)."
    )
    many = {"file": "pom.csv", "rows": 5000, "columns": columns, "data": "uniaxial"}
    assert "5000 rows of pom.csv, 1 of them drawn, columns" in measured_text(many)


def test_heading_has_the_label_unless_it_repeats_the_title() -> None:
    ball = xr.Dataset(attrs={"title": "Ball"})
    found = [heading_of(ball, label) for label in ("", "run-2", "Ball, force 2 N")]
    assert found == ["Ball", "Ball (run-2)", "Ball, force 2 N"]


def test_title_block_has_the_known_entries() -> None:
    found = title_entries(xr.Dataset(attrs={"title_block": '{"project": "P-7", "revision": "B"}'}))
    assert found == [("Project", "P-7"), ("Revision", "B")]


# --- limits of the theory -----------------------------------------------------------------------


def said(ds: xr.Dataset) -> dict[str, str]:
    return dict(assumptions(ds))


def with_case(ds: xr.Dataset, **sections: Any) -> xr.Dataset:
    """The same result of a case with other sections."""
    case = json.loads(ds.attrs["case"])
    return ds.assign_attrs(case=json.dumps({**case, **sections}))


@pytest.mark.parametrize("transposed", [False, True])
def test_contact_and_approach_are_stated_at_their_largest(transposed: bool) -> None:
    """At last the ellipse is 0.6 mm by 1.5 mm, and the approach 2.25 µm."""
    found = said(ellipse(transposed=transposed))
    along = ("1.5 mm along x, 600 µm along y", "600 µm along x, 1.5 mm along y")
    assert f"Largest contact here: {along[not transposed]}." in found["Half-space"]
    largest = "Largest approach here: 2.25 µm, 0.0037 of the contact's shorter side."
    assert found["Small slopes"].endswith(largest)


def test_approach_is_not_stated_without_contact_or_datum() -> None:
    open_gap, no_datum = ellipse(), ellipse()
    for name in ("contact_length", "contact_width"):
        open_gap[name][:] = 0.0
    no_datum["approach"][:] = np.nan
    for ds in (open_gap, no_datum):
        assert "Largest approach" not in said(ds)["Small slopes"]


@pytest.mark.parametrize("axis", ["x", "y"])
def test_period_is_named_after_its_axis(axis: str) -> None:
    grid = json.loads(ellipse().attrs["case"])["grid"]
    along_one = with_case(ellipse(), grid=grid | {"periodic": [axis == "x", axis == "y"]})
    assert f"one period of it along {axis} is pressed here" in said(along_one)["Half-space"]


@pytest.mark.parametrize("transposed", [False, True])
def test_strain_of_an_ellipse_is_the_larger_one_of_its_axes(transposed: bool) -> None:
    """0.2 a/R (Tabor 1951): of 0.3 mm and 20 mm, and of 0.75 mm and 100 mm."""
    found = said(ellipse(transposed=transposed))["Linear viscoelasticity"]
    assert "curvature R of the body: 0.0030, at t = 5 s. Check" in found


@pytest.mark.parametrize("along", ["x", "y"])
def test_strain_of_a_steady_contact_is_that_of_its_passage(along: str) -> None:
    """Mean pressure times (1/G + t/η)/2 of a Maxwell body after the time of the passage t."""
    shear, viscosity, speeds = 1e9, 1e8, np.array([4e-3, 5e-3, 1e-2])
    law = {"type": "Maxwell", "shear_modulus": shear, "viscosity": viscosity}
    material = {"type": "Material", "law": law, "poisson_ratio": 0.5, "bulk_modulus": None}
    cone = {"type": "Cone", "half_angle": 1.4}
    ds = with_case(ellipse(), indenter=cone, material=material).rename(time="speed")
    ds = ds.assign_coords(speed=speeds).assign_attrs(along=along)
    passage = ds["contact_length" if along == "x" else "contact_width"].values / speeds
    strains = ds.mean_pressure.values * (1 / shear + passage / viscosity) / 2
    stated = f"{strains.max():.2g}, at {1e3 * speeds[strains.argmax()]:g} mm/s"
    assert f"creep compliance at the same instant: {stated}" in said(ds)["Linear viscoelasticity"]


def test_assumptions_about_the_contact_are_those_of_the_run() -> None:
    plain = said(ellipse())
    assert {"No friction", "No adhesion"} <= set(plain)
    sticking = {"type": "Adhesion", "work": 0.05, "range": 2e-9, "strength": None}
    found = said(with_case(ellipse(), adhesion=sticking, friction={"coefficient": 0.3}))
    assert not {"No friction", "No adhesion"} & set(found)
    assert "with a work of 50 mJ/m²" in found["Adhesion over the gap"]
    assert "0.3 times the pressure" in found["Friction of Coulomb"]
