"""The `time`, `grid` and `output` of a case file."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Discriminator, Field, Tag, model_validator

from viscontact import grid
from viscontact.case.quantities import CellCount, Duration, Instant, Length, Section, StepCount
from viscontact.stepping import log_times, uniform_times

#: Without `first`, steps in log time begin at this part of the end.
FIRST_OF_END = 1e-3

#: Without `output`, so many instants keep their fields.
DEFAULT_FIELDS = 10


class Time(Section):
    """The instants at which the state is computed."""

    end: Duration
    steps: StepCount
    spacing: Literal["uniform", "log"] = "uniform"
    first: Duration | None = Field(
        default=None, description="with log spacing: the first instant after 0; end/1000 if not"
    )

    def instants(self) -> NDArray[np.float64]:
        """Return the instants, from 0 to the end [s]."""
        if self.spacing == "uniform":
            return uniform_times(self.end, self.steps)
        first = self.end * FIRST_OF_END if self.first is None else self.first
        return log_times(first, self.end, self.steps)

    @model_validator(mode="after")
    def _accepted(self) -> Time:
        if self.spacing == "uniform" and self.first is not None:
            raise ValueError("first goes with spacing: log only; leave it out")
        self.instants()
        return self


class Cells(Section):
    """The grid of pressure cells, centred on the origin."""

    shape: Annotated[tuple[CellCount, CellCount], Field(strict=False)] = Field(
        description="numbers of cells along x and y", examples=[[256, 128]]
    )
    size: Annotated[tuple[Length, Length], Field(strict=False)] = Field(
        description="extents along x and y", examples=[["50 mm", "5 mm"]]
    )

    def noun(self) -> grid.Grid:
        """Return the grid."""
        return grid.Grid(self.shape, self.size)

    @model_validator(mode="after")
    def _accepted(self) -> Cells:
        self.noun()
        return self


def _word_or_list(given: Any) -> str:
    return "word" if isinstance(given, str) else "instants"


_Fields = Annotated[
    Annotated[Literal["all", "none"], Tag("word")] | Annotated[list[Instant], Tag("instants")],
    Discriminator(_word_or_list),
]


class Output(Section):
    """What is kept besides the scalars of every step."""

    fields: _Fields | None = Field(
        default=None,
        description="instants whose pressure, gap and displacement are kept, or all, or none; "
        "ten of the run's instants when left out",
    )


def kept_fields(output: Output, times: NDArray[np.float64]) -> str | tuple[float, ...]:
    """Return the instants whose fields are kept.

    Parameters
    ----------
    output : Output
        What the case asks for.
    times : ndarray
        The run's instants [s].

    Returns
    -------
    str or tuple of float
        ``"all"``, ``"none"``, or instants [s].

    Raises
    ------
    ValueError
        If an instant lies after the end.

    Examples
    --------
    >>> kept_fields(Output(fields=["0 s", "30 s"]), np.array([0.0, 60.0]))
    (0.0, 30.0)
    """
    if isinstance(output.fields, str):
        return output.fields
    if output.fields is None:
        chosen = np.linspace(0, len(times) - 1, min(DEFAULT_FIELDS, len(times))).round()
        return tuple(times[chosen.astype(int)].tolist())
    late = [instant for instant in output.fields if instant > times[-1] * (1 + 1e-9)]
    if late:
        raise ValueError(
            f"the instant {late[0]:g} s lies after the end of the run, {times[-1]:g} s"
        )
    return tuple(sorted({min(instant, float(times[-1])) for instant in output.fields}))


def with_instants(
    times: NDArray[np.float64], fields: str | tuple[float, ...]
) -> NDArray[np.float64]:
    """Return the run's instants with those added whose fields are asked for.

    Parameters
    ----------
    times : ndarray
        The instants of the `time` section [s].
    fields : str or tuple of float
        From `kept_fields`.

    Returns
    -------
    ndarray
        All instants, strictly increasing [s].

    Examples
    --------
    >>> with_instants(np.array([0.0, 1.0]), (0.0, 0.5)).tolist()
    [0.0, 0.5, 1.0]
    """
    if isinstance(fields, str):
        return times
    # A field asked for at 30 s is the field at 30 s, not that of a step nearby; it takes the
    # place of a step that differs by rounding only.
    asked = np.asarray(fields)
    doubled = np.isclose(times[:, None], asked[None, :], rtol=1e-6, atol=0.0).any(axis=1)
    return np.union1d(times[~doubled], asked)
