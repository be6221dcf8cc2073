"""Stresses of a result of layers: sections, interfaces, figures, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact import plot
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.stress import stress_on_plane, stress_on_section
from viscontact.mechanics.problem.stress_history import stress_history

GRID = vc.Grid((32, 32), (0.5e-3, 0.5e-3))
STIFF = vc.Material(vc.Elastic(160e9), poisson_ratio=0.25)
SOFT = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
#: The same stack, in its own units.
STACK = ElasticStack((ElasticLayer(60e-6, 2.0, 0.25),), ElasticBase(1.0, 0.3))


def pressed(
    body: vc.Layered | vc.Material, times: tuple[float, ...] = (0.0,), **how: object
) -> xr.Dataset:
    return vc.simulate(
        vc.Paraboloid(0.01, 0.01), body, vc.step(20.0), GRID, list(times), errors=False, **how
    )


@pytest.fixture(scope="module")
def coated() -> xr.Dataset:
    return pressed(vc.Layered([vc.Layer(60e-6, STIFF)], base=SOFT))


def test_a_section_shows_the_stresses_of_the_stack(coated: xr.Dataset) -> None:
    depths = [0.0, 30e-6, 60e-6, 100e-6]
    found = vc.section_stresses(coated, depths, x=2e-5)
    wanted = stress_on_section(
        coated.pressure.values[0], GRID, depths, LayeredStress(STACK), x=2e-5
    )
    assert found.von_mises.values[0] == close_to(wanted.von_mises, rel=1e-9)
    usual = vc.section_stresses(coated)
    z = usual.z.values
    assert (np.diff(z) > 0).all()
    # Both sides of the interface.
    assert (np.isclose(z, 60e-6, rtol=1e-8, atol=0)).sum() == 2
    jump = usual.stress_xx.sel(z=60e-6, method="pad") - usual.stress_xx.sel(
        z=60.001e-6, method="pad"
    )
    assert float(np.abs(jump).max()) > 0.1 * float(coated.peak_pressure[0])


def test_layers_of_one_material_give_the_stresses_of_a_half_space() -> None:
    half_space = pressed(SOFT)
    same = pressed(vc.Layered([vc.Layer(60e-6, SOFT), vc.Layer(30e-6, SOFT)], base=SOFT))
    depths = np.linspace(0, 2e-4, 5)
    peak = float(half_space.peak_pressure[0])
    for name in ("stress_xx", "stress_xz", "von_mises"):
        own, wanted = (vc.section_stresses(ds, depths)[name].values for ds in (same, half_space))
        assert own == close_to(wanted, abs=1e-5 * peak)


def test_interface_stresses_are_the_tractions_there(coated: xr.Dataset) -> None:
    found = vc.interface_stresses(coated)
    assert found.interface_normal_stress.dims == ("time", "interface", "x", "y")
    assert found.depth.values.tolist() == [60e-6]
    stress = stress_on_plane(coated.pressure.values[0], GRID, 60e-6, LayeredStress(STACK))
    assert found.interface_normal_stress.values[0, 0] == close_to(stress["zz"], rel=1e-9)
    shear = np.hypot(stress["xz"], stress["yz"])
    assert found.interface_shear_stress.values[0, 0] == close_to(shear, rel=1e-9)
    assert float(found.largest_interface_shear[0, 0]) == close_to(shear.max())
    assert stress["zz"].max() < 0
    assert float(found.largest_interface_tension[0, 0]) == 0
    assert float(found.largest_interface_compression[0, 0]) == close_to(-stress["zz"].min())
    for variable in (*found.data_vars.values(), found.depth):
        assert variable.attrs["units"] in ("Pa", "m")
        assert variable.attrs["long_name"]


def test_a_stiff_layer_pulls_at_its_soft_base_beside_the_contact() -> None:
    """As a plate on an elastic foundation rises beside its load (Hertz 1884)."""
    soft = vc.Material(vc.Elastic(8e9), poisson_ratio=0.3)
    ds = pressed(vc.Layered([vc.Layer(20e-6, STIFF)], base=soft))
    stack = ElasticStack((ElasticLayer(20e-6, 20.0, 0.25),), ElasticBase(1.0, 0.3))
    tension = stress_on_plane(ds.pressure.values[0], GRID, 20e-6, LayeredStress(stack))["zz"].max()
    assert tension > 5e5
    found = vc.interface_stresses(ds).largest_interface_tension
    assert float(found[0, 0]) == close_to(tension, rel=1e-6)


def test_a_creeping_cover_on_a_rigid_base_is_stressed_by_the_present_pressure() -> None:
    """By correspondence, as its Poisson's ratio is constant: S(q, z) holds no modulus."""
    polymer = vc.Material(vc.Zener(10e9, 10e9, 10e9), poisson_ratio=0.45)
    ds = pressed(vc.Layered([vc.Layer(100e-6, polymer)], base="rigid"), (0.0, 1.0, 4.0))
    body = LayeredStress(ElasticStack((ElasticLayer(100e-6, 1.0, 0.45),), None))
    found = vc.section_stresses(ds, [50e-6], times=[3.9])
    wanted = stress_on_section(ds.pressure.values[2], GRID, [50e-6], body)
    assert found.von_mises.values[0] == close_to(wanted.von_mises, rel=1e-9)
    usual = vc.section_stresses(ds)
    assert float(usual.z[-1]) == close_to(100e-6)  # no deeper
    with pytest.raises(ValueError, match="rigid base"):
        vc.section_stresses(ds, [150e-6])


