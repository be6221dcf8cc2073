"""Figures of a fit to a force curve show measured rows, fitted law and contact point."""

from __future__ import annotations

import numpy as np

import viscontact as vc
from closeness import close_to
from viscontact.drawing.content.look import LIGHT
from viscontact.drawing.plotly.indentation_fits import (
    contact_point,
    fit_over_time,
    force_over_approach,
)

# Hertz: F = 4/3 E* sqrt(R) d^1.5, on a cantilever whose base has moved by d + F/k since contact.
MODULUS, RADIUS, STIFFNESS, AT = 20e3, 5e-6, 0.1, 3e-6
DEPTH = np.linspace(0.0, 1e-6, 200)
BENDING = 4 / 3 * MODULUS * np.sqrt(RADIUS) * DEPTH**1.5 / STIFFNESS


def measured() -> vc.ForceCurve:
    position = np.append(np.linspace(0, 2.99e-6, 300), AT + DEPTH + BENDING)
    deflection = np.append(np.zeros(300), BENDING) + 0.003 * position + 2e-8
    return vc.ForceCurve(position / 4e-6, position, deflection, spring_constant=STIFFNESS)


def test_contact_point_is_marked_on_the_curve_of_an_elastic_body() -> None:
    found = vc.find_contact(measured(), vc.Sphere(RADIUS))
    figure = contact_point(found)
    assert figure.layout.xaxis.title.text == "Position [µm]"
    assert figure.layout.meta["title"] == "Deflection [nm]"
    (mark,) = figure.layout.shapes
    assert mark.x0 == mark.x1 == close_to(3.0, abs=1e-3)
    points, body, baseline = figure.data
    np.testing.assert_allclose(points.y, 1e9 * found.curve.deflection, rtol=1e-6)
    np.testing.assert_allclose(baseline.y, 20 + 3 * np.asarray(baseline.x), rtol=1e-3)
    exact = np.interp(np.asarray(body.x), 1e6 * (AT + DEPTH + BENDING), 1e9 * BENDING, left=0.0)
    np.testing.assert_allclose(np.asarray(body.y) - baseline.y, exact, atol=2e-4 * exact.max())


def test_fitted_law_is_drawn_over_approach_and_time_with_its_residuals() -> None:
    record = vc.find_contact(measured(), vc.Sphere(RADIUS)).record()
    fit = vc.fit_indentation(record, "elastic", poisson_ratio=0.5)
    points, law = force_over_approach(fit, LIGHT).data
    np.testing.assert_allclose(points.x, 1e6 * fit.record.approach, rtol=1e-6, atol=1e-9)
    depth = 1e-6 * np.maximum(law.x, 0.0)
    hertz = 1e9 * 4 / 3 * MODULUS * np.sqrt(RADIUS) * depth**1.5
    np.testing.assert_allclose(law.y, hertz, atol=3e-3 * hertz.max())
    figure = fit_over_time(fit)
    *_, residual = figure.data
    assert residual.yaxis == "y2"
    np.testing.assert_allclose(residual.y, 100 * fit.residuals, rtol=1e-5)
    assert figure.layout.yaxis2.domain[1] < figure.layout.yaxis.domain[0]
