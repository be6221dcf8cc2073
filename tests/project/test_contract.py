"""What users rely on, name by name: every promise of the contract, touched once."""

from __future__ import annotations

import csv
import inspect
import json
import math
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.results.descriptions import describe, rebuild

# A handful of steps is enough here; that they are few is warned about, and tested elsewhere.
pytestmark = [
    pytest.mark.filterwarnings("ignore:the load grows from nothing:viscontact.AccuracyWarning"),
    pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning"),
]

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 4e6), 0.5)  # retarded by 4 s: steps of 1 s are short
BALL = vc.Sphere(0.01)
GRID = vc.Grid((32, 32), (2.4e-3, 2.4e-3))
TIMES = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.1, 3.5, 4.0, 5.0]
#: A jump up at 0 s, one down at 1 s, off from 2 s to 3 s, on again.
LOAD = vc.ForceHistory([0, 1, 1, 2, 3, 4, 5], [0.1, 0.1, 0.05, 0, 0, 0.1, 0.1])


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    """A run that passes through all that can happen."""
    return vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES)


# --- names and arguments ------------------------------------------------------------------------

# More arguments may follow behind: adding is free.
SIGNATURES = {
    "Sphere": "(radius)",
    "Paraboloid": "(radius_x, radius_y)",
    "Cone": "(half_angle)",
    "FlatPunch": "(radius=None, *, half_length=None, half_width=None)",
    "Roller": "(radius, half_length, crown_radius=None, profile=None)",
    "HeightMap": "(x, y, height)",
    "Elastic": "(shear_modulus)",
    "Maxwell": "(shear_modulus, viscosity)",
    "Zener": "(shear_modulus, delayed_modulus, viscosity)",
    "Burgers": "(shear_modulus, viscosity, delayed_modulus, delayed_viscosity)",
    "CreepSeries": "(instant, amplitudes, times, fluidity=0.0)",
    "RelaxationSeries": "(equilibrium, moduli, times)",
    "PowerLaw": "(compliance, exponent, reference_time, instant=0.0)",
    "FractionalMaxwell": "(shear_modulus, time, exponent, second_exponent=0.0)",
    "FractionalZener": "(shear_modulus, equilibrium_modulus, time, exponent)",
    "TabulatedCreep": "(times, compliance, *, before='first', beyond='slope')",
    "TabulatedRelaxation": "(times, modulus, *, before='first', beyond='slope')",
    "Material": "(law, poisson_ratio=None, *, bulk_modulus=None)",
    "ForceHistory": "(times, force, eccentricity_x=0.0, eccentricity_y=0.0, "
    "tilt_x=None, tilt_y=None)",
    "step": "(force=None, *, approach=None, eccentricity_x=0.0, eccentricity_y=0.0, "
    "tilt_x=None, tilt_y=None)",
    "ramp": "(force=None, duration=None, *, approach=None, eccentricity_x=0.0, "
    "eccentricity_y=0.0, tilt_x=None, tilt_y=None)",
    "triangle": "(force=None, rise=None, fall=None, *, approach=None, eccentricity_x=0.0, "
    "eccentricity_y=0.0, tilt_x=None, tilt_y=None)",
    "Grid": "(shape, size)",
    "auto_grid": "(indenter, material, load, tolerance=0.01)",
    "uniform_times": "(end, n)",
    "log_times": "(first, end, n)",
    **dict.fromkeys(
        ("simulate", "march"),
        "(indenter, material, load, grid=None, times=None, *, indenter_material=None, "
        "tolerance=1e-06, fields='all', threads=1, progress=None)",
    ),
    "rolling_temperature": "(curve, *, cooling, ambient, area=None, speed=None, conductivity=None, "
    "core_temperature=None, heat_capacity=None, density=None)",
    "leakage": "(ds, *, viscosity, pressure_difference=None, along='x', ends=None, length=None, "
    "width=None, gas=None, fields='none')",
    "under_pressure": "(pressure, material, grid=None, times=None)",
    "save": "(ds, path)",
    "open_results": "(path)",
}
LAWS = (
    *("Elastic", "Maxwell", "Zener", "Burgers", "CreepSeries", "RelaxationSeries"),
    *("PowerLaw", "FractionalMaxwell", "FractionalZener"),
    *("TabulatedCreep", "TabulatedRelaxation"),
)


def _bare_signature(thing: Any) -> str:
    """Names and defaults of the arguments, without their types."""
    signature = inspect.signature(thing)
    bare = [each.replace(annotation=each.empty) for each in signature.parameters.values()]
    return str(signature.replace(parameters=bare, return_annotation=signature.empty))


@pytest.mark.parametrize("name", SIGNATURES)
def test_name_is_public_and_takes_the_promised_arguments(name: str) -> None:
    assert name in vc.__all__
    assert _bare_signature(getattr(vc, name)).startswith(SIGNATURES[name].removesuffix(")"))


def test_package_says_its_version_and_offers_the_exact_solutions() -> None:
    assert vc.__version__.count(".") == 2
    assert vc.reference.hertz_sphere
    for error in (vc.ConvergenceError, vc.DomainError):
        assert error("why").partial is None
    assert issubclass(vc.AccuracyWarning, UserWarning)
    assert (vc.Outcome.CONVERGED, vc.Outcome.NO_CONTACT, vc.Outcome.NOT_CONVERGED) == (0, 1, 2)


PROFILES: dict[str, Any] = {
    "cylindrical": {"profile": "cylindrical"},
    "full": {"profile": "full", "crown_radius": 1.0},
    "partial": {"profile": "partial", "crown_radius": 1.0},
    "logarithmic": {"profile": "logarithmic", "amplitude": 1e-6},
    "chamfer": {"profile": "chamfer", "angle": 0.5, "length": 1e-3},
    "table of (x, drop)": {"profile": [(0.0, 0.0), (0.01, 1e-6)]},
}


@pytest.mark.parametrize("arguments", PROFILES.values(), ids=PROFILES)
def test_roller_takes_each_named_profile_with_its_own_arguments(arguments: Any) -> None:
    roller = vc.Roller(0.005, 0.01, **arguments)
    assert float(roller.gap(0.0, 0.0)) == 0.0
    assert float(roller.gap(0.001, 0.001)) > 0.0


# --- indenters ----------------------------------------------------------------------------------

