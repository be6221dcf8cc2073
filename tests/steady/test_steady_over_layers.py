"""Steady motion over layers: forecast, warnings, stresses, and what is refused."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.steady_forecast import curve_memory, steady_forecast
from viscontact.simulation.steady_motion.preparation import SteadySetup, prepare
from viscontact.simulation.steady_motion.problem import steady_problem

RUBBER = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.45)
CORE = vc.Material(vc.Elastic(50e6), poisson_ratio=0.3)
THICKNESS = 5e-3
ON_RIGID = vc.Layered([vc.Layer(THICKNESS, RUBBER)], base="rigid")
ON_CORE = vc.Layered([vc.Layer(THICKNESS, RUBBER)], base=CORE)
CYLINDER, BALL = vc.Paraboloid(np.inf, 0.1), vc.Paraboloid(0.1, 0.1)
LINE = vc.Grid((1, 128), (1e-3, 60e-3), periodic=(True, False))
SQUARE = vc.Grid((32, 32), (18e-3, 18e-3))


def level(force: float) -> vc.ForceHistory:
    return vc.step(force, tilt_x=0.0, tilt_y=0.0)


def prepared(indenter, body, force: float, speed: float, grid: vc.Grid) -> SteadySetup:
    motion = SteadyMotion((speed,), "y")
    problem = Problem(indenter, body, level(force), grid, tolerance=1e-6, motion=motion)
    return prepare(steady_problem(problem, motion))


@pytest.mark.parametrize("body", [ON_RIGID, ON_CORE])
def test_the_forecast_of_a_line_contact_is_that_of_the_layer(body: vc.Layered) -> None:
    speed, force = 0.1, 20.0
    found = steady_forecast(prepared(CYLINDER, body, force, speed, LINE), errors=False)
    with pytest.warns(vc.AccuracyWarning):  # large strains, and the approach without a datum
        ds = vc.steady(CYLINDER, body, level(force), speed, grid=LINE, errors=False)
    # It is an estimate; on a half-space of the rubber it would be 30 mm wide.
    assert found.estimate.width == close_to(float(ds.contact_width[0]), rel=0.2)


def test_large_strains_of_the_cover_are_reported_and_forecast() -> None:
    for force, expected in ((5.0, False), (200.0, True)):
        run = prepared(BALL, ON_RIGID, force, 0.1, vc.Grid((32, 32), (40e-3, 40e-3)))
        assert ("cover" in steady_forecast(run, errors=False).warnings) == expected
    with pytest.warns(vc.AccuracyWarning, match="of the thickness of the layers, 5 mm"):
        vc.steady(BALL, ON_RIGID, level(200.0), 0.1, grid=run.grid, errors=False)


def test_memory_grows_with_the_terms() -> None:
    one, several = (prepared(BALL, body, 5.0, 0.1, SQUARE) for body in (ON_RIGID, ON_CORE))
    terms = len(several.problem.contact.surface.terms)
    assert terms > 1
    # Measured with 768 x 768 cells: 54 arrays on a half-space, 79 with five terms.
    assert curve_memory(several) - curve_memory(one) == 6 * (terms - 1) * 8 * 32 * 32


def test_stresses_of_layers_that_creep_alike_are_those_of_the_pressure() -> None:
    # Under a layer that creeps by one law on a rigid base the stresses are elastic.
    elastic = vc.Layered(
        [vc.Layer(THICKNESS, vc.Material(vc.Elastic(9e6), poisson_ratio=0.45))], base="rigid"
    )
    ds = vc.steady(BALL, ON_RIGID, level(20.0), 1.0, grid=SQUARE, errors=False)
    found = vc.interface_stresses(ds)
    rest = vc.simulate(BALL, elastic, level(20.0), SQUARE, [0.0], errors=False)
    wanted = vc.interface_stresses(
        rest.assign(pressure=rest.pressure.copy(data=ds.pressure.values))
    )
    for name in ("interface_normal_stress", "interface_shear_stress_y"):
        assert found[name].values == close_to(wanted[name].values, rel=1e-6, abs=1e-3), name


def test_stresses_of_layers_that_creep_differently_are_refused() -> None:
    ds = vc.steady(BALL, ON_CORE, level(20.0), 1.0, grid=SQUARE, errors=False)
    with pytest.raises(ValueError, match="not available in steady motion; move the body in time"):
        vc.section_stresses(ds)
