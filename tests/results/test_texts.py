"""Texts of results: values with errors, arguments, citations, labels."""

from __future__ import annotations

import csv
import io
import math

import xarray as xr

import viscontact as vc
from closeness import close_to
from synthetic_results import ellipse, maxwell_sphere
from viscontact.results.argument_table import argument_rows, in_plain_words
from viscontact.results.citation import bibtex, citations
from viscontact.results.formatting import (
    format_bound,
    format_bounded,
    format_with_error,
    format_with_error_in,
)
from viscontact.results.history_csv import write_history
from viscontact.results.summary import headline, legend, summary_rows
from viscontact.results.sweep_axes import key_label, over_of
from viscontact.results.typed_rows import typed_rows
from viscontact.results.variables import Place, scalar_attributes, shown_in
from viscontact.results.verdicts import Verdict, deciding, limits_of, stated_limits
from viscontact.units.formatting import readable_unit


def test_accessor_shows_the_force_in_a_readable_unit() -> None:
    material = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    grid = vc.Grid((32, 32), (4e-3, 4e-3))
    ds = vc.simulate(vc.Sphere(0.01), material, vc.step(force=0.1), grid, [0.0, 1.0])
    printed = str(ds.viscontact).splitlines()[3].split()[:3]
    assert printed == ["force", "100", "mN"]


def test_argument_rows_begin_with_the_kind() -> None:
    sphere = {"type": "Sphere", "radius": 0.01}
    assert list(argument_rows(sphere)) == [("shape", "sphere"), ("radius", "10 mm")]


def test_type_in_words_keeps_the_capital_of_a_person() -> None:
    assert in_plain_words("CreepSeries") == "creep series"
    assert in_plain_words("FractionalMaxwell") == "fractional Maxwell"


def test_rows_of_a_nested_section_are_named_after_it() -> None:
    crown = {"kind": "johns-gohar", "force": "500 N"}
    found = list(typed_rows({"half_length": "8 mm", "profile": crown}))
    assert found == [
        ("half length", "8 mm"),
        ("profile", "johns-gohar"),
        ("profile force", "500 N"),
    ]


def test_citation_has_the_version() -> None:
    found = citations("0.1.0")[0]
    assert (
        found
        == "The viscontact developers: viscontact: contact of creeping bodies. Version 0.1.0, MIT."
    )


def test_bibtex_begins_with_the_program() -> None:
    assert bibtex("0.1.0").splitlines()[0] == "@software{viscontact,"


def test_value_that_depends_on_the_mesh_is_a_lower_bound() -> None:
    assert format_with_error(57.634e-6, 0.149e-6, "m2") == "57.63 ± 0.15 mm²"
    assert format_with_error(152.2e6, math.inf, "Pa") == ">152.2 MPa (depends on the mesh)"


def test_infinite_error_alone_marks_a_lower_bound() -> None:
    found = [format_bounded(152.2e6, error, "Pa") for error in (5e6, math.nan, math.inf)]
    assert found == ["152.2 MPa", "152.2 MPa", ">152.2 MPa"]


def test_value_has_the_digits_of_its_error_in_the_unit_of_the_table() -> None:
    table = readable_unit("m", 0.08)
    found = [format_with_error_in(table, 0.0576344, error) for error in (0.000149, 0.0, math.inf)]
    assert found == ["57.63 ± 0.15", "57.63", ">57.63"]


def test_bound_is_a_percentage_or_below_the_least() -> None:
    assert format_bound(0.0031) == "at most 0.31 %"
    assert format_bound(1e-9) == "below 0.01 %"


def test_legend_of_a_result_over_speed_names_the_speed() -> None:
    found = legend(xr.Dataset({"force": ("speed", [1.0])}))[:41]
    assert found == "±: the error of each value at that speed "


def test_steps_of_a_steady_sweep_are_speeds() -> None:
    assert over_of(xr.Dataset({"speed": (("run", "step"), [[1.0]])})) == "speed"


def test_key_label_is_the_key_in_words() -> None:
    assert key_label("material.delayed_modulus") == "Material delayed modulus"
    assert key_label("indenter[2].radius") == "Indenter 2 radius"


def test_scalars_of_a_place_are_those_that_a_result_has() -> None:
    found = shown_in(Place.LIVE)
    assert found == [
        *("contact_area", "strip_width", "approach", "peak_pressure", "friction_coefficient")
    ]
    line = {"contact_area", "strip_width", "contact_length", "force_per_length"}
    assert shown_in(Place.LIVE, line) == ["strip_width"]
    assert shown_in(Place.LIVE, {"approach"}) == ["approach"]


def test_scalar_points_to_its_error() -> None:
    assert scalar_attributes("force", errors=True)["ancillary_variables"] == "force_error"


def test_pressure_at_a_point_is_that_of_its_x_and_y() -> None:
    """A plane is its own bilinear interpolation."""
    ds, file = ellipse(), io.StringIO()
    ds["pressure"][:] = (1e9 * ds.x + 1e10 * ds.y).transpose("x", "y")
    write_history(ds, file, points=[(1e-4, -2e-4)])
    *_, last = csv.DictReader(io.StringIO(file.getvalue()))
    pressure = float(last["pressure at x=0.0001 m y=-0.0002 m [Pa]"])
    assert pressure == close_to(1e9 * 1e-4 - 1e10 * 2e-4, rel=1e-9)


def test_bodies_come_apart_at_the_first_instant_without_contact() -> None:
    ds = maxwell_sphere((0.0, 10.0, 20.0, 30.0))
    ds["contact_area"][2:] = 0.0
    assert headline(ds).endswith("from t = 20 s to the end, t = 30 s, they do not touch.")


def test_error_of_a_zero_is_compared_with_the_largest_value() -> None:
    ds = ellipse()
    ds["peak_pressure"][:] = [0.0, 1e6, 2e6]
    ds["peak_pressure_error"] = ("time", [1.0, 1e4, 1e4])
    [row] = [each for each in summary_rows(ds) if each.name == "peak_pressure"]
    assert (row.first, row.last) == ("0", "2.000 ± 0.010")


def test_margin_is_the_part_that_value_and_error_leave() -> None:
    assert Verdict("force", 10.0, "passed", 7.0, 1.0).margin == 0.2


def test_limits_are_read_from_the_result() -> None:
    found = limits_of(xr.Dataset(attrs={"allowable": '{"peak_pressure": {"limit": 65e6}}'}))
    assert found == {"peak_pressure": 65000000.0}


def test_limits_are_stated_with_unit_and_label() -> None:
    found = stated_limits(xr.Dataset(attrs={"allowable": '{"peak_pressure": {"limit": 65e6}}'}))
    assert found == [("Peak pressure", "65 MPa")]


def test_undecided_quantity_decides() -> None:
    found = deciding([Verdict("force", 1.0, "passed"), Verdict("work", 1.0, "undecided")])
    assert found == "work"