SHAPES = {
    "sphere": (BALL, (0.011, 0.0)),
    "round punch": (vc.FlatPunch(0.01), (0.008, 0.008)),
    "rectangular punch": (vc.FlatPunch(half_length=0.01, half_width=0.02), (0.0, 0.021)),
    "roller, beside it": (vc.Roller(0.005, 0.01), (0.0, 0.006)),
    "roller, behind its sharp end": (vc.Roller(0.005, 0.01), (0.0101, 0.0)),
    "roller, beyond its crown's section": (vc.Roller(0.005, 0.01, 0.02), (0.029, 0.0)),
    "map": (vc.HeightMap([-1, 0, 1], [-1, 0, 1], [[0, 0, 0], [0, 5, 0], [0, 0, 0]]), (1.1, 0.0)),
    "paraboloid": (vc.Paraboloid(0.01, 0.02), None),
    "cone": (vc.Cone(1.2), None),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_gap_is_zero_at_the_deepest_point_and_infinite_outside_the_outline(shape: str) -> None:
    indenter, outside = SHAPES[shape]
    assert indenter.gap(0.0, 0.0) == 0.0
    x = np.linspace(-0.03, 0.03, 21)
    assert (indenter.gap(x[:, None], x[None, :]) >= 0).all()
    if outside is None:
        assert np.isfinite(indenter.gap(1.0, 1.0))
    else:
        assert indenter.gap(*outside) == np.inf


def test_crown_continues_beyond_the_straight_part_as_eq_13_says() -> None:
    R, L, R_c, x, y = 5e-3, 10e-3, 75e-3, 14e-3, 1e-3
    section = R - R_c + math.sqrt(R_c**2 - (x - L) ** 2)
    expected = R - math.sqrt(section**2 - y**2)
    assert float(vc.Roller(R, L, R_c).gap(-x, y)) == close_to(expected, rel=1e-11)


def test_map_shows_its_peaks_first_and_sums_are_not_zeroed_again() -> None:
    height = np.array([[0.0, 1.0], [2.0, 4.0]])
    surface = vc.HeightMap([0, 1], [0, 1], height)
    corners = surface.gap(np.array([[0.0], [1.0]]), np.array([[0.0, 1.0]]))
    np.testing.assert_array_equal(corners, height.max() - height)
    # the map's peak is at (1, 1), the cone's tip at the origin: nowhere is the sum zero
    total = surface + vc.Cone(math.pi / 4)
    assert float(total.gap(1.0, 1.0)) == close_to(math.sqrt(2))
    assert float(total.gap(0.0, 0.0)) == 4.0


def test_objects_are_frozen() -> None:
    for given in (BALL, vc.Elastic(1.0), RUBBER, GRID, LOAD):
        with pytest.raises(AttributeError):
            given.radius = 1.0


# --- laws and materials -------------------------------------------------------------------------


def test_law_is_the_deviatoric_compliance_and_its_modulus_the_shear_modulus() -> None:
    G, eta, G_2, eta_2, t = 1e9, 5e9, 2e9, 3e9, 2.0
    kelvin = (1 - math.exp(-t * G_2 / eta_2)) / (2 * G_2)
    expected = {
        vc.Elastic(G): 1 / (2 * G),
        vc.Maxwell(G, eta): 1 / (2 * G) + t / (2 * eta),
        vc.Zener(G, G_2, eta_2): 1 / (2 * G) + kelvin,
        vc.Burgers(G, eta, G_2, eta_2): 1 / (2 * G) + t / (2 * eta) + kelvin,
        vc.CreepSeries(3e-10, [2e-10], [4.0], 1e-11): 3e-10
        + 2e-10 * (1 - math.exp(-0.5))
        + 1e-11 * t,
    }
    for law, phi in expected.items():
        assert law(t) == close_to(phi, rel=1e-12)
        assert law.relaxation(0.0) == close_to(1 / (2 * law(0.0)), rel=1e-12)
    series = vc.RelaxationSeries(1e9, [2e9], [4.0])
    assert series.relaxation(t) == close_to(1e9 + 2e9 * math.exp(-0.5), rel=1e-12)


@pytest.mark.parametrize("of", ["__call__", "relaxation"])
def test_law_takes_numbers_lists_and_arrays_of_any_shape(of: str) -> None:
    evaluate = getattr(vc.Zener(1e9, 2e9, 3e9), of)
    assert isinstance(evaluate(1), float)
    assert evaluate([0.0, 1.0]).shape == (2,)
    assert evaluate(np.ones((2, 3))).shape == (2, 3)
    with pytest.raises(ValueError, match=r"-1\.0 s"):
        evaluate(-1.0)


def test_rheometers_compliance_is_half_and_tensile_one_is_one_plus_nu() -> None:
    terms: tuple[Any, ...] = (1e-9, [2e-9], [3.0], 1e-12)
    phi = vc.CreepSeries(*terms)(5.0)
    assert vc.CreepSeries.from_shear(*terms)(5.0) == close_to(phi / 2)
    tensile = vc.CreepSeries.from_uniaxial
    assert tensile(*terms, poisson_ratio=0.3)(5.0) == close_to(1.3 * phi)
    K = 4e9
    assert tensile(*terms, bulk_modulus=K)(5.0) == close_to(1.5 * (phi - 1 / (9 * K)))
    E = vc.Elastic.from_uniaxial(youngs_modulus=3e9, poisson_ratio=0.5)
    assert E.relaxation(0.0) == close_to(1e9)  # G = E / (2 (1 + nu))


@pytest.mark.parametrize("name", LAWS)
def test_every_law_is_made_from_shear_and_from_uniaxial_data(name: str) -> None:
    law = getattr(vc, name)
    arguments = list(inspect.signature(law).parameters)
    shear = list(inspect.signature(law.from_shear).parameters)
    uniaxial = list(inspect.signature(law.from_uniaxial).parameters)
    assert shear == arguments
    assert uniaxial[-2:] == ["poisson_ratio", "bulk_modulus"]
    assert uniaxial[:-2] == [{"shear_modulus": "youngs_modulus"}.get(a, a) for a in arguments]


@pytest.mark.parametrize("value", [True, "1e9", None, [1e9], 1j, math.nan, math.inf, -1.0, 10**400])
def test_law_and_material_refuse_what_is_no_positive_number(value: Any) -> None:
    for make in (
        lambda: vc.Elastic(value),
        lambda: vc.CreepSeries(1e-9, [value], [1.0]),
        lambda: vc.RelaxationSeries(1e9, [1e9], [value]),
        lambda: vc.Material(vc.Elastic(1e9), bulk_modulus=value),
    ):
        with pytest.raises(ValueError, match=r"modulus|amplitudes|times"):
            make()


def test_material_takes_one_of_poissons_ratio_and_bulk_modulus() -> None:
    law = vc.Elastic(3e9)
    by_ratio = vc.Material(law, 0.25).contact_compliance()(0.0)
    assert by_ratio == close_to(0.75 / 6e9)
    assert vc.Material(law, bulk_modulus=5e9).contact_compliance()(0.0) == close_to(by_ratio)
    for wrong in ({}, {"poisson_ratio": 0.3, "bulk_modulus": 1e9}):
        with pytest.raises(ValueError, match="exactly one"):
            vc.Material(law, **wrong)


# --- load histories, grids, times ---------------------------------------------------------------


def test_history_is_zero_before_linear_between_jumping_at_and_held_after_its_points() -> None:
    load = vc.ForceHistory([1, 2, 2, 3], [10, 20, 5, 8], eccentricity_x=[0, 1e-3, 1e-3, 1e-3])
    assert load.force_at([0.5, 1.0, 1.5, 2.0, 2.5, 9.0]).tolist() == [0, 10, 15, 5, 6.5, 8]
    assert load.at(2.0, side="left").force == 20
    assert load.at(1.5).eccentricity_x == 5e-4
    assert load.at(1.5).tilt_x is None
    assert vc.ForceHistory([0, 1], 3.0, tilt_y=[0, 2e-3]).at(0.5).tilt_y == 1e-3


def test_force_below_1e_minus_12_of_the_largest_counts_as_zero() -> None:
    load = vc.ForceHistory([0, 1, 2], [1.0, 0.9e-12, 1.1e-12])
    assert load.force_at([1.0, 2.0]).tolist() == [0.0, 1.1e-12]


def test_shapes_of_histories() -> None:
    assert vc.step(4.0).force_at([0.0, 9.0]).tolist() == [4, 4]
    assert vc.ramp(4.0, 2.0).force_at([1.0, 2.0, 9.0]).tolist() == [2, 4, 4]
    assert vc.triangle(4.0, 2.0).force_at([1.0, 2.0, 3.0, 4.0, 9.0]).tolist() == [2, 4, 2, 0, 0]
    assert vc.triangle(4.0, 2.0, 4.0).force_at(4.0) == 2.0
    tail = {"eccentricity_x": 1e-3, "tilt_y": 2e-3}
    for load in (vc.step(1.0, **tail), vc.ramp(1.0, 1.0, **tail), vc.triangle(1.0, 1.0, **tail)):
        assert (load.at(0.0).eccentricity_x, load.at(0.0).tilt_y) == (1e-3, 2e-3)


def test_grid_has_cell_centres_centred_on_the_origin() -> None:
    grid = vc.Grid((4, 5), (8.0, 5.0))
    assert grid.x.tolist() == [-3, -1, 1, 3]  # an even number: no cell at 0
    assert grid.y.tolist() == [-2, -1, 0, 1, 2]


def test_instants_begin_at_0_and_end_at_the_end() -> None:
    assert vc.uniform_times(10.0, 4).tolist() == [0, 2.5, 5, 7.5, 10]
    np.testing.assert_allclose(vc.log_times(1.0, 1000.0, 4), [0, 1, 10, 100, 1000], rtol=1e-14)


@pytest.mark.parametrize("value", [True, "1", None, [1.0], 1j, math.nan, math.inf, -1.0, 10**400])
def test_lengths_forces_and_times_refuse_what_is_no_positive_number(value: Any) -> None:
    for make in (
        lambda: vc.Sphere(value),
        lambda: vc.Cone(value),
        lambda: vc.ramp(1.0, value),
        lambda: vc.uniform_times(value, 2),
        lambda: vc.uniform_times(1.0, value),
    ):
        with pytest.raises(ValueError, match=r"must|missing"):
            make()


@pytest.mark.parametrize("value", [True, "1", None, [1.0], 1j, math.nan, math.inf, 10**400])
def test_forces_refuse_what_is_no_number(value: Any) -> None:
    with pytest.raises(ValueError, match=r"must|missing"):
        vc.step(value)


def test_auto_grid_holds_the_contact_and_follows_its_tolerance() -> None:
    coarse, fine = (vc.auto_grid(BALL, RUBBER, vc.step(0.1), tolerance=t) for t in (0.04, 0.01))
    # Hertz with Phi(inf) = 1/G: a^3 = 3 R W Phi / 8 (eq. 16 of Spinu & Cerlinca 2018)
    radius = (3 * 0.01 * 0.1 * 1e-6 / 8) ** (1 / 3)
    assert min(fine.size) > 2 * radius
    assert fine.shape[0] > coarse.shape[0]


# --- results ------------------------------------------------------------------------------------

SCALARS = {
    **{"force": "N", "eccentricity_x": "m", "eccentricity_y": "m"},
    **{"approach": "m", "tilt_x": "rad", "tilt_y": "rad"},
    **{"contact_area": "m2", "contact_length": "m", "contact_width": "m"},
    **{"peak_pressure": "Pa", "mean_pressure": "Pa", "peak_line_load": "N/m"},
    **{"work": "J", "loss_per_cycle": "J", "time_error": "1"},
    **{"iterations": "1", "residual": "1", "cells_across": "1", "outcome": "1"},
}
ERRORS = {
    f"{name}_error": unit
    for name, unit in SCALARS.items()
    if name not in ("time_error", "iterations", "residual", "cells_across", "outcome")
}
FIELDS = {"pressure": "Pa", "gap": "m", "displacement": "m", "line_load": "N/m", "in_contact": "1"}
COORDINATES = {"time": "s", "x": "m", "y": "m"}
KINDS = {"iterations": "i", "cells_across": "i", "outcome": "i", "in_contact": "i"}


def _check_variables(ds: xr.Dataset, fields: type[np.floating] = np.float64) -> None:
    assert set(ds.data_vars) == {*SCALARS, *ERRORS, *FIELDS}
    assert set(ds.coords) == set(COORDINATES)
    for name, unit in {**SCALARS, **ERRORS, **FIELDS, **COORDINATES}.items():
        assert ds[name].attrs["units"] == unit, name
        assert ds[name].attrs["long_name"], name
        assert ds[name].dtype.kind == KINDS.get(name, "f"), name
        assert "axis" not in ds[name].attrs, name
    assert all(ds[name].dims == ("time",) for name in (*SCALARS, *ERRORS))
    for name in ERRORS:
        assert ds[name.removesuffix("_error")].attrs["ancillary_variables"] == name
    axes = dict.fromkeys(FIELDS, ("time", "x", "y")) | {"line_load": ("time", "x")}
    assert all(ds[name].dims == axes[name] for name in FIELDS)
    assert all(ds[name].dtype == np.float64 for name in COORDINATES)
    assert all(ds[name].dtype == fields for name in FIELDS if name not in KINDS)
    assert ds.in_contact.attrs["flag_values"].tolist() == [0, 1]
    assert ds.in_contact.attrs["flag_meanings"] == "open in_contact"
    np.testing.assert_array_equal(ds.in_contact, ds.pressure > 0)  # without adhesion
    assert ds.outcome.attrs["flag_values"].tolist() == [0, 1, 2, 3]
    assert ds.outcome.attrs["flag_meanings"] == "converged no_contact not_converged pulled_off"


def test_result_has_every_variable_with_its_dimensions_unit_and_long_name(ds: xr.Dataset) -> None:
    _check_variables(ds)
    assert ds.time.values.tolist() == TIMES
    np.testing.assert_array_equal(ds.x, GRID.x)
    np.testing.assert_array_equal(ds.y, GRID.y)


def test_result_carries_version_case_wall_time_tolerance_and_warnings(ds: xr.Dataset) -> None:
    assert ds.attrs["version"] == vc.__version__
    assert ds.attrs["tolerance"] == 1e-6
    assert ds.attrs["wall_time"] > 0
    assert ds.attrs["warnings"] == ""
    case = json.loads(ds.attrs["case"])
    assert case["indenter"] == {"type": "Sphere", "radius": 0.01}
    assert case["material"]["law"]["type"] == "Zener"
    assert case["load"]["force"] == LOAD.force.tolist()
    assert case["grid"]["shape"] == [32, 32]
    assert case["times"] == TIMES


def test_scalars_mean_what_their_names_say(ds: xr.Dataset) -> None:
    np.testing.assert_allclose(ds.pressure.sum(("x", "y")) * GRID.cell_area, ds.force, rtol=1e-12)
    np.testing.assert_allclose(ds.force, LOAD.force_at(TIMES), rtol=1e-6)
    np.testing.assert_array_equal(ds.pressure.max(("x", "y")), ds.peak_pressure)
    touching = ds.where(ds.contact_area > 0, drop=True)
    np.testing.assert_allclose(touching.force / touching.contact_area, touching.mean_pressure)
    # gap = initial gap + displacement - approach - tilts (eq. 1), to the solver's tolerance
    initial = xr.DataArray(BALL.gap(GRID.x[:, None], GRID.y[None, :]), dims=("x", "y"))
    rigid = ds.approach + ds.tilt_x * ds.x + ds.tilt_y * ds.y
    np.testing.assert_allclose(
        (initial + ds.displacement - rigid).transpose("time", "x", "y"), ds.gap, atol=1e-12
    )
    assert (ds.residual <= ds.attrs["tolerance"]).all()


def test_value_at_a_jump_is_the_one_just_after_it(ds: xr.Dataset) -> None:
    assert float(ds.force.sel(time=0.0)) == close_to(0.1)
    assert float(ds.force.sel(time=1.0)) == close_to(0.05)


def test_without_contact_everything_is_exactly_zero_and_the_march_continues(ds: xr.Dataset) -> None:
    apart = ds.sel(time=[2.0, 2.5, 3.0])
    assert (apart.outcome == vc.Outcome.NO_CONTACT).all()
    for name in (
        *("pressure", "force", "contact_area", "peak_pressure", "mean_pressure"),
        *("contact_length", "contact_width", "residual", "cells_across"),
    ):
        assert (apart[name] == 0.0).all(), name
    assert np.isnan(apart.eccentricity_x).all()
    assert np.isnan(apart.eccentricity_y).all()
    assert (apart.work == apart.work[0]).all()
    again = ds.sel(time=[3.1, 3.5, 4.0, 5.0])
    assert (again.outcome == vc.Outcome.CONVERGED).all()
    assert (again.contact_area > 0).all()


def test_without_contact_the_body_just_touches_its_indentation(ds: xr.Dataset) -> None:
    apart = ds.sel(time=[2.0, 2.5, 3.0])
    np.testing.assert_allclose(apart.gap.min(("x", "y")), 0.0, atol=1e-18)
    # the dent heals, so the touching body rises
    assert (apart.approach > 0).all()
    assert (apart.approach.diff("time") < 0).all()


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_without_contact_free_tilts_keep_their_last_value() -> None:
    load = vc.ForceHistory([0, 1, 1, 2], [0.1, 0.1, 0, 0], eccentricity_x=1e-4)
    punch = vc.FlatPunch(half_length=1e-3, half_width=1e-3)
    ds = vc.simulate(punch, RUBBER, load, GRID, [0.0, 0.5, 0.999, 1.0, 2.0], fields="none")
    assert float(ds.tilt_x[0]) > 1e-4  # a force towards +x presses that end deeper
    # up to the jump at 1 s the tilt still creeps a little, and that is the value kept
    assert float(ds.tilt_x[3]) == close_to(float(ds.tilt_x[2]), rel=2e-3)
    assert float(ds.tilt_x[4]) == float(ds.tilt_x[3])
    assert (ds.outcome.values[3:] == vc.Outcome.NO_CONTACT).all()


def test_given_tilt_replaces_the_moment_equation() -> None:
    ds = vc.simulate(BALL, RUBBER, vc.step(0.1, tilt_x=1e-3), GRID, [0.0], fields="none")
    assert float(ds.tilt_x[0]) == 1e-3
    # a sphere rolls: it touches where its slope is the tilt's, x = R tilt
    assert float(ds.eccentricity_x[0]) == close_to(0.01 * 1e-3, rel=0.01)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_eccentric_force_has_its_moments_about_both_axes() -> None:
    punch = vc.FlatPunch(half_length=1e-3, half_width=1e-3)
    load = vc.step(0.1, eccentricity_x=1e-4, eccentricity_y=-5e-5)
    ds = vc.simulate(punch, RUBBER, load, GRID, [0.0], fields="none")
    assert float(ds.eccentricity_x[0]) == close_to(1e-4, rel=1e-5)
    assert float(ds.eccentricity_y[0]) == close_to(-5e-5, rel=1e-5)
    assert float(ds.tilt_x[0]) > 0 > float(ds.tilt_y[0])


def test_times_that_begin_later_see_the_whole_history(ds: xr.Dataset) -> None:
    late = vc.simulate(BALL, RUBBER, LOAD, GRID, [1.5, 2.5], fields="none")
    whole = ds.sel(time=[1.5, 2.5])
    # Other steps, so only as close as the steps' own error, up to 1e-3; without its past the
    # ball would stand a third higher at 1.5 s.
    np.testing.assert_allclose(late.approach, whole.approach, rtol=3e-3)


def test_kinks_are_stepped_and_not_added() -> None:
    load = vc.ForceHistory([0, 1, 2], [0.05, 0.1, 0.05])
    one, two = (vc.simulate(BALL, RUBBER, load, GRID, t) for t in ([2.0], [1.0, 2.0]))
    assert one.time.values.tolist() == [2.0]
    np.testing.assert_allclose(one.approach[-1], two.approach[-1], rtol=1e-12)


def test_load_is_zero_before_its_first_point_and_held_after_its_last() -> None:
    load = vc.ForceHistory([1.0, 2.0], [0.1, 0.1])
    ds = vc.simulate(BALL, RUBBER, load, GRID, [0.0, 0.5, 1.0, 2.0, 4.0], fields="none")
    assert ds.force.values[:2].tolist() == [0.0, 0.0]
    np.testing.assert_allclose(ds.force[2:], 0.1, rtol=1e-6)
    assert float(ds.approach[4]) > float(ds.approach[3])


def test_default_times_hold_the_kinks() -> None:
    ds = vc.simulate(BALL, RUBBER, vc.triangle(0.1, 0.3, 0.7), GRID, fields="none")
    assert {0.0, 0.3, 1.0} <= set(ds.time.values.tolist())


# --- fields, march, arguments -------------------------------------------------------------------


def test_fields_are_kept_at_all_instants_at_none_or_at_those_asked_for(ds: xr.Dataset) -> None:
    some = vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES, fields=[5.0, 0.0])
    assert some.field_time.values.tolist() == [0.0, 5.0]
    assert some.field_time.attrs["units"] == "s"
    for name in FIELDS:
        assert some[name].dims == ("field_time", *ds[name].dims[1:])
        np.testing.assert_array_equal(some[name], ds[name].sel(time=[0.0, 5.0]))
    by_array = vc.simulate(BALL, RUBBER, LOAD, GRID, np.array(TIMES), fields=np.array([0.0, 5.0]))
    np.testing.assert_array_equal(by_array.pressure, some.pressure)
    none = vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES, fields="none")
    assert set(none.data_vars) == {*SCALARS, *ERRORS}
    np.testing.assert_array_equal(none.approach, ds.approach)
    with pytest.raises(ValueError, match=r"fields: 700 ms is not among the run's times"):
        vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES, fields=[0.7])


