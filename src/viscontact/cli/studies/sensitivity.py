"""Command `sensitivity`: its options as arguments, and what it prints and writes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from viscontact.cli.studies.arguments import bounds, by_key, case_of, instant, settings_of
from viscontact.cli.studies.execution import (
    OF_ALL,
    REPORT_NAME,
    Records,
    performed,
    show,
    write_report,
)
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.studies.sensitivity.result import SensitivityResult
from viscontact.studies.sensitivity.sensitivity import sensitivity
from viscontact.studies.study_files import write_table

#: The table as netCDF-4, in the directory of the runs.
_TABLE_NAME = "sensitivity.nc"
_SCATTER = "KEY=VALUE, with the unit, e.g. 'indenter.radius=4.98 mm:5.02 mm'"


def execute_sensitivity(typed: Mapping[str, Any]) -> None:
    """Compute the runs, write the table and the report, and print them."""
    arguments, output = _arguments(typed), typed["output"]

    def study(**how: Any) -> SensitivityResult:
        found = sensitivity(**arguments, **how)
        write_table(output / _TABLE_NAME, found.table)
        return found

    records = Records(output, output / MANIFEST_NAME)
    found = performed(study, records, typed, line=OF_ALL)
    show(found)
    write_report(found, output / REPORT_NAME)
    print(output / _TABLE_NAME)


def _arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.sensitivity` by name."""
    return {
        "case": case_of(typed),
        **{name: typed[name] for name in ("of", "samples", "seed", "step")},
        "change": typed["change"] or None,
        "scatter": by_key("--scatter", typed["scatter"], _SCATTER, bounds),
        "at": instant(typed["at"]),
        "settings": settings_of(typed["settings"]),
        "directory": typed["output"],
    }
