"""Adhesive contact problem of one time step, and the attraction over a gap."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.problem import ContactProblem, Guess

#: Largest pressure over which residuals of the traction are relative at most, in strengths [-].
LARGEST_PRESSURE_SHARE = 1e-6


@dataclass(frozen=True, eq=False)
class AdhesiveProblem:
    """Contact problem of bodies that attract each other, p = q - sigma(g) with q, g >= 0, q g = 0.

    A stage on a spring holds the body: its position less the spring's deflection is the approach.
    """

    contact: ContactProblem  # of a stage: with the force spring · position as the resultant
    law: CohesiveLaw
    spring: float = 0.0  # stiffness of the stage that a free approach hangs on [N/m]

    def gap(self, iterate: Guess, domain: ContactDomain) -> Floats:
        """Gap under a pressure, +inf outside the body [m]."""
        contact, plane = self.contact, domain.whole.plane
        gap = contact.open_gap + contact.compliance * iterate.unit_displacement
        gap -= plane.field(iterate.motion)
        return gap

    def lacking(self, iterate: Guess, domain: ContactDomain) -> Floats:
        """Force [N] and moments [N m] that a pressure lacks; 0 of a prescribed motion."""
        constraints, whole = self.contact.constraints, domain.whole
        sums = whole.plane.sums(iterate.pressure) * whole.cell_area
        pull = np.array([self.spring * iterate.motion[0], 0.0, 0.0])
        return np.where(constraints.free, constraints.targets - pull - sums, 0.0)

    def displacement(self, iterate: Guess, spacing: float) -> float:
        """Displacement that errors of the gap are relative to [m], on cells of an edge [m]."""
        compliance = self.contact.compliance
        largest = compliance * largest_size(iterate.unit_displacement)
        # Without a load a flat punch has no pressure where attraction and contact cancel.
        of_cell = compliance * self.law.strength * spacing
        return max(self.contact.displacement_scale, largest, of_cell)

    def traction_scale(self, iterate: Guess) -> float:
        """Traction that errors of the traction are relative to [Pa]."""
        largest = largest_size(iterate.pressure)
        return max(self.law.strength, LARGEST_PRESSURE_SHARE * largest)

    def without_force(self) -> AdhesiveProblem:
        """Same problem without the prescribed force."""
        constraints = self.contact.constraints
        free = replace(constraints, resultants=(0.0, *constraints.resultants[1:]))
        return replace(self, contact=replace(self.contact, constraints=free))

    def on_spring(self, spring: float, position: float) -> AdhesiveProblem:
        """Same problem of a body on a stage at a position [m]."""
        constraints = self.contact.constraints
        resultants = (spring * position, *constraints.resultants[1:])
        held = replace(constraints, resultants=resultants)
        return replace(self, contact=replace(self.contact, constraints=held), spring=spring)


@dataclass(frozen=True, eq=False)
class Attraction:
    """Attraction on the cells at a gap."""

    traction: Floats  # positive [Pa]
    slope: Floats  # its derivative by the gap [Pa/m]
    #: Of a law that ends abruptly: its derivatives by the halved differences of the gaps of the two
    #: neighbours along each axis [Pa/m].
    slopes_across: tuple[Floats, ...] = ()


def attraction(law: CohesiveLaw, gap: Floats, periodic: tuple[bool, bool]) -> Attraction:
    """Attraction at a gap [m]; of cells that overlap that at contact."""
    open_gap = np.maximum(gap, 0.0)
    if not law.is_abrupt:
        return Attraction(*law.traction_and_slope(open_gap))
    # Along its steepest direction.
    changes = changes_over_cells(open_gap, periodic)
    across = np.sqrt(sum(change**2 for change in changes))
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(across > 0, law.slope_across(open_gap, across) / across, 0.0)
    return Attraction(
        law.traction(open_gap, across),
        law.slope(open_gap, across),
        tuple(share * change for change in changes),
    )


def changes_over_cells(gap: Numbers, periodic: tuple[bool, bool]) -> tuple[Numbers, Numbers]:
    """Changes of a gap over a cell along both axes [m], by central differences."""

    def along(axis: int) -> Numbers:
        ends = [(1, 1) if each == axis else (0, 0) for each in (0, 1)]
        padded = np.pad(gap, ends, mode="wrap" if periodic[axis] else "edge")
        lines = np.moveaxis(padded, axis, 0)
        with np.errstate(invalid="ignore"):  # inf - inf outside the body
            change = np.moveaxis(lines[2:] - lines[:-2], 0, axis) / 2
        return np.where(np.isfinite(change), change, 0.0)

    return along(0), along(1)


@dataclass(frozen=True, eq=False)
class AdhesiveSolution(ContactSolution):
    """Solution of an adhesive contact; its residual is the larger one of gap and traction."""

    traction: Floats  # attraction, positive [Pa]
    predicted: float = 0.0  # sum of the attraction of the guess over the cells [Pa]


@dataclass(frozen=True, eq=False)
class AdhesiveResidual:
    """Residual of the conditions for a pressure, on the whole grid."""

    gap: Floats  # [m]
    attraction: Attraction
    in_contact: Bools
    of_gap: float  # largest gap in contact or overlap, over the largest displacement [-]
    of_traction: float  # largest missing attraction off contact, over the strength [-]
    imbalance: float  # of force and moments, over the largest force [-]

    @property
    def error(self) -> float:
        """Relative residual [-]; NaN if a part of it is."""
        return _largest(self.of_gap, self.of_traction, self.imbalance)


def _largest(*values: float) -> float:
    """The largest of some values; unlike Python's `max`, NaN if there is one."""
    return math.nan if any(map(math.isnan, values)) else max(values)


