"""Command `sensitivity`: its options as arguments, and what it prints and writes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from viscontact.cli.studies.execution import OF_ALL, Records, conclude, performed
from viscontact.cli.studies.typed_options import by_key, instant, shared_arguments
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.studies.sensitivity.result import SensitivityResult
from viscontact.studies.sensitivity.sensitivity import sensitivity
from viscontact.studies.study_files import write_table
from viscontact.studies.typed_values import bounds

#: The table as netCDF-4, in the directory of the runs.
_TABLE_NAME = "sensitivity.nc"
_SCATTER = "KEY=VALUE, with the unit, e.g. 'indenter.radius=4.98 mm:5.02 mm'"


def execute(typed: Mapping[str, Any]) -> None:
    """Compute the runs, write the table and the report, and print them."""
    arguments, output = _arguments(typed), typed["output"]

    def study(**how: Any) -> SensitivityResult:
        found = sensitivity(**arguments, **how)
        write_table(output / _TABLE_NAME, found.table)
        return found

    records = Records(output, output / MANIFEST_NAME)
    conclude(performed(study, records, typed, line=OF_ALL), output, [_TABLE_NAME])


def _arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.sensitivity` by name."""
    return {
        **shared_arguments(typed),
        **{name: typed[name] for name in ("of", "samples", "seed", "step")},
        "change": typed["change"] or None,
        "scatter": by_key("--scatter", typed["scatter"], _SCATTER, bounds),
        "at": instant(typed["at"]),
    }
