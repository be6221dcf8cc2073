"""The package's pressures against those of the iteration that everybody knows."""

import numpy as np
import pytest

import viscontact as vc
from verification import polonsky_keer

# Both are converged to 1e-10. Measured difference over the cases, relative to the peak: 8e-10
# and less.
BOUND = 1e-8

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

rubber = vc.Material(vc.Elastic(1e6), 0.5)
rough = vc.HeightMap(
    np.linspace(-0.5, 0.5, 30),
    np.linspace(-0.5, 0.5, 30),
    1e-3 * np.random.default_rng(5).standard_normal((30, 30)),
)
ball_grid, roller_grid = vc.Grid((48, 48), (0.5, 0.5)), vc.Grid((64, 40), (6.0, 0.6))
map_grid, punch_grid = vc.Grid((40, 40), (1.2, 1.2)), vc.Grid((36, 33), (2.5, 2.5))

CENTRIC = {
    "sphere": (vc.Sphere(1.0), ball_grid, 1e3),
    "crowned roller": (vc.Roller(1.0, 2.0, 15.0), roller_grid, 2e4),
    "sharp roller": (vc.Roller(1.0, 2.0), roller_grid, 2e4),
    "round punch": (vc.FlatPunch(1.0), punch_grid, 1e4),
}
ECCENTRIC = {
    "crowned roller": (vc.Roller(1.0, 2.0, 15.0), roller_grid, 2e4, (1.5, 0.0)),
    "sharp roller": (vc.Roller(1.0, 2.0), roller_grid, 2e4, (0.4, 0.0)),
    "round punch": (vc.FlatPunch(1.0), punch_grid, 1e4, (0.2, -0.3)),
    "sphere": (vc.Sphere(1.0), ball_grid, 1e3, (0.02, 0.01)),
    "rough map": (rough, map_grid, 2e3, (0.05, 0.02)),
}


def assert_same_pressure(case, load, eccentricity, *, tilts):
    indenter, grid, force = case
    (state,) = vc.march(indenter, rubber, load, grid, [0.0], tolerance=1e-10)
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    compliance = rubber.contact_compliance()(0.0)
    published = polonsky_keer.solve(grid, open_gap, compliance, force, eccentricity, tilts=tilts)
    assert np.abs(state.pressure - published).max() < BOUND * published.max()


@pytest.mark.parametrize("name", CENTRIC)
def test_the_published_iteration_finds_the_same_pressure(name):
    load = vc.step(CENTRIC[name][-1], tilt_x=0.0, tilt_y=0.0)
    assert_same_pressure(CENTRIC[name], load, (0.0, 0.0), tilts=False)


@pytest.mark.parametrize("name", ECCENTRIC)
def test_with_moments_the_iteration_finds_the_same_pressure(name):
    *case, (x, y) = ECCENTRIC[name]
    load = vc.step(case[-1], eccentricity_x=x, eccentricity_y=y)
    assert_same_pressure(case, load, (x, y), tilts=True)
