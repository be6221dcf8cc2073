"""Coupling of pressure and tractions over the steps of a run, with the memory of earlier ones.

With the weights c_m of `ShearTerm.coupling` and the operator B of tractions (`coupling_filter`),
tractions displace the surface into itself by B Q and pressures along itself by B^T P, where

    Q = Σ c_m ∫ J_m(t - t') dq(t'),   P = Σ c_m ∫ J_m(t - t') dp(t').

Creep is in these sums, so that each is one convolution. Layers have an operator for each term, and
sums of their own (`ShearTerms.coupled`).
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.problem.shear_terms import ShearTerms
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.hereditary_integral import (
    HereditaryIntegral,
    HereditaryResponse,
    response_to,
)
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_shape import FieldMap
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.shear_history import ShearStep


@dataclass(frozen=True, eq=False)
class CouplingStep:
    """Sums P and Q of a step as functions of its new pressure and tractions."""

    terms: ShearTerms
    responses: tuple[HereditaryResponse, ...]  # to pressure
    shear: ShearStep  # response to tractions
    before: tuple[Floats, ...]  # P at the begin of the step [-], (nx, ny)

    def of_pressure(self, pressure: Floats) -> tuple[Floats, ...]:
        """P at the end of the step [-]."""
        return self.terms.coupled_sums([response.of(pressure) for response in self.responses])

    def of_traction(self, traction: Floats) -> tuple[Floats, ...]:
        """Part of Q by the new tractions [-], (2, nx, ny)."""
        compliances = [np.asarray(response.compliance) for response in self.shear.responses]
        weights = self.terms.coupled_sums(compliances)
        return tuple(np.asarray(weight * traction) for weight in weights)

    @property
    def past(self) -> tuple[Floats, ...]:
        """Part of Q by earlier tractions [-], (2, nx, ny)."""
        return self.terms.coupled_sums([response.history for response in self.shear.responses])


class CouplingHistory:
    """Hereditary integrals of the pressure over the whole grid, one for each term under shear."""

    def __init__(self, run: RunSetup) -> None:
        self._terms = run.problem.shear
        plans = run.shear_plans
        laws = tuple(plan.clocked_compliance for plan in plans) if len(plans) > 1 else ()
        shape = run.grid.shape
        self._integrals: list[HereditaryIntegral] = [plan.integral(shape, laws) for plan in plans]
        self._before = tuple(np.zeros(shape) for _ in self._terms.coupled)
        #: The last step and the response to it, until it is accepted.
        self._latest: tuple[TimeStep, CouplingStep] | None = None

    def respond(self, step: TimeStep, shear: ShearStep) -> CouplingStep:
        """Response to a step, with that to its tractions."""
        if self._latest is None or self._latest[0] is not step:
            responses = tuple(response_to(step, integral) for integral in self._integrals)
            self._latest = step, CouplingStep(self._terms, responses, shear, self._before)
        return self._latest[1]

    def accept(self, step: CouplingStep, pressure: Floats) -> None:
        """Close a step with its pressure."""
        pressure.flags.writeable = False  # the integrals keep it without a copy
        self._before, self._latest = step.of_pressure(pressure), None
        for integral in self._integrals:
            integral.accept(pressure)

    def map_fields(self, grown: FieldMap) -> None:
        """Continue on a larger grid."""
        self._before, self._latest = tuple(grown(each) for each in self._before), None
        for integral in self._integrals:
            integral.map_fields(grown)

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        return {
            "integrals": [integral.restart_data() for integral in self._integrals],
            "before": list(self._before),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue from restart data of the same run."""
        for integral, data in zip(self._integrals, restart_data["integrals"], strict=True):
            integral.restore(data)
        self._before, self._latest = tuple(restart_data["before"]), None
