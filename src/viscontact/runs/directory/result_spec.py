"""What a result is to hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.results.dataset import field_axis
from viscontact.runs.directory.netcdf_layout import Layout
from viscontact.time_integration.run_times import field_instants


@dataclass(frozen=True, eq=False)
class Contents:
    """What a result is to hold of a run.

    Attributes
    ----------
    grid : Grid
        Grid of the fields when the run begins.
    times : ndarray
        Instants of the run [s].
    fields : "all", "none" or sequence of float
        Instants [s] whose fields are kept.
    attributes : mapping
        Global attributes.
    errors : bool
        Whether there will be errors of the scalars.
    """

    grid: Grid
    times: NDArray[np.float64]
    fields: str | Sequence[float] = "all"
    attributes: Mapping[str, Any] = field(default_factory=dict)
    errors: bool = False

    @property
    def kept(self) -> frozenset[float]:
        """Instants whose fields are kept, among those that can be told beforehand [s]."""
        return frozenset(field_instants(self.fields, self.times).tolist())

    def layout(self, grid: Grid) -> Layout:
        """Return the layout of the result's file.

        Parameters
        ----------
        grid : Grid
            Grid of the fields by now.

        Examples
        --------
        >>> grid = Grid((4, 4), (1.0, 1.0))
        >>> Contents(grid, np.array([0.0, 1.0]), fields=[1.0]).layout(grid).axis
        'field_time'
        """
        return Layout(grid, field_axis(self.fields) if self.kept else None, self.errors)
