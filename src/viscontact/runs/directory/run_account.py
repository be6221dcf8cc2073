"""What a result says of its run besides numbers."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping, Sequence
from typing import Any

from viscontact.grid import Grid
from viscontact.results.enlarged_grid import enlargement
from viscontact.state import ContactState

#: An account before the first state, as plain data.
NOTHING_YET: Mapping[str, Any] = {"warnings": (), "wall_time": 0.0, "cells": None, "enlarged": ()}


class Account:
    """Warnings, enlargements of the grid, and how long it took, from state to state.

    Parameters
    ----------
    grid : Grid
        Grid of the fields when the run began.
    position : mapping
        The `position` of an earlier account, or `NOTHING_YET`.

    Attributes
    ----------
    grid : Grid
        Grid of the last state.
    """

    def __init__(self, grid: Grid, position: Mapping[str, Any]) -> None:
        self.grid = grid.widened(tuple(position["cells"] or grid.shape))
        self._started: float = clock.monotonic() - position["wall_time"]
        self._warnings = list(position["warnings"])
        self._enlarged = list(position["enlarged"])

    def add(self, state: ContactState) -> None:
        """Take down what a state says."""
        self._warnings += state.warnings
        if state.grid != self.grid:
            self._enlarged.append(enlargement(state.time, self.grid, state.grid))
            self.grid = state.grid

    def add_warning(self, warnings: Sequence[str]) -> None:
        """Take down warnings that no single state has raised."""
        self._warnings += warnings

    @property
    def attributes(self) -> dict[str, Any]:
        """As global attributes of the result: lines of text, and seconds."""
        return {
            "warnings": "\n".join(self._warnings),
            "grid_enlarged": "\n".join(self._enlarged),
            "wall_time": self._wall_time,
        }

    @property
    def position(self) -> dict[str, Any]:
        """As plain data, to go on from."""
        return {
            "warnings": list(self._warnings),
            "wall_time": self._wall_time,
            "cells": list(self.grid.shape),
            "enlarged": list(self._enlarged),
        }

    @property
    def _wall_time(self) -> float:
        return clock.monotonic() - self._started