def test_march_yields_the_dataset_state_by_state_and_reports_progress(ds: xr.Dataset) -> None:
    seen: list[tuple[float, int, int]] = []
    states = vc.march(
        *(BALL, RUBBER, LOAD, GRID, TIMES),
        progress=lambda state, done, total: seen.append((state.time, done, total)),
    )
    for k, state in enumerate(states):
        assert isinstance(state, vc.ContactState)
        assert state.time == TIMES[k]
        for name in (*SCALARS, *FIELDS):
            np.testing.assert_array_equal(getattr(state, name), ds[name][k], err_msg=name)
    assert seen == [(time, k + 1, len(TIMES)) for k, time in enumerate(TIMES)]


def test_march_refuses_bad_input_before_it_is_iterated() -> None:
    with pytest.raises(ValueError, match="indenter must be"):
        vc.march("ball", RUBBER, LOAD)


def test_indenter_of_the_same_material_doubles_the_compliance(ds: xr.Dataset) -> None:
    both = vc.simulate(
        *(BALL, RUBBER, vc.step(0.05), GRID, [0.0]), indenter_material=RUBBER, threads=2
    )
    # Hertz: a^3 ~ F J, so half the force on twice the compliance has the same contact
    np.testing.assert_allclose(both.contact_area[0], ds.contact_area[0], rtol=1e-6)


