"""Work that a load does on a contact over a step."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution

#: Most by which the work of a step differs from that of the mean loads, over the product of the
#: changes of load and approach [-]; and where the bodies are apart for a part of the step.
MOST_OF_CHANGES, MOST_WHERE_APART = 0.25, 0.5


def first_work(run: RunSetup, solution: StepSolution) -> float:
    """Work of the jump that every run starts with [J]."""
    return run.problem.compliance.instant * solution.energy - solution.adhesion_energy


def work_of_step(
    run: RunSetup, before: StepSolution, solution: StepSolution, *, held: bool
) -> float:
    """Work over a step [J], with what the attraction did before in cells the grid has gained.

    Exact while the load is held, and on elastic bodies, with two exceptions where they adhere: a
    law that ends abruptly, and a step that jumped or may have, as one of the shortest length. These
    take mean force times travel, as creeping bodies that adhere do.
    """
    # With it a run whose grid grows goes on as one on the large grid: what the load has done on an
    # elastic body is its energy, and a closed path without jumps takes none.
    return _within(run, before, solution, held=held) + before.work_beyond


def _within(run: RunSetup, before: StepSolution, solution: StepSolution, *, held: bool) -> float:
    """Work within a step [J]."""
    travel = solution.motion - before.motion
    of_load = float((before.resultants + solution.resultants) @ travel / 2)
    if held or (run.law is not None and not _gives_back(run, run.law, solution)):
        return of_load
    # Where the load moves, force times approach is not exact, as an elastic contact's force is
    # no straight function of its approach; a cycle in long steps would gain energy. Mean
    # pressure times change of displacement, which moves with the body wherever there is
    # pressure, is exact by reciprocity, however far the step goes.
    mean = (before.pressure + solution.pressure) / 2
    moved = solution.displacement - before.displacement
    work = float(np.einsum("ij,ij->", mean, moved)) * run.grid.cell_area
    # The attraction does the work that separating the surfaces takes less.
    work += before.adhesion_energy - solution.adhesion_energy
    if not run.problem.motion.stands or run.law is not None:
        return work
    # Where the body creeps much within a step, pressure moves on while the load hardly does. By
    # the means of the loads the work errs by at most half the product of both changes, for an
    # elastic force δ^m by |1/2 - 1/(m + 1)| of it: a sixth under a cone. On the way without
    # contact there is no work, on either side.
    change = solution.resultants - before.resultants
    apart = before.resultants[0] <= 0 or solution.resultants[0] <= 0
    part = MOST_WHERE_APART if apart else MOST_OF_CHANGES
    most = part * abs(float(change @ travel))
    return min(max(work, of_load - most), of_load + most)


def _gives_back(run: RunSetup, law: CohesiveLaw, solution: StepSolution) -> bool:
    """True of a step of bodies that adhere whose work is a change of their energy."""
    # What a jump loses is no work of the load, nor what creep does, for which means of pressure and
    # displacement are no better than those of force and approach. Where the front of a law that
    # ends abruptly crosses a cell, the traction is no slope of an energy.
    return run.problem.surface.creep.is_elastic and not (solution.jumped or law.is_abrupt)
