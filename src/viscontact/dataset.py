"""Labels begin here: from states to an xarray dataset, and `simulate`."""

from __future__ import annotations

import json
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from viscontact import __version__
from viscontact.description import describe_run
from viscontact.errors import ConvergenceError, DomainError
from viscontact.grid import AutomaticGrid, Grid
from viscontact.indenters import Indenter
from viscontact.instants import field_instants
from viscontact.load import LoadHistory
from viscontact.marching import Progress, march_run
from viscontact.material import Material
from viscontact.outgrown import enlargements, on_wider
from viscontact.run import Run, prepare_run
from viscontact.state import ContactState, Outcome
from viscontact.stepping import AdaptiveTimes


@dataclass(frozen=True)
class Variable:
    """A variable of the result.

    Attributes
    ----------
    units : str
        Its unit, as CF and UDUNITS write it.
    long_name : str
        What it is.
    kind : str
        NumPy's name of its type.
    """

    units: str
    long_name: str
    kind: str = "f8"

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes the variable carries."""
        return {"units": self.units, "long_name": self.long_name}


COORDINATES = {
    "time": Variable("s", "time"),
    "x": Variable("m", "position along the indenter"),
    "y": Variable("m", "position across the indenter"),
}

FIELDS = {
    "pressure": Variable("Pa", "contact pressure, positive in compression"),
    "gap": Variable("m", "gap, positive when open"),
    "displacement": Variable("m", "surface displacement, positive into the half-space"),
}

SCALARS = {
    "force": Variable("N", "force on the contact"),
    "eccentricity_x": Variable("m", "position of the resultant along x"),
    "eccentricity_y": Variable("m", "position of the resultant along y"),
    "approach": Variable("m", "rigid approach, positive when the bodies come closer"),
    "tilt_x": Variable("rad", "rigid slope along x, positive when the +x end is deeper"),
    "tilt_y": Variable("rad", "rigid slope along y, positive when the +y end is deeper"),
    "contact_area": Variable("m2", "contact area"),
    "contact_length": Variable("m", "extent of the contact along x"),
    "contact_width": Variable("m", "extent of the contact along y"),
    "peak_pressure": Variable("Pa", "largest pressure"),
    "mean_pressure": Variable("Pa", "force over contact area"),
    "work": Variable("J", "work of the load on the contact since the start"),
    "loss_per_cycle": Variable("J", "work that the last whole cycle of the load has cost"),
    "time_error": Variable("1", "estimated relative error of pressure owed to the time steps"),
    "iterations": Variable("1", "iterations of the contact solver", "i4"),
    "residual": Variable("1", "relative violation of the contact conditions"),
    "cells_across": Variable("1", "cells across the contact, along its shorter way", "i4"),
    "outcome": Variable("1", "how the instant ended", "i1"),
}

#: CF's way to write an enumeration.
OUTCOME_FLAGS = {
    "flag_values": np.array([outcome.value for outcome in Outcome], dtype="i1"),
    "flag_meanings": " ".join(outcome.name.lower() for outcome in Outcome),
}


def simulate(
    indenter: Indenter,
    material: Material,
    load: LoadHistory,
    grid: Grid | AutomaticGrid | None = None,
    times: ArrayLike | AdaptiveTimes | None = None,
    *,
    indenter_material: Material | None = None,
    tolerance: float = 1e-6,
    fields: str | Sequence[float] = "all",
    threads: int = 1,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Press an indenter on a creeping half-space and return what happens over time.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material
        Material of the half-space.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    grid : Grid or AutomaticGrid, optional
        Cells that carry the pressure, or what is asked of them: then, and when left out, the
        run chooses them.
    times : array_like or AdaptiveTimes, optional
        Instants of the result, strictly increasing, none before 0 [s]; chosen from load and
        law when left out. With `adaptive_times` the run chooses its steps, and ``time`` holds
        those it took.
    indenter_material : Material, optional
        Material of the indenter; rigid when left out.
    tolerance : float
        Relative error of gap and balances at every instant.
    fields : "all", "none" or sequence of float
        Instants [s] whose pressure, gap and displacement are kept: all on the dimension
        ``time``, some on ``field_time``.
    threads : int
        Threads of one Fourier transform.
    progress : callable, optional
        Called with (state, done, total) after each instant.

    Returns
    -------
    xarray.Dataset
        Scalars over ``time``, fields over (time or field_time, x, y), all in SI units, each
        with ``units`` and ``long_name``; the case, warnings and tolerance as attributes.

    Raises
    ------
    ValueError
        If an argument makes no sense, with a remedy.
    ConvergenceError, DomainError
        If the run stops; ``partial`` holds the completed steps as a dataset.

    Warns
    -----
    AccuracyWarning
        If the result is coarser than one would expect; kept in the attribute ``warnings``.

    See Also
    --------
    march : the generator underneath, with its equations.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), times=vc.uniform_times(5.0, 20))
    >>> round(float(ds.approach[-1] / ds.approach[0]), 2)  # (J(5 s)/J(0))**(2/3)
    1.58
    """
    run = prepare_run(
        indenter,
        material,
        load,
        grid,
        times,
        indenter_material=indenter_material,
        tolerance=tolerance,
        fields=fields,
        threads=threads,
    )
    started = clock.perf_counter()
    states: list[ContactState] = []
    keep = set(field_instants(fields, run.times).tolist())
    keeps_all = field_axis(fields) == "time"
    try:
        for state in march_run(run, progress):
            kept = keeps_all or state.time in keep
            states.append(state if kept else state.without_fields())
    except (ConvergenceError, DomainError) as stop:
        if states:
            stop.partial = to_dataset(run, states, fields, clock.perf_counter() - started)
        raise
    return to_dataset(run, states, fields, clock.perf_counter() - started)


