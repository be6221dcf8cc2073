"""Accuracy of a run as the report states it: errors, balance, steps, cells."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import xarray as xr

from viscontact.results.formatting import format_bound
from viscontact.results.recorded_case import (
    case_of,
    has_mixed_control,
    is_layered,
    prescribes_approach,
    recorded_grid,
)
from viscontact.results.recorded_events import recorded_events
from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import WHY_MESH_DEPENDENT, largest_error
from viscontact.results.summary import SummaryRow, summary_rows, summary_scalars
from viscontact.units.formatting import format_quantity


def error_rows(ds: xr.Dataset) -> list[tuple[str, ...]]:
    """Return the table of results and their errors."""
    rows = f"{run_axis(ds).row}s"
    return [
        (row.heading, row.first, row.last, row.largest, _worst(row, rows), row.when)
        for row in summary_rows(ds)
    ]


def accuracy_lines(ds: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Yield further statements on a run's accuracy: title and text."""
    residual = ds["residual"].values
    tolerance = float(ds.attrs.get("tolerance", math.nan))
    requested = "" if math.isnan(tolerance) else f"; requested: {tolerance:.1e}"
    yield (
        "Residual",
        f"{float(residual.max(initial=0.0)):.1e} at most, of the largest displacement{requested}. "
        "The gap under pressure and penetration elsewhere are no larger.",
    )
    yield "Balance", _balance(ds)
    if run_axis(ds).is_history:
        yield "Time discretisation error", _steps(ds)
    yield "Cells", _cells(ds)
    if memory := str(ds.attrs.get("memory", "")):
        yield "History integral", memory
    inversion = float(ds.attrs.get("inversion_error", 0.0))
    if inversion > 0:
        yield "Law", f"converted numerically; error {format_bound(inversion)} (estimated)"
    if is_layered(ds) or is_layered(ds, "indenter_material"):
        yield "Layers", _splitting(ds)
    yield from _of_ends(ds)
    for number, event in enumerate(recorded_events(ds), start=1):
        yield f"Event {number}", event.text
    yield "Error estimation", _coarser_runs(ds)
    if _is_marked(ds):
        yield "Depends on the mesh", f"{WHY_MESH_DEPENDENT}."


def _of_ends(ds: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Statements on the free ends of bodies."""
    ends = float(ds.attrs.get("ends_error", 0.0))
    if ends > 0:
        yield (
            "Free ends",
            (
                f"their operator misses {format_bound(ends)} of the displacement (measured by "
                "reciprocity and by what its short sum leaves out), part of those above"
            ),
        )
    left = float(ds.attrs.get("end_stress_left", 0.0))
    if left > 0:
        yield (
            "Stress left on free ends",
            (
                f"{format_bound(left)} of the peak pressure (found by waves across the ends, in "
                "another way than their operator), part of those above"
            ),
        )


def _splitting(ds: xr.Dataset) -> str:
    error = float(ds.attrs.get("splitting_error", 0.0))
    if not error:
        return "all parts creep alike, so that their response is exact"
    return (
        "their response is a short sum of products of a creep function and an elastic response; "
        f"its error is {format_bound(error)} (measured over wave lengths and frequencies) and part "
        "of those above"
    )


def _worst(row: SummaryRow, rows: str) -> str:
    error = f"{row.error} ({row.part})" if row.when else row.part or row.error
    return f"{error}; not known at {row.unknown} {rows}" if row.part and row.unknown else error


def _balance(ds: xr.Dataset) -> str:
    if prescribes_approach(ds):
        return "the approach is prescribed; the force is the pressure's integral"
    if has_mixed_control(ds):
        return (
            "segments prescribe force or approach; under a force, the pressure's integral and "
            "moments are those of the load, to the requested tolerance"
        )
    known = largest_error(ds, "force")
    if known is None or not math.isfinite(known.part):
        return "force and moments of the pressure are those of the load, to the requested tolerance"
    return (
        f"the pressure's integral differs from the load by {format_bound(known.part)} of it; "
        "its moments are the load's to the requested tolerance"
    )


def _steps(ds: xr.Dataset) -> str:
    largest = float(np.nanmax(ds["time_error"].values, initial=0.0))
    if largest > 0:
        return f"{format_bound(largest)} of the pressure (estimated)"
    if _is_elastic(ds):
        return "none: the contact at each instant follows from the load alone"
    return "not estimated step by step; it is part of the errors above"


def _cells(ds: xr.Dataset) -> str:
    across = ds["cells_across"].values
    touching = across[ds["contact_area"].values > 0]
    grid = recorded_grid(ds)
    edges = " × ".join(format_quantity(edge, "m", 3) for edge in grid.cell_size)
    counted = f"{grid.shape[0]} × {grid.shape[1]} cells of {edges}"
    if not touching.size:
        return counted
    return f"{counted}; {int(touching.max())} across the shorter side of the largest contact"


def _coarser_runs(ds: xr.Dataset) -> str:
    if not any(str(name).endswith("_error") and name != "time_error" for name in ds.data_vars):
        return "none: the errors of the numbers above are not estimated"
    return (
        f"coarser {run_axis(ds).coarser} of the same problem, from which the errors are estimated: "
        "95 of 100 true errors are expected to lie within the stated ones"
    )


def _is_elastic(ds: xr.Dataset) -> bool:
    material = case_of(ds).get("material") or {}
    parts = [each["material"] for each in material.get("layers", [])]
    parts += [material.get("base", material)]
    return all(
        part == "rigid" or (part.get("law") or {}).get("type") == "Elastic" for part in parts
    )


def _is_marked(ds: xr.Dataset) -> bool:
    found = (largest_error(ds, name) for name in summary_scalars(ds))
    return any(each is not None and math.isinf(each.half_width) for each in found)
