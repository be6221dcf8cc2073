"""Sizes of the cells and the steps of coarser runs, in those of the run."""

from __future__ import annotations

#: Least number of cells across the largest contact, and cell sizes of the coarser runs, in cells of
#: the run. Lines of centres of whole multiples would lie on those of the run: the rims of all grids
#: might then agree by chance.
CELL_RATIOS = ((40, (1.9, 2.9)), (0, (1.5, 2.4)))

#: Number of steps below which a third run estimates their errors, however small the estimated
#: time errors are: the first step behind a kink of the load has none.
FEW_STEPS = 16

#: Least number of steps of the run, and step sizes of its coarser runs, in steps of the run.
STEP_RATIOS = ((32, (4, 8)), (FEW_STEPS, (2, 4)), (7, (2, 2)), (0, (1, 1)))


def usual_coarsening(steps: int, across: float) -> tuple[tuple[float, int], ...]:
    """Ratios of cells and of steps of the coarser runs, by the run's steps and cells across."""
    return tuple(zip(ratios_of_cells(across), ratios_of_steps(steps), strict=True))


def ratios_of_cells(across: float) -> tuple[float, float]:
    """Ratios of cells by the number of those of the run across its largest contact."""
    return next(ratios for least, ratios in CELL_RATIOS if across >= least)


def ratios_of_steps(steps: int) -> tuple[int, int]:
    """Ratios of steps by the number of those of the run."""
    return next(ratios for least, ratios in STEP_RATIOS if steps >= least)
