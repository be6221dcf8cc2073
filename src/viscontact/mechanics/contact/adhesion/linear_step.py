"""Linear equations of one Newton step of an adhesive contact, solved by GMRES.

The preconditioner is that of the contact solver in contact, which also takes back what changes
beside the contact move there; elsewhere, where the equation is of the second kind, it is about one.
A multiple of the planes' images makes every direction keep the balances.
"""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Singles
from viscontact.mechanics.contact.adhesion.problem import (
    AdhesiveProblem,
    AdhesiveResidual,
    changes_over_cells,
)
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.krylov import gmres, norm
from viscontact.mechanics.contact.patch import Patch
from viscontact.mechanics.contact.problem import Guess

#: Vectors of GMRES.
MAX_VECTORS = 40

#: Spare fields of a patch that are used within one image.
SPARE = 2

#: Attraction below this part of the tolerance is no unknown [-].
NEGLIGIBLE_SHARE = 1e-2

#: Cell sizes that a change of the pressure moves the surface by below a cell: alone about what a
#: square cell does, 4 ln(1 + sqrt 2)/pi = 1.1; with those around it, which change alike, more.
OWN_SHARE, SHARE_ALIKE = 1.0, 2.5

#: Largest part of a change of the pressure that the attraction takes back by what it moves the
#: surface by, in the preconditioner; on coarse cells more would be too much.
LARGEST_ENHANCEMENT = 0.3

#: Nothing that is lacking, and no motion; not to be written to.
NO_MOTION = np.zeros(3)


