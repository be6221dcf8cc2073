"""Runs of a calibration on the cells of the search and of the case."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from tests.studies.calibration.experiments import BALL, triangle, written

import viscontact as vc
from viscontact.studies.calibration.response import Experiment, Mounting, RecordRun


def test_runs_on_the_cells_of_the_case_have_steps_half_as_long(tmp_path: Path) -> None:
    times, force = triangle(4.0, 9)
    finer = np.linspace(0.0, 4.0, 17)
    records = [
        vc.ContactRecord(times, force),
        vc.ContactRecord(finer, np.interp(finer, times, force)),
    ]
    cells = vc.Grid((24, 24), (3.2e-3, 3.2e-3))
    path = written(tmp_path, BALL)
    test = Experiment(path, {}, records[0], "force", "force", cells, cells, may_grow=False)
    found = RecordRun(test, {}, Mounting(), "case")().values["approach"]
    through_rows = RecordRun(test, {}, Mounting(), "coarse")().values["approach"]
    rows = RecordRun(replace(test, record=records[1]), {}, Mounting(), "coarse")
    other = rows().values["approach"]
    # Within the tolerance of the solver; steps through the rows differ by 1 %.
    np.testing.assert_allclose(found, other[::2], rtol=1e-6)
    assert np.abs(np.array(found) - through_rows).max() > 5e-3 * max(found)
