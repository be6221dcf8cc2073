"""Summary of a result: a row for each scalar, with its errors, and a headline."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.formatting import (
    NEGLIGIBLE,
    format_error,
    format_percent,
    format_scalar,
    format_with_error_in,
)
from viscontact.results.last_cycle_values import last_cycle, notable_largest
from viscontact.results.run_axis import SPEED, RunAxis, run_axis
from viscontact.results.shown_scalars import is_line, is_shown, lacks_datum
from viscontact.results.stated_errors import (
    LargestError,
    errors_of,
    is_rounding,
    largest_error,
)
from viscontact.results.variables import (
    MESH_DEPENDENT,
    SCALARS,
    scalars_in,
    scalars_with_error,
    shown_name,
)
from viscontact.units.formatting import ReadableUnit, format_quantity, readable_unit

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result

#: Legend of the columns, with the name of a row.
_LEGEND = (
    "±: the error of each value at that {row} (of 100 true errors 95 are meant to be smaller); "
    "left out below 0.01 %. Largest error: the worst of the run, in % of the largest value."
)


def legend(ds: Result) -> str:
    """Legend of the columns."""
    return _LEGEND.format(row=run_axis(ds).row)


@dataclass(frozen=True)
class SummaryRow:
    """A scalar of a run in words, no digit more than its error supports."""

    name: str  # in the result
    unit: str  # of the numbers
    # Values at the first and the last instant or speed, and where the magnitude is largest; each
    # with the error that it has there, unless that is negligible.
    first: str
    last: str
    largest: str
    error: str  # the largest error over the run, in the unit, or the reason why there is none
    part: str  # the same relative to the largest value; empty where there is none
    when: str  # place of the largest error; empty where it is negligible everywhere
    unknown: int  # number of instants or speeds at which the error is unknown

    @property
    def title(self) -> str:
        """Its name in words."""
        return self.name.replace("_", " ")

    @property
    def heading(self) -> str:
        """Its title with the unit in brackets."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title

    @property
    def largest_error(self) -> str:
        """The largest error in short: as a part of the largest value, and when."""
        if not self.part:
            return self.error
        return f"{self.part} at {self.when}" if self.when else self.part


def summary_rows(ds: Result) -> list[SummaryRow]:
    """Rows of the summary: one for each scalar of a result that is more than rounding."""
    return [_row(ds, name) for name in summary_scalars(ds)]


def summary_scalars(ds: Result) -> list[str]:
    """Scalars of a result that have errors, are of use, and are more than rounding."""
    names = [name for name in scalars_in(ds, scalars_with_error()) if is_shown(ds, name)]
    return [name for name in names if not is_rounding(ds, name)]


def _row(ds: Result, name: str) -> SummaryRow:
    values, errors = np.asarray(ds[name].values, dtype=np.float64), errors_of(ds, name)
    at_largest = int(np.nanargmax(np.abs(values)))
    unit = readable_unit(SCALARS[name].units, float(values[at_largest]))
    # The error of a zero is compared with the largest value.
    most = float(np.abs(values[at_largest]))
    errors = np.where((values == 0) & (errors <= NEGLIGIBLE * most), 0.0, errors)
    first, last, largest = (
        format_with_error_in(unit, float(values[k]), float(errors[k]), most)
        for k in (0, -1, at_largest)
    )
    found = largest_error(ds, name)
    error, part, when = _largest_error(found, unit, run_axis(ds))
    unknown = found.unknown if found else 0
    return SummaryRow(name, unit.symbol, first, last, largest, error, part, when, unknown)


def _largest_error(
    found: LargestError | None, unit: ReadableUnit, axis: RunAxis
) -> tuple[str, str, str]:
    """The largest error in the row's unit, as a part of the largest value, and where it occurs."""
    if found is None or math.isnan(found.half_width):
        return "not known", "", ""
    if math.isinf(found.half_width):
        return MESH_DEPENDENT, "", ""
    error, part = format_error(found.half_width / unit.factor), format_percent(found.part)
    return error, part, axis.quantity(found.place, 3) if found.part > NEGLIGIBLE else ""