class LinearStep:
    """Linear equations of one Newton step on a patch, of all cells: those left alone keep p."""

    # Fields, not lists of cells: mostly all of a patch are attracted, and to pick them out takes
    # longer than to compute with the others. Equations in contact are weighed, so that residuals
    # of all equations at the tolerance are alike.

    def __init__(
        self,
        problem: AdhesiveProblem,
        domain: ContactDomain,
        patch: Patch,
        cells: tuple[Bools, Bools],
        checked: AdhesiveResidual,
        lacking: Floats,
        scales: tuple[float, float],
    ) -> None:
        """Take the cells in contact and those attracted, the residual, and its units [Pa, m]."""
        contact, pulled = cells
        self._patch, self.convolutions = patch, 0
        along_x, along_y = domain.periodic
        whole_x, whole_y = (a == b for a, b in zip(patch.shape, domain.shape, strict=True))
        self._periodic = along_x and whole_x, along_y and whole_y
        #: True if the patch is the whole grid, so that `solve` changes the displacement, too.
        self.is_whole = whole_x and whole_y
        #: True if `solve` has ended at the tolerance, not where the residual was reduced.
        self.meets_tolerance = False
        compliance, spacing = problem.contact.compliance, float(np.sqrt(patch.cell_area))
        self._free, self._compliance = problem.contact.constraints.free, compliance
        self._is_free = bool(self._free.any())
        self._contact = np.flatnonzero(contact)
        self._gap, self._traction, self._pulled = checked.gap, checked.attraction.traction, pulled
        self._scale, displacement = scales
        #: Weight of a gap per unit compliance in equations in contact [1/m].
        self._weight = self._scale * compliance / displacement
        if problem.law.is_abrupt:  # its front crosses a cell under errors of a contact beside it
            self._weight = 1 / spacing
        slope, *self._across = (
            np.where(pulled, compliance * each, 0.0).astype(np.float32)
            for each in (checked.attraction.slope, *checked.attraction.slopes_across)
        )
        self._weigh(slope, spacing)
        self._lacking = lacking / patch.cell_area
        if self._is_free:
            self._balance(problem.spring / patch.cell_area)

    def _weigh(self, slope: Singles, spacing: float) -> None:
        """Prepare factors of the equations, by the slope of the attraction per unit compliance."""
        #: Factor of a change of the gap, per unit compliance, in each equation [1/m].
        self._of_gap = slope.copy()
        self._of_gap.ravel()[self._contact] = self._weight
        self._open = np.ones(self._patch.shape, np.float32)
        self._open.ravel()[self._contact] = 0.0
        self._closed = 1 - self._open
        # Where the attraction grows with the gap, a change of the pressure is resisted, where it
        # falls with the gap beside a contact, enhanced.
        followed = np.maximum(slope, 0.0)
        if self._contact.size:
            followed += SHARE_ALIKE * np.minimum(slope, 0.0)
        followed *= np.float32(spacing)
        #: About the change of the pressure outside the contact that a residual calls for [-].
        self._answer = self._open / (1 + np.maximum(followed, -LARGEST_ENHANCEMENT))
        #: What the contact takes back of a residual: in contact what its equation takes the gap by,
        #: inverted, elsewhere what the answer to it moves the surface by below itself [m].
        self._moving = self._closed * np.float32(1 / self._weight)
        self._moving += np.float32(OWN_SHARE * spacing) * self._answer

    def _balance(self, spring: float) -> None:
        """Prepare how much of each free motion meets what is lacking; stiffness by area [N/m³]."""
        patch = self._patch
        modes = (patch.plane.field(unit) for unit in np.eye(3))
        self._planes = [np.broadcast_to(mode, patch.shape) for mode in modes]
        self._shares = [self._share(mode) for mode in range(3)]
        matrix = np.array([patch.plane.sums(share) for share in self._shares]).T
        matrix[0, 0] += spring
        fixed = ~self._free
        matrix[fixed], matrix[:, fixed] = 0.0, 0.0
        matrix[fixed, fixed] = 1.0
        self._inverse = np.linalg.pinv(matrix)

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
        patch, pulled = domain.whole, ~checked.in_contact
        if not _reaches_all_edges(checked.attraction.traction, least):
            active = checked.in_contact | (np.abs(checked.attraction.traction) > least)
            active |= iterate.pressure != 0
            patch, pulled = domain.patch_around(active), pulled & active
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
        cells = cut.in_contact, patch.cut(pulled)
        lacking = problem.lacking(iterate, domain)
        displacement = problem.displacement(iterate, math.sqrt(patch.cell_area))
        return cls(problem, domain, patch, cells, cut, lacking, (scale, displacement))

    def solve(self, iterate: Guess, reduction: float, tolerance: float) -> Floats:
        """Add the change to the pressure of an iterate; return its motion.

        Ends where the residual is reduced by a factor, or to a norm of so many strengths. On the
        whole grid the displacement follows, in the precision of the search.
        """
        here, everywhere = self._patch.cut(iterate.pressure), iterate.unit_displacement
        right = np.where(self._pulled, -(here + self._traction), 0.0).astype(np.float32)
        gap = self._gap.ravel()[self._contact] * (self._weight / self._compliance)
        right.ravel()[self._contact] = -gap
        taken: list[tuple[Singles, Singles, Floats]] = []
        spare = self._patch.operators.spare

        def image(vector: Singles, lacking: Floats) -> Singles:
            change, lifted, found = (spare(SPARE + 3 * len(taken) + each) for each in range(3))
            motion = self._direction(vector.reshape(right.shape), lacking, change)
            self._patch.convolution.apply(change, into=lifted)
            self.convolutions += 1
            taken.append((change, lifted, motion))
            self._image(*taken[-1], found)
            return found.ravel()

        left, weights = right.ravel(), []
        goal, least = reduction * norm(left), tolerance * self._scale
        self.meets_tolerance, goal = goal <= least, max(goal, least)
        if self._lacking.any():
            left, weights = left - image(right, self._lacking), [1.0]
        factors, _ = gmres(lambda vector: image(vector, NO_MOTION), left, goal, MAX_VECTORS)

        motion, part = iterate.motion, spare(0)
        change, lifted = np.zeros((2, *right.shape), np.float32)
        for factor, (other, raised, moved) in zip([*weights, *factors], taken, strict=True):
            change += np.multiply(other, np.float32(factor), out=part)
            motion = motion + factor * moved
            if self.is_whole:
                lifted += np.multiply(raised, np.float32(factor), out=part)
        here += change
        if self.is_whole:
            everywhere += lifted
        return motion

    def _direction(self, vector: Singles, lacking: Floats, into: Singles) -> Floats:
        """Preconditioned change of pressure [Pa] and of the motion for a residual [Pa]."""
        change = self._preconditioned(vector, into)
        if not self._is_free:
            return NO_MOTION
        sums = self._patch.plane.sums(change)
        motion = self._inverse @ np.where(self._free, lacking - sums, 0.0)
        for amount, share in zip(motion, self._shares, strict=True):
            if amount:
                change += np.float32(amount) * share
        return motion

    def _image(self, change: Singles, lifted: Singles, motion: Floats, into: Singles) -> None:
        """Left sides of the equations for a change [Pa] and its unit displacement [Pa m]."""
        opened, part = lifted, self._patch.operators.spare(0)
        if self._is_free and motion.any():
            plane = self._patch.plane.field(motion / self._compliance, np.float32)
            opened = np.subtract(lifted, plane, out=self._patch.operators.spare(1))
        np.multiply(opened, self._of_gap, out=into)
        into += np.multiply(self._open, change, out=part)
        changes = changes_over_cells(opened, self._periodic) if self._across else ()
        for factor, each in zip(self._across, changes, strict=True):
            into += factor * each

    def _preconditioned(self, vector: Singles, into: Singles) -> Singles:
        """About the pressure that a residual calls for [Pa]."""
        np.multiply(vector, self._answer, out=into)
        if self._contact.size:
            field = np.multiply(vector, self._moving, out=self._patch.operators.spare(0))
            self._patch.preconditioner.apply(field, into=field)
            field *= self._closed
            into += field
        return into

    def _share(self, mode: int) -> Singles:
        """About the pressure by a unit of one rigid motion: of cells in contact, if there are."""
        if not self._free[mode]:
            return np.zeros(self._patch.shape, np.float32)
        pressed = self._of_gap * self._planes[mode] / self._compliance
        if self._contact.size:
            pressed *= self._closed
        return self._preconditioned(pressed.astype(np.float32), np.empty_like(self._open))


def _reaches_all_edges(traction: Floats, least: float) -> bool:
    """True if a traction above a least one reaches each edge of its field [Pa]."""
    edges = traction[0], traction[-1], traction[:, 0], traction[:, -1]
    return all(float(each.max()) > least for each in edges)