def to_dataset(
    run: Run, states: Sequence[ContactState], fields: str | Sequence[float], wall_time: float
) -> xr.Dataset:
    """Label the states of a run.

    Parameters
    ----------
    run : Run
        The run.
    states : sequence of ContactState
        Its states so far; fields are needed only where they are kept.
    fields : str or sequence of float
        As in `simulate`.
    wall_time : float
        What it took [s].

    Returns
    -------
    xarray.Dataset
        As `simulate` returns it.
    """
    times = np.array([state.time for state in states])
    scalars = {
        name: (
            "time",
            np.array([getattr(state, name) for state in states], dtype=variable.kind),
            variable.attributes,
        )
        for name, variable in SCALARS.items()
    }
    grid = states[-1].grid  # the widest: a grid is enlarged only
    dataset = xr.Dataset(scalars, coords=_coordinates(grid, times))
    dataset["outcome"].attrs.update(OUTCOME_FLAGS)
    kept = [state for state in states if state.pressure.size]
    if kept:
        dataset = dataset.assign(_field_arrays(kept, grid, field_axis(fields)))
    said = [text for state in states for text in state.warnings]
    return dataset.assign_attrs(
        run_attributes(run),
        wall_time=wall_time,
        warnings="\n".join(said),
        grid_enlarged="\n".join(enlargements(run.grid, states)),
    )


def field_axis(fields: str | Sequence[float]) -> str:
    """Return the dimension on which fields are kept: ``time``, or ``field_time`` for some.

    Parameters
    ----------
    fields : str or sequence of float
        As in `simulate`.

    Examples
    --------
    >>> field_axis("all"), field_axis([0.0, 2.0])
    ('time', 'field_time')
    """
    # An array is not to be compared with a word.
    return "time" if isinstance(fields, str) and fields == "all" else "field_time"


def run_attributes(run: Run) -> dict[str, Any]:
    """Attributes that every result of a run carries.

    Parameters
    ----------
    run : Run
        The run.

    Returns
    -------
    dict
        Conventions, version, the case as JSON, the tolerance.
    """
    return {
        "Conventions": "CF-1.11",
        "source": f"viscontact {__version__}",
        "version": __version__,
        "case": json.dumps(describe_run(run)),
        "tolerance": run.tolerance,
        "memory": run.memory.method,
        "memory_error": run.memory.error,
        "inversion_error": run.compliance.inversion_error,
    }


def _coordinates(grid: Grid, times: NDArray[np.float64]) -> dict[str, Any]:
    values = {"time": times, "x": grid.x, "y": grid.y}
    return {
        name: (name, values[name], variable.attributes) for name, variable in COORDINATES.items()
    }


def _field_arrays(states: Sequence[ContactState], grid: Grid, axis: str) -> dict[str, Any]:
    arrays: dict[str, Any] = {
        name: (
            (axis, "x", "y"),
            np.stack([on_wider(name, getattr(s, name), s.grid, grid) for s in states]),
            variable.attributes,
        )
        for name, variable in FIELDS.items()
    }
    if axis != "time":
        instants = np.array([state.time for state in states])
        attributes = {"units": "s", "long_name": "time of the stored fields"}
        arrays[axis] = (axis, instants, attributes)
    return arrays