def test_layers_that_creep_differently_need_the_pressure_of_all_instants() -> None:
    polymer = vc.Material(vc.Zener(4e9, 2e9, 4e9), poisson_ratio=0.4)
    body = vc.Layered([vc.Layer(60e-6, polymer)], base=vc.Material(vc.Elastic(8e9), 0.3))
    times = (0.0, 0.5, 1.0, 2.0, 4.0)
    ds = vc.simulate(vc.Paraboloid(0.01, 0.01), body, vc.step(2.0), GRID, list(times), errors=False)
    inside = vc.section_stresses(ds, [30e-6, 60e-6])
    assert 0 < inside.attrs["splitting_error"] < 1e-3
    history = stress_history(body)
    parts = history.loads(np.array(times), ds.pressure.values, np.zeros(0))
    for row in (0, 4):
        wanted = sum(
            stress_on_section(part[row], GRID, [30e-6, 60e-6], LayeredStress(stack)).components
            for part, stack in zip(parts, history.stacks, strict=True)
        )
        assert inside.stress_xx.values[row] == close_to(wanted[0], rel=1e-9, abs=1.0)
    at_interface = vc.interface_stresses(ds, times=[4.0])
    assert at_interface.attrs["splitting_error"] == inside.attrs["splitting_error"]
    assert at_interface.sizes["time"] == 1
    some = vc.simulate(
        vc.Paraboloid(0.01, 0.01),
        body,
        vc.step(2.0),
        GRID,
        list(times),
        fields=[1.0, 4.0],
        errors=False,
    )
    for compute in (vc.section_stresses, vc.interface_stresses, plot.stress_section):
        with pytest.raises(ValueError, match=r"history of the pressure.*all instants"):
            compute(some)


def test_a_rubber_cover_on_steel_is_stressed_by_the_present_pressure() -> None:
    """The ratio of the moduli is so small that its change by creep does not matter."""
    rubber = vc.Material(vc.Zener(2e6, 1e6, 1e6), poisson_ratio=0.45)
    body = vc.Layered([vc.Layer(60e-6, rubber)], base=SOFT)
    ds = vc.simulate(
        vc.Paraboloid(0.01, 0.01),
        body,
        vc.step(2e-3),
        GRID,
        vc.uniform_times(1.0, 20),
        fields=[1.0],
        errors=False,
    )
    inside = vc.section_stresses(ds, [60e-6])
    assert 0 < inside.attrs["splitting_error"] < 1e-4
    stack = ElasticStack((ElasticLayer(60e-6, 1e6, 0.45),), ElasticBase(80e9, 0.3))
    wanted = stress_on_section(ds.pressure.values[0], GRID, [60e-6], LayeredStress(stack))
    found = inside.stress_zz.values[0]
    assert found == close_to(wanted["zz"], abs=1e-4 * np.abs(wanted["zz"]).max())


def test_the_figure_draws_the_interfaces(coated: xr.Dataset) -> None:
    axes = plot.stress_section(coated).axes[0]
    levels = [line.get_ydata()[0] for line in axes.get_lines() if len(set(line.get_ydata())) == 1]
    assert any(level == close_to(60.0) for level in levels)  # µm
    below = plot.von_mises_history(coated).axes[1]
    assert len(below.get_lines()[0].get_ydata()) == 1


def test_a_covered_indenter_has_stresses_of_its_own() -> None:
    ds = pressed(SOFT, indenter_material=vc.Layered([vc.Layer(60e-6, STIFF)], base=SOFT))
    own = vc.section_stresses(ds, [30e-6], body="indenter_material")
    wanted = stress_on_section(ds.pressure.values[0], GRID, [30e-6], LayeredStress(STACK))
    assert own.von_mises.values[0] == close_to(wanted.von_mises, rel=1e-9)
    assert vc.interface_stresses(ds, body="indenter_material").sizes["interface"] == 1
    other = vc.section_stresses(ds, [30e-6]).von_mises.values[0]
    plain = stress_on_section(ds.pressure.values[0], GRID, [30e-6], 0.3).von_mises
    assert other == close_to(plain, rel=1e-9)


def test_what_has_no_stresses_is_refused_by_name(coated: xr.Dataset) -> None:
    with pytest.raises(ValueError, match="indenter of this result is rigid"):
        vc.section_stresses(coated, body="indenter_material")
    with pytest.raises(ValueError, match="leave it out"):
        vc.section_stresses(coated, poisson_ratio=0.3)
    with pytest.raises(ValueError, match="body must be"):
        vc.section_stresses(coated, body="ball")
    with pytest.raises(ValueError, match="no interfaces"):
        vc.interface_stresses(pressed(SOFT))
