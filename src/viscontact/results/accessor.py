"""Accessor `ds.viscontact` of a result: its display and its figures."""

from __future__ import annotations

from typing import Any

import xarray as xr

from viscontact.results.rolling import at_creepage
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

    def at_creepage(self, creepage: float) -> xr.Dataset:
        """Result at one of its creepages, with the contact and tractions of this one only.

        Parameters
        ----------
        creepage : float
            One of those of a result of `viscontact.steady` [-].

        Returns
        -------
        xarray.Dataset
            As of a run at this creepage alone, also of coupled bodies, whose contact is over the
            creepage where there are several.

        Raises
        ------
        ValueError
            If it is none of those of the result.
        """
        return at_creepage(self.result, creepage)

    def explore(self, *, dark: bool = False, units: str = "auto", width: int | None = None) -> Any:
        """Pressure map and sections with a slider, see `viscontact.figures.explore`."""
        return result_explorer(self.result, dark=dark, units=units, width=width)

    def __repr__(self) -> str:
        return str(self)
