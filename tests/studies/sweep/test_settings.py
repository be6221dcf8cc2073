"""Settings of runs of a sweep: coordinates, equal values, numbers of a job array."""

from __future__ import annotations

from viscontact.studies.sweep.axes import coordinate
from viscontact.studies.sweep.equal_values import comparable
from viscontact.studies.sweep.job_array import _numbers, _ranges
from viscontact.studies.sweep.manifest import SweepRun


def test_coordinate_is_a_number_in_si_unless_a_value_is_no_quantity() -> None:
    assert coordinate("grid.tolerance", "run", ["1 %", "5 %"]).values.tolist() == [0.01, 0.05]
    assert coordinate("material", "run", ["pmma", "1 %"]).values.tolist() == ["pmma", "1 %"]


def test_values_in_other_units_are_equal() -> None:
    assert comparable("load.force", "1 kN") == comparable("load.force", "1000N")
    assert comparable("grid.size", "[1 mm, 2 mm]") == comparable("grid.size", "[0.1cm,2mm]")


def test_numbers_of_a_job_array_are_ranges_of_slurm() -> None:
    assert _ranges([0, 1, 2, 5, 7, 8]) == "0-2,5,7-8"


def test_numbers_of_a_job_array_are_ranges_of_bash() -> None:
    assert _numbers([0, 1, 2, 5, 7, 8]) == "{0..2} 5 {7..8}"


def test_own_settings_name_what_a_run_leaves_out() -> None:
    settings = {"load.force": "5 kN", "grid.size": "[9 mm, 9 mm]"}
    changed = ("grid.size", "grid.largest_cell")
    found = SweepRun(0, "", "a", settings, (), "a.yaml", "grid", changed).own_settings
    assert found == "grid.size=[9 mm, 9 mm], without grid.largest_cell"
