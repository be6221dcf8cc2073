"""Line contacts on grids that are periodic along one axis, against exact solutions."""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.reference import hertz_line
from viscontact.verify.case import observed_order
from viscontact.verify.line_contact import CASES

from .pressing import ELASTIC, MODULUS

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RADIUS, WIDTH = 5e-3, 5e-5  # m
LINE_LOAD = math.pi * MODULUS * WIDTH**2 / (4 * RADIUS)
PERIOD = 1e-3
CYLINDER = vc.Paraboloid(math.inf, RADIUS)
CREEPING = vc.Material(vc.Zener(0.35 * MODULUS, 0.35 * MODULUS, 3.5 * MODULUS), poisson_ratio=0.3)


def strip(cells, shape=(1, 0), centre=0.0):
    """One period; `cells` over the half width of the elastic contact."""
    across = 2 * math.ceil(1.6 * cells) + shape[1]
    size = (PERIOD, across * WIDTH / cells)
    return vc.Grid((shape[0], across), size, periodic=(True, False), centre=(0.0, centre))


@pytest.mark.parametrize(
    ("case", "orders"),
    [
        pytest.param(case, order, marks=[] if number else pytest.mark.slow)
        for number, (case, order) in enumerate(zip(CASES, (2.0, 2.0, 1.0), strict=True))
    ],
)
def test_orders_of_the_verification_cases(case, orders):
    """Second order in half width and pressure; a strip's edges are singular."""
    levels = [case.compare(level) for level in case.levels[-3:]]
    assert all(len(level) == len(case.quantities) for level in levels)
    for errors in zip(*levels, strict=True):
        order = observed_order(case.levels[-3:], [each.error for each in errors])
        assert order == close_to(orders, abs=0.35)


def test_symmetric_and_unsymmetric_runs_agree():
    """Moved aside by a whole number of cells, both halves are computed."""
    times = [0.0, 1.0, 10.0]
    grid = strip(16.3)
    aside = 4 * grid.cell_size[1]
    load = LINE_LOAD * PERIOD
    one = vc.simulate(CYLINDER, CREEPING, vc.step(load), grid, times, tolerance=1e-9, errors=False)
    other = vc.simulate(
        CYLINDER.shifted(y=aside),
        CREEPING,
        vc.step(load, eccentricity_y=aside),
        strip(16.3, centre=aside),
        times,
        tolerance=1e-9,
        errors=False,
    )
    peak = float(one.peak_pressure.max())
    assert np.abs(one.pressure.values - other.pressure.values).max() < 1e-7 * peak
    assert np.abs(other.eccentricity_y.values - aside).max() < 1e-8 * WIDTH
    assert np.abs(other.tilt_y.values).max() < 1e-8


def test_a_tilted_cylinder_is_a_shifted_one():
    """The gap y²/(2R) - θ y has its apex at y = R θ; the force acts there."""
    grid, load = strip(20.3, shape=(1, 8)), LINE_LOAD * PERIOD
    aside = 2 * grid.cell_size[1]
    turned = vc.simulate(
        CYLINDER, ELASTIC, vc.step(load, tilt_y=aside / RADIUS), grid, [0.0], errors=False
    )
    pushed = vc.simulate(
        CYLINDER, ELASTIC, vc.step(load, eccentricity_y=aside), grid, [0.0], errors=False
    )
    assert float(turned.eccentricity_y[0]) == close_to(aside, rel=1e-3)
    assert float(pushed.tilt_y[0]) == close_to(aside / RADIUS, rel=1e-3)
    assert np.abs(turned.pressure - pushed.pressure).max() < 1e-3 * pushed.peak_pressure[0]


def test_cylinder_is_loaded_again_after_a_separation():
    """Without force no contact; a creeping body is pressed a second time."""
    load = vc.ForceHistory(
        [0.0, 1.0, 1.0, 2.0, 2.0], LINE_LOAD * PERIOD * np.array([1, 1, 0, 0, 1])
    )
    ds = vc.simulate(CYLINDER, CREEPING, load, strip(12.3), [0.0, 1.0, 1.5, 2.0], errors=False)
    assert ds.contact_width.values[1:3].tolist() == [0.0, 0.0]
    assert ds.contact_width.values[3] > ds.contact_width.values[0]
    assert np.isnan(ds.approach.values).all()


