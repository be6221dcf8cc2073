"""Line load along x, q(x) = ∫ p dy, and its largest mean over a part of the contact."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.team import Team
from viscontact.bodies.grid import Grid

#: Length of the means whose largest counts, as a part of the contact's. At a sharp end of the body
#: q grows as distance^(-1/2), at a corner as its logarithm: only a mean has a limit.
PART = 1 / 20


def line_load(pressure: Floats, grid: Grid) -> Floats:
    """Line load on the rows of cells, shape (nx,) [N/m], of a pressure on the grid [Pa].

    Examples
    --------
    >>> line_load(np.ones((4, 8)), Grid((4, 8), (1.0, 2.0))).tolist()
    [2.0, 2.0, 2.0, 2.0]
    """
    return np.asarray(pressure.sum(axis=1) * grid.cell_size[1])


def peak_line_load(load: Floats, grid: Grid, length: float, team: Team | None = None) -> float:
    """Largest mean line load over a twentieth of the contact's `length` [m] along x [N/m]."""
    window = PART * length / grid.cell_size[0]  # in cells
    if not (load.any() and window > 0):
        return float(load.max())
    if grid.periodic[0]:
        load = np.append(load, load[: int(np.ceil(window))])
    if team is not None and team.core is not None:
        return float(team.core.largest_mean(load, window))
    edges = np.arange(len(load) + 1)
    before = np.append(0.0, np.cumsum(load))
    # A mean is largest where the window begins or ends with a row.
    starts = np.append(edges, edges - window).clip(0.0, len(load) - window)
    in_window = np.interp(starts + window, edges, before) - np.interp(starts, edges, before)
    return float(in_window.max() / window)
