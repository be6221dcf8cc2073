"""Sections `time`, `grid` and `output` of a case file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator

from viscontact.backend.arrays import Floats
from viscontact.bodies import grid
from viscontact.case.quantities import (
    CellCount,
    Duration,
    GridTolerance,
    Instant,
    Length,
    Offset,
    Section,
    Speed,
    StepCount,
    TimeTolerance,
)
from viscontact.mechanics.time_integration.moving_times import CellTimes
from viscontact.mechanics.time_integration.requested_times import (
    AdaptiveTimes,
    adaptive_times,
    log_times,
    uniform_times,
)
from viscontact.units.axis_flags import AxisFlags
from viscontact.units.formatting import format_quantity
from viscontact.units.parsing import parse_quantity

#: Default of `first` for log spacing, as a part of the end.
FIRST_OF_END = 1e-3

#: Default relative error of adaptive steps.
ADAPTIVE_TOLERANCE = 1e-3

#: Default number of instants with fields.
DEFAULT_FIELDS = 10

#: Default relative error of an automatic grid.
DEFAULT_TOLERANCE = 0.01


#: Instants of a run [s], or settings of steps that are chosen later.
Times = Floats | AdaptiveTimes | CellTimes


class Time(Section):
    """The instants at which the state is computed."""

    end: Duration = Field(description="last instant of the run")
    steps: StepCount | None = Field(
        default=None, description="number of steps; not with adaptive spacing or cells"
    )
    spacing: Literal["uniform", "log", "adaptive", "cells"] = Field(
        default="uniform",
        description="adaptive: each step as long as the tolerance allows; cells: with a motion, "
        "a step for each cell that the body passes",
    )
    first: Duration | None = Field(
        default=None,
        description="with log spacing: the first instant after 0; end/1000 when left out",
    )
    tolerance: TimeTolerance | None = Field(
        default=None,
        description="with adaptive spacing: relative error that the steps may cause; "
        f"{ADAPTIVE_TOLERANCE:g} if not",
    )

    def instants(self) -> Floats | AdaptiveTimes:
        """Return the instants from 0 to the end [s], or the settings of adaptive steps."""
        if self.spacing == "adaptive":
            return adaptive_times(self.end, self.tolerance or ADAPTIVE_TOLERANCE)
        assert self.steps is not None  # refused otherwise
        if self.spacing == "uniform":
            return uniform_times(self.end, self.steps)
        first = self.end * FIRST_OF_END if self.first is None else self.first
        return log_times(first, self.end, self.steps)

    @model_validator(mode="after")
    def _accepted(self) -> Time:
        for name, spacings in _GOES_WITH.items():
            if getattr(self, name) is not None and self.spacing not in spacings:
                raise ValueError(
                    f"{name} goes with spacing: {' or '.join(spacings)} only; leave it out"
                )
        if self.spacing == "cells":
            return self  # they follow from the motion and the grid
        if self.steps is None and self.spacing != "adaptive":
            raise ValueError(
                "steps is missing; write e.g. 'steps: 120', or 'spacing: adaptive' for steps "
                "that the run chooses"
            )
        self.instants()
        return self


#: Spacing that each key belongs to.
_GOES_WITH = {"steps": ("uniform", "log"), "first": ("log",), "tolerance": ("adaptive",)}


def _one_or_pair(given: Any) -> str:
    return "pair" if isinstance(given, list | tuple) else "one"


_Periodic = Annotated[
    Annotated[bool, Tag("one")] | Annotated[tuple[bool, bool], Field(strict=False), Tag("pair")],
    Discriminator(_one_or_pair),
]


class Cells(Section):
    """The grid of pressure cells, or the settings of an automatic one."""

    shape: Annotated[tuple[CellCount, CellCount], Field(strict=False)] | None = Field(
        default=None, description="numbers of cells along x and y", examples=[[256, 128]]
    )
    size: Annotated[tuple[Length, Length], Field(strict=False)] | None = Field(
        default=None, description="extents along x and y", examples=[["50 mm", "5 mm"]]
    )
    centre: Annotated[tuple[Offset, Offset], Field(strict=False)] | None = Field(
        default=None,
        description="with shape and size: position of the middle of the grid along x and y; the "
        "origin when left out",
        examples=[["12 mm", "0 mm"]],
    )
    periodic: _Periodic = Field(
        default=False,
        description="whether the grid is one period of an infinite surface: in both directions, or "
        "a pair along x and y",
        examples=[True, [True, False]],
    )
    tolerance: GridTolerance | None = Field(
        default=None,
        description="in place of shape and size: relative error that the cells of an automatic "
        f"grid may cause; {DEFAULT_TOLERANCE:g} if not",
    )
    quantities: list[Literal[*grid.MESH_QUANTITIES]] | None = Field(  # type: ignore[valid-type]
        default=None,
        description="with an automatic grid: quantities with this error; peak_pressure, "
        "contact_area and approach when left out",
        examples=[["contact_width", "approach"]],
    )
    largest_cell: Annotated[tuple[Length, Length], Field(strict=False)] | None = Field(
        default=None,
        description="with an automatic grid: largest lengths of a cell along x and y; as the "
        "tolerance allows when left out",
        examples=[["50 um", "10 um"]],
    )

    def build(self) -> grid.Grid | grid.AutomaticGrid:
        """Return the grid, or the settings of an automatic one."""
        if self.shape and self.size:
            centre = self.centre or (0.0, 0.0)
            return grid.Grid(self.shape, self.size, self.periodic, centre=centre)
        quantities = grid.GRID_QUANTITIES if self.quantities is None else self.quantities
        tolerance = self.tolerance or DEFAULT_TOLERANCE
        return grid.AutomaticGrid(tolerance, quantities, self.largest_cell)

    @model_validator(mode="after")
    def _accepted(self) -> Cells:
        automatic = ("tolerance", "quantities", "largest_cell")
        requests = [name for name in automatic if getattr(self, name) is not None]
        cells = [name for name in ("shape", "size") if getattr(self, name) is not None]
        if requests and cells:
            raise ValueError(
                f"{requests[0]} goes with an automatic grid, which has no {cells[0]} of yours; "
                "leave out the one or the other"
            )
        if any(AxisFlags(self.periodic)) and not cells:
            raise ValueError(
                "periodic goes with shape and size, an automatic grid knows no period; write e.g. "
                "'shape: [128, 128]' and 'size: [1 mm, 1 mm]'"
            )
        if self.centre is not None and not cells:
            raise ValueError(
                "centre goes with shape and size, an automatic grid finds its place; write e.g. "
                "'shape: [128, 128]' and 'size: [1 mm, 1 mm]', or leave it out"
            )
        if len(cells) == 1:
            missing = "size" if self.shape else "shape"
            example = "[50 mm, 5 mm]" if self.shape else "[256, 128]"
            raise ValueError(
                f"{missing} is missing; write e.g. '{missing}: {example}', or leave out the whole "
                "section for an automatic grid"
            )
        self.build()
        return self


def _form_of_fields(given: Any) -> str:
    if isinstance(given, str):
        return "word"
    first = given[0] if isinstance(given, list) and given else None
    return "speeds" if isinstance(first, str) and _is_speed(first) else "instants"


def _is_speed(text: str) -> bool:
    try:
        parse_quantity(text, "speed")
    except ValueError:
        return False
    return True


class Speeds(tuple[float, ...]):
    """Speeds whose fields are kept [m/s], as distinct from instants."""


def _as_speeds(given: list[float]) -> Speeds:
    # Of the class itself pydantic would look for the signature, which takes 5 ms.
    return Speeds(given)


_Fields = Annotated[
    Annotated[Literal["all", "none"], Tag("word")]
    | Annotated[list[Instant], Tag("instants")]
    | Annotated[list[Speed], AfterValidator(_as_speeds), Tag("speeds")],
    Discriminator(_form_of_fields),
]


class Output(Section):
    """Results to keep in addition to the scalars of every step."""

    fields: _Fields | None = Field(
        default=None,
        description="instants whose pressure, gap and displacement are kept, with the end of the "
        "run in any case; or all, or none; ten of the run's instants when left out; in steady "
        "motion speeds in place of instants",
    )
    errors: bool = Field(
        default=True,
        description="whether the errors of the scalars are estimated after the last step, from two "
        "coarser runs, which take about a third of the time of the run",
    )


def kept_fields(output: Output, times: Times) -> str | tuple[float, ...]:
    """Return the instants whose fields are kept: the requested ones, and the end of the run."""
    if isinstance(output.fields, str):
        return output.fields
    if isinstance(output.fields, Speeds):
        raise ValueError("speeds go with a steady motion; give instants, such as '30 s'")
    end = end_of(times)
    if output.fields is None:
        return _default_fields(times)
    late = [instant for instant in output.fields if instant > end * (1 + 1e-9)]
    if late:
        raise ValueError(
            f"the instant {format_quantity(late[0], 's', 6)} lies after the end of the run, "
            f"{format_quantity(end, 's', 6)}"
        )
    if not output.fields:
        return ()
    return tuple(sorted({min(instant, end) for instant in output.fields} | {end}))


def early_fields(output: Output, times: Times) -> str | None:
    """Note on requested fields that end before the run; None if the end is among them."""
    if not output.fields or isinstance(output.fields, str | Speeds):
        return None
    latest, end = max(output.fields), end_of(times)
    if latest >= end * (1 - 1e-9):
        return None
    return (
        f"output.fields ends at {format_quantity(latest, 's', 6)}, before the run at "
        f"{format_quantity(end, 's', 6)}; the fields of its end are kept as well"
    )


def end_of(times: Times) -> float:
    """Last instant of the run [s]."""
    return times.end if isinstance(times, AdaptiveTimes | CellTimes) else float(times[-1])


def kept_speeds(output: Output, speeds: Sequence[float]) -> str | tuple[float, ...]:
    """Return the speeds whose fields are kept [m/s]."""
    fields = output.fields
    if isinstance(fields, str):
        return fields
    if fields is None:
        if len(speeds) <= DEFAULT_FIELDS:
            return "all"
        chosen = np.linspace(0, len(speeds) - 1, DEFAULT_FIELDS).round().astype(int)
        return tuple(speeds[index] for index in chosen)
    if not isinstance(fields, Speeds) and fields:
        raise ValueError("a steady motion has no instants; give speeds, such as '0.5 m/s'")
    nearest = [min(speeds, key=lambda each: abs(each - wanted)) for wanted in fields]
    for wanted, found in zip(fields, nearest, strict=True):
        if abs(found - wanted) > 1e-9 * wanted:
            raise ValueError(
                f"{format_quantity(wanted, 'm/s', 6)} is not among the speeds of motion; the "
                f"nearest is {format_quantity(found, 'm/s', 6)}"
            )
    return tuple(dict.fromkeys(nearest)) or "none"


def _default_fields(times: Times) -> tuple[float, ...]:
    if isinstance(times, AdaptiveTimes | CellTimes):
        spread = log_times(times.end * FIRST_OF_END, times.end, DEFAULT_FIELDS - 1)
        return tuple(spread.tolist())
    chosen = np.linspace(0, len(times) - 1, min(DEFAULT_FIELDS, len(times))).round()
    return tuple(times[chosen.astype(int)].tolist())


def with_instants(times: Times, fields: str | tuple[float, ...]) -> Times:
    """Return the instants of the run together with those of requested fields."""
    if isinstance(fields, str) or isinstance(times, AdaptiveTimes | CellTimes):
        return times
    # A field requested at 30 s is computed at 30 s, not at a step nearby; it replaces a step that
    # differs by rounding only.
    requested = np.asarray(fields)
    doubled = np.isclose(times[:, None], requested[None, :], rtol=1e-6, atol=0.0).any(axis=1)
    return np.union1d(times[~doubled], requested)