def test_tolerance_bounds_the_residual() -> None:
    for tolerance in (1e-3, 1e-9):
        ds = vc.simulate(BALL, RUBBER, vc.step(0.1), GRID, [0.0, 1.0], tolerance=tolerance)
        assert (ds.residual <= tolerance).all()
        np.testing.assert_allclose(ds.force, 0.1, rtol=tolerance)


# --- errors and warnings ------------------------------------------------------------------------


def test_contact_at_the_rim_is_a_domain_error_that_keeps_the_completed_steps() -> None:
    small = vc.Grid((32, 32), (1.35e-3, 1.35e-3))  # 1.1 mm at first, 1.4 mm in the end
    with pytest.raises(
        vc.DomainError, match=r"reaches the edge of the grid at t = .*grid\.size"
    ) as stop:
        vc.simulate(BALL, RUBBER, vc.step(0.1), small, vc.uniform_times(20.0, 20))
    partial = stop.value.partial
    assert 1 <= partial.sizes["time"] < 21
    _check_variables(partial)


def test_error_at_the_first_step_has_no_partial_result() -> None:
    tiny = vc.Grid((32, 32), (0.5e-3, 0.5e-3))
    with pytest.raises(vc.DomainError) as stop:
        vc.simulate(BALL, RUBBER, vc.step(0.1), tiny, [0.0])
    assert stop.value.partial is None


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_fewer_than_four_cells_across_the_largest_contact_is_a_domain_error() -> None:
    coarse = vc.Grid((16, 16), (10e-3, 10e-3))
    with pytest.raises(vc.DomainError, match="cells lie across") as stop:
        vc.simulate(BALL, RUBBER, vc.step(0.1), coarse, [0.0])
    assert stop.value.partial.sizes["time"] == 1


