"""Layout of the joint result of a sweep: dimensions, coordinates, rows and states."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact import __version__
from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.results.variables import (
    AXES,
    ERRORS,
    RUN_VALUES,
    error_name,
    scalar_attributes,
)
from viscontact.studies.sweep.axes import SweepAxes, sweep_axes
from viscontact.studies.sweep.manifest import SweepRun, read_manifest
from viscontact.studies.sweep.run_scalars import COLUMNS, RunOutline, run_outline, run_scalars
from viscontact.studies.sweep.states import RunState, State, run_state

#: Called with the numbers of finished and of all runs.
Progress = Callable[[int, int], None]

#: Dimension of the rows of runs with different times or speeds.
STEP = "step"
#: Memory for scalars that are read at once [bytes].
_BLOCK = 2**24


@dataclass(frozen=True, eq=False)
class JointLayout:
    """Layout of the joint result of a sweep; runs count in the order of the manifest."""

    directory: Path
    runs: list[SweepRun]
    axes: SweepAxes
    states: list[RunState]
    over: str  # "time", or "speed" for runs in steady motion
    rows: Floats | None  # common instants [s] or speeds [m/s]; None if they differ
    steps: int  # largest number of rows of a run
    columns: tuple[str, ...]  # names of the scalars and their errors that any run states
    fields: Mapping[str, Any] | None  # description of the fields that all finished runs share
    has_fields: bool  # True if any run has fields
    values: list[Mapping[str, float]]  # of each whole run, with errors

    @property
    def row_dim(self) -> str:
        """Dimension of the instants or speeds."""
        return STEP if self.rows is None else self.over

    @property
    def done(self) -> list[int]:
        """Numbers of the finished runs."""
        return [n for n, each in enumerate(self.states) if each.state is State.DONE]

    @property
    def has_changed(self) -> bool:
        """True if any run has settings of its own."""
        return any(each.changed for each in self.runs)

    @property
    def has_verdicts(self) -> bool:
        """True if any finished run was compared with allowable values."""
        return any(each.verdict for each in self.states)

    @property
    def has_warnings(self) -> bool:
        """True if any finished run has warnings."""
        return any(each.warnings for each in self.states)

    @property
    def scalar_dims(self) -> tuple[str, ...]:
        """Dimensions of a scalar."""
        return (*self.axes.dims, self.row_dim)

    @property
    def scalar_shape(self) -> tuple[int, ...]:
        """Sizes along `scalar_dims`."""
        return (*self.axes.shape, self.steps)

    @property
    def names(self) -> tuple[str, ...]:
        """Variables over the rows: times or speeds where these differ, and `columns`."""
        return self.columns if self.rows is not None else (self.over, *self.columns)

    @property
    def beside(self) -> list[str]:
        """Coordinates of a scalar that are no dimensions."""
        found = [name for name in self.axes.coords if name not in self.axes.dims]
        return [*found, self.over] if self.rows is None else found

    def place(self, run: int) -> Path:
        """Directory of a run."""
        return self.directory / self.runs[run].directory

    def attributes(self, name: str) -> dict[str, Any]:
        """Attributes of a scalar, of its error, or of time or speed."""
        if name in AXES:
            return AXES[name].attributes
        if name in ERRORS:
            return ERRORS[name].attributes
        found = scalar_attributes(name, errors=any(each in ERRORS for each in self.columns))
        if name == "outcome":  # a float here, NaN without a result
            found["flag_values"] = np.asarray(found["flag_values"], dtype=np.float64)
        return found

    def frame(self) -> xr.Dataset:
        """Joint result without scalars and fields: coordinates, states and messages."""
        dims, shape = self.axes.dims, self.axes.shape
        about = {
            "state": ([each.state.value for each in self.states], "state of the run"),
            "message": ([each.message for each in self.states], "reason why the run has no result"),
        }
        if self.has_changed:
            own = [each.own_settings for each in self.runs]
            about["changed"] = (own, "settings of the run alone")
        if self.has_verdicts:
            worst = [each.verdict for each in self.states]
            about["verdict"] = (worst, "worst verdict on the allowable values")
            names = [each.decided_by for each in self.states]
            about["decided_by"] = (names, "quantities with this verdict; empty if all have passed")
        if self.has_warnings:
            warned = ["\n".join(each.warnings) for each in self.states]
            about["warnings"] = (warned, "warnings of the run, one a line")
        texts = {
            name: (dims, np.array(values, dtype=np.str_).reshape(shape), {"long_name": title})
            for name, (values, title) in about.items()
        }
        whole = self._run_values()
        frame = xr.Dataset(texts | whole, self.axes.coords, self._attributes)
        if self.rows is not None:
            values = (self.over, self.rows, self.attributes(self.over))
            frame = frame.assign_coords({self.over: values})
        return frame

    def _run_values(self) -> dict[str, tuple[Any, ...]]:
        """Values of whole runs that any run states, with their errors, NaN where it does not."""
        found = {}
        for name, variable in RUN_VALUES.items():
            if not any(name in each for each in self.values):
                continue
            bar = {
                "units": variable.units,
                "long_name": f"estimated error of: {variable.long_name}",
            }
            for column, about in ((name, variable.attributes), (error_name(name), bar)):
                values = np.array([each.get(column, math.nan) for each in self.values])
                found[column] = (self.axes.dims, values.reshape(self.axes.shape), about)
        return found

    @property
    def _attributes(self) -> dict[str, str]:
        about = {"Conventions": "CF-1.11", "source": f"viscontact {__version__}"}
        if self.has_fields and self.fields is None:
            about["fields"] = "on different grids: open_many(directory, tree=True) returns them"
        return about

    def blocks(self, block: int = _BLOCK) -> Iterator[tuple[slice, Floats]]:
        """Yield runs and values of `names`, shape (runs, names, steps), NaN without a result."""
        chosen = [COLUMNS.index(name) for name in self.names]
        size = max(1, block // (8 * len(COLUMNS) * max(1, self.steps)))
        for first in range(0, len(self.runs), size):
            last = min(first + size, len(self.runs))
            values = np.full((last - first, len(chosen), self.steps), np.nan)
            for run in range(first, last):
                if self.states[run].state is State.DONE:
                    table = run_scalars(self.place(run))[: self.steps]
                    values[run - first, :, : len(table)] = table[:, chosen].T
            yield slice(first, last), values


def joint_layout(directory: str | Path, progress: Progress | None = None) -> JointLayout:
    """Read the layout of the joint result of a sweep; `progress` is called with (done, total).

    FileNotFoundError without a manifest, ValueError if it is damaged.
    """
    # A finished run whose files cannot be read counts as failed.
    folder = Path(directory)
    manifest = folder / MANIFEST_NAME
    if not manifest.is_file():
        raise FileNotFoundError(f"no manifest {MANIFEST_NAME} of a sweep in {directory}")
    runs = list(read_manifest(manifest))
    shared, states, values = _Shared(), [], []
    for run in runs:
        state, outline = _state_and_outline(folder / run.directory)
        if outline is not None and not shared.add(outline):
            state = RunState(State.FAILED, f"it is over {outline.over}, and other runs are not")
        states.append(state)
        values.append({} if outline is None else outline.values)
        if progress is not None:
            progress(run.run + 1, len(runs))
    columns = tuple(name for name in COLUMNS if name in shared.columns and name not in AXES)
    rows = shared.rows if shared.rows is not None or shared.steps else np.empty(0)
    fields = shared.fields
    if fields is not None and rows is None and fields["axis"] == shared.over:
        fields = {**fields, "axis": STEP}
    return JointLayout(
        folder,
        runs,
        sweep_axes(runs),
        states,
        shared.over,
        rows,
        shared.steps,
        columns,
        fields,
        shared.has_fields,
        values,
    )


def _state_and_outline(directory: Path) -> tuple[RunState, RunOutline | None]:
    state = run_state(directory)
    if state.state is not State.DONE:
        return state, None
    try:
        outline = run_outline(directory)
        ended = replace(
            state,
            verdict=outline.verdict,
            decided_by=outline.decided_by,
            warnings=outline.warnings,
        )
        return ended, outline
    except (OSError, RuntimeError, ValueError, LookupError, TypeError) as error:
        return RunState(State.FAILED, f"its result cannot be read: {error}"), None


class _Shared:
    """Rows, scalars and fields that runs share, found one run after the other."""

    def __init__(self) -> None:
        self.steps = 0
        self.columns: set[str] = set()
        self.over = "time"
        self.rows: Floats | None = None
        self.fields: Mapping[str, Any] | None = None
        self.has_fields = False
        self._is_first = True

    def add(self, outline: RunOutline) -> bool:
        """Take a run into account; False if it is over another quantity than the others."""
        if self._is_first:
            self.over, self.rows, self.fields = outline.over, outline.rows, outline.fields
        elif outline.over != self.over:
            return False
        elif self.rows is not None and not np.array_equal(self.rows, outline.rows):
            self.rows = None
        if self.fields != outline.fields:
            self.fields = None
        self.has_fields |= outline.fields is not None
        self.steps = max(self.steps, outline.rows.size)
        self.columns |= outline.columns
        self._is_first = False
        return True
