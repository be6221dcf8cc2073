"""Scalars of a sensitivity study."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.studies.scalars import At
from viscontact.studies.sensitivity.outputs import OutputScalars, checked_outputs


def test_outputs_are_separated_by_commas() -> None:
    assert checked_outputs("peak_pressure, approach") == ("peak_pressure", "approach")


def test_a_run_ends_at_its_own_last_instant() -> None:
    over = ("run", "step")
    times = [[0.0, 1.0, 2.0], [0.0, 1.0, np.nan], [np.nan] * 3]
    tilts = [[1.0, -5.0, 2.0], [-3.0, 1.0, np.nan], [np.nan] * 3]
    joint = xr.Dataset({"tilt_x": (over, tilts)}, {"time": (over, times)})

    def values(at: At) -> list[float]:
        return OutputScalars(joint, at).values("tilt_x")[:2].tolist()

    assert values("end") == [2.0, 1.0]
    assert values("worst") == [5.0, 3.0]
    assert values(1.0) == [5.0, 1.0]
    assert np.isnan(OutputScalars(joint, "end").values("tilt_x")[2])
