"""A step as it is posed and solved, before it is accepted."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import LoadPoint
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.state import Outcome
from viscontact.mechanics.time_integration.extrapolation import ElasticReference
from viscontact.mechanics.time_integration.step_error import StepError
from viscontact.simulation import transient
from viscontact.simulation.transient.frictionless import JointSlip
from viscontact.simulation.transient.step_solution import StepSolution
from viscontact.simulation.transient.surface_history import SurfaceStep


@dataclass(frozen=True, eq=False)
class StepProblem:
    """The contact problem of a step, and the guess of its solution if there is one."""

    point: LoadPoint
    response: SurfaceStep
    drive: float  # force [N] or approach [m] over which references are extrapolated
    problem: ContactProblem
    guess: Guess | None
    earlier_lift: Floats | None = None  # displacement by earlier tractions [m], cells computed


@dataclass(frozen=True, eq=False)
class TrialStep:
    """A solved step, before it is accepted: equilibrium, outcome, and the error that it adds."""

    point: LoadPoint
    solution: ContactSolution
    response: SurfaceStep
    pairs: tuple[Floats, ...]  # pressure and unit displacement of each term
    reference: ElasticReference
    outcome: Outcome
    error: StepError
    adhesive: transient.AdhesiveStep | None = None
    joint: JointSlip | None = None  # tractions that are coupled with the pressure
    earlier_lift: Floats | None = None  # displacement by earlier tractions [m], cells computed

    @property
    def lift(self) -> Floats | None:
        """Displacement into the surface by tractions [m]; None where none is coupled."""
        if self.earlier_lift is None or self.joint is None:
            return self.earlier_lift
        return self.earlier_lift + self.joint.lift

    @property
    def change(self) -> float:
        """Change of the force over the largest one of a step; 0 where it is not limited [-]."""
        return 0.0 if self.adhesive is None else self.adhesive.change


class StepTooLongError(Exception):
    """A step that has to be shorter before it can be solved."""

    def __init__(self, change: float, *, longest: float = math.inf) -> None:
        """Take the change of the force over the largest one of a step [-], and a duration [s]."""
        self.change, self.longest = change, longest


def on_full_grid(
    domain: ContactDomain,
    trial: TrialStep,
    time_error: float,
    loss: tuple[float, float] = (math.nan, math.nan),
    stability: float = math.nan,
) -> StepSolution:
    """The solution of a step, on the whole grid, with heat [J] and power [W] lost."""
    solution, lift = trial.solution, trial.lift
    found = solution.found
    fields = {
        "pressure": domain.expand_by_symmetry(found.pressure),
        "gap": domain.expand_by_symmetry(solution.gap),
        "displacement": domain.expand_by_symmetry(trial.reference.fields[1]),
    }
    reference, in_contact = trial.reference.fields, domain.expand_by_symmetry(solution.in_contact)
    if lift is not None:
        fields["displacement"] = fields["displacement"] + domain.expand_by_symmetry(lift)
    for field in (*fields.values(), reference, in_contact):
        field.flags.writeable = False  # later steps start from them
    cell_area = domain.symmetry_count * domain.grid.cell_area  # with its mirror images
    energy = float(np.einsum("ij,ij->", found.pressure, found.unit_displacement)) / 2
    if lift is not None and trial.response.compliance > 0:
        energy += float(np.einsum("ij,ij->", found.pressure, lift)) / 2 / trial.response.compliance
    adhesive, separating = trial.adhesive, 0.0
    if adhesive is not None:
        separating = float(adhesive.problem.law.energy(np.maximum(solution.gap, 0.0)).sum())
    return StepSolution(
        **fields,
        in_contact=in_contact,
        reference=reference,
        motion=found.motion,
        peak=float(found.pressure.max()),
        resultants=domain.whole.passes.sums(found.pressure) * cell_area,
        energy=energy * cell_area,
        residual=solution.residual,
        iterations=solution.iterations,
        outcome=trial.outcome,
        resolved=all(term.resolved for term in trial.response.terms),
        stability=stability,
        adhesion_energy=separating * cell_area,
        jumped=adhesive is not None and adhesive.jumped,
        time_error=time_error,
        heat=loss[0],
        power=loss[1],
    )
