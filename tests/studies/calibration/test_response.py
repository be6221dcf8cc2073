"""Runs of a calibration on the cells of the search and of the case."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from tests.studies.calibration.experiments import BALL, triangle, written

import viscontact as vc
from closeness import close_to
from viscontact.studies.calibration.residuals import Residuals
from viscontact.studies.calibration.response import Experiment, Mounting, RecordRun
from viscontact.studies.journal import Entry


def test_rows_before_a_jump_do_not_count_and_each_record_has_its_own_contact_point() -> None:
    cells = vc.Grid((24, 24), (3.2e-3, 3.2e-3))
    record = vc.ContactRecord(
        [0, 1, 1, 2, 3], [0.2, 0.2, 0.5, 0.5, 0.5], [1e-6, 2e-6, 3e-6, 4e-6, 5e-6]
    )
    one = Experiment(Path("ball.yaml"), {}, record, "force", "force", cells, cells, may_grow=False)
    values = {
        "contact_point[1]": "1 um",
        "contact_point[2]": "-2 um",
        "machine_stiffness": "1 N/um",
    }
    outcome = Entry({"force": record.force.tolist(), "approach": [1e-5] * 5})
    compared = Residuals([one], (), None)._compare_record
    for test, fitted in ((one, 11.5e-6), (replace(one, number=1), 8.5e-6)):
        found, counted = compared(RecordRun(test, {}, Mounting(), "case"), outcome, values)
        assert found[2:] == close_to(fitted, rel=1e-12)  # 10 um, the contact point, and 0.5 N
        assert counted.tolist() == [True, False, True, True, True]


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
