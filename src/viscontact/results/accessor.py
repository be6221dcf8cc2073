"""Accessor `ds.viscontact` of a result: its display and its figures."""

from __future__ import annotations

from typing import Any

import xarray as xr

from viscontact.units.display import Displayable, result_explorer, result_plots


@xr.register_dataset_accessor("viscontact")
class ResultAccessor(Displayable):
    """A result in a few lines and small drawings, as ``ds.viscontact``."""

    # Available after ``import viscontact`` and the first of its names that makes or opens results.

    def __init__(self, result: xr.Dataset) -> None:
        self.result = result

    @property
    def plot(self) -> Any:
        """Its figures: ``plot.pressure_map()`` and the like, each of which returns axes."""
        return result_plots(self.result)

    def explore(self, *, dark: bool = False, units: str = "auto", width: int | None = None) -> Any:
        """Pressure map and sections with a slider, see `viscontact.figures.explore`."""
        return result_explorer(self.result, dark=dark, units=units, width=width)

    def __repr__(self) -> str:
        return str(self)
