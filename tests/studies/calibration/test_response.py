"""Runs of a calibration on the cells of the search and of the case."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.studies.calibration.experiments import BALL, triangle, written

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.studies.calibration.preparation import experiment_of
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


#: A body that grows under a ball to which it sticks, pushed along a little.
DISSIMILAR = """
indenter: {shape: sphere, radius: 5 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.2}
friction: {coefficient: 5}
tangential: {kind: ramp, force_x: 10 mN, duration: 4 s}
load: {kind: step, force: 0.5 N}
time: {end: 4 s, steps: 4}
grid: {shape: [24, 24], size: [4 mm, 4 mm]}
"""


def test_runs_have_the_friction_of_the_case(tmp_path: Path) -> None:
    times = np.arange(5.0)
    record = vc.ContactRecord(times, 0.125 * times, times)
    case = read_case(written(tmp_path, DISSIMILAR))
    whole = vc.simulate(
        *(case.indenter, case.material, case.load, case.grid, times),
        friction=case.friction,
        tangential=case.tangential,
    )
    without = vc.simulate(case.indenter, case.material, case.load, case.grid, times)
    test = experiment_of(tmp_path / "ball.yaml", {}, case, record, "case")
    run = RecordRun(replace(test, coarse_cells=test.own_cells), {}, Mounting(), "coarse")
    found = run().values["approach"]
    np.testing.assert_allclose(found, whole.approach, rtol=1e-6)
    # Spence (1968): a body that sticks is a few per cent stiffer.
    assert 0.9 < found[-1] / float(without.approach[-1]) < 0.99


def test_tangential_load_needs_the_times_of_the_case(tmp_path: Path) -> None:
    path = written(tmp_path, DISSIMILAR)
    record = vc.ContactRecord(np.arange(5.0), 0.1 * np.arange(5.0), 1e-6 * np.arange(5.0))
    with pytest.raises(ValueError, match=r"tangential: its times .*--drive case"):
        experiment_of(path, {}, read_case(path), record, "force")
    assert experiment_of(path, {}, read_case(path), record, "case").drive == "case"