def test_small_contacts_passed_through_are_no_error() -> None:
    ds = vc.simulate(BALL, RUBBER, vc.triangle(0.1, 1.0), GRID, vc.uniform_times(2.0, 40))
    assert 0 < float(ds.cells_across[1:-1].min()) < 8
    assert ds.attrs["warnings"] == ""


def test_fewer_than_ten_cells_across_is_a_warning_kept_with_the_result() -> None:
    coarse = vc.Grid((12, 12), (2.4e-3, 2.4e-3))
    with pytest.warns(vc.AccuracyWarning, match="6 cells lie across the largest"):
        ds = vc.simulate(BALL, RUBBER, vc.step(0.1), coarse, [0.0, 1.0])
    assert len(ds.attrs["warnings"].splitlines()) == 1
    assert "6 cells lie across" in ds.attrs["warnings"]


WIDE = (vc.Sphere(5e-4), RUBBER, vc.step(0.1), vc.Grid((32, 32), (9e-4, 9e-4)), [0.0])
PUNCH = (vc.FlatPunch(8e-4), RUBBER, vc.step(0.1), GRID, [0.0])
SOFTENING = vc.Material(vc.Zener(1e6, 2e5, 2e5), 0.5)  # creeps by five times its instant compliance
UNLOADED = vc.ForceHistory([0, 40], [0.1, 0.02])
HURRIED = (BALL, SOFTENING, UNLOADED, vc.Grid((48, 48), (3e-3, 3e-3)), [0.0, 20.0, 40.0])


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (WIDE, "slope within the contact"),
        (WIDE, "half width is"),
        (WIDE, "the approach is"),
        (PUNCH, "the end of the indenter's profile"),
        (HURRIED, "a time step of 20 s is long against the law"),
    ],
)
def test_theory_beyond_its_limits_and_long_steps_give_warnings(arguments: Any, said: str) -> None:
    with pytest.warns(vc.AccuracyWarning) as warned:
        ds = vc.simulate(*arguments)
    assert any(said in str(each.message) for each in warned)
    assert said in ds.attrs["warnings"]
    assert len(ds.attrs["warnings"].splitlines()) == len(warned)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_law_without_instant_compliance_is_accepted_and_refused_only_where_the_load_jumps() -> None:
    kelvin = vc.CreepSeries(0.0, [1e-6], [1.0])
    assert kelvin(0.0) == 0.0
    body = vc.Material(kelvin, 0.5)
    with pytest.raises(ValueError, match=r"jumps at t = 0 s.*use a ramp.*instant compliance"):
        vc.simulate(BALL, body, vc.step(0.1), GRID, [0.0, 1.0])
    ramped = vc.simulate(BALL, body, vc.ramp(0.1, 1.0), GRID, vc.uniform_times(2.0, 20))
    assert float(ramped.approach[-1]) > 0


