"""Memory of runs, and the number of runs that fit into it at once."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate

from viscontact.grid import Grid
from viscontact.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.simulation.setup import RunSetup
from viscontact.steady.preparation import SteadySetup

#: Memory of the program [bytes], and number of grid-sized arrays of a run, both measured for a body
#: without symmetry planes; each term of the law adds two arrays. The program takes 150 to 190 MB,
#: since the buffers of the linear algebra library differ between processors.
PROGRAM, WORK_ARRAYS, ARRAYS_PER_TERM = 2.2e8, 56, 2

#: Arrays of a state over speed on the grid of all speeds.
ARRAYS_OF_STATE = 4

#: Fields that take as much memory as the tables and operators of a further term of layers.
#: In steady motion, which keeps no history, as many as these.
ARRAYS_OF_TERM, ARRAYS_OF_MOVING_TERM = 12, 3

#: Memory of the time and the scalars of a step [bytes], measured.
BYTES_PER_STEP = 2000.0


def run_memory(run: RunSetup) -> float:
    """Memory of a checked run [bytes], with the scalars of its steps."""
    kept = BYTES_PER_STEP * run.problem.step_count
    return needed_memory(run.grid, fields_kept(run)) + kept


def fields_kept(run: RunSetup) -> int:
    """Stored fields of pressure of a run; each further term of layers adds a few operators."""
    further = sum(plan.fields_kept + ARRAYS_OF_TERM for plan in run.other_terms)
    return run.hereditary.fields_kept + further


def curve_memory(run: SteadySetup) -> float:
    """Memory of a checked run over speed [bytes]; its fields are written as they are found."""
    largest = max(run.grids, key=lambda grid: grid.shape[0] * grid.shape[1])
    kept = 8.0 * ARRAYS_OF_STATE * run.grid.shape[0] * run.grid.shape[1]
    further = len(run.problem.contact.surface.terms) - 1
    return needed_memory(largest, ARRAYS_OF_MOVING_TERM * further) + kept


def needed_memory(grid: Grid, fields_kept: int) -> float:
    """Memory of a run without the scalars of its steps [bytes]; allocates no arrays.

    `fields_kept` counts the stored fields of pressure, and as many of displacement: one for each
    exponential term of the contact compliance, or one for each step.

    >>> round(needed_memory(Grid((1000, 1000), (1.0, 1.0)), fields_kept=2) / 1e6)
    700
    """
    nx, ny = grid.shape
    return PROGRAM + 8.0 * float(nx) * float(ny) * (WORK_ARRAYS + ARRAYS_PER_TERM * fields_kept)


def least_memory(grid: Grid, compliance: ContactCompliance) -> float:
    """Lower bound of the memory of a run [bytes], known before it is set up.

    >>> from viscontact.laws import Zener
    >>> from viscontact.materials.material import Material
    >>> rubber = Material(Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    >>> round(least_memory(Grid((1000, 1000), (1.0, 1.0)), rubber.contact_compliance()) / 1e6)
    684
    """
    # The fields that other laws store depend on the steps, which are not known yet.
    terms = len(compliance.times) if isinstance(compliance, SeriesCompliance) else 1
    return needed_memory(grid, terms)


def fitting(needs: Iterable[float], available: float) -> int:
    """Number of runs, in any choice, that fit into memory at once; needs and memory in bytes.

    0 if the largest does not fit alone.

    >>> fitting([1e8, 2e8, 1.5e8], available=4e8)
    2
    """
    largest_first = sorted(needs, reverse=True)
    return sum(together <= available for together in accumulate(largest_first))
