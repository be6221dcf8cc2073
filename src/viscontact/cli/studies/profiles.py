"""`design --profile free`: its options and the lines that it prints."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.cli.studies.design import instant, keys
from viscontact.cli.studies.execution import REPORT_NAME, performed, written_report
from viscontact.cli.sweep.plan_options import split_values
from viscontact.cli.terminal.messages import refuse, say
from viscontact.studies.design.profiles.design_profile import design_profile
from viscontact.studies.design.profiles.drawing import write_dxf
from viscontact.studies.design.profiles.result import ProfileDesign
from viscontact.studies.design.profiles.result_files import CSV_NAME, DXF_NAME
from viscontact.studies.design.result_files import BEST_NAME
from viscontact.units.parsing import parse_quantity

_PROFILE = re.compile(r"free(?::(?P<knots>\d+))?(?P<asymmetric>:asymmetric)?")


@dataclass(frozen=True)
class ProfileRequest:
    """Options of `design --profile`, as they were typed."""

    case: Path
    output: Path
    profile: str | None  # free[:KNOTS][:asymmetric]
    drop_tolerance: str | None
    minimise: Sequence[str]
    at: str
    over: Sequence[str]  # KEY=A,B,...
    settings: Sequence[str]
    runs: int | None
    jobs: int
    excluded: Mapping[str, object]  # options that do not go with a profile

    def arguments(self) -> dict[str, Any]:
        """Arguments of `viscontact.design_profile` by name."""
        if self.profile is None:
            refuse("--drop-tolerance: goes with --profile free")
        match = _PROFILE.fullmatch(self.profile)
        if match is None:
            refuse(
                f"--profile {self.profile}: write free, free:KNOTS, or free:KNOTS:asymmetric, e.g. "
                "free:8"
            )
        for option, value in self.excluded.items():
            if value:
                refuse(f"{option}: does not go with --profile, which minimises the peak pressure")
        if set(self.minimise) - {"peak_pressure"}:
            given = ", ".join(self.minimise)
            refuse(f"--minimise: a free profile minimises peak_pressure, got {given}")
        optional = {
            "knots": int(match["knots"]) if match["knots"] else None,
            "drop_tolerance": _length(self.drop_tolerance),
            "runs": self.runs,
        }
        return {
            "case": self.case,
            "symmetric": match["asymmetric"] is None,
            "at": instant(self.at),
            "over": keys("--over", self.over, split_values),
            "settings": keys("--set", self.settings, str),
            "workers": self.jobs,
            "directory": self.output,
            **{name: value for name, value in optional.items() if value is not None},
        }


def execute_profile_design(request: ProfileRequest, *, resume: bool, quiet: bool) -> None:
    """Search, write the result to its directory, and print it."""
    search = partial(design_profile, **request.arguments())
    found = performed(search, request.output, resume=resume, quiet=quiet)
    print(found)
    _print_table(found)
    for note in found.notes:
        say(f"note: {note}")
    written_report(found, request.output / REPORT_NAME)
    print(request.output / CSV_NAME)
    if _has_drawing(found, request.output / DXF_NAME):
        print(request.output / DXF_NAME)
    print(request.output / BEST_NAME)


def _print_table(found: ProfileDesign) -> None:
    """Peak pressures of all profiles."""
    table = found.table
    width = max(map(len, table["profile"].values.tolist()))
    for name in table["profile"].values.tolist():
        row = table.sel(profile=name)
        has_limit = not np.isposinf(float(row["peak_pressure_error"]))
        value = found.formatted(name) if has_limit else "no limit, at a sharp end"
        print(f"  {name:{width}}  {value:22}  {row['parameter'].values!s}".rstrip())


def _has_drawing(found: ProfileDesign, path: Path) -> bool:
    """Write the profile as a drawing, if ezdxf is installed."""
    try:
        write_dxf(path, found.x, found.drop, found.radius)
    except ModuleNotFoundError:
        say(f"without {path.name}: it needs ezdxf: pip install 'viscontact[drawing]'")
        return False
    return True


def _length(text: str | None) -> float | None:
    if text is None:
        return None
    try:
        return parse_quantity(text, "length")
    except ValueError as error:
        refuse(f"--drop-tolerance: {error}")