def test_many_periods_are_one():
    """A cylinder with waves along it: one wave or two of them in the period."""
    bumpy = CYLINDER + vc.Waviness(1e-7, wavelength_x=PERIOD / 2)
    found = []
    for waves in (1, 2):
        size = (waves * PERIOD / 2, 3.2 * WIDTH)
        grid = vc.Grid((12 * waves, 32), size, periodic=(True, False))
        load = vc.step(LINE_LOAD * size[0])
        ds = vc.simulate(bumpy, ELASTIC, load, grid, [0.0], tolerance=1e-9, errors=False)
        found.append(ds.pressure.values[0])
    assert np.ptp(found[0].max(axis=1)) > 0.1 * found[0].max()
    # A crest lies in the middle of either grid.
    twice = np.roll(np.tile(found[0], (2, 1)), 6, axis=0)
    assert np.abs(twice - found[1]).max() < 1e-7 * found[0].max()


def test_a_row_of_balls_is_one_of_many_rows_far_apart():
    """Rows far apart on a grid that is periodic along both axes; neighbours act as 1/distance³."""
    pitch, cells = 1.2e-4, 24
    ball, force = vc.Paraboloid(RADIUS, RADIUS), MODULUS * 8e-14 * 4 / 3 / RADIUS
    peaks = []
    for rows in (1, 2, 8):
        periodic = (True, rows > 1)
        grid = vc.Grid((cells, rows * cells), (pitch, rows * pitch), periodic=periodic)
        ds = vc.simulate(ball, ELASTIC, vc.step(force), grid, [0.0], tolerance=1e-8, errors=False)
        peaks.append(float(ds.peak_pressure[0]))
    assert peaks[2] == close_to(peaks[0], rel=3e-3)
    assert abs(peaks[1] - peaks[0]) > 2 * abs(peaks[2] - peaks[0])


@pytest.mark.slow
def test_error_bars_hold():
    """At most 5 of 100 errors are larger than their bars."""
    random = np.random.default_rng(7)
    exact = hertz_line(LINE_LOAD, RADIUS, MODULUS)
    missed = total = 0
    for _ in range(40):
        grid = random_strip(random)
        ds = vc.simulate(CYLINDER, ELASTIC, vc.step(LINE_LOAD * PERIOD), grid, [0.0])
        for name, truth in (
            ("contact_area", 2 * exact.half_width * PERIOD),
            ("contact_width", 2 * exact.half_width),
            ("peak_pressure", exact.peak_pressure),
            ("peak_line_load", LINE_LOAD),
        ):
            missed += abs(float(ds[name][0]) - truth) > float(ds[f"{name}_error"][0])
            total += 1
        assert np.isnan(ds.approach_error.values).all()
    assert missed <= 0.05 * total


@pytest.mark.slow
def test_error_bars_of_creeping_cylinders_hold():
    """Lee & Radok 1960: b² = 4 R q J(t)/π, or with ∫ J dq under a force that grows."""
    random, times = np.random.default_rng(11), np.linspace(0.0, 20.0, 21)
    compliance = np.asarray(CREEPING.contact_compliance()(np.linspace(0.0, 20.0, 2001)))
    means = np.cumsum((compliance[1:] + compliance[:-1]) / 2) / 2000 * 20.0
    missed = total = 0
    for load, effective in (
        (vc.step(LINE_LOAD * PERIOD), compliance[::100]),
        (vc.ramp(LINE_LOAD * PERIOD, 20.0), np.append(0.0, means)[::100] / 20.0),
    ):
        truth = 2 * np.sqrt(4 * RADIUS * LINE_LOAD * effective / math.pi)
        for _ in range(6):
            grid = random_strip(random)
            ds = vc.simulate(CYLINDER, CREEPING, load, grid, times, fields="none")
            late = times >= 5.0
            for name, scale in (("contact_width", 1.0), ("contact_area", PERIOD)):
                wrong = abs(ds[name].values - truth * scale) > ds[f"{name}_error"].values
                missed, total = missed + int(wrong[late].sum()), total + int(late.sum())
    assert missed <= 0.05 * total


def random_strip(random):
    """Cells of any size and place over the strip, one or several along it."""
    grid = strip(
        random.uniform(6.0, 40.0), (int(random.choice([1, 4, 6])), int(random.integers(0, 2)))
    )
    aside = random.uniform(-0.5, 0.5) * grid.cell_size[1]
    return vc.Grid(grid.shape, grid.size, periodic=(True, False), centre=(0.0, aside))
