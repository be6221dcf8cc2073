"""History of the surface: hereditary integrals of the displacements under each of its terms.

The surface of both bodies is displaced by Σ_m ∫ J_m dq_m, with the unit displacement q_m = K_m p of
each term's frequency response. Over a step this is a known history and Σ b_m K_m p, with the
weights b_m of the new pressure: an elastic contact of the compliance Σ b_m L_m(∞), that of short
waves, and of the response Σ b_m L_m over it. A half-space has one term, and its own operator.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.hereditary_integral import (
    HereditaryIntegral,
    HereditaryResponse,
    response_to,
)
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.setup import RunSetup


@dataclass(frozen=True, eq=False)
class SurfaceStep:
    """Displacement at the end of a step, as a function of the new pressure."""

    terms: tuple[HereditaryResponse, ...]
    short_waves: tuple[float, ...]  # limits of the terms' frequency responses [-]

    @property
    def first(self) -> HereditaryResponse:
        """Response of the first term."""
        return self.terms[0]

    def widened(self, open_gap: Floats) -> Floats:
        """An open gap and the displacement so far by all terms [m]."""
        weights, fields = [1.0], [open_gap]
        for term in self.terms:
            weights += term.weights
            fields += [field[1] for field in term.fields]
        return self.first.team.weighted_sum(np.empty(open_gap.shape), weights, fields)

    @property
    def is_untouched(self) -> bool:
        """True if no displacement is left of earlier steps."""
        return not any(term.history[1].any() for term in self.terms)

    @property
    def slow(self) -> float:
        """Part of the step after the rise of the pressure [-]."""
        return max(self.first.held, self.first.trended)

    @property
    def weights(self) -> tuple[float, ...]:
        """Compliances b_m of the new pressure [1/Pa]."""
        return tuple(term.compliance for term in self.terms)

    @property
    def compliance(self) -> float:
        """Contact compliance of the new pressure, as short waves see it [1/Pa]."""
        if len(self.terms) == 1:
            return self.first.compliance
        pairs = zip(self.weights, self.short_waves, strict=True)
        return sum(weight * part for weight, part in pairs)

    def of(self, pairs: tuple[Floats, ...]) -> Floats:
        """Reference pressure ∫ J_1 dp [-] and displacement [m] of new pairs; shape (2, nx, ny)."""
        fields = self.first.of(pairs[0])
        for term, pair in zip(self.terms[1:], pairs[1:], strict=True):
            fields[1] += term.compliance * pair[1] + term.history[1]
        return fields


class SurfaceHistory:
    """Hereditary integrals of pressure and unit displacement, a pair for each term."""

    def __init__(self, run: RunSetup, domain: ContactDomain) -> None:
        self._domain = domain
        self._responses = tuple(term.response for term in run.problem.surface.terms)
        # Half-spaces of two clocks have the same one.
        self._alike = all(each == self._responses[0] for each in self._responses)
        self._end = 0.0
        # All of one field, the pressure, so that its steps have one shape.
        laws = tuple(plan.clocked_compliance for plan in run.plans) if run.other_terms else ()
        self._integrals: list[HereditaryIntegral] = [
            plan.integral((2, *domain.shape), laws, domain.team) for plan in run.plans
        ]

    def loss(self, pairs: tuple[Floats, ...]) -> tuple[float, float] | None:
        """Heat of the step to new pairs, and power lost at its end; None without variables."""
        heat = power = 0.0
        for integral, pair in zip(self._integrals, pairs, strict=True):
            if not isinstance(integral, InternalVariables):
                return None
            lost = integral.loss(pair)
            heat, power = heat + lost[0], power + lost[1] * integral.clock.rate(self._end)
        return heat, power

    def respond(self, step: TimeStep) -> SurfaceStep:
        """Response to a step; sets that of the domain's surface."""
        self._end = step.time
        short_waves = tuple(response.short_waves for response in self._responses)
        found = SurfaceStep(tuple(response_to(step, each) for each in self._integrals), short_waves)
        if not self._alike:
            shares = tuple(weight / found.compliance for weight in found.weights)
            self._domain.set_response(self._responses, shares)
        return found

    def pairs(self, step: SurfaceStep, values: Floats) -> tuple[Floats, ...]:
        """Pair of each term, of pressure [Pa] and unit displacement [Pa m] of the whole surface."""
        values.flags.writeable = False  # the hereditary integrals keep it without a copy
        if self._alike or not values.any():  # without pressure all are zero
            return (values,) * len(self._responses)
        pressure, unit_displacement = values[0], self._domain.unit_displacement
        others = [unit_displacement(pressure, each) for each in self._responses[1:]]
        if step.weights[0] == 0:  # a law that does not yield instantly
            first = unit_displacement(pressure, self._responses[0])
        else:  # what the others leave of the whole
            weighted = zip(step.weights[1:], others, strict=True)
            rest = step.compliance * values[1] - sum(weight * unit for weight, unit in weighted)
            first = rest / step.weights[0]
        found = tuple(np.stack([pressure, unit]) for unit in (first, *others))
        for pair in found:
            pair.flags.writeable = False
        return found

    def accept(self, pairs: tuple[Floats, ...]) -> None:
        """Close the step with its new pairs."""
        for integral, pair in zip(self._integrals, pairs, strict=True):
            integral.accept(pair)

    def restart_data(self) -> list[RestartData]:
        """Restart data of the integrals."""
        return [integral.restart_data() for integral in self._integrals]

    def restore(self, restart_data: list[RestartData]) -> None:
        """Continue from restart data of the same run."""
        for integral, each in zip(self._integrals, restart_data, strict=True):
            integral.restore(each)

    def map_fields(self, enlargement: GridEnlargement) -> None:
        """Continue on a larger grid."""
        self._domain = enlargement.large
        for integral, response in zip(self._integrals, self._responses, strict=True):
            integral.map_fields(partial(enlargement.pairs, response=response))
