"""Options of `fit` that need a case, where none is given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from viscontact.cli.material.fit_kinds import switch
from viscontact.cli.terminal.messages import refuse

#: Options of fits to runs by their parameters; `quiet`, which asks for nothing, goes with all fits.
_OF_RUNS = (
    *("change", "drive", "contact_point", "machine_stiffness", "settings", "rows", "runs"),
    *("report", "jobs", "scheduler", "resume", "overwrite"),
)


def refuse_without_case(typed: Mapping[str, Any], files: Sequence[Path], *, several: bool) -> None:
    """Refuse options of ``--case`` without it, and those that do not go with several curves."""
    given = [name for name in _OF_RUNS if typed[name] is not None and typed[name] is not False]
    if several:
        given = [name for name in given if name != "jobs"]
    if idle := ["--set" if name == "settings" else switch(name) for name in given]:
        refuse(f"{', '.join(idle)}: needs --case CASE.yaml, the case of the experiment")
    if several and typed["indenter"] is None:
        found = f"{len(files)} tables" if len(files) > 1 else f"{files[0].name} has several curves"
        refuse(
            f"{found}: give --indenter, such as 'sphere 5 um', to fit each as an "
            "indentation, or --case CASE.yaml, the case of the experiment, to fit them together"
        )
    if several and typed["section"] is not None:
        refuse("--yaml: goes with one table; several curves give a table (--table)")
    if not several and typed["table"] is not None:
        refuse("--table: goes with several curves; one gives a section of a case (--yaml)")
