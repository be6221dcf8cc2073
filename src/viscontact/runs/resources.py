"""How much memory runs hold, and how many of them fit into it at once."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate

from viscontact.grid import Grid
from viscontact.materials.compliance import SeriesCompliance
from viscontact.materials.material import Material
from viscontact.simulation.setup import RunSetup

#: Bytes of the program itself, and arrays of the grid's size that a run holds at a time and writes,
#: both measured, of a body without mirror images; two arrays more for each term of the law. The
#: program takes 150 to 190 MB: what the linear algebra library sets aside for itself differs
#: between processors.
PROGRAM, WORK_ARRAYS, ARRAYS_PER_TERM = 2.2e8, 62, 2

#: What is kept of each step besides fields: when it is, and the scalars it ends with; measured.
BYTES_PER_STEP = 2000.0


def run_memory(run: RunSetup) -> float:
    """Return how many bytes a run holds, what it keeps of its steps among them.

    Parameters
    ----------
    run : RunSetup
        A run that has been checked.
    """
    kept = BYTES_PER_STEP * run.problem.step_count
    return needed_memory(run.grid, run.memory.fields_kept) + kept


def needed_memory(grid: Grid, fields_kept: int) -> float:
    """Return how many bytes a run holds.

    Parameters
    ----------
    grid : Grid
        Its grid; nothing of its size is allocated here.
    fields_kept : int
        Fields that the memory keeps of pressure, and as many of deflection: one for each
        exponential term of the contact compliance, or one for each step.

    Returns
    -------
    float
        Bytes.

    Examples
    --------
    >>> round(needed_memory(Grid((1000, 1000), (1.0, 1.0)), fields_kept=2) / 1e6)
    748
    """
    nx, ny = grid.shape
    return PROGRAM + 8.0 * float(nx) * float(ny) * (WORK_ARRAYS + ARRAYS_PER_TERM * fields_kept)


def least_memory(grid: Grid, material: Material) -> float:
    """Return how many bytes a run holds at least, before anything of it has been prepared.

    Parameters
    ----------
    grid : Grid
        Its grid.
    material : Material
        The half-space's.

    Returns
    -------
    float
        Bytes.

    Examples
    --------
    >>> from viscontact.laws import Zener
    >>> rubber = Material(Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    >>> round(least_memory(Grid((1000, 1000), (1.0, 1.0)), rubber) / 1e6)
    732
    """
    compliance = material.contact_compliance()
    # What any other law keeps depends on the steps, of which nothing is known yet.
    terms = len(compliance.times) if isinstance(compliance, SeriesCompliance) else 1
    return needed_memory(grid, terms)


def fitting(needs: Iterable[float], available: float) -> int:
    """Return how many runs at once, whichever they are, fit into memory.

    Parameters
    ----------
    needs : iterable of float
        What each holds [bytes].
    available : float
        What there is [bytes].

    Returns
    -------
    int
        0 if the largest does not fit alone.

    Examples
    --------
    >>> fitting([1e8, 2e8, 1.5e8], available=4e8)
    2
    """
    largest_first = sorted(needs, reverse=True)
    return sum(together <= available for together in accumulate(largest_first))
