"""Arguments and records of a fit that are refused, with the reason, and records that are read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.studies.calibration.experiments import ELASTIC_BALL, MODULUS, hertz_depth, written

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.studies.calibration.preparation import experiment_of
from viscontact.studies.calibration.record import read_record

FORCE = np.linspace(0.0, 0.1, 9)
RECORD = vc.ContactRecord(np.arange(9.0), FORCE, hertz_depth(FORCE), "a.csv")
ONLY_FORCE = vc.ContactRecord(np.arange(9.0), force=FORCE, name="a.csv")
ONLY_APPROACH = vc.ContactRecord(np.arange(9.0), approach=hertz_depth(FORCE), name="a.csv")

REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no unknown": ({"change": {}}, "change: name a key"),
    "no range": ({"change": {"material.shear_modulus": "1 MPa"}}, "must be two bounds"),
    "reversed": (
        {"change": {"material.shear_modulus": ("2 MPa", "1 MPa")}},
        "change: material.shear_modulus: the lower bound comes first",
    ),
    "unknown key": ({"change": {"material.shear": ("1 MPa", "2 MPa")}}, "shear: unknown key"),
    "no entry": ({"change": {"material.times[1]": ("1 s", "2 s")}}, "material"),
    "no key": ({"change": {"material..law": ("1 s", "2 s")}}, "change: material..law: is no key"),
    "unit": ({"change": {"material.shear_modulus": ("1 mm", "2 mm")}}, "cannot read '1 mm'"),
    "load": ({"change": {"load.force": ("1 N", "2 N")}}, "the load follows from the record"),
    "cells": ({"change": {"grid.tolerance": ("1 %", "2 %")}}, "grid.tolerance: is no unknown"),
    "body of no sense": ({"change": {"material.poisson_ratio": ("0.2", "0.7")}}, "poisson_ratio"),
    "twice": ({"settings": {"material.shear_modulus": "1 MPa"}}, "is given twice"),
    "contact point": ({"contact_point": ("1 N", "2 N")}, "contact_point: cannot read '1 N'"),
    "stiffness": (
        {"machine_stiffness": ("0 N/mm", "2 N/mm")},
        "machine_stiffness: must be above zero",
    ),
    "drive": ({"drive": "moment"}, "drive: must be 'force', 'approach' or 'case'"),
    "nothing compared": ({"records": ONLY_FORCE}, "has no column approach, which is to be compare"),
    "nothing prescribed": (
        {"records": ONLY_FORCE, "drive": "approach"},
        "a.csv: has no column approach, which is to be prescribed; there is time and force",
    ),
    "after the end": (
        {"records": ONLY_APPROACH},
        "a.csv: time 2 s lies outside the load of the case, which ends at 1 s",
    ),
    "too few rows": (
        {
            "records": vc.ContactRecord(np.arange(5.0), FORCE[:5], FORCE[:5]),
            "contact_point": ("-1 um", "1 um"),
            "machine_stiffness": ("1 N/mm", "2 N/mm"),
        },
        "records: 3 unknowns need at least 6 rows, got 5",
    ),
    "no record": ({"records": []}, "records: name a table"),
    "confidence": ({"confidence": 1.0}, "confidence: must lie between 0 and 1"),
    "rolling": (
        {"settings": {"motion": "{kind: travel, points: [[0 s, 0 mm], [1 s, 1 mm]], along: x}"}},
        "pressed at rest",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused_with_the_reason(name: str, tmp_path: Path) -> None:
    given, reason = REFUSED[name]
    arguments = {"records": RECORD, "change": MODULUS, **given}
    with pytest.raises(ValueError, match=r"\w") as refused:
        vc.fit_case(written(tmp_path, ELASTIC_BALL), **arguments)
    assert reason in str(refused.value)
    assert "--set" not in str(refused.value)


def test_a_run_that_fails_at_every_start_gives_its_reason(tmp_path: Path) -> None:
    record = vc.ContactRecord(np.arange(9.0), 100 * FORCE, hertz_depth(FORCE))
    with pytest.raises(ValueError, match="the contact reaches the edge of the grid"):
        vc.fit_case(written(tmp_path, ELASTIC_BALL), record, MODULUS)


def test_a_table_is_read_and_its_faults_name_lines(tmp_path: Path) -> None:
    table = tmp_path / "a.csv"
    rows = "".join(f"{n}, {n}, {2 * n}\n" for n in range(6))
    table.write_text(f"time [min], force [mN], depth [um]\n{rows}")
    record = read_record(table)
    assert record.times[1] == 60.0
    assert record.force is not None
    assert record.approach is not None
    assert record.force[5] == close_to(5e-3)
    assert record.approach[5] == close_to(1e-5)
    table.write_text(f"time [min], force [mN], depth [um]\n{rows}1, 2, 3\n")
    with pytest.raises(ValueError, match=r"line 8 of a\.csv: must not be before the row above"):
        read_record(table)
    table.write_text("time [s], temperature [degC]\n1, 20\n2, 20\n")
    with pytest.raises(ValueError, match=r"a\.csv: needs a column force or approach"):
        read_record(table)


def test_a_long_record_is_thinned_to_means_that_keep_a_jump() -> None:
    times = np.concatenate([np.linspace(0, 1, 101), np.linspace(1, 2, 101)])
    force = np.where(np.arange(202) < 101, 1.0, 3.0)
    record = vc.ContactRecord(times, force, times**2)
    thin = record.thinned(20)
    assert 20 <= thin.times.size <= 24
    assert np.count_nonzero(np.diff(thin.times) == 0) == 1
    assert set(thin.column("force")) == {1.0, 3.0}
    assert thin.times[0] == 0.0
    # A mean of squares exceeds the square of the mean by the variance of the times.
    np.testing.assert_allclose(thin.column("approach"), thin.times**2, atol=2e-3)
    assert record.thinned(500) is record


def test_a_load_of_mixed_control_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path, ELASTIC_BALL)
    load = vc.MixedHistory([0.0, 1.0, 6.0], ["approach", "force"], [0.0, 0.1], [1e-6, 0.1])
    case = replace(read_case(path), load=load)
    with pytest.raises(ValueError, match="prescribes force and approach in turn"):
        experiment_of(path, {}, case, RECORD, None)
