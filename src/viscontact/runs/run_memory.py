"""Memory of runs, and the number of runs that fit into it at once."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate

from viscontact.bodies.grid import Grid
from viscontact.bodies.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.mechanics import time_integration
from viscontact.simulation import transient
from viscontact.simulation.transient.setup import RunSetup

#: Memory of the program [bytes]. It takes 120 to 190 MB, since the buffers of the linear algebra
#: library differ between processors.
PROGRAM = 1.5e8

#: Grid-sized arrays of a run without symmetry, measured; each term of the law adds two arrays.
WORK_ARRAYS, ARRAYS_PER_TERM = 20.0, 2.0

#: Of a body with symmetry planes: arrays of the whole grid, and those of the cells computed.
WHOLE_ARRAYS, COMPUTED_ARRAYS = 11.1, 6.4

#: Freed arrays of a run that the process keeps, of all cells and of those computed, and the most
#: that is kept for each [bytes], measured with glibc, which gives memory of large arrays back.
#: The same run keeps all of them or none, depending on what was allocated before it.
FREED_WHOLE_ARRAYS, FREED_COMPUTED_ARRAYS, MOST_FREED = 2.0, 4.0, 2.2e7

#: Further ones of the whole grid under friction, measured.
FREED_ARRAYS_OF_FRICTION = 5.0

#: Further arrays under a moving body, and of a sum over all steps.
ARRAYS_OF_MOTION, ARRAYS_OF_SUM = 6.0, 2.0

#: Arrays for the trends of gap and pressure on a creeping body: two of numbers and three of marks.
#: With symmetry planes they are of the cells computed, and those after a step count besides those
#: before it; so do arrays of the whole grid, of which the marks' part is 0.4, the rest measured.
ARRAYS_OF_TRENDS, ARRAYS_OF_MARKS = 2.375, 1.0

#: Arrays of the whole grid under friction: pairs of tractions, of their reference, trend and start,
#: of slip and of the next state, and single ones; and those of each term of the law.
ARRAYS_OF_FRICTION, FRICTION_ARRAYS_PER_TERM = 20.5, 2.0

#: Arrays of the operators and the search on the block of the contact, 62 a cell there, where it is
#: half of the grid; of less of it with symmetries.
ARRAYS_OF_SLIP_SEARCH = 31.0

#: Arrays of the coefficients and operators of each term of layers under shear, likewise.
ARRAYS_OF_LAYERS = 10.0

#: Arrays of the operators on the track of a creeping body that rolls.
ARRAYS_OF_TRACK = 31.0

#: Further arrays where pressure and tractions are coupled, of the whole grid and of the cells
#: computed, measured: fields of the alternation, and spectra of the kernels and of three fields on
#: four times the cells. Each term of the law adds one of the pressure.
ARRAYS_OF_COUPLING, COMPUTED_ARRAYS_OF_COUPLING = 27.0, 30.0

#: Arrays of the computed cells with adhesion: attraction and its slope, gap, a third pair that
#: guesses are extrapolated from, and about ten vectors each of basis and directions of GMRES.
ARRAYS_OF_ADHESION = 32.0

#: Fields that take as much memory as the tables and operators of a further term of layers.
FIELDS_OF_TERM = 7

#: Memory of the time and the scalars of a step [bytes], measured.
BYTES_PER_STEP = 2000.0


def run_memory(run: RunSetup) -> float:
    """Memory of a checked run [bytes], with the scalars of its steps."""
    kept = BYTES_PER_STEP * run.problem.step_count
    further = 0.0 if run.problem.motion.stands else ARRAYS_OF_MOTION
    fields = 0
    for plan in (run.hereditary, *run.other_terms):
        fields += plan.fields_kept
        if not isinstance(plan.compliance, SeriesCompliance):  # with the sums computed ahead
            fields += min(plan.rows, time_integration.BLOCK_STEPS)
            further += ARRAYS_OF_SUM
    fields += FIELDS_OF_TERM * len(run.other_terms)
    creeps = not run.problem.surface.creep.is_elastic
    whole = ARRAYS_OF_TRENDS * creeps
    if any(run.mirrored):
        whole = (2 * 0.5 ** sum(run.mirrored) * ARRAYS_OF_TRENDS + ARRAYS_OF_MARKS) * creeps
    if run.law is not None:
        further += ARRAYS_OF_ADHESION
    if run.problem.friction is not None:
        kept_there = sum(plan.fields_kept for plan in run.shear_plans)
        whole += ARRAYS_OF_FRICTION + FRICTION_ARRAYS_PER_TERM * kept_there
        symmetry = transient.symmetry_of(run)
        share = 1.0 if symmetry is None else 0.5 ** sum(symmetry.mirrored)
        whole += share * ARRAYS_OF_SLIP_SEARCH
        if not (run.problem.motion.stands or run.problem.surface.creep.is_elastic):
            whole += share * ARRAYS_OF_TRACK
        whole += share * ARRAYS_OF_LAYERS * len(run.problem.shear.layers)
        if run.problem.is_coupled:
            whole += ARRAYS_OF_COUPLING + share * COMPUTED_ARRAYS_OF_COUPLING + kept_there
    freed = freed_memory(run.grid, run.mirrored, under_friction=run.problem.friction is not None)
    return array_memory(run.grid, fields, run.mirrored, further=further, whole=whole) + freed + kept


def needed_memory(
    grid: Grid, fields_kept: int, mirrored: tuple[bool, bool] = (False, False)
) -> float:
    """Memory of a run without the scalars of its steps [bytes]; allocates no arrays."""
    return array_memory(grid, fields_kept, mirrored) + freed_memory(grid, mirrored)


def array_memory(
    grid: Grid,
    fields_kept: int,
    mirrored: tuple[bool, bool] = (False, False),
    *,
    further: float = 0.0,
    whole: float = 0.0,
) -> float:
    """Memory of the program and the arrays of a run at a time [bytes]; allocates none.

    `fields_kept` counts the stored fields of pressure, and as many of displacement: one for each
    exponential term of the contact compliance, or one for each step; `further` other arrays of
    the cells that are computed, `whole` of all cells.
    """
    # A body that is even across x = 0, or y = 0 (`mirrored`), needs less.
    share = 0.5 ** sum(mirrored)
    arrays = further + ARRAYS_PER_TERM * fields_kept
    if any(mirrored):
        arrays = WHOLE_ARRAYS + share * (COMPUTED_ARRAYS + arrays)
    else:
        arrays += WORK_ARRAYS
    return PROGRAM + _array_memory(grid) * (arrays + whole)


def freed_memory(
    grid: Grid, mirrored: tuple[bool, bool] = (False, False), *, under_friction: bool = False
) -> float:
    """Memory of freed arrays that the process of a run may keep [bytes]."""
    arrays = FREED_WHOLE_ARRAYS + 0.5 ** sum(mirrored) * FREED_COMPUTED_ARRAYS
    arrays += FREED_ARRAYS_OF_FRICTION * under_friction
    return arrays * min(_array_memory(grid), MOST_FREED)


def _array_memory(grid: Grid) -> float:
    return 8.0 * float(grid.shape[0]) * float(grid.shape[1])


def least_memory(
    grid: Grid, compliance: ContactCompliance, mirrored: tuple[bool, bool] = (False, False)
) -> float:
    """Lower bound of the memory of a run [bytes], known before it is set up."""
    # The fields that other laws store depend on the steps, which are not known yet.
    terms = len(compliance.times) if isinstance(compliance, SeriesCompliance) else 1
    return needed_memory(grid, terms, mirrored)


def fitting(needs: Iterable[float], available: float) -> int:
    """Number of runs that fit into memory [bytes] in any choice; 0 if the largest does not."""
    largest_first = sorted(needs, reverse=True)
    return sum(together <= available for together in accumulate(largest_first))
