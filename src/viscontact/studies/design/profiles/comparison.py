"""Comparison of a free profile with named ones, on the cells of the case."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.profile import Profile
from viscontact.results.formatting import format_with_error
from viscontact.studies.design.profiles.named import NamedProfile
from viscontact.studies.design.profiles.profile_runs import MARGIN, ProfileRuns
from viscontact.studies.design.profiles.result import CASE, ELASTIC, FREE, ProfileDesign
from viscontact.studies.design.profiles.tables import deviating, tabulated
from viscontact.studies.scalars import Value, value_columns
from viscontact.units.formatting import format_quantity

_PEAK, _ERROR = "peak_pressure", "peak_pressure_error"


@dataclass(frozen=True, eq=False)
class FoundProfiles:
    """Profiles that the search has found; positions and drops in m."""

    x: Floats
    named: tuple[NamedProfile, ...]
    free: Floats
    elastic: Floats | None  # best without creep; None if the bodies do not creep
    tolerance: float
    is_cut_short: bool


def compared(
    search: ProfileRuns, found: FoundProfiles, case: Path, settings: Mapping[str, str]
) -> ProfileDesign:
    """Compute the peak pressures of all profiles on the cells of the case, with their errors."""
    profiles: dict[str, Profile | None] = {CASE: None}
    profiles |= {each.name: each.profile for each in found.named}
    profiles[FREE] = tabulated(found.x, found.free)
    if found.elastic is not None:
        profiles[ELASTIC] = tabulated(found.x, found.elastic)
    values, warned = zip(*search.certified(list(profiles.values())), strict=True)
    table = _table(search, found, profiles, values)
    if found.tolerance:
        table = table.assign(_deviations(search, found, values[list(profiles).index(FREE)]))
    runs = search.evaluation.budget.runs
    design = ProfileDesign(table, (), runs, case, dict(settings), tuple(search.scenarios), profiles)
    notes = (*_notes(design, found), *warned[list(profiles).index(FREE)])
    about = {"goal": _PEAK, "at": str(search.at), "drop_tolerance": found.tolerance}
    about |= {"best_named": design.best_named, "notes": "\n".join(notes)}
    return ProfileDesign(
        *(table.assign_attrs(about), notes, runs, case, dict(settings)),
        *(tuple(search.scenarios), profiles),
    )


def _table(
    search: ProfileRuns,
    found: FoundProfiles,
    profiles: Mapping[str, Profile | None],
    values: Sequence[Sequence[Value]],
) -> xr.Dataset:
    own, end = search.scenarios[0].roller, search.scenarios[0].end
    lines = [
        own.drop(found.x) if each is None else each.drop(found.x, end) for each in profiles.values()
    ]
    drops = np.array([np.where(np.isfinite(line), line, np.nan) for line in lines])
    parameters = {each.name: each.parameter for each in found.named}
    names = [each.name or "as in the case" for each in search.scenarios]
    data = {
        "drop": xr.Variable(
            ("profile", "x"), drops, {"units": "m", "long_name": "drop of the generating line"}
        ),
        "parameter": ("profile", np.array([parameters.get(name, "") for name in profiles])),
        **value_columns(_PEAK, "profile", [_worst(each) for each in values]),
        **value_columns(_PEAK, ("profile", "scenario"), values, "_of_scenarios"),
    }
    x = xr.Variable("x", found.x, {"units": "m", "long_name": "position from the middle"})
    return xr.Dataset(data, {"profile": list(profiles), "x": x, "scenario": names})


def _deviations(
    search: ProfileRuns, found: FoundProfiles, as_drawn: Sequence[Value]
) -> Mapping[str, xr.Variable | xr.DataArray]:
    """Peak pressures of the free profile within the production tolerance."""
    u = found.x / search.scenarios[0].end
    drops = deviating(found.free, u, found.tolerance)
    others = [tabulated(found.x, drop) for name, drop in drops.items() if name != "none"]
    values = [as_drawn, *(each for each, _ in search.certified(others))]
    worst = [_worst(each) for each in values]
    peaks = value_columns(_PEAK, "deviation", worst, "_of_deviations")
    names = xr.Variable("deviation", list(drops))
    return {name: xr.DataArray(each, {"deviation": names}) for name, each in peaks.items()}


def _worst(values: Sequence[Value]) -> Value:
    """Value of the worst scenario; NaN if a run failed."""
    failed = next((each for each in values if np.isnan(each.value)), None)
    return failed or max(values, key=lambda each: (each.depends_on_mesh, each.value))


def _notes(design: ProfileDesign, found: FoundProfiles) -> Iterator[str]:
    table = design.table
    if not all(each.may_touch_ends for each in design.scenarios):
        margin = format_quantity(MARGIN * design.scenarios[0].end, "m", 2)
        yield f"the contact is kept {margin} away from the ends, where pressure has no limit"
    free, best = (table.sel(profile=name) for name in (FREE, design.best_named))
    gain, error = float(best[_PEAK] - free[_PEAK]), float(best[_ERROR] + free[_ERROR])
    if gain <= error:
        yield (
            f"the {design.best_named} profile ({best['parameter'].values!s}) is as good within "
            "the errors"
        )
    if ELASTIC in table.profile:
        drops = [
            format_quantity(float(table["drop"].sel(profile=name).max()), "m", 3)
            for name in (ELASTIC, FREE)
        ]
        yield (
            f"without creep the best profile would drop {drops[0]} at its ends, in place of "
            f"{drops[1]}; with creep its peak pressure is {design.formatted(ELASTIC)}"
        )
    if found.tolerance:
        row = table.isel(deviation=int(np.argmax(table[f"{_PEAK}_of_deviations"].values)))
        value = float(row[f"{_PEAK}_of_deviations"]), float(row[f"{_PEAK}_of_deviations_error"])
        yield (
            f"within ± {format_quantity(found.tolerance, 'm', 3)} of the drop the largest peak "
            f"pressure is {format_with_error(*value, 'Pa')} ({row['deviation'].values!s})"
        )
    if found.is_cut_short:
        yield "the runs are too few to search until the gain is small"
