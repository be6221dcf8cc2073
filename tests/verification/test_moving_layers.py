"""Layers under a moving contact: energy, exchange of the bodies, and steady motion."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to

J0, J1, TIME = 1 / 1000, 9 / 1000, 10.0
RUBBER = vc.Material(vc.CreepSeries(J0, [J1], [TIME]), poisson_ratio=0.45)
CORE = vc.Material(vc.Elastic(5e3), poisson_ratio=0.3)
PLATE = vc.Material(vc.Elastic(2e3), poisson_ratio=0.4)
ON_RIGID = vc.Layered([vc.Layer(0.5, RUBBER)], base="rigid")
ON_CORE = vc.Layered([vc.Layer(0.5, RUBBER)], base=CORE)
BODY = vc.Paraboloid(10.0, 10.0)
LEVEL = vc.step(10.0, tilt_x=0.0, tilt_y=0.0)

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def travelled(material, mate=None):
    """Scalars of a ball that is moved from rest over 0.8 m, in steps of a cell."""
    grid = vc.Grid((28, 40), (2.24, 3.2), centre=(0.0, 0.4))
    path = vc.Travel([0.0, 8.0], y=[0.0, 0.8], rolling=True)
    return vc.simulate(
        *(BODY, material, LEVEL, grid),
        indenter_material=mate,
        motion=path,
        fields="none",
        errors=False,
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "body",
    [
        pytest.param(ON_RIGID, id="one term"),
        pytest.param(ON_CORE, id="several terms"),
    ],
)
def test_work_of_a_cycle_that_ends_unloaded_is_heat(body):
    load = vc.ForceHistory([0, 1, 16, 17, 400], [0, 10, 10, 0, 0], tilt_x=0.0, tilt_y=0.0)
    rises, cycle = np.linspace(0, 1, 6), np.linspace(1, 16, 41)
    falls, rest = np.linspace(16, 17, 13), 17 + np.geomspace(0.2, 383, 16)
    times = np.unique(np.concatenate([rises, cycle, falls, rest]))
    grid = vc.Grid((28, 40), (3.08, 4.4))
    path = vc.reciprocating(0.6, 15.0, cycles=1)
    ds = vc.simulate(BODY, body, load, grid, times, motion=path, fields="none", errors=False)
    work = float(ds.work[-1] + ds.motion_work[-1])
    assert float(ds.motion_work[-1]) > 0.3 * work
    # Measured: 2e-4.
    assert float(ds.heat[-1]) == close_to(work, rel=1e-3)
    assert float(ds.dissipation[-1]) < 1e-9


def test_a_term_in_two_equal_parts_loses_the_same_heat():
    """Two equal covers are one term; a law that differs by 1e-9 makes them two."""
    almost = vc.Material(vc.CreepSeries(J0, [J1 * (1 + 1e-9)], [TIME]), poisson_ratio=0.45)
    other = vc.Layered([vc.Layer(0.5, almost)], base="rigid")
    one, two = travelled(ON_RIGID, ON_RIGID), travelled(ON_RIGID, other)
    for name in ("heat", "dissipation", "motion_work", "approach"):
        assert two[name].values == close_to(one[name].values, rel=2e-6, abs=1e-9), name
    assert float(one.heat[-1]) > 0


@pytest.mark.parametrize(
    "layered",
    [
        pytest.param(ON_RIGID, id="one term", marks=pytest.mark.slow),
        pytest.param(ON_CORE, id="several terms"),
    ],
)
def test_a_covered_ball_rolls_on_a_plate_as_a_plain_one_does_on_the_covered_plate(layered):
    there, here = travelled(PLATE, layered), travelled(layered, PLATE)
    for name in ("friction_coefficient", "heat", "approach", "peak_pressure"):
        scale = float(abs(here[name]).max())
        assert there[name].values == close_to(here[name].values, abs=1e-5 * scale, nan_ok=True)
    assert float(here.friction_coefficient[-1]) > 0.01


def test_layers_that_creep_on_a_body_that_slides_are_refused():
    with pytest.raises(ValueError, match="body that slides keeps its own creep"):
        vc.simulate(
            *(BODY, PLATE, LEVEL),
            indenter_material=ON_RIGID,
            motion=vc.Travel([0.0, 8.0], y=[0.0, 0.8], rolling=False),
        )
