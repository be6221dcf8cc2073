"""Pressure profiles at the ends of a body."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.drawing.matplotlib.pressure.contact_curves import pressure_profile

POLYMER = vc.Material(vc.Elastic(1e9), poisson_ratio=0.4)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("cells", [40, 42, 50])
def test_pressure_falls_to_zero_at_the_end_of_the_body(along: str, cells: int) -> None:
    """Wherever the end lies among the cells; half length 4 mm, displaced by 0.3 mm."""
    body = vc.Roller(5e-3, 4e-3).shifted(x=3e-4)
    shape, size = (cells, 24), (10e-3, 0.8e-3)
    if along == "y":
        body = vc.Roller(5e-3, 4e-3).rotated(np.pi / 2).shifted(y=3e-4)
        shape, size = shape[::-1], size[::-1]
    load = vc.step(200.0, tilt_x=0.0, tilt_y=0.0)
    ds = vc.simulate(body, POLYMER, load, vc.Grid(shape, size), [0.0], errors=False)
    (line,) = pressure_profile(ds, along=along).axes[0].get_lines()
    x, pressure = line.get_data()
    assert (np.diff(x) >= 0).all()
    pressed = x[pressure > 0]
    assert [pressed.min(), pressed.max()] == close_to([-3.7, 4.3], abs=1e-6)  # mm
    for end in (-3.7, 4.3):
        assert 0.0 in pressure[np.isclose(x, end, atol=0)]


def test_profile_of_a_smooth_contact_is_that_of_the_cells() -> None:
    grid = vc.Grid((24, 24), (2e-3, 2e-3))
    ds = vc.simulate(vc.Sphere(0.01), POLYMER, vc.step(100.0), grid, [0.0], errors=False)
    (line,) = pressure_profile(ds).axes[0].get_lines()
    assert len(line.get_xdata()) == 24
