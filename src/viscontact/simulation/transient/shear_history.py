"""History of the surface under shear: hereditary integrals of the tractions, one for each term.

Over a step the surface moves along itself by

    Σ T_m (b_m q + h_m - r_m)

with the weights b_m of the new tractions q, the history h_m of the hereditary integral, and its
value r_m at the end of the step before.
"""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.contact.friction.region import Region, ShearDomain
from viscontact.mechanics.halfspace.shear_filter import PairFilter
from viscontact.mechanics.problem.shear_terms import ShearTerms
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.hereditary_integral import (
    HereditaryIntegral,
    HereditaryResponse,
    response_to,
)
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_shape import FieldMap
from viscontact.simulation.transient.setup import RunSetup


@dataclass(frozen=True, eq=False)
class ShearStep:
    """Displacement along the surface over a step, as a function of the new tractions."""

    shear: ShearTerms
    responses: tuple[HereditaryResponse, ...]
    before: tuple[Floats, ...]  # hereditary integrals of the tractions before [-], (2, nx, ny)
    _pasts: dict[Region, Floats] = field(default_factory=dict)

    @property
    def compliance(self) -> float:
        """Contact compliance of the new tractions [1/Pa]."""
        pairs = zip(self.shear.terms, self.responses, strict=True)
        return sum(term.direct * response.compliance for term, response in pairs)

    @property
    def kappa(self) -> float:
        """ν/(1 - ν) of the surface under the new tractions [-]."""
        pairs = zip(self.shear.terms, self.responses, strict=True)
        weighted = sum(term.poisson * response.compliance for term, response in pairs)
        return weighted / self.compliance

    @property
    def layers(self) -> tuple[float, ...]:
        """Weights of the parts of layers under the new tractions, over the compliance [-]."""
        pairs = zip(self.shear.terms, self.responses, strict=True)
        own = [response.compliance for term, response in pairs if term.layers is not None]
        return tuple(each / self.compliance for each in own)

    def past(self, domain: ShearDomain, region: Region) -> Floats:
        """Displacement of a region in the step by earlier tractions [m], (2, nx, ny)."""
        if region not in self._pasts:
            self._pasts[region] = self._past(domain, region)
        return self._pasts[region]

    def earlier(self, region: Region) -> Floats | None:
        """New tractions that displaced a region as the earlier ones do in the step [Pa].

        None where these displace it by several creep functions.
        """
        if len(self.responses) > 1:
            return None
        cut, (response,) = region.cut, self.responses
        return (response.history_on(cut) - self.before[0][:, *cut]) / response.compliance

    def _past(self, domain: ShearDomain, region: Region) -> Floats:
        cut, parts = region.cut, domain.parts(region)
        found = np.zeros((2, *region.shape))
        for weights, response, before in zip(
            self.shear.weights, self.responses, self.before, strict=True
        ):
            change = response.history_on(cut) - before[:, *cut]
            if change.any():
                found += parts.sum_of(*weights).apply(change)
        return found

    def of(self, traction: Floats) -> tuple[Floats, ...]:
        """Hereditary integrals of new tractions [-]."""
        return tuple(response.of(traction) for response in self.responses)


class ShearHistory:
    """Hereditary integrals of the tractions over the whole grid, one for each term."""

    def __init__(self, run: RunSetup) -> None:
        self._shear = run.problem.shear
        plans = run.shear_plans
        laws = tuple(plan.clocked_compliance for plan in plans) if len(plans) > 1 else ()
        shape = (2, *run.grid.shape)
        self._integrals: list[HereditaryIntegral] = [plan.integral(shape, laws) for plan in plans]
        self._before: tuple[Floats, ...] = tuple(np.zeros(shape) for _ in plans)
        #: The last step and the response to it, until it is accepted.
        self._latest: tuple[TimeStep, ShearStep] | None = None

    def respond(self, step: TimeStep) -> ShearStep:
        """Response to a step."""
        if self._latest is None or self._latest[0] is not step:
            responses = tuple(response_to(step, integral) for integral in self._integrals)
            self._latest = step, ShearStep(self._shear, responses, self._before)
        return self._latest[1]

    def loss(
        self, traction: Floats, domain: ShearDomain, region: Region, time: float
    ) -> tuple[float, float]:
        """Heat of a step to new tractions [J], and power lost at its end [W]; NaN if unknown."""
        if not all(isinstance(each, InternalVariables) for each in self._integrals):
            return math.nan, math.nan
        heat = power = 0.0
        for weights, integral in zip(self._shear.weights, self._integrals, strict=True):
            assert isinstance(integral, InternalVariables)
            operator = domain.parts(region).sum_of(*weights)

            def paired(field: Floats, operator: PairFilter = operator) -> Floats:
                here = field[:, *region.cut]
                moved = operator.apply(here) if here.any() else np.zeros(here.shape)
                return np.stack([np.concatenate(here), np.concatenate(moved)])

            lost = integral.loss(traction, paired)
            heat, power = heat + lost[0], power + lost[1] * integral.clock.rate(time)
        area = domain.shift(region).cell_area
        return heat * area, power * area

    def accept(self, step: ShearStep, traction: Floats) -> None:
        """Close a step with its tractions."""
        traction.flags.writeable = False  # the integrals keep it without a copy
        self._before, self._latest = step.of(traction), None
        for integral in self._integrals:
            integral.accept(traction)

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
