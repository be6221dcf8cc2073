"""Stresses of a result: labelled, with its own Poisson's ratio, drawn."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact import plot
from viscontact.mechanics.halfspace.stress import stress_on_section
from viscontact.results.recorded_case import recorded_grid

GRID = vc.Grid((40, 40), (2.6e-3, 2.6e-3))


def pressed(material: vc.Material, fields: str | list[float] = "all") -> xr.Dataset:
    return vc.simulate(
        vc.Paraboloid(0.01, 0.01), material, vc.step(0.1), GRID, [0.0, 0.3, 0.6, 1.0], fields=fields
    )


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return pressed(vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.3), [0.0, 1.0])


def test_stresses_are_those_of_each_instants_pressure(results: xr.Dataset) -> None:
    depths = np.linspace(0, 1e-3, 7)
    found = vc.section_stresses(results, depths, x=1e-4)
    assert found.von_mises.dims == ("time", "z", "y")
    assert found.time.values.tolist() == [0.0, 1.0]
    for index in range(2):
        exact = stress_on_section(results.pressure.values[index], GRID, depths, 0.3, x=1e-4)
        for name in ("xx", "yz"):
            ours = found[f"stress_{name}"].values[index]
            assert ours == close_to(exact[name], rel=1e-9, abs=1e-6)
        assert found.max_shear.values[index] == close_to(exact.max_shear, rel=1e-9)


def test_stresses_under_a_moved_ball_are_those_under_the_ball(results: xr.Dataset) -> None:
    place = (5e-3, -3e-3)
    moved = vc.simulate(
        vc.Paraboloid(0.01, 0.01).shifted(*place),
        vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.3),
        vc.step(0.1, tilt_x=0.0, tilt_y=0.0),
        vc.Grid(GRID.shape, GRID.size, centre=place),
        [0.0, 0.3, 0.6, 1.0],
        fields=[0.0, 1.0],
    )
    kept = recorded_grid(moved)
    assert kept.shape == GRID.shape
    assert (*kept.size, *kept.centre) == close_to((*GRID.size, *place), rel=1e-12)
    for where, there in (({}, {}), ({"x": 1e-4}, {"x": 1e-4 + place[0]})):
        own, found = (
            vc.section_stresses(ds, [1e-4, 3e-4], **at).von_mises.values
            for ds, at in ((results, where), (moved, there))
        )
        assert found == close_to(own, rel=1e-4)
    line = plot.pressure_profile(moved).axes[0].get_lines()[-1]
    peak = float(moved.peak_pressure[-1])  # in the middle of four cells
    assert 1e3 * np.nanmax(line.get_ydata()) == close_to(peak, rel=0.01)
    film = plot.animation(moved, seconds=1.0, fps=4.0).figure
    assert "at y = -3 mm" in [axes.get_title(loc="left") for axes in film.axes]


def test_creeping_ball_is_strained_most_as_hertzs_at_every_instant(results: xr.Dataset) -> None:
    # Johnson (1985), section 4.5: 0.620 p0 at 0.481 a for nu = 0.3, whatever p0 and a have become
    found = vc.section_stresses(results)
    scalars = results.sel(time=found.time)
    radius = np.sqrt(scalars.contact_area.values / np.pi)
    for index in range(2):
        stress = found.von_mises.values[index]
        assert stress.max() / scalars.peak_pressure.values[index] == close_to(0.62, rel=0.01)
        deepest = found.z.values[stress.max(axis=1).argmax()]
        assert deepest / radius[index] == close_to(0.48, abs=0.04)


def test_every_variable_has_unit_and_name(results: xr.Dataset) -> None:
    found = vc.section_stresses(results, [1e-4], times=[0.9])
    assert found.time.values.tolist() == [1.0]
    for variable in found.data_vars.values():
        assert variable.attrs["units"] == "Pa"
        assert variable.attrs["long_name"]
    assert found.z.attrs["units"] == "m"


def test_poisson_ratio_that_varies_is_refused_until_one_is_given() -> None:
    bulky = pressed(vc.Material(vc.Zener(1e6, 1e6, 1e6), bulk_modulus=1e9))
    with pytest.raises(ValueError, match="varies in time"):
        vc.section_stresses(bulky)
    assert vc.section_stresses(bulky, poisson_ratio=0.5).von_mises.max() > 0
    bulky.attrs.pop("case")
    with pytest.raises(ValueError, match="does not contain Poisson's ratio"):
        vc.section_stresses(bulky)


def test_result_without_fields_or_contact_is_refused() -> None:
    material = vc.Material(vc.Elastic(1e6), 0.3)
    with pytest.raises(ValueError, match="stresses need stored pressure"):
        vc.section_stresses(pressed(material, fields="none"))
    apart = vc.simulate(vc.Sphere(0.01), material, vc.step(0.0), GRID, [0.0])
    with pytest.raises(ValueError, match="no contact at any instant"):
        vc.section_stresses(apart)


def test_figures_show_the_largest_stress_and_its_depth(results: xr.Dataset) -> None:
    found = vc.section_stresses(results, np.linspace(0, 1e-3, 101))
    figure = plot.stress_section(results)
    headings = figure.axes[0].get_title(loc="left") + figure.axes[0].get_title(loc="right")
    largest = float(found.von_mises[0].max()) / 1e3
    said = float(headings.split("largest ")[1].split()[0])
    assert said == close_to(largest, rel=0.01)
    above, below = plot.von_mises_history(results).axes
    drawn = above.lines[0].get_ydata()
    assert drawn == close_to(found.von_mises.max(("z", "x")).values / 1e3, rel=0.01)
    assert below.lines[0].get_ydata()[0] < below.lines[0].get_ydata()[1]


@pytest.mark.filterwarnings("ignore:the grid is periodic along x only")
def test_stresses_of_a_cylinder_lie_across_it() -> None:
    """Largest in-plane shear 0.300 p0 at 0.786 half widths: Johnson 1985, section 4.2."""
    grid = vc.Grid((1, 96), (1e-3, 2.6e-3), periodic=(True, False))
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    ds = vc.simulate(vc.Paraboloid(np.inf, 0.01), rubber, vc.step(0.25), grid, [0.0], errors=False)
    half_width, peak = float(ds.contact_width[0]) / 2, float(ds.peak_pressure[0])
    found = vc.section_stresses(ds)
    assert found.von_mises.dims == ("time", "z", "y")
    assert float(found.z[-1]) == close_to(2 * half_width)
    in_plane = np.hypot((found.stress_yy - found.stress_zz) / 2, found.stress_yz)[0]
    assert float(in_plane.max()) == close_to(0.300 * peak, rel=2e-3)
    place = in_plane.argmax(("z", "y"))
    assert float(in_plane.z[place["z"]]) == close_to(0.786 * half_width, abs=0.03 * half_width)
    axes = plot.stress_section(ds).axes[0]
    assert axes.get_xlabel() == "y [mm]"
    assert axes.get_ylim()[0] == close_to(2e3 * half_width, rel=0.05)
    # von Mises stress for ν = 0.5, √3 times the in-plane shear
    assert f"largest {3**0.5 * float(in_plane.max()) / 1e3:.3g}" in axes.get_title(loc="left")
    assert "x =" not in axes.get_title(loc="left")  # it is the same everywhere along x


def test_stresses_across_a_period_are_those_through_its_middle(results: xr.Dataset) -> None:
    """A period that is elsewhere is under the same stresses there."""
    case = results.attrs["case"].replace('"periodic": false', '"periodic": [true, false]')
    here = results.assign_attrs(case=case)
    there = here.assign_coords(x=here.x + 7e-3)
    found = [vc.section_stresses(each, [2e-4], times=[1.0]).von_mises for each in (here, there)]
    assert found[0].dims == ("time", "z", "y")
    np.testing.assert_allclose(found[1], found[0], rtol=1e-9)