@pytest.mark.parametrize(
    ("shape", "size", "said"),
    [
        (64, (1, 1), "grid.shape needs two entries, along x and y, got 64"),
        ((64, 64, 64), (1, 1), "grid.shape needs two entries"),
        ((64, 64), 1.0, "grid.size needs two entries, along x and y, got 1.0"),
        *(
            ((64, count), (1, 1), "ny must be a whole number >= 4")
            for count in (3, 64.5, math.nan, math.inf, "64", None, True, [64], 10**400)
        ),
        *(
            ((64, 64), (1, extent), "ly must be a positive finite number")
            for extent in (0, -1, math.nan, math.inf, "1", None, True, [1], 10**400)
        ),
    ],
)
def test_bad_grid_is_refused_with_what_was_got(shape: Any, size: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        vc.Grid(shape, size)


@pytest.mark.parametrize(
    ("centre", "said"),
    [
        (1.0, "grid.centre needs two entries, along x and y, got 1.0"),
        ((0.0, math.nan), "grid.centre: y must be a finite number in m, got nan"),
        (("1", 0.0), "grid.centre: x must be a finite number in m, got '1'"),
    ],
)
def test_bad_centre_of_a_grid_is_refused_with_what_was_got(centre: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        vc.Grid((64, 64), (1, 1), centre=centre)


def test_centre_of_a_grid_is_shown_and_recorded_only_if_given() -> None:
    plain, placed = GRID, vc.Grid((8, 4), (1.0, 2.0), centre=(-3, 4))
    assert "centre" not in describe(plain)
    assert "centre" not in f"{plain!r} {plain}"
    assert (plain.x == -plain.x[::-1]).all()
    assert eval(repr(placed), {"Grid": vc.Grid}) == rebuild(describe(placed)) == placed
    assert "-3 m, 4 m" in str(placed)
    assert placed.widened((12, 4)).x[2:-2] == close_to(placed.x, rel=1e-15)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"times": [1.0, 0.0]}, "times must be strictly increasing, got 1 s, then 0 s"),
        ({"times": [-1.0]}, "times must not be before 0"),
        ({"times": []}, "times must be one or more"),
        ({"times": [0.0, math.nan]}, "times must be one or more finite"),
        ({"times": [[0.0, 1.0]]}, "times must be one or more"),
        ({"times": [[0.0], [1.0, 2.0]]}, "times must be numbers in s"),
        ({"times": "soon"}, "times must be numbers in s, got 'soon'"),
        ({"times": [False, True]}, "times must be numbers in s"),
        ({"tolerance": -1e-6}, "tolerance must lie between"),
        ({"tolerance": math.nan}, "tolerance must lie between"),
        ({"threads": 0}, "threads must be a whole number >= 1, .* got 0"),
        ({"threads": 2**70}, "threads must be a whole number"),
        ({"fields": ["all"]}, "fields must be numbers in s, got 'all' at"),
        ({"fields": None}, "fields must be numbers in s, got None"),
        ({"load": vc.step(1e300)}, "load.force: .* is beyond what can be computed with"),
        ({"grid": vc.Grid((8, 8), (1e-200, 1.0))}, "grid.size: .* is beyond what can be"),
        ({"material": vc.Material(vc.Elastic(1e-200), 0.5)}, "material: .* is beyond what"),
        ({"fields": "some"}, "fields must be 'all', 'none' or instants"),
        ({"grid": (32, 32)}, "grid must be of kind Grid"),
        ({"load": 0.1}, "load must be of kind LoadHistory, got 0.1; write vc.step"),
        (
            {"material": vc.Elastic(1.0)},
            r"kind Material or Layered or Body, .*; write vc.Material",
        ),
        (
            {"material": "pmma-paper"},
            r"kind Material or Layered or Body, .*; write vc.shipped",
        ),
        ({"load": vc.step(0.1, eccentricity_x=0.02)}, "load.eccentricity_x: the force acts at"),
    ],
)
def test_bad_argument_is_refused_with_its_name_and_value(changed: Any, said: str) -> None:
    arguments = {"indenter": BALL, "material": RUBBER, "load": LOAD, "grid": GRID, "times": TIMES}
    with pytest.raises(ValueError, match=said.replace("(", r"\(")):
        vc.simulate(**{**arguments, **changed})


# --- files --------------------------------------------------------------------------------------


def test_saved_result_comes_back_the_same(ds: xr.Dataset, tmp_path: Path) -> None:
    vc.save(ds, tmp_path / "run.nc")
    with vc.open_results(tmp_path / "run.nc") as back:
        xr.testing.assert_identical(back.load(), ds)
        _check_variables(back)


def test_file_is_cf_netcdf_for_others_too(ds: xr.Dataset, tmp_path: Path) -> None:
    vc.save(ds, str(tmp_path / "run.nc"))
    with netCDF4.Dataset(tmp_path / "run.nc") as file:
        assert file.data_model == "NETCDF4"
        assert file.Conventions.startswith("CF-")
        assert file["pressure"].dimensions == ("time", "x", "y")
        assert file["contact_area"].units == "m2"
        assert file["time"].dtype == np.float64
        assert file["time"].units == "s"
        assert file["outcome"].flag_meanings == "converged no_contact not_converged pulled_off"
        np.testing.assert_array_equal(file["pressure"][:], ds.pressure)


