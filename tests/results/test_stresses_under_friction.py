"""Stresses below contacts under friction, in a whole run."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact import plot
from viscontact.results.peak_stress import peak_stress

MU, NU = 0.3, 0.3
STEEL = vc.Material(vc.Elastic(80e9), NU)

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def sliding_ball(cells: int, shape: vc.Indenter | None = None) -> xr.Dataset:
    """A ball under force, moved along x after a second until all of it slides."""
    return vc.simulate(
        shape or vc.Sphere(0.01),
        STEEL,
        vc.step(100.0),
        vc.Grid((cells, cells), (0.5e-3, 0.5e-3)),
        [0.0, 1.0],
        friction=vc.Friction(MU, coupling=False),
        tangential=vc.TangentialHistory([1.0], displacement_x=[10e-6]),
        errors=False,
    )


@pytest.fixture(scope="module")
def sliding() -> xr.Dataset:
    return sliding_ball(49)


def at_surface(ds: xr.Dataset, name: str) -> xr.DataArray:
    return vc.section_stresses(ds, [0.0], y=0.0, times=[1.0])[name][0, 0]


def test_tractions_of_a_sliding_ball_stretch_the_surface_behind_its_middle() -> None:
    """G. M. Hamilton, Proc. Inst. Mech. Eng. 197C (1983) 53: within the contact at the surface

    σxx = -(4 + ν) π q_0 x/(8 a) by the tractions alone; the error falls with the cells.
    """
    errors = []
    for cells in (25, 49, 97):
        ds = sliding_ball(cells)
        assert float(ds.slip_fraction[1]) == 1.0
        alone = ds.drop_vars(["traction_x", "traction_y"])
        sheared = at_surface(ds, "stress_xx") - at_surface(alone, "stress_xx")
        half, peak = float(ds.contact_length[1]) / 2, float(ds.peak_pressure[1])
        x = np.array([-0.7, -0.4, 0.5]) * half
        exact = -(4 + NU) * np.pi * MU * peak * x / (8 * half)
        errors.append(float(np.abs(sheared.interp(x=x).values / exact - 1).max()))
    assert errors[2] < errors[0] / 3
    assert errors[2] < 0.015


def test_tractions_bend_the_stresses_of_a_ball(sliding: xr.Dataset) -> None:
    """The same run without them: symmetric about the axis; with them, σxz at the surface is -q."""
    alone = sliding.drop_vars(["traction_x", "traction_y"])
    sheared, pressed = (
        vc.section_stresses(each, [1e-9], y=0.0, times=[1.0]) for each in (sliding, alone)
    )
    row = sliding.traction_x.sel(time=1.0).isel(y=24).values
    assert sheared.stress_xz.values[0, 0] == close_to(-row, abs=1e-3 * np.abs(row).max())
    largest = float(np.abs(pressed.stress_zz).max())
    assert sheared.stress_zz.values == close_to(pressed.stress_zz.values, abs=1e-6 * largest)
    ahead = pressed.stress_xx.values[0, 0]
    assert ahead == close_to(ahead[::-1], abs=1e-6 * np.abs(ahead).max())


def test_the_other_body_is_sheared_in_the_opposite_direction(sliding: xr.Dataset) -> None:
    """Equal bodies: what one has at x, the other has at -x."""
    ds = vc.simulate(
        vc.Sphere(0.01),
        STEEL,
        vc.step(100.0),
        vc.Grid((25, 25), (0.5e-3, 0.5e-3)),
        [0.0, 1.0],
        indenter_material=STEEL,
        friction=MU,
        tangential=vc.TangentialHistory([1.0], force_x=[10.0]),
        errors=False,
    )
    depths = [0.0, 5e-5]
    one, other = (
        vc.section_stresses(ds, depths, y=0.0, times=[1.0], body=body).von_mises.values
        for body in ("material", "indenter_material")
    )
    assert other == close_to(one[..., ::-1], rel=1e-6)
    assert np.abs(one - one[..., ::-1]).max() > 0.1 * one.max()


def test_planes_along_both_axes_meet_in_the_same_stresses(sliding: xr.Dataset) -> None:
    along, across = (
        vc.section_stresses(sliding, [4e-5], **place, times=[1.0])
        for place in ({"y": 0.0}, {"x": 0.0})
    )
    for name in ("stress_xx", "stress_yy", "stress_zz", "stress_xz", "von_mises"):
        one, other = float(along[name].sel(x=0.0)[0, 0]), float(across[name].sel(y=0.0)[0, 0])
        assert one == close_to(other, rel=1e-9)


def test_largest_stress_of_a_sliding_ball_is_at_the_surface(sliding: xr.Dataset) -> None:
    """Johnson (1985), section 7.1: above μ = 0.3 yield begins at the surface, below beneath it."""
    found = peak_stress(sliding.isel(time=[1]), "von_mises")
    alone = peak_stress(sliding.drop_vars(["traction_x", "traction_y"]), "von_mises")
    assert found.value > alone.value
    assert found.depth < alone.depth
    assert found.plane == "x"


def test_section_of_a_round_contact_runs_along_the_friction(sliding: xr.Dataset) -> None:
    """At both instants, also before there is any; without friction along y."""
    figure = plot.stress_section(sliding)
    assert [axes.get_xlabel() for axes in figure.axes[:2]][-1].startswith("x")
    assert all("y =" in axes.get_title(loc="left") for axes in figure.axes[:2])
    alone = plot.stress_section(sliding.drop_vars(["traction_x", "traction_y"]))
    assert "x =" in alone.axes[0].get_title(loc="left")
