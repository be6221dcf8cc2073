"""Frictional equilibrium of one time step, by Newton's method on the discs |q| <= μ p.

0. Tractions under a changed force are predicted (`predicted`).
1. The rigid motion by least squares, the slip w under it, and the residual of the friction law.
2. Free directions: both in cells that stick, the tangent in those that slip. A cell on its circle
   whose slip has the direction of its traction is released.
3. Newton's step on the free directions, where the curvature of the circle adds λ/(μ p) along the
   tangents. The matrix is symmetric and positive: conjugate gradients (`newton_step`).
4. Tractions are cut off at the discs, and their resultants restored.
5. Where next to no cell sticks and the residual does not fall, tractions of a contact that slides
   as a whole are tried (`sliding`).
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.friction.discs import balanced, lengths, on_circle
from viscontact.mechanics.contact.friction.newton_step import NewtonStep, newton_step
from viscontact.mechanics.contact.friction.predicted import predicted
from viscontact.mechanics.contact.friction.problem import ShearBlock, SlipProblem, SlipSolution
from viscontact.mechanics.contact.friction.residual import (
    SlipResidual,
    duality_gap,
    slip_residual,
)
from viscontact.mechanics.contact.friction.sliding import sliding_traction

#: Newton's steps of one solve.
MAX_STEPS = 60

#: Parts of a Newton step that are tried until one lowers the objective.
PARTS = (1.0, 0.3, 0.09)

#: Part that is taken where none does, in turn: so the slip set does not go around in circles.
FALLBACKS = (1.0, 0.3)

#: Relative difference of objectives that is rounding, of displacements in single precision: taken
#: for a rise, good steps were shortened, and some searches went around in circles.
ROUNDING = 1e-7

#: Tolerance that single precision is too coarse for; its error of a displacement over the largest,
#: and the part of the tolerance that errors of a solution by it are up to.
FINE, SINGLE, NEGLIGIBLE = 1e-5, 5e-7, 0.1

#: Part of the cells that may stick where sliding is tried, and part of the residual that it leaves
#: at most.
FEW, LESS = 0.1, 0.5

#: Vain tries of sliding, as under a force beyond what friction carries.
MOST_TRIES = 3

#: Part of what friction carries that a traction may lack to count as slipping: closer to its circle
#: a cell sticks or slips by the accuracy of the search, now this way and now that.
REACHED = 1e-4

#: Imbalance of a solution over the force that friction carries.
IMBALANCE = 1e-9


def solve_slip(
    problem: SlipProblem,
    block: ShearBlock,
    start: Floats,
    *,
    tolerance: float,
    motion: Floats | None = None,
) -> SlipSolution:
    """Solve for traction and rigid motion from a given traction, and a motion; see the module.

    ``converged`` is False if the residual or the balances are not met, as where the prescribed
    forces exceed what friction carries.
    """
    traction = _first(problem, block, start, motion)
    found = _judged(problem, block, traction, motion, single=tolerance > FINE)
    iterations, convolutions, failures, tries = 0, 1, 0, MOST_TRIES
    rounding = 0.0  # of the displacement, over the largest
    for _ in range(MAX_STEPS):
        if found.error <= tolerance:
            break
        step = newton_step(problem, block, traction, found, tolerance)
        iterations += step.iterations
        trial, judged, tried = _along(problem, block, (traction, found), step, failures)
        convolutions += step.convolutions + tried
        failures += not _is_better(judged, found)
        # The change of the displacement is about as large as the residual was.
        rounding += SINGLE * found.error
        if judged.error <= tolerance <= FINE and rounding > NEGLIGIBLE * tolerance:
            judged, rounding = _judged(problem, block, trial, judged.motion), 0.0
            convolutions += 1
        if tries > 0 and _may_slide(judged, max(LESS * found.error, tolerance)):
            slid = _slid(problem, block, trial, judged)
            convolutions += 1
            if slid[1].error < LESS * judged.error:
                trial, judged = slid
            else:
                tries -= 1
        traction, found = trial, judged
    return _solution(problem, block, traction, found, (iterations, convolutions), tolerance)


def _first(problem: SlipProblem, block: ShearBlock, start: Floats, motion: Floats | None) -> Floats:
    """Traction on the discs with the prescribed resultants; without a motion it is predicted."""
    if motion is None:
        start = predicted(start, problem.bound, block.shift, problem.constraints)
    slips = on_circle(start, problem.bound, problem.in_contact)
    return balanced(start, problem.bound, block.shift, problem.constraints, slips)


def _along(
    problem: SlipProblem,
    block: ShearBlock,
    known: tuple[Floats, SlipResidual],
    step: NewtonStep,
    failures: int,
) -> tuple[Floats, SlipResidual, int]:
    """Traction after the first part of a step that is better, or the last one; parts tried."""
    (traction, found), tried = known, 0
    for part in (*PARTS, FALLBACKS[failures % len(FALLBACKS)]):
        tried += 1
        trial = traction + part * step.traction
        trial = balanced(trial, problem.bound, block.shift, problem.constraints, step.slips)
        moved = found.motion + part * step.motion
        judged = _judged_near(problem, block, known, trial, moved)
        if _is_better(judged, found):
            break
    return trial, judged, tried


def _may_slide(found: SlipResidual, most: float) -> bool:
    """True if few cells stick and the residual is larger than a step may leave."""
    sticks, slips = (
        np.count_nonzero(each) for each in (found.directions.sticks, found.directions.slips)
    )
    return bool(found.error > most and sticks <= FEW * (sticks + slips))


def _slid(
    problem: SlipProblem, block: ShearBlock, traction: Floats, found: SlipResidual
) -> tuple[Floats, SlipResidual]:
    """Traction of a contact that slides as a whole, with its residual."""
    pull, motion = sliding_traction(problem, block.shift, traction, found)
    slips = on_circle(pull, problem.bound, problem.in_contact)
    pull = balanced(pull, problem.bound, block.shift, problem.constraints, slips)
    return pull, _judged(problem, block, pull, motion)


def _is_better(new: SlipResidual, old: SlipResidual) -> bool:
    """True if the objective falls, or the residual where it differs by rounding only."""
    change = new.rise_since(old)
    if abs(change) > ROUNDING * old.work:
        return change < 0
    return new.error < old.error


def _judged(
    problem: SlipProblem,
    block: ShearBlock,
    traction: Floats,
    motion: Floats | None = None,
    *,
    single: bool = False,
) -> SlipResidual:
    """Residual of a traction by a fresh convolution, near a motion."""
    operator = block.search if single else block.convolution
    moved = problem.displaced(operator, traction)
    return slip_residual(problem, block.shift, traction, moved, motion)


def _judged_near(
    problem: SlipProblem,
    block: ShearBlock,
    known: tuple[Floats, SlipResidual],
    traction: Floats,
    motion: Floats,
) -> SlipResidual:
    """Residual of a traction near a known one: the change by it is found in single precision."""
    before, found = known
    moved = found.unit_displacement + block.search.apply(traction - before)
    return slip_residual(problem, block.shift, traction, moved, motion)


def _solution(
    problem: SlipProblem,
    block: ShearBlock,
    traction: Floats,
    found: SlipResidual,
    spent: tuple[int, int],
    tolerance: float,
) -> SlipSolution:
    carried = float(problem.bound.sum()) * block.shift.cell_area
    resultants = block.shift.resultants(traction)
    meets = carried == 0 or problem.constraints.imbalance(resultants, carried) <= IMBALANCE
    # All cells on their circles: in a held load slip is rounding, in this direction or that.
    slips = on_circle(traction, problem.bound, problem.in_contact)
    reaches = problem.in_contact & (lengths(traction) >= (1 - REACHED) * problem.bound)
    return SlipSolution(
        traction,
        found.motion,
        found.slip * slips,
        found.slip,
        problem.in_contact.astype(np.int8) + reaches,
        found.error,
        duality_gap(problem, traction, found.slip, found.displacement),
        found.displacement,
        *spent,
        converged=found.error <= tolerance and meets,
    )
