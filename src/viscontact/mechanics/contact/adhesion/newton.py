"""Semismooth Newton method for an adhesive contact.

The unknowns are the pressure p on the cells in contact and on those that attract each other, and
the free rigid motions c. With the gap g = h + J K p - plane(c) and D = -sigma'(g) the equations of
a step (Hintermueller, Ito & Kunisch 2003, SIAM J. Optim. 13, 865) are

    in contact:   (J K dp - plane(dc))/(J d) = -g/(J d)
    attracted:    dp - D (J K dp - plane(dc)) = -(p + sigma(g))
    balances:     sums(dp) dA + k dc = what is lacking

with the cell size d, and k the spring of the stage. The front of a law that ends abruptly is as
wide as the gap changes over a cell, so D acts on these changes, too. The equations are solved by
GMRES. Its preconditioner is that of the contact solver in contact, and one elsewhere, where the
equation is of the second kind; a multiple of the planes' images makes every direction keep the
balances.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.adhesion.problem import (
    AdhesiveProblem,
    AdhesiveResidual,
    changes_over_cells,
    residual_of,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.krylov import gmres, norm
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import Guess

#: Newton steps of one search; from an extrapolated guess 3 to 6 are needed.
MAX_STEPS = 20

#: Vectors of GMRES.
MAX_VECTORS = 40

#: Reduction of the residual at which it ends [-]: far from the solution, where sets of cells still
#: change, and from a residual of so many strengths on.
REDUCTION_AFAR, REDUCTION, NEAR = 1e-1, 1e-3, 1e-2

#: Part of the tolerance down to which a linear system is solved, in its norm, which is larger than
#: the largest residual.
INNER_TOLERANCE = 0.5

#: Growth of the residual over the least one at which a search is given up [-].
DIVERGED = 1e3

#: Attraction below this part of the tolerance is no unknown [-].
NEGLIGIBLE_SHARE = 1e-2


@dataclass(frozen=True, eq=False)
class NewtonSearch:
    """Last pressure of a search, with its residual and cost."""

    iterate: Guess
    checked: AdhesiveResidual
    steps: int
    convolutions: int
    converged: bool
    predicted: float  # sum of the attraction at the start over the cells [Pa]


def newton_search(
    problem: AdhesiveProblem,
    domain: ContactDomain,
    start: Guess,
    tolerance: float,
    max_steps: int = MAX_STEPS,
) -> NewtonSearch:
    """Search from a pressure, whose memory is used, until the residual meets the tolerance.

    Its displacement may be a guess, too.
    """
    iterate, convolutions = start, 0
    checked = residual_of(problem, domain, iterate)
    if checked.error <= tolerance:
        domain.convolution.apply(iterate.pressure, into=iterate.unit_displacement)
        checked = residual_of(problem, domain, iterate)
        convolutions = 1
    least = checked.error
    predicted = float(checked.attraction.traction.sum())
    for step in range(max_steps):
        if checked.error <= tolerance:
            return NewtonSearch(iterate, checked, step, convolutions, True, predicted)
        if not checked.error <= DIVERGED * max(least, tolerance):
            break
        system = LinearStep.of(problem, domain, iterate, checked, tolerance)
        reduction = REDUCTION if checked.error <= NEAR else REDUCTION_AFAR
        motion = iterate.motion + system.solve(iterate.pressure, reduction)
        iterate = Guess(iterate.values, motion)
        domain.convolution.apply(iterate.pressure, into=iterate.unit_displacement)
        checked = residual_of(problem, domain, iterate)
        least = min(least, checked.error)
        convolutions += system.convolutions + 1
    converged = checked.error <= tolerance
    return NewtonSearch(iterate, checked, max_steps, convolutions, converged, predicted)


class LinearStep:
    """Linear equations of one Newton step on a patch."""

    def __init__(
        self,
        problem: AdhesiveProblem,
        patch: Patch,
        cells: tuple[Bools, Bools],
        checked: AdhesiveResidual,
        lacking: Floats,
        goal: float,
        periodic: tuple[bool, bool] = (False, False),
    ) -> None:
        """Take the cells in contact and those attracted, the residual, and where to end [Pa]."""
        self._patch, self._cells, self.convolutions = patch, cells[0] | cells[1], 0
        self._contact = cells[0][self._cells]
        self._goal, self._compliance = goal, problem.contact.compliance
        self._spacing = float(np.sqrt(patch.cell_area))
        self._free = problem.contact.constraints.free
        slope = checked.attraction.slope[self._cells]
        #: Factor of a change of the gap in each equation [Pa/m].
        self._of_gap = np.where(self._contact, 1 / (self._compliance * self._spacing), slope)
        #: Equations of cells whose attraction grows with the gap are stiff [-].
        self._stiffness = 1 + np.maximum(slope, 0.0) * self._compliance * self._spacing
        self._across = [each[self._cells] for each in checked.attraction.slopes_across]
        self._periodic = periodic
        self._gap = checked.gap[self._cells]
        self._traction = checked.attraction.traction[self._cells]
        self._lacking = lacking / patch.cell_area
        modes = (patch.plane.field(unit) for unit in np.eye(3))
        self._planes = [np.broadcast_to(mode, patch.shape)[self._cells] for mode in modes]
        self._shares = [self._share(mode) for mode in range(3)]
        matrix = np.array([self._sums(share) for share in self._shares]).T
        matrix[0, 0] += problem.spring / patch.cell_area
        fixed = ~self._free
        matrix[fixed], matrix[:, fixed] = 0.0, 0.0
        matrix[fixed, fixed] = 1.0
        self._inverse = np.linalg.pinv(matrix)
        self._spring = problem.spring / patch.cell_area

    @classmethod
    def of(
        cls,
        problem: AdhesiveProblem,
        domain: ContactDomain,
        iterate: Guess,
        checked: AdhesiveResidual,
        tolerance: float,
    ) -> LinearStep:
        """Step from an iterate, on the patch around the cells that bear traction."""
        scale = problem.traction_scale(iterate)
        least = NEGLIGIBLE_SHARE * tolerance * scale
        active = checked.in_contact | (np.abs(checked.attraction.traction) > least)
        active |= iterate.pressure != 0
        patch = domain.patch_around(active)
        cut = AdhesiveResidual(
            patch.cut(checked.gap),
            type(checked.attraction)(
                patch.cut(checked.attraction.traction),
                patch.cut(checked.attraction.slope),
                tuple(patch.cut(each) for each in checked.attraction.slopes_across),
            ),
            patch.cut(checked.in_contact),
            *(checked.of_gap, checked.of_traction, checked.imbalance),
        )
        cells = cut.in_contact, patch.cut(active & ~checked.in_contact)
        lacking = problem.lacking(iterate, domain)
        goal = INNER_TOLERANCE * tolerance * scale
        along_x, along_y = domain.periodic
        whole_x, whole_y = (a == b for a, b in zip(patch.shape, domain.shape, strict=True))
        periodic = along_x and whole_x, along_y and whole_y
        return cls(problem, patch, cells, cut, lacking, goal, periodic)

    def solve(self, pressure: Floats, reduction: float) -> Floats:
        """Add the change to a pressure on the whole grid [Pa]; return that of the motion."""
        here = self._patch.cut(pressure)
        missing = -(here[self._cells] + self._traction)
        right = np.where(self._contact, -self._gap * self._of_gap, missing)
        directions: list[tuple[Floats, Floats]] = []

        def image(vector: Floats) -> Floats:
            directions.append(self._direction(vector, np.zeros(3)))
            return self._image(*directions[-1])

        change, motion = self._direction(right, self._lacking)
        left = right - self._image(change, motion)
        goal = max(reduction * norm(right), self._goal)
        factors, _ = gmres(image, left, goal, MAX_VECTORS)
        for factor, (direction, moved) in zip(factors, directions, strict=True):
            change += factor * direction
            motion = motion + factor * moved
        here[self._cells] += change
        return motion

    def _direction(self, vector: Floats, lacking: Floats) -> tuple[Floats, Floats]:
        """Preconditioned change of pressure [Pa] and of the motion for a residual [Pa]."""
        change = self._preconditioned(vector)
        if not self._free.any():
            return change, np.zeros(3)
        motion = self._inverse @ np.where(self._free, lacking - self._sums(change), 0.0)
        for part, share in zip(motion, self._shares, strict=True):
            if part:
                change += part * share
        return change, motion

    def _image(self, change: Floats, motion: Floats) -> Floats:
        """Left sides of the equations for a change [Pa]."""
        field = np.zeros(self._patch.shape)
        field[self._cells] = change
        self.convolutions += 1
        opened = self._compliance * self._patch.convolution.apply(field)
        if motion.any():
            opened = opened - self._patch.plane.field(motion)
        found = self._of_gap * opened[self._cells]
        pulled = ~self._contact
        found[pulled] += change[pulled]
        changes = changes_over_cells(opened, self._periodic) if self._across else ()
        for factor, each in zip(self._across, changes, strict=True):
            found[pulled] += (factor * each[self._cells])[pulled]
        return found

    def _preconditioned(self, vector: Floats) -> Floats:
        """About the pressure that a residual calls for [Pa]."""
        attracted = vector / self._stiffness
        if not self._contact.any():
            return attracted
        field = np.zeros(self._patch.shape)
        field[self._cells] = np.where(self._contact, vector, 0.0) * self._spacing
        pressed = self._patch.preconditioner.apply(field)[self._cells]
        return np.where(self._contact, pressed, attracted)

    def _share(self, mode: int) -> Floats:
        """About the pressure by a unit of one rigid motion: of cells in contact, if there are."""
        if not self._free[mode]:
            return np.zeros(self._contact.shape)
        pressed = self._of_gap * self._planes[mode]
        if self._contact.any():
            pressed = np.where(self._contact, pressed, 0.0)
        return self._preconditioned(pressed)

    def _sums(self, change: Floats) -> Floats:
        """Sums of a change against 1, x, y."""
        field = np.zeros(self._patch.shape)
        field[self._cells] = change
        return self._patch.plane.sums(field)