def test_open_results_says_what_is_missing_or_wrong(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no result at"):
        vc.open_results(tmp_path)
    (tmp_path / "text.nc").write_text("not a result")
    with pytest.raises(ValueError, match="cannot be read"):
        vc.open_results(tmp_path / "text.nc")


# --- case files ---------------------------------------------------------------------------------

CASE: dict[str, Any] = {
    "title": "Ball",
    "indenter": {"shape": "sphere", "radius": "10 mm"},
    "material": {
        **{"law": "zener", "shear_modulus": "1 MPa", "delayed_modulus": "1 MPa"},
        **{"viscosity": "4 MPa s", "poisson_ratio": 0.5},
    },
    "load": {"kind": "step", "force": "100 mN"},
    "time": {"end": "1 s", "steps": 2},
    "grid": {"shape": [32, 32], "size": ["2.4 mm", "2.4 mm"]},
    "output": {"fields": "all"},
}


def _read(changes: dict[str, Any]) -> Any:
    """The case with sections replaced; JSON is YAML too."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.yaml"
        path.write_text(json.dumps({**CASE, **changes}), encoding="utf-8")
        (path.parent / "load.csv").write_text("time [ms], force [mN]\n0, 0\n1000, 100\n")
        return read_case(path)


@pytest.mark.parametrize(
    ("section", "given"),
    [
        ({"shape": "sphere", "radius": "10 mm"}, BALL),
        (
            {"shape": "paraboloid", "radius_x": "10 mm", "radius_y": "2 cm"},
            vc.Paraboloid(0.01, 0.02),
        ),
        ({"shape": "cone", "half_angle": "1.2 rad"}, vc.Cone(1.2)),
        ({"shape": "flat-punch", "radius": "1 mm"}, vc.FlatPunch(1e-3)),
        (
            {"shape": "flat-punch", "half_length": "1 mm", "half_width": "2 mm"},
            vc.FlatPunch(half_length=1e-3, half_width=2e-3),
        ),
        (
            {"shape": "roller", "radius": "5 mm", "half_length": "9 mm", "crown_radius": "75 mm"},
            vc.Roller(0.005, 0.009, 0.075),
        ),
        ({"shape": "roller", "radius": "5 mm", "half_length": "9 mm"}, vc.Roller(0.005, 0.009)),
        (
            [{"shape": "sphere", "radius": "10 mm"}, {"shape": "cone", "half_angle": "1.2 rad"}],
            BALL + vc.Cone(1.2),
        ),
    ],
)
def test_case_files_indenter(section: Any, given: Any) -> None:
    assert _read({"indenter": section}).indenter == given


MODULI = {"shear_modulus": "1 MPa"}
KELVIN = {"delayed_modulus": "2 MPa", "viscosity": "3 MPa s"}
TERMS: dict[str, Any] = {
    **{"instant": "1 / MPa", "amplitudes": ["2 / MPa"], "times": ["3 s"]},
    **{"fluidity": "1e-3 / (MPa s)"},
}
PRONY = {"equilibrium": "1 MPa", "moduli": ["2 MPa"], "times": ["3 s"]}
NUMBERS: Any = (1e-6, [2e-6], [3.0], 1e-9)


@pytest.mark.parametrize(
    ("section", "law"),
    [
        ({"law": "elastic", **MODULI}, vc.Elastic(1e6)),
        (
            {"law": "elastic", "youngs_modulus": "3 MPa", "data": "uniaxial"},
            vc.Elastic.from_uniaxial(3e6, poisson_ratio=0.4),
        ),
        ({"law": "maxwell", **MODULI, "viscosity": "3 MPa s"}, vc.Maxwell(1e6, 3e6)),
        ({"law": "zener", **MODULI, **KELVIN}, vc.Zener(1e6, 2e6, 3e6)),
        (
            {"law": "burgers", **MODULI, **KELVIN, "delayed_viscosity": "4 MPa s"},
            vc.Burgers(1e6, 3e6, 2e6, 4e6),
        ),
        ({"law": "creep-series", **TERMS, "data": "deviatoric"}, vc.CreepSeries(*NUMBERS)),
        ({"law": "creep-series", **TERMS, "data": "shear"}, vc.CreepSeries.from_shear(*NUMBERS)),
        (
            {"law": "creep-series", **TERMS, "data": "uniaxial"},
            vc.CreepSeries.from_uniaxial(*NUMBERS, poisson_ratio=0.4),
        ),
        (
            {"law": "relaxation-series", **PRONY, "data": "shear"},
            vc.RelaxationSeries(1e6, [2e6], [3.0]),
        ),
        (
            {"law": "relaxation-series", **PRONY, "data": "uniaxial"},
            vc.RelaxationSeries.from_uniaxial(1e6, [2e6], [3.0], poisson_ratio=0.4),
        ),
    ],
)
def test_case_files_material(section: dict[str, Any], law: Any) -> None:
    case = _read({"material": {**section, "poisson_ratio": 0.4}})
    np.testing.assert_allclose(case.material.law([0.0, 2.0]), law([0.0, 2.0]), rtol=1e-14)
    assert case.material.poisson_ratio == 0.4
    of_indenter = _read({"indenter_material": {**section, "poisson_ratio": 0.4}}).indenter_material
    assert of_indenter.law == case.material.law


def test_case_files_material_by_bulk_modulus_and_by_name() -> None:
    section = {"law": "elastic", **MODULI, "bulk_modulus": "4 GPa"}
    assert _read({"material": section}).material == vc.Material(vc.Elastic(1e6), bulk_modulus=4e9)
    for name in ("pmma-paper", "pmma-kumar-2004"):
        assert _read({"material": name}).material.poisson_ratio == 0.38


@pytest.mark.parametrize(
    ("section", "load"),
    [
        ({"kind": "step", "force": "1 kN"}, vc.step(1e3)),
        ({"kind": "ramp", "force": "1 kN", "duration": "2 min"}, vc.ramp(1e3, 120.0)),
        ({"kind": "triangle", "force": "1 N", "rise": "2 s"}, vc.triangle(1.0, 2.0)),
        (
            {"kind": "triangle", "force": "1 N", "rise": "2 s", "fall": "1 h"},
            vc.triangle(1.0, 2.0, 3600.0),
        ),
        (
            {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "100 mN"]]},
            vc.ForceHistory([0, 1], [0, 0.1]),
        ),
        ({"kind": "history", "file": "load.csv"}, vc.ForceHistory([0, 1], [0, 0.1])),
        (
            {
                "kind": "history",
                "sentences": "ramp to 10 kN in 1 s; hold for 240 s; unload in 0.1 s",
            },
            vc.ForceHistory([0, 1, 241, 241.1], [0, 1e4, 1e4, 0]),
        ),
        ({"kind": "step", "approach": "0.1 mm"}, vc.step(approach=1e-4)),
        (
            {"kind": "history", "points": [["0 s", "0 mm"], ["1 s", "0.1 mm"]]},
            vc.ApproachHistory([0, 1], [0, 1e-4]),
        ),
        (
            {"kind": "harmonic", "mean": "2 N", "amplitude": "1 N", "period": "3 s", "cycles": 4},
            vc.harmonic(2.0, 1.0, 3.0, 4),
        ),
        (
            {"kind": "step", "force": "1 N", "eccentricity_x": "-1 mm", "eccentricity_y": "2 mm"},
            vc.step(1.0, eccentricity_x=-1e-3, eccentricity_y=2e-3),
        ),
        (
            {"kind": "step", "force": "1 N", "tilt_x": "1 mrad", "tilt_y": "0 rad"},
            vc.step(1.0, tilt_x=1e-3, tilt_y=0.0),
        ),
    ],
)
def test_case_files_load(section: dict[str, Any], load: vc.LoadHistory) -> None:
    assert _read({"load": section}).load == load


@pytest.mark.parametrize(
    ("section", "times"),
    [
        ({"end": "4 s", "steps": 2}, vc.uniform_times(4.0, 2)),
        ({"end": "4 s", "steps": 2, "spacing": "uniform"}, vc.uniform_times(4.0, 2)),
        (
            {"end": "4 s", "steps": 3, "spacing": "log", "first": "10 ms"},
            vc.log_times(0.01, 4.0, 3),
        ),
    ],
)
def test_case_files_time(section: dict[str, Any], times: Any) -> None:
    np.testing.assert_array_equal(_read({"time": section}).times, times)


def test_case_files_adaptive_time() -> None:
    section = {"end": "4 s", "spacing": "adaptive", "tolerance": 1e-4}
    assert _read({"time": section}).times == vc.adaptive_times(4.0, tolerance=1e-4)


def test_case_files_title_grid_output_and_tolerance() -> None:
    case = _read({"output": {"fields": ["0 s", "1 s"]}, "tolerance": 1e-8})
    assert (case.title, case.grid, case.tolerance) == ("Ball", GRID, 1e-8)
    assert case.fields == (0.0, 1.0)
    assert _read({"output": {"fields": "none"}}).fields == "none"
    assert _read({"grid": None}).grid is None
    many = _read({"output": {}, "time": {"end": "1 s", "steps": 99}}).fields
    assert (len(many), many[0], many[-1]) == (10, 0.0, 1.0)


# --- command line -------------------------------------------------------------------------------

OPTIONS = {
    "run": ("--output", "-o", "--resume", "--overwrite", "--set", "--threads", "--quiet"),
    "check": ("CASE.yaml",),
    "show": ("DIR",),
    "export": ("DIR", "--output", "-o"),
    "plot": ("DIR", "FIGURE", "--time", "--output", "-o"),
    "compare": ("DIR", "--figure", "--output", "-o"),
    **{"schema": (), "demo": ()},
    "example": ("-o",),
    "run ...": (
        *("--vary", "--zip", "--table", "--sample", "--range", "--seed", "-j"),
        *("--scheduler", "--array", "--task"),
    ),
    "fit": (
        *("FILE.csv", "--case", "--change", "--contact-point", "--machine-stiffness", "--drive"),
        *("-j", "-o", "--yaml", "--resume"),
    ),
    "design": (
        *("--change", "--minimise", "--maximise", "--at", "--over", "--constraint"),
        *("--runs", "-j", "-o", "--resume"),
    ),
    "sensitivity": ("--of", "--change", "--at", "-j", "-o", "--resume"),
    "heat": (
        *("DIR", "--cooling", "--ambient", "--area", "--conductivity", "--core-temperature"),
        *("--heat-capacity", "--density"),
    ),
    "leakage": ("DIR", "--viscosity", "--pressure-difference", "--along", "-o"),
    **{"status": ("DIR", "--watch"), "collect": ("DIR", "-o")},
    # promised, not built yet
    **{"report": ("DIR", "-o"), "material": (), "verify": ("--fast", "-o")},
}
FIGURES = (
    *("pressure-map", "pressure-profile", "pressure-radial", "contact-outline"),
    *("history", "hysteresis", "creep", "line-load"),
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A working directory with a case in it."""
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(json.dumps(CASE), encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("command", OPTIONS)
def test_command_has_its_options(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command.split()[0], "--help"]) == 0
    said = capsys.readouterr().out
    for option in OPTIONS[command]:
        assert option in said


def test_run_directory_holds_the_result_and_the_case(folder: Path) -> None:
    assert main(["run", "ball.yaml", "--quiet", "--threads", "1"]) == 0
    held = sorted(path.name for path in Path("ball").iterdir())
    assert held == ["case.yaml", "progress.jsonl", "result.nc"]
    with netCDF4.Dataset("ball/result.nc") as file:
        assert file.dimensions["time"].isunlimited()
    with vc.open_results("ball") as ds, xr.open_dataset("ball/result.nc") as plain:
        _check_variables(ds, np.float32)
        xr.testing.assert_identical(ds, plain)
        again = vc.simulate(BALL, RUBBER, vc.step(0.1), GRID, vc.uniform_times(1.0, 2))
        np.testing.assert_array_equal(ds.pressure, again.pressure.astype(np.float32))
        assert ds.attrs["title"] == "Ball"
        assert {"version", "case", "wall_time", "tolerance", "warnings"} <= set(ds.attrs)


def test_every_command_works_on_a_directory_and_on_its_file(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "ball.yaml"]) == 0
    assert main(["run", "ball.yaml", "-q", "-o", "one"]) == 0
    assert main(["run", "ball.yaml", "-q", "-o", "two", "--set", "load.force=80mN"]) == 0
    for read in ("one", "one/result.nc"):
        assert main(["show", read]) == 0
        assert main(["export", read, "-o", "one.csv"]) == 0
    with Path("one.csv").open(encoding="utf-8") as lines:
        assert len(list(csv.DictReader(lines))) == 3
    assert main(["compare", "one", "two/result.nc", "--figure", "history", "-o", "both.png"]) == 0
    assert main(["schema"]) == 0
    assert main(["example", "sphere-zener", "-o", "example.yaml"]) == 0
    assert {path.name for path in folder.iterdir()} >= {"one.csv", "both.png", "example.yaml"}


