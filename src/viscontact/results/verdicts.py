"""Comparison of a result with the allowable values of its case, within the errors."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.formatting import format_percent, format_with_error
from viscontact.results.last_cycle_values import first_largest
from viscontact.results.peak_stress import peak_stress
from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import ALLOWABLE, SCALARS, STRESSES
from viscontact.units.formatting import format_quantity

Outcome = Literal["passed", "failed", "undecided"]


@dataclass(frozen=True)
class Verdict:
    """A magnitude that decides on a limit, and the outcome."""

    name: str  # of a scalar or of a stress
    limit: float  # SI, here and below
    verdict: Outcome
    value: float = math.nan  # NaN if there is none
    error: float = math.nan  # half width of the error bar: inf if mesh-dependent, NaN if unknown
    at: float = math.nan  # instant [s] or speed [m/s]
    reason: str = ""  # why it is undecided

    @property
    def units(self) -> str:
        """SI unit."""
        return "Pa" if self.name in STRESSES else SCALARS[self.name].units

    @property
    def label(self) -> str:
        """Name of the quantity."""
        return STRESSES[self.name] if self.name in STRESSES else SCALARS[self.name].label

    @property
    def allowed(self) -> str:
        """The limit with its unit."""
        return format_quantity(self.limit, self.units)

    @property
    def margin(self) -> float:
        """Part of the limit left by value and error, (a - v - e) / a; NaN unknown, -inf mesh."""
        return (self.limit - self.value - self.error) / self.limit

    @property
    def shown_margin(self) -> str:
        """The margin in percent, empty where it is not known or without a limit."""
        if not math.isfinite(self.margin):
            return ""
        sign = "−" if self.margin < 0 else ""
        return f"{sign}{format_percent(abs(self.margin))}"

    @property
    def found(self) -> str:
        """The value with its error and unit; empty without a value."""
        if math.isnan(self.value):
            return ""
        return format_with_error(self.value, self.error, self.units)


def verdicts(ds: xr.Dataset) -> list[Verdict]:
    """Return the verdicts of a result on the allowable values of its case."""
    # A finished run may state them; else they are computed, and what has passed so far is
    # undecided.
    given = _limits(ds)
    if all("verdict" in each for each in given.values()):
        return [_verdict_from(name, each) for name, each in given.items()]
    found = (verdict_on(ds, name, float(each["limit"])) for name, each in given.items())
    return [_so_far(each) for each in found] if not ds.attrs.get("complete", 1) else list(found)


def limits_of(ds: xr.Dataset) -> dict[str, float]:
    """Return the limits of the quantities in SI units, by name."""
    return {name: float(each["limit"]) for name, each in _limits(ds).items()}


def stated_limits(ds: xr.Dataset) -> list[tuple[str, str]]:
    """Return names of the limited quantities and the limits with their units."""
    limits = (Verdict(name, each["limit"], "undecided") for name, each in _limits(ds).items())
    return [(each.label, each.allowed) for each in limits]


def compared(ds: xr.Dataset, found: Verdict) -> str:
    """Return value, allowable value and margin of a verdict in words."""
    name = found.label[:1].lower() + found.label[1:]
    value = f" {found.found} at {run_axis(ds).place(found.at)}" if found.found else ""
    reason = f"; {found.reason}" if found.reason else ""
    margin = f", margin {found.shown_margin}" if found.shown_margin else ""
    return f"{name}{value}, allowable {found.allowed}{margin}{reason}"


def final_verdicts(ds: xr.Dataset) -> list[Verdict]:
    """Return the verdicts on a run whose last row is there, whatever the result states so far."""
    return [verdict_on(ds, name, float(each["limit"])) for name, each in _limits(ds).items()]


def verdict_attribute(found: Sequence[Verdict]) -> str:
    """Return the attribute `allowable` of a result, as JSON."""
    return json.dumps({each.name: _plain_numbers(each) for each in found})


def verdict_on(ds: xr.Dataset, name: str, limit: float) -> Verdict:
    """Compare the largest magnitude of a scalar or of a stress over a run with its limit."""
    # Passed if all magnitudes with their errors are within the limit, failed if one of them less
    # its error is beyond it, or one that depends on the mesh: smaller cells give more.
    if name in STRESSES:
        return _on_stress(ds, name, limit)
    if name not in ds:
        return Verdict(name, limit, "undecided", reason="the result does not have it")
    values, errors = np.abs(np.asarray(ds[name].values, dtype=float)), errors_of(ds, name)
    return _compare(name, limit, values, errors, run_axis(ds).values(ds))


def overall(found: Sequence[Verdict]) -> Outcome | None:
    """Return the worst of some verdicts; None without any."""
    outcomes = [each.verdict for each in found]
    order: tuple[Outcome, ...] = ("failed", "undecided", "passed")
    return next((each for each in order if each in outcomes), None)


def deciding(found: Sequence[Verdict]) -> str:
    """Return the names of the quantities with the worst verdict; empty if all have passed."""
    worst = overall(found)
    names = [each.name for each in found if each.verdict == worst]
    return "" if worst == "passed" else ", ".join(names)


def _on_stress(ds: xr.Dataset, name: str, limit: float) -> Verdict:
    try:
        found = peak_stress(ds, name)
    except ValueError as error:
        return Verdict(name, limit, "undecided", reason=str(error))
    one = (np.array([each]) for each in (found.value, found.error, found.place))
    return _compare(name, limit, *one)


def _compare(name: str, limit: float, values: Any, errors: Any, places: Any) -> Verdict:
    def at(outcome: Outcome, weights: Any, reason: str = "") -> Verdict:
        row = first_largest(np.nan_to_num(weights, nan=-1.0, posinf=-1.0, neginf=-1.0))
        value, error, place = (float(each[row]) for each in (values, errors, places))
        return Verdict(name, limit, outcome, value, error, place, reason)

    known, stated = np.isfinite(values), np.isfinite(errors)
    if not known.any():
        return Verdict(name, limit, "undecided", reason="it has no value in this run")
    if (beyond := known & stated & (values - errors > limit)).any():
        return at("failed", np.where(beyond, values, np.nan))
    if (on_mesh := known & np.isposinf(errors)).any():
        outcome: Outcome = "failed" if (values[on_mesh] > limit).any() else "undecided"
        return at(outcome, np.where(on_mesh, values, np.nan), "smaller cells give more")
    if (unknown := known & np.isnan(errors)).any():
        return at("undecided", np.where(unknown, values, np.nan), "its error is not known")
    if (values + errors > limit).any():
        return at("undecided", values + errors, "the limit lies within the error")
    return at("passed", values + errors)


def _so_far(found: Verdict) -> Verdict:
    if found.verdict != "passed":
        return found
    return replace(found, verdict="undecided", reason="the run has not ended")


def _limits(ds: xr.Dataset) -> Mapping[str, Any]:
    try:
        found = json.loads(str(ds.attrs.get(ALLOWABLE, "{}")))
    except ValueError:
        return {}
    known = {*STRESSES, *SCALARS}
    return {name: each for name, each in found.items() if name in known}


def _plain_numbers(found: Verdict) -> dict[str, Any]:
    """Plain data without NaN and inf, for which JSON has no notation."""
    sizes = {"limit": found.limit, "value": found.value, "error": found.error, "at": found.at}
    plain = {
        name: "inf" if math.isinf(size) else size
        for name, size in sizes.items()
        if not math.isnan(size)
    }
    return {**plain, "verdict": found.verdict, "reason": found.reason}


def _verdict_from(name: str, each: Mapping[str, Any]) -> Verdict:
    limit, value, error, at = (float(each.get(k, "nan")) for k in ("limit", "value", "error", "at"))
    return Verdict(name, limit, each["verdict"], value, error, at, str(each["reason"]))
