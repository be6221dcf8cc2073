"""Figure of records that were fitted by runs of a case."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from viscontact.plot import fitted_records


def curves(records: int) -> xr.Dataset:
    """Records of creep whose fitted values are 1 % of the largest one too high; row 0 is out."""
    parts = []
    for number in range(1, records + 1):
        measured = number * 1e-6 * np.arange(6.0)
        fitted = measured + 0.01 * measured.max()
        fitted[0] = np.nan
        columns = {
            "record": np.full(6, number),
            "name": np.full(6, f"{number}.csv"),
            "quantity": np.full(6, "approach"),
            "units": np.full(6, "m"),
            "time": np.arange(6.0),
            "measured": measured,
            "fitted": fitted,
            "residual": (fitted - measured) / measured.max(),
        }
        parts.append(xr.Dataset({name: ("row", values) for name, values in columns.items()}))
    return xr.concat(parts, "row")


def test_values_and_residuals_are_drawn_in_their_units() -> None:
    above, below = fitted_records(curves(1)).axes
    dots, line = above.get_lines()
    np.testing.assert_allclose(np.asarray(dots.get_ydata()), np.arange(6.0))
    np.testing.assert_allclose(np.asarray(line.get_ydata()), np.arange(1.0, 6.0) + 0.05)
    np.testing.assert_allclose(np.asarray(below.get_lines()[0].get_ydata())[1:], 1.0)
    assert below.get_xlabel() == "Time [s]"
    assert above.get_ylabel() == "Approach [µm]"


@pytest.mark.parametrize(("records", "shown"), [(2, 4), (3, 6), (5, 10)])
def test_each_record_has_two_panels(records: int, shown: int) -> None:
    figure = fitted_records(curves(records))
    visible = [axes for axes in figure.axes if axes.get_visible()]
    assert len(visible) == shown
    values = [axes.get_lines()[0].get_ydata() for axes in visible if len(axes.get_lines()) == 2]
    assert len(values) == 2 * records