def test_every_figure_is_drawn(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # No pixels are counted here.
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 30)
    assert main(["run", "ball.yaml", "-q"]) == 0
    for figure in FIGURES:
        assert main(["plot", "ball", figure, "-o", f"{figure}.png"]) == 0
        assert Path(f"{figure}.png").read_bytes().startswith(b"\x89PNG")


def test_exit_codes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # 2: refused before the first step, and nothing created
    assert main(["run", "ball.yaml", "--set", "load.force=10 MPa"]) == 2
    assert not Path("ball").exists()
    assert "load.force: cannot read '10 MPa' as a force" in capsys.readouterr().err
    # 1: stopped during the run, and the completed steps kept
    small = ["--set", "grid.size=[1.3 mm, 1.3 mm]", "--set", "time={end: 9 s, steps: 50}"]
    assert main(["run", "ball.yaml", "-q", *small]) == 1
    with vc.open_results("ball") as ds:
        assert 1 <= ds.sizes["time"] < 51
    # 2 again: a result is there, and both ways out are named
    capsys.readouterr()
    assert main(["run", "ball.yaml", "-q"]) == 2
    said = capsys.readouterr().err
    assert "--resume" in said
    assert "--overwrite" in said
    # 0: done, and finished already
    assert main(["run", "ball.yaml", "-q", "--overwrite"]) == 0
    assert main(["run", "ball.yaml", "--resume"]) == 0
    assert capsys.readouterr().err.count("\n") == 1


def test_sweep_has_a_manifest_and_a_dataset(folder: Path) -> None:
    varied = ["--vary", "load.force=80mN,0.1N", "-j", "1"]
    assert main(["run", "ball.yaml", "-q", *varied, "-o", "all"]) == 0
    lines = [json.loads(line) for line in Path("all/runs.jsonl").read_text().splitlines()]
    assert [line["run"] for line in lines] == [0, 1]
    assert set(lines[0]) >= {"run", "name", "directory", "settings"}
    assert all(Path("all", line["directory"], "result.nc").is_file() for line in lines)
    ds = vc.open_many("all")
    assert ds.approach.dims == ("load.force", "time")
    assert (ds["load.force"].values.tolist(), ds["load.force"].attrs["units"]) == ([0.08, 0.1], "N")
    assert main(["status", "all"]) == main(["collect", "all", "-o", "all.nc"]) == 0
    assert main(["report", "all"]) == 0


def test_functions_for_many_runs_have_their_arguments() -> None:
    names = {"executor", "client", "directory", "workers", "progress", "return_exceptions"}
    assert set(inspect.signature(vc.simulate_many).parameters) >= {"runs", *names}
    assert next(iter(inspect.signature(vc.open_many).parameters)) == "directory"
    case = {"load.force": ["1 N", "2 N"]}
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "ball.yaml").write_text(json.dumps(CASE), encoding="utf-8")
        assert len(list(vc.vary(Path(place) / "ball.yaml", case))) == 2
