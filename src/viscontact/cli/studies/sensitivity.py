"""Command `sensitivity`: its options as arguments, and what it prints and writes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from viscontact.cli.studies.arguments import bounds, by_key, instant, settings_of
from viscontact.cli.studies.execution import (
    OF_ALL,
    REPORT_NAME,
    Records,
    performed,
    show,
    write_report,
)
from viscontact.run_files import MANIFEST_NAME
from viscontact.studies.sensitivity.result import SensitivityResult
from viscontact.studies.sensitivity.result_files import TABLE_NAME, write_table
from viscontact.studies.sensitivity.sensitivity import sensitivity

_SCATTER = "KEY=VALUE, with the unit, e.g. 'indenter.radius=4.98 mm:5.02 mm'"


def execute_sensitivity(typed: Mapping[str, Any]) -> None:
    """Compute the runs, write the table and the report, and print them.

    `typed` are the options by name.
    """
    arguments, output = _arguments(typed), typed["output"]

    def study(**progress: Any) -> SensitivityResult:
        found = sensitivity(**arguments, **progress)
        write_table(output, found)
        return found

    records = Records(output, output / MANIFEST_NAME)
    how = {"resume": typed["resume"], "quiet": typed["quiet"]}
    found = performed(study, records, **how, line=OF_ALL)
    show(found)
    write_report(found, output / REPORT_NAME)
    print(output / TABLE_NAME)


def _arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.sensitivity` by name."""
    return {
        **{name: typed[name] for name in ("case", "of", "samples", "seed", "step")},
        "change": typed["change"] or None,
        "scatter": by_key("--scatter", typed["scatter"], _SCATTER, bounds),
        "at": instant(typed["at"]),
        "settings": settings_of(typed["settings"]),
        **{"workers": typed["jobs"], "directory": typed["output"]},
    }
