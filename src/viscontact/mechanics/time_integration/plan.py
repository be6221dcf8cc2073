"""Method for the hereditary integral: exact, or a Prony series with a stated error."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.compliance import (
    ClockedCompliance,
    ContactCompliance,
    SeriesCompliance,
)
from viscontact.mechanics import time_integration
from viscontact.units.formatting import format_quantity

if TYPE_CHECKING:
    from viscontact.mechanics.time_integration.hereditary_integral import HereditaryIntegral

#: Largest memory for the increments of the fields in a sum over all steps [bytes].
MAX_HISTORY_BYTES = 256 * 2**20

#: Memory reserved for adaptive steps, in planned steps. The system assigns it only as it is used,
#: and the arrays need not be moved, which would take it twice.
STEP_RESERVE = 4

#: Largest number of steps that are summed; beyond it the sum takes longer than the contact solver.
MAX_SUMMED_STEPS = 2000


@dataclass(frozen=True, eq=False)
class HereditaryPlan:
    """Method by which the hereditary integral of a run is evaluated."""

    compliance: ContactCompliance  # J(t) as it is used, over the reduced time of its clock
    instants: Floats  # planned ends of the steps on its clock [s], empty for adaptive steps
    rows: int  # expected number of increments, one for each linear part of a step
    method: str  # description for users
    error: float  # largest relative deviation of the J that is used from the material's [-]
    prony_approximation: SeriesCompliance  # J(t) as a Prony series, for estimates and predictions
    clock: Clock = TIME

    @property
    def clocked_compliance(self) -> ContactCompliance:
        """J as it is used, on its clock."""
        used = self.compliance
        return used if self.clock is TIME else ClockedCompliance(used, self.clock)

    @property
    def fields_kept(self) -> int:
        """Number of stored fields: one for each exponential, or for each linear part of a step."""
        if isinstance(self.compliance, SeriesCompliance):
            return self.compliance.term_count
        return self.rows

    def integral(
        self,
        shape: tuple[int, ...],
        others: tuple[ContactCompliance, ...] = (),
        team: Team | None = None,
    ) -> HereditaryIntegral:
        """Hereditary integral of a field of this shape; `others` act on it as well."""
        if isinstance(self.compliance, SeriesCompliance):
            return time_integration.InternalVariables(
                self.compliance, shape, others, team, self.clock
            )
        is_adaptive = not self.instants.size
        room = STEP_RESERVE * self.rows if is_adaptive else self.rows
        return time_integration.BoltzmannSum(
            self.compliance, shape, self.instants, room, others, self.clock
        )


def plan_hereditary_integral(
    compliance: ContactCompliance, instants: Floats, numbers: int
) -> HereditaryPlan:
    """Choose the method for the hereditary integral of a run."""
    # A recursion for a series law, which is exact. For any other law the sum over all earlier
    # steps, as long as they fit into 256 MiB and are at most 2000; else a Prony series, whose
    # deviation from the law is part of the plan. `instants` are the ends of the steps in order, a
    # jump's twice [s]; `numbers` are to be stored at each step.
    clock, compliance = compliance.clock, compliance.over_reduced_time
    instants = clock.reduced(instants)
    if isinstance(compliance, SeriesCompliance):
        exact = "recursion, exact for a series law"
        return HereditaryPlan(compliance, instants, len(instants), exact, 0.0, compliance, clock)
    durations = np.diff(instants)
    first = float(durations.min(initial=np.inf, where=durations > 0))
    if math.isinf(first):
        first = 1.0  # a jump alone, where time does not matter
    last = max(float(instants[-1]), 10 * first)
    series, error = time_integration.prony_approximation.as_exponentials(compliance, first, last)
    rows = len(instants) + _long_steps(compliance, durations)
    if len(instants) <= MAX_SUMMED_STEPS and 8.0 * rows * numbers <= MAX_HISTORY_BYTES:
        method = "direct sum over all earlier steps, with the given law"
        return HereditaryPlan(compliance, instants, rows, method, 0.0, series, clock)
    method = (
        f"sum of {len(series.times)} exponentials, within {error:.1e} of the law's creep "
        f"compliance from {format_quantity(first, 's', 3)} to {format_quantity(last, 's', 3)}"
    )
    return HereditaryPlan(series, instants, rows, method, error, series, clock)


def _long_steps(compliance: ContactCompliance, durations: Floats) -> int:
    """Number of steps over which the field does not rise all the way (`longest_smooth_rise`)."""
    lasting = durations[durations > 0]
    new = compliance.mean(np.zeros(lasting.size), lasting)
    limit = np.where(compliance.instant > 0, compliance.instant, new / 2)
    return int(np.count_nonzero(compliance(lasting) - new > limit))