def residual_of(
    problem: AdhesiveProblem, domain: ContactDomain, iterate: Guess
) -> AdhesiveResidual:
    """Residual of a pressure and motion; the contact is that of the semismooth method.

    In contact are the cells where q - g/(J d) > 0, with the cell size d.
    """
    law, contact = problem.law, problem.contact
    gap = problem.gap(iterate, domain)  # infinite outside the body, which is no contact
    pulled = attraction(law, gap, domain.periodic)
    pressed = iterate.pressure + pulled.traction
    in_contact = pressed * cell_stiffness_inverse(problem, domain) > gap
    touching = np.flatnonzero(in_contact)
    open_gap = gap.ravel()[touching].max(initial=0.0)
    overlap = _largest(float(open_gap), -float(gap.min()))
    tensile = -float(pressed.min())
    pressed.ravel()[touching] = 0.0
    missing = _largest(tensile, float(pressed.max()), 0.0)
    spacing = math.sqrt(domain.whole.cell_area)
    return AdhesiveResidual(
        gap,
        pulled,
        in_contact,
        overlap / problem.displacement(iterate, spacing),
        missing / problem.traction_scale(iterate),
        _imbalance(problem, domain, iterate) if contact.constraints.free.any() else 0.0,
    )


def _imbalance(problem: AdhesiveProblem, domain: ContactDomain, iterate: Guess) -> float:
    """What the free motions' forces lack, over the largest force [-]."""
    whole = domain.whole
    force = float(np.abs(iterate.pressure).sum()) * whole.cell_area
    lacking = problem.lacking(iterate, domain) / np.array([1.0, whole.arm, whole.arm])
    largest = float(np.abs(lacking).max())
    return largest / force if force else float(largest > 0)


def largest_size(field: Floats) -> float:
    """Largest absolute value of a field."""
    return max(float(field.max()), -float(field.min()))


def cell_stiffness_inverse(problem: AdhesiveProblem, domain: ContactDomain) -> float:
    """Displacement of a cell under its own unit pressure, about J d [m/Pa]."""
    return problem.contact.compliance * float(np.sqrt(domain.whole.cell_area))
