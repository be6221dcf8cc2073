"""Periodic grids: what is refused, what crosses the border, and what stays as it was."""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.contact.rim import trace_rim

RUBBER = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
PERIOD = vc.Grid((32, 32), (1e-3, 1e-3), periodic=True)
WAVES = vc.Waviness(1e-6, wavelength_x=1e-3, wavelength_y=1e-3)


def run(indenter=WAVES, load=None, grid=PERIOD, material=RUBBER):
    return vc.simulate(indenter, material, load or vc.step(4e-4), grid, [0.0], errors=False)


@pytest.mark.parametrize("given", [1, "yes", None])
def test_periodic_is_true_or_false(given):
    with pytest.raises(ValueError, match=r"grid\.periodic must be true or false, got"):
        vc.Grid((8, 8), (1.0, 1.0), periodic=given)


@pytest.mark.parametrize("name", ["eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y"])
def test_load_off_centre_or_tilted_is_refused(name):
    with pytest.raises(ValueError, match=rf"load\.{name}: must be 0 on a periodic grid"):
        run(load=vc.step(1e-4, **{name: 1e-6}))


def test_no_tilt_may_be_said_aloud():
    said, unsaid = run(load=vc.step(4e-4, tilt_x=0.0, tilt_y=0.0)), run()
    assert np.array_equal(said.pressure, unsaid.pressure)


@pytest.mark.parametrize(
    ("shape", "size"),
    [
        (WAVES, (1.3e-3, 1e-3)),
        (WAVES, (1e-3, 1.5e-3)),
        (WAVES.rotated(math.pi / 4), (1e-3, 1e-3)),
        (vc.Sphere(0.01) + WAVES, (1.3e-3, 1e-3)),
        (vc.Dimples(1e-6, 1e-4, 3e-4), (1e-3, 9e-4)),
    ],
)
def test_waves_that_do_not_fit_are_refused(shape, size):
    """At the border they would have a kink, or a step, that is not intended."""
    with pytest.raises(ValueError, match=r"grid\.size: the body does not repeat itself over"):
        run(shape, grid=vc.Grid((32, 32), size, periodic=True))


@pytest.mark.parametrize("turns", [1, 3])
def test_waves_that_fit_turned_are_taken(turns):
    turned = WAVES.rotated(turns * math.pi / 4)
    size = 1e-3 * (math.sqrt(2) if turns % 2 else 1)
    run(turned, grid=vc.Grid((48, 48), (size, size), periodic=True))


def _map(points, period):
    x = (np.arange(points) - (points - 1) / 2) * period / points
    return vc.HeightMap(x, x, WAVES.gap(x[:, None], x).max() - WAVES.gap(x[:, None], x))


@pytest.mark.filterwarnings("ignore:between:viscontact.AccuracyWarning")  # 32 points a wave
def test_map_of_the_waves_is_the_waves():
    """Each point of a map stands for a cell: so many cells as points, and it is the same body."""
    assert run(_map(32, 1e-3)).pressure.values == close_to(run().pressure.values, rel=1e-5)


@pytest.mark.parametrize(
    ("shape", "grid", "why"),
    [
        (_map(32, 0.9e-3), PERIOD, r"grid\.size: one period along x must be as long as the height"),
        (_map(64, 1.1e-3), PERIOD, r"grid\.size: one period along x must be as long as the height"),
        (_map(16, 1e-3), PERIOD, r"grid\.shape: the height map has 16 points along x"),
        (_map(32, 1e-3).shifted(x=1e-4), PERIOD, r"grid\.periodic: the height map is moved"),
    ],
)
def test_map_that_is_no_period_is_refused(shape, grid, why):
    with pytest.raises(ValueError, match=why):
        run(shape, grid=grid)


def test_approach_that_presses_everything_flat_is_refused():
    """The waves are 1 um deep in the mean: that approach determines no pressure."""
    with pytest.raises(ValueError, match=r"load\.approach: at 1 µm the surfaces .* everywhere"):
        run(load=vc.step(approach=1e-6))
    assert run(load=vc.step(approach=0.99e-6)).contact_area[0] < PERIOD.area


def test_periodic_half_space_is_not_mirrored():
    with pytest.raises(ValueError, match="not mirrored"):
        ContactDomain(PERIOD, mirrored=(False, True))


def test_support_of_a_period_does_not_tilt():
    assert ContactDomain(PERIOD).reduced_constraints(Constraints((3.0, 0.0, 0.0))) == Constraints(
        (3.0, None, None)
    )


@pytest.mark.parametrize("roll", [(0, 0), (5, -3), (16, 16), (13, 0)])
def test_rim_of_a_disc_does_not_mind_the_border(roll):
    """A disc of radius 6.3 cells, gaps as Hertz's beside it, wherever the border cuts it."""
    r = np.hypot(PERIOD.x[:, None], PERIOD.y[None, :]) / PERIOD.cell_size[0]
    gap = np.maximum(r - 6.3, 0.0) ** 1.5
    rolled = np.roll(gap, roll, axis=(0, 1))
    rim, still = (trace_rim(PERIOD, each == 0, each) for each in (rolled, gap))
    assert rim.area == close_to(still.area, rel=1e-12)
    assert rim.area == close_to(math.pi * (6.3 * PERIOD.cell_size[0]) ** 2, rel=1e-2)
    assert rim.length == close_to(still.length, rel=1e-12)
    assert rim.width == close_to(still.width, rel=1e-12)
    assert rim.cells_across == still.cells_across


@pytest.mark.parametrize("roll", [0, 15, 16, 30])
def test_rim_of_a_hole_does_not_mind_the_border(roll):
    """All in contact but one cell: half the square around its centre, and the curved rest."""
    gap = np.zeros((32, 32))
    gap[0, 3] = 1e-9
    gap = np.roll(gap, (roll, roll), axis=(0, 1))
    rim = trace_rim(PERIOD, gap == 0, gap)
    open_area = (0.5 + 4 * rim.extent.segment) * PERIOD.cell_area
    assert rim.area == close_to(PERIOD.area - open_area, rel=1e-12)
    assert (rim.length, rim.width) == PERIOD.size


def test_contact_may_cross_the_border():
    """Crests on the border, where a free grid is refused."""
    across = vc.Waviness(1e-6, wavelength_x=1e-3, wavelength_y=1e-3, phase_x=math.pi)
    there, here = run(across), run()
    assert there.contact_area.values == close_to(here.contact_area.values, rel=1e-6)
    assert (there.pressure[0, [0, -1]] > 0).any()
    assert "beyond" not in there.attrs["warnings"]


@pytest.mark.filterwarnings("ignore:between:viscontact.AccuracyWarning")
def test_step_at_the_border_causes_a_warning():
    """A measured map that does not continue at its border has a step there."""
    x = (np.arange(32) - 15.5) / 32 * 1e-3
    ramp = vc.HeightMap(x, x, np.tile(2e-6 * x[:, None] / 1e-3, 32))
    with pytest.warns(
        vc.AccuracyWarning, match="border of the period, where the body does not continue"
    ):
        run(ramp, vc.step(1e-2))


def test_stresses_of_a_periodic_result_are_periodic():
    """The mean of σzz over a period is the mean pressure at every depth; a free grid's falls."""
    found = vc.section_stresses(run(vc.Waviness(1e-6, wavelength_x=1e-3), vc.step(3e-3)), y=0.0)
    mean = 3e-3 / PERIOD.area
    assert found.stress_zz.mean("x").values == close_to(-mean, rel=1e-6)
