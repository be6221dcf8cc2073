"""Curves of an active run: its whole range, few points, and the last value always."""

from __future__ import annotations

import numpy as np

from closeness import close_to
from viscontact.drawing.content.look import LIGHT
from viscontact.drawing.plotly.growing import growing
from viscontact.results.run_axis import SPEED, TIME


def test_long_curves_keep_their_last_value_and_few_points() -> None:
    times = np.linspace(0.0, 10.0, 5003)
    figure = growing("peak_pressure", times, 1e6 * times, TIME, (0.0, 20.0), LIGHT)
    (curve,) = figure.data
    assert curve.x.size <= 402
    assert (curve.x[0], curve.x[-1], curve.y[-1]) == (0.0, 10.0, 10.0)
    np.testing.assert_allclose(curve.y, curve.x, rtol=1e-6)
    assert list(figure.layout.xaxis.range) == [0.0, 20.0]
    assert figure.layout.meta["title"] == "Peak pressure [MPa]"


def test_time_is_logarithmic_where_steps_grow() -> None:
    times = [0.0, *np.geomspace(0.1, 10.0, 5)]
    figure = growing("approach", times, 6 * [1e-6], TIME, (0.0, 1000.0), LIGHT)
    assert figure.layout.xaxis.type == "log"
    assert list(figure.layout.xaxis.range) == close_to([-1.0, 3.0])


def test_speeds_are_drawn_in_their_order() -> None:
    values = [3e-6, 1e-6, np.nan]
    figure = growing("approach", [1.0, 0.01, 0.1], values, SPEED, (0.01, 1.0), LIGHT)
    np.testing.assert_allclose(figure.data[0].x, [0.01, 0.1, 1.0])
    np.testing.assert_allclose(figure.data[0].y, [1.0, np.nan, 3.0])
    assert list(figure.layout.xaxis.range) == [-2.0, 0.0]
