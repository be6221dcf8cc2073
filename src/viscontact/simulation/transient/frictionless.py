"""Contact without friction, and the friction of a run, if it has some."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import TYPE_CHECKING, Any

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution, solve_contact
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.simulation import transient
from viscontact.simulation.checks.friction import Grip, grip_warnings
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.setup import RunSetup

if TYPE_CHECKING:
    from viscontact.simulation.transient.coupling_history import CouplingStep
    from viscontact.simulation.transient.shear_history import ShearStep
    from viscontact.simulation.transient.slip_state import SlipState, StepSlip
    from viscontact.simulation.transient.step_solution import StepSolution


@dataclass(frozen=True, eq=False)
class SlipTrial:
    """Tractions of a step that has been solved but not accepted; none of a contact without them."""

    #: Scalars and fields of the state at its end.
    values: Mapping[str, Any] = field(default_factory=dict)
    grip: Grip | None = None
    response: ShearStep | None = None
    after: SlipState | None = None
    duration: float = 0.0  # [s]
    coupling: CouplingStep | None = None
    #: Energy lost in the bodies under the tractions since the start [J], and its rate [W].
    loss: tuple[float, float] = (0.0, 0.0)

    @property
    def warnings(self) -> dict[str, str]:
        """Warnings, by kind."""
        return {} if self.grip is None else grip_warnings(self.grip)


@dataclass(frozen=True, eq=False)
class JointSlip:
    """Tractions that have been found together with their normal contact."""

    slip: StepSlip
    lift: Floats  # displacement into the surface by the new tractions [m], (nx, ny)


class Uncoupled:
    """Normal contact that does not feel tractions."""

    def earlier_lift(self, step: TimeStep) -> Floats | None:
        """Displacement into the surface by earlier tractions [m]; None for none."""
        return None

    def equilibrium(
        self,
        step: TimeStep,
        problem: ContactProblem,
        domain: ContactDomain,
        guess: Guess | None,
        tolerance: float,
    ) -> tuple[ContactSolution, JointSlip | None]:
        """Solve the normal contact of a step, and tractions with it if they are coupled."""
        return solve_contact(problem, domain, guess, tolerance=tolerance), None


class Frictionless(Uncoupled):
    """Contact without friction, which carries no traction."""

    #: Warnings of the whole run, by kind.
    warnings_at_end: Mapping[str, str] = {}

    def trial(
        self, step: TimeStep, solution: StepSolution, joint: JointSlip | None = None
    ) -> SlipTrial:
        """Return no tractions."""
        return SlipTrial()

    def accept(self, trial: SlipTrial) -> None:
        """Keep nothing."""

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue on a larger grid, as on any other."""

    def restart_data(self) -> None:
        """Return nothing, as nothing is kept."""

    def restore(self, restart_data: None) -> None:
        """Continue from nothing."""


def frictional_contact(run: RunSetup) -> Frictionless | transient.FrictionalContact:
    """Friction of a run; without it nothing is carried along the surface."""
    problem = run.problem
    if problem.friction is None or problem.shear_load is None:
        return Frictionless()
    kind = transient.CoupledContact if problem.is_coupled else transient.FrictionalContact
    return kind(run, problem.friction, problem.shear_load)
