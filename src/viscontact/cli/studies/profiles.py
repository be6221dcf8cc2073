"""Command `design --profile free`: its options, and what it prints and writes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.cli.studies.execution import Records, conclude, performed
from viscontact.cli.studies.typed_options import instant, quantity, scenarios_of, shared_arguments
from viscontact.cli.terminal.messages import refuse, say
from viscontact.studies.design.profiles.design_profile import design_profile
from viscontact.studies.design.profiles.drawing import write_dxf
from viscontact.studies.design.profiles.result import ProfileDesign
from viscontact.studies.design.profiles.result_files import CSV_NAME, DXF_NAME
from viscontact.studies.journal import JOURNAL_NAME
from viscontact.studies.study_files import BEST_NAME

_PROFILE = re.compile(r"free(?::(?P<knots>\d+))?(?P<asymmetric>:asymmetric)?")


def execute_profile_design(typed: Mapping[str, Any]) -> None:
    """Search, write the result to its directory, and print it; `typed` are the options by name."""
    search, output = partial(design_profile, **_arguments(typed)), typed["output"]
    found = performed(search, Records(output, output / JOURNAL_NAME), typed)
    drawing = [DXF_NAME] if _has_drawing(found, output / DXF_NAME) else []
    conclude(found, output, [CSV_NAME, *drawing, BEST_NAME], _peak_pressures(found))


def _arguments(typed: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of `viscontact.design_profile` by name."""
    profile = typed["profile"]
    if profile is None:
        refuse("--drop-tolerance: goes with --profile free")
    match = _PROFILE.fullmatch(profile)
    if match is None:
        refuse(
            f"--profile {profile}: write free, free:KNOTS, or free:KNOTS:asymmetric, e.g. free:8"
        )
    for name in ("change", "maximise", "constraint", "clear_of_ends", "scatter"):
        if typed[name]:
            option = name.replace("_", "-")
            refuse(f"--{option}: does not go with --profile, which minimises the peak pressure")
    if set(typed["minimise"] or ()) - {"peak_pressure"}:
        given = ", ".join(typed["minimise"])
        refuse(f"--minimise: a free profile minimises peak_pressure, got {given}")
    optional = {
        "knots": int(match["knots"]) if match["knots"] else None,
        "drop_tolerance": quantity("--drop-tolerance", typed["drop_tolerance"], "length"),
        "runs": typed["runs"],
    }
    return {
        **shared_arguments(typed),
        "symmetric": match["asymmetric"] is None,
        "at": instant(typed["at"]),
        "over": scenarios_of(typed["over"]),
        **{name: value for name, value in optional.items() if value is not None},
    }


def _peak_pressures(found: ProfileDesign) -> Iterator[str]:
    """Lines with the peak pressures of all profiles."""
    table = found.table
    names = table["profile"].values.tolist()
    width = max(map(len, names))
    for name in names:
        row = table.sel(profile=name)
        has_limit = not np.isposinf(float(row["peak_pressure_error"]))
        value = found.formatted(name) if has_limit else "no limit, at a sharp end"
        yield f"  {name:{width}}  {value:22}  {row['parameter'].values!s}".rstrip()


def _has_drawing(found: ProfileDesign, path: Path) -> bool:
    """Write the profile as a drawing, if ezdxf is installed."""
    try:
        write_dxf(path, found.x, found.drop, found.radius)
    except ModuleNotFoundError:
        say(f"without {path.name}: it needs ezdxf: pip install 'viscontact[drawing]'")
        return False
    return True
