"""The contact on one period, estimated: a coarse elastic solve."""

from __future__ import annotations

import numpy as np

from viscontact.balance import Support
from viscontact.contact import solve_contact
from viscontact.contact_problem import ContactProblem
from viscontact.estimate import COARSE_TOLERANCE, ContactEstimate
from viscontact.grid import Grid
from viscontact.half_space import HalfSpace
from viscontact.indenters import Indenter
from viscontact.load import LoadPoint
from viscontact.rim import trace_rim

#: Cells of the coarse solve along each axis, at most: a period may hold many waves.
MOST_CELLS = 128


def estimate_period(
    indenter: Indenter, contact_compliance: float, point: LoadPoint, grid: Grid
) -> ContactEstimate:
    """Solve an elastic contact on a periodic grid coarsely.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    contact_compliance : float
        J of an elastic body in its place [1/Pa].
    point : LoadPoint
        Force or approach.
    grid : Grid
        The period; a finer one is made coarser.

    Returns
    -------
    ContactEstimate
        To a few per cent.

    Raises
    ------
    ValueError
        If the solve does not converge.

    Examples
    --------
    Under half of its pressure of full contact a wave's strip is half as wide as the wave is long:

    >>> import viscontact as vc
    >>> period = Grid((64, 4), (1e-3, 1e-3), periodic=True)
    >>> waves, load = vc.Waviness(1e-6, wavelength_x=1e-3), vc.step(0.5 * 3.1416e6 * period.area)
    >>> round(estimate_period(waves, 1e-9, load.at(0.0), period).length * 1e3, 2)
    0.5
    """
    nx, ny = (min(count, MOST_CELLS) for count in grid.shape)
    coarse = Grid((nx, ny), grid.size, periodic=True)
    open_gap = indenter.gap(coarse.x[:, None], coarse.y[None, :])
    half_space = HalfSpace(coarse)
    support = half_space.share(Support.of(point))
    problem = ContactProblem(open_gap, contact_compliance, support, 1e-12 * max(grid.size))
    solution = solve_contact(problem, half_space, tolerance=COARSE_TOLERANCE)
    if not solution.converged:
        raise ValueError("grid: the contact on this period could not be estimated; use more cells")
    pressure = solution.found.pressure
    rim = trace_rim(coarse, pressure > 0, solution.gap)
    x, y = coarse.x[rim.rows], coarse.y[rim.columns]
    return ContactEstimate(
        length=max(rim.length, coarse.cell_size[0]),
        width=max(rim.width, coarse.cell_size[1]),
        approach=float(solution.found.motion[0]),
        peak_pressure=float(pressure.max()),
        peak_place=coarse.largest_at(pressure),
        centre_x=float(np.median(x)) if rim.length < grid.size[0] else 0.0,
        centre_y=float(np.median(y)) if rim.width < grid.size[1] else 0.0,
        force=float(pressure.sum()) * coarse.cell_area,
        rim=rim,
        open_gap=open_gap,
        motion=solution.found.motion,
    )
