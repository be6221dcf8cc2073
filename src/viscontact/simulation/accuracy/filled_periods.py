"""Extents of contacts that fill a period, as a line contact fills that along its lines."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History
from viscontact.simulation.accuracy.refinement_levels import RefinementLevels
from viscontact.simulation.accuracy.rim_cells import EXTENTS
from viscontact.simulation.transient.setup import RunSetup

#: Part of a period that is rounding [-].
_ROUNDING = 1e-9


def zero_over_periods(
    values: dict[str, Floats], run: RunSetup, history: History, results: list[CoarserResult]
) -> None:
    """Set the bars of extents to zero where the contact fills a period on all grids."""
    for name, repeats, side in zip(EXTENTS, run.grid.periodic, run.grid.size, strict=True):
        if repeats:
            rows = RefinementLevels.of(name, history, results).values
            # A coarser run may lack an instant.
            filled = ((rows >= side * (1 - _ROUNDING)) | np.isnan(rows)).all(axis=0)
            values[name] = np.where(filled & (history[name] > 0), 0.0, values[name])