def headline(ds: Result) -> str:
    """The result in words: the contact at the end, or when largest if it is lost by then."""
    # Under a cyclic load the last whole cycle comes first. The largest peak pressure follows where
    # it exceeds that of the sentence. In steady motion: the largest friction coefficient.
    if not run_axis(ds).is_history:
        return _headline_over_speed(ds)
    instants, area = ds["time"].values, ds["contact_area"].values
    end = format_quantity(float(instants[-1]), "s")
    if not np.any(area > 0):
        return f"Until t = {end} the bodies do not touch."
    if area[-1] > 0:
        return f"{_cycle(ds)}After {end} {_contact(ds, -1)}.{_largest_peak(ds, -1)}"
    largest = int(area.argmax())
    lost = format_quantity(float(instants[int(np.flatnonzero(area > 0)[-1]) + 1]), "s")
    return (
        f"{_cycle(ds)}At t = {format_quantity(float(instants[largest]), 's')}, when it is largest, "
        f"{_contact(ds, largest)}.{_largest_peak(ds, largest)} The bodies come apart: from "
        f"t = {lost} to the end, t = {end}, they do not touch."
    )


def largest_friction(ds: Result) -> int:
    """Index of the speed with the largest friction coefficient."""
    return int(np.nan_to_num(np.abs(ds["friction_coefficient"].values)).argmax())


def _headline_over_speed(ds: Result) -> str:
    index = largest_friction(ds)
    speed = SPEED.place(float(ds["speed"][index]))
    if is_rounding(ds, "friction_coefficient"):
        return (
            f"Without loss in the bodies there is no resistance. At {speed} {_contact(ds, index)}."
        )
    value = format_scalar(ds, "friction_coefficient", index)
    if ds.sizes["speed"] == 1:
        return f"At {speed} the friction coefficient is {value}; {_contact(ds, index)}."
    return f"The friction coefficient is largest at {speed}, {value}. There {_contact(ds, index)}."


def _largest_peak(ds: Result, shown: int) -> str:
    """Sentence about the largest peak pressure; empty if it hardly exceeds that at an index."""
    at = notable_largest(ds, "peak_pressure", shown)
    if at is None:
        return ""
    when = format_quantity(float(ds["time"][at]), "s")
    return f" The peak pressure is largest at t = {when}: {format_scalar(ds, 'peak_pressure', at)}."


def _cycle(ds: Result) -> str:
    """Sentence about the last whole cycle of a cyclic load; empty for any other load."""
    cycle = last_cycle(ds)
    if cycle is None:
        return ""
    begin, end = (format_quantity(time, "s") for time in (cycle.begin, cycle.end))
    names = [shown_name("force", ds), "peak_pressure", *(() if lacks_datum(ds) else ("approach",))]
    ranges = [f"the {name.replace('_', ' ')} {cycle.range_of(ds, name)}" for name in names]
    text = f"In the last cycle, t = {begin} to {end}: {', '.join(ranges)}"
    if "loss_per_cycle" in ds and np.isfinite(ds["loss_per_cycle"].values[cycle.last]):
        text += f"; the loss per cycle is {format_scalar(ds, 'loss_per_cycle', cycle.last)}"
    return f"{text}. "


def _contact(ds: Result, index: int) -> str:
    names = (shown_name("force", ds), shown_name("contact_area", ds), "approach", "peak_pressure")
    force, area, approach, peak = (format_scalar(ds, name, index) for name in names)
    extent = f"is {area} wide" if is_line(ds) else f"covers {area}"
    text = f"the contact {extent} under {force}; "
    if lacks_datum(ds):
        return text + f"the peak pressure is {peak}"
    return text + f"the approach is {approach} and the peak pressure {peak}"
