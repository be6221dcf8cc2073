"""Figures of steady motion: friction over speed with its limits, pressure with its edges."""

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.plot import friction, motion_profile, traction_creepage

BALL, LOAD = vc.Paraboloid(10.0, 10.0), vc.step(10.0, tilt_x=0.0, tilt_y=0.0)
RUBBER = vc.Material(vc.CreepSeries(1 / 1000, [9 / 1000], [10.0]), poisson_ratio=0.5)
SPEEDS = [1.0, 0.01, 100.0]


@pytest.fixture(scope="module")
def curve():
    return vc.steady(BALL, RUBBER, LOAD, SPEEDS, along="x", grid=vc.AutomaticGrid(tolerance=0.09))


def test_friction_is_drawn_over_speed_between_its_limits(curve):
    axes = friction(curve).axes[0]
    values, slow, fast = (line.get_xydata() for line in axes.lines)
    assert values[:, 0].tolist() == sorted(SPEEDS)
    order = np.argsort(SPEEDS)
    assert values[:, 1] == close_to(curve.friction_coefficient.values[order])
    # The limits: 0.9 V, and one over the speed, which the fastest contact has almost reached.
    assert slow[:, 1] == close_to(0.9 * slow[:, 0])
    assert fast[:, 1] * fast[:, 0] == close_to(fast[0, 1] * fast[0, 0])
    assert values[-1, 1] == close_to(fast[-1, 1], rel=0.02)
    assert values[0, 1] == close_to(slow[0, 1], rel=0.2)
    assert axes.get_xscale() == axes.get_yscale() == "log"


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_limits_are_drawn_only_where_they_hold():
    coarse = {"grid": vc.AutomaticGrid(tolerance=0.25), "errors": False, "fields": "none"}
    cone = vc.steady(vc.Cone(1.5), RUBBER, LOAD, 0.1, **coarse)
    assert len(friction(cone).axes[0].lines) == 1
    roller = vc.Roller(10.0, 1.0, crown_radius=10.0)
    crowned = vc.steady(roller, RUBBER, LOAD, 0.02, **coarse)
    assert len(friction(crowned).axes[0].lines) == 2
    steel = vc.Material(vc.Elastic(500.0), poisson_ratio=0.3)
    soft = vc.steady(BALL, steel, LOAD, 0.1, indenter_material=RUBBER, rolling=True, **coarse)
    assert len(friction(soft).axes[0].lines) == 1


def test_the_profile_marks_trailing_and_leading_edge(curve):
    axes = motion_profile(curve, speeds=[1.0]).axes[0]
    line, trailing, leading = axes.lines[:3]
    x, pressure = line.get_data()
    touched = x[np.flatnonzero(np.asarray(pressure) > 0)]
    cell = x[1] - x[0]
    assert float(trailing.get_xdata()[0]) == close_to(touched[0] - cell / 2)
    assert float(leading.get_xdata()[0]) == close_to(touched[-1] + cell / 2)
    assert trailing.get_markerfacecolor() == "white"
    assert leading.get_markerfacecolor() == leading.get_color()
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["1 m/s"]
    assert len(motion_profile(curve).axes[0].get_legend().get_texts()) == 3


def test_other_results_are_refused(curve):
    with pytest.raises(ValueError, match="steady motion"):
        friction(curve.rename(speed="time"))
    with pytest.raises(ValueError, match="with fields"):
        motion_profile(curve.drop_vars("pressure"))
    with pytest.raises(ValueError, match="positive"):
        friction(curve.assign(friction_coefficient=0 * curve.friction_coefficient))


def driven(cells: int, creepages: object, **given: float) -> xr.Dataset:
    """A long roller that drives, slow and fast."""
    return vc.steady(
        *(vc.Paraboloid(np.inf, 10.0), RUBBER, vc.step(1.0, tilt_y=0.0), [1e-4, 1e4]),
        grid=vc.Grid((1, cells), (1.0, 2.2), periodic=(True, False)),
        friction=0.3,
        creepage=creepages,
        errors=False,
        **given,
    )


@pytest.mark.filterwarnings("ignore:the grid is periodic:viscontact.AccuracyWarning")
def test_limits_of_carter_are_left_out_of_a_roller_that_is_askew():
    ds = driven(120, [0.001, 0.01], lateral_creepage=0.002)
    texts = [text.get_text() for text in traction_creepage(ds).axes[0].get_legend().get_texts()]
    assert texts == ["100 µm/s", "10 km/s"]


@pytest.mark.filterwarnings("ignore:the grid is periodic:viscontact.AccuracyWarning")
def test_traction_of_a_long_roller_lies_between_the_limits_of_carter():
    ds = driven(160, np.linspace(0.001, 0.01, 5))
    axes = traction_creepage(ds).axes[0]
    slow, fast, relaxed, instant = (line.get_xydata() for line in axes.lines)
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert texts == ["100 µm/s", "10 km/s", "Carter, slow motion", "Carter, fast motion"]
    assert slow[:, 0] == close_to(100 * ds.creepage.values)
    for found, exact in ((slow, relaxed), (fast, instant)):
        np.testing.assert_allclose(found[:, 1], np.interp(found[:, 0], *exact.T), atol=0.01)


def test_traction_over_creepage_needs_creepages(curve):
    with pytest.raises(ValueError, match=r"^traction-creepage: needs a result of steady motion"):
        traction_creepage(curve)
