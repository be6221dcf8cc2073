"""The largest stress below the largest pressure, against closed forms, with its error."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.results.peak_stress import peak_stress

# Coarse grids and small fields are what is asked for here.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

NU, MODULUS = 0.3, 80e9
STEEL = vc.Material(vc.Elastic(MODULUS), NU)
DEPTHS = np.linspace(0.01, 2.0, 20_001)  # in radii or half widths of the contact
FORCE, RADIUS = 100.0, 0.01
EFFECTIVE = 2 * MODULUS * (1 + NU) / (1 - NU**2)  # of a rigid indenter


def below_ball() -> tuple[float, float]:
    """Largest von Mises stress [Pa] and its depth [m] on the axis (Johnson 1985, eq. 3.45)."""
    a = (3 * FORCE * RADIUS / (4 * EFFECTIVE)) ** (1 / 3)
    peak = 3 * FORCE / (2 * np.pi * a**2)
    along_z = -1 / (1 + DEPTHS**2)
    radial = -(1 + NU) * (1 - DEPTHS * np.arctan(1 / DEPTHS)) - along_z / 2
    found = np.abs(along_z - radial)
    return peak * float(found.max()), a * float(DEPTHS[found.argmax()])


def below_cylinder(line_load: float) -> tuple[float, float]:
    """Likewise below a cylinder, in plane strain (Johnson 1985, eq. 4.46)."""
    b = np.sqrt(4 * line_load * RADIUS / (np.pi * EFFECTIVE))
    peak = 2 * line_load / (np.pi * b)
    root = np.sqrt(1 + DEPTHS**2)
    across = -((1 + 2 * DEPTHS**2) / root - 2 * DEPTHS)
    down = -1 / root
    along = NU * (across + down)
    squares = (across - down) ** 2 + (down - along) ** 2 + (along - across) ** 2
    found = np.sqrt(squares / 2)
    return peak * float(found.max()), b * float(DEPTHS[found.argmax()])


def ball(cells: int, **options: object) -> xr.Dataset:
    """A ball whose contact has a radius of 0.21 of the grid."""
    grid = vc.Grid((cells, cells), (0.6e-3, 0.6e-3))
    body, load = vc.Paraboloid(RADIUS, RADIUS), vc.step(FORCE)
    return vc.simulate(body, STEEL, load, grid, [0.0], **options)  # type: ignore[arg-type]


def test_stress_below_a_ball_is_the_closed_form_within_its_bar() -> None:
    exact, depth = below_ball()
    found = [peak_stress(ball(cells), "von_mises") for cells in (25, 50, 100)]
    errors = [abs(each.value - exact) for each in found]
    assert all(error <= each.error for error, each in zip(errors, found, strict=True))
    # Whether a cell lies at the centre changes from grid to grid: the bars fall, at first order.
    assert max(errors) < 2e-3 * exact
    assert found[2].error < found[0].error / 4 < 0.02 * exact
    assert found[2].depth == close_to(depth, rel=0.01)


def test_stress_in_layers_of_one_material_is_that_of_its_half_space() -> None:
    """It lies 0.13 mm deep: in the second layer, in the first one on a rigid base or below both."""
    exact, depth = below_ball()
    thin = [vc.Layer(2e-5, STEEL), vc.Layer(4e-5, STEEL)]
    for number, body in (
        (2, vc.Layered([vc.Layer(5e-5, STEEL), vc.Layer(5e-4, STEEL)], base=STEEL)),
        (1, vc.Layered([vc.Layer(1e-2, STEEL)], base="rigid")),
        (3, vc.Layered(thin, base=STEEL)),
    ):
        grid = vc.Grid((50, 50), (0.6e-3, 0.6e-3))
        ds = vc.simulate(vc.Paraboloid(RADIUS, RADIUS), body, vc.step(FORCE), grid, [0.0])
        found = peak_stress(ds, "von_mises")
        assert found.layer == number
        assert abs(found.value - exact) < found.error < 0.05 * exact
        assert found.depth == close_to(depth, rel=0.05)


def pulled(body: vc.Material | vc.Layered, part: float) -> xr.Dataset:
    """A ball that is pressed, then pulled by a part of what friction carries."""
    return vc.simulate(
        *(vc.Paraboloid(RADIUS, RADIUS), body, vc.step(FORCE)),
        *(vc.Grid((50, 50), (0.6e-3, 0.6e-3)), [0.0, 1.0]),
        friction=vc.Friction(0.3, coupling=False),
        tangential=vc.TangentialHistory([1.0], force_x=[0.3 * FORCE * part]),
    )


def test_stress_under_friction_is_that_of_the_pulled_contact() -> None:
    """The pressure is the same at both instants, and the stress is larger under the pull."""
    ds = pulled(STEEL, 0.9)
    found = peak_stress(ds, "von_mises")
    pressed, gripped = (peak_stress(ds.isel(time=[k]), "von_mises") for k in (0, 1))
    assert found.place == 1.0
    assert found.value == gripped.value > 1.02 * pressed.value
    assert found.plane == "x"


def test_stress_in_a_stiff_coating_is_the_largest_of_a_fine_section() -> None:
    """It jumps at the interface; at the surface or just above the base it is largest."""
    stiff = vc.Material(vc.Elastic(4 * MODULUS), NU)
    ds = pulled(vc.Layered([vc.Layer(4e-5, stiff)], base=STEEL), 0.9)
    found = peak_stress(ds, "von_mises")
    depths = np.concatenate([np.linspace(0, 4e-5, 41), np.linspace(4.0001e-5, 4e-4, 73)])
    inside = vc.section_stresses(ds, depths, y=float(ds.y[25])).von_mises
    assert found.layer == 1
    assert found.value == close_to(float(inside.max()), rel=2e-3)


def test_stress_below_a_cylinder_converges_to_the_closed_form_within_its_bar() -> None:
    exact, depth = below_cylinder(30.0 / 1e-3)
    found = []
    for cells in (48, 96, 192):
        grid = vc.Grid((1, cells), (1e-3, 0.4e-3), periodic=(True, False))
        ds = vc.simulate(vc.Paraboloid(np.inf, RADIUS), STEEL, vc.step(30.0), grid, [0.0])
        found.append(peak_stress(ds, "von_mises"))
    errors = [abs(each.value - exact) for each in found]
    assert all(error <= each.error for error, each in zip(errors, found, strict=True))
    # Of order 1.5, as the pressure at a rim: 2.8 in each step.
    assert errors[0] > 2.8 * errors[1] > 2.8**2 * errors[2]
    assert found[0].error > 2.8 * found[1].error > 2.8**2 * found[2].error
    assert found[2].error < 0.003 * exact
    assert found[2].depth == close_to(depth, rel=0.01)


def test_largest_shear_below_a_ball_is_half_of_the_von_mises_stress() -> None:
    # On the axis two principal stresses are equal.
    ds = ball(50)
    shear, mises = peak_stress(ds, "max_shear"), peak_stress(ds, "von_mises")
    assert shear.value == close_to(mises.value / 2, rel=2e-3)


def test_the_stress_is_that_of_the_instant_of_the_largest_pressure() -> None:
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)
    grid, load = vc.Grid((24, 24), (6e-3, 6e-3)), vc.triangle(1.0, 1.0)
    some = vc.simulate(
        vc.Sphere(0.01), rubber, load, grid, [0.5, 1.0, 1.5], fields=[0.5, 1.0], errors=False
    )
    assert peak_stress(some, "von_mises").place == 1.0
    with pytest.raises(ValueError, match=r"largest pressure is at t = 1 s, whose fields are not"):
        peak_stress(some.isel(field_time=[0]), "von_mises")


def test_without_errors_of_the_pressure_that_of_the_stress_is_unknown() -> None:
    assert np.isnan(peak_stress(ball(25, errors=False), "von_mises").error)


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"fields": "none"}, "no fields are stored"),
        ({"bulk": True}, "Poisson's ratio varies in time"),
    ],
)
def test_an_unknown_stress_is_refused_with_the_reason(change: dict[str, object], why: str) -> None:
    material = vc.Material(vc.Elastic(1e9), bulk_modulus=4e9) if "bulk" in change else STEEL
    size = 1.8e-3 if "bulk" in change else 0.6e-3
    grid = vc.Grid((24, 24), (size, size))
    fields = change.get("fields", "all")
    ds = vc.simulate(
        vc.Sphere(RADIUS), material, vc.step(FORCE), grid, [0.0], fields=fields, errors=False
    )
    with pytest.raises(ValueError, match=why):
        peak_stress(ds, "von_mises")


@pytest.mark.parametrize("plane", ["x", "y"])
def test_the_plane_is_that_of_the_larger_stress(plane: str) -> None:
    """Below a long contact whose pressure falls from one end, it is not below that end."""
    ds = ball(48, errors=False)
    pressure = np.zeros((48, 48))
    across = np.sqrt(1 - (np.arange(-6, 7) / 7.0) ** 2)
    pressure[8:40, 12:25] = 1e9 * np.outer(np.linspace(1.0, 0.97, 32), across)
    ds["pressure"][0] = pressure if plane == "x" else pressure.T
    assert peak_stress(ds, "von_mises").plane == plane


def test_below_a_ball_both_planes_are_equal() -> None:
    assert peak_stress(ball(48, errors=False), "von_mises").plane == ""
