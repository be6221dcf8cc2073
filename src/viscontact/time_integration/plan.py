"""Which memory a run gets: exact wherever that is possible, and said where it is not."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.materials.compliance import ContactCompliance, SeriesCompliance
from viscontact.time_integration.boltzmann_sum import BoltzmannSum
from viscontact.time_integration.hereditary_integral import HereditaryIntegral
from viscontact.time_integration.internal_variables import InternalVariables
from viscontact.time_integration.prony_approximation import as_exponentials
from viscontact.units.formatting import format_quantity

#: Increments of the fields are kept and summed as long as they take no more than this [bytes].
MAX_HISTORY_BYTES = 256 * 2**20

#: Where a run chooses its steps, there is room for so many times the planned ones: it is taken
#: only as steps come, and never has to be moved, which would take it twice.
STEP_RESERVE = 4

#: Beyond this many steps a sum over all of them would take longer than the contact itself.
MAX_SUMMED_STEPS = 2000


@dataclass(frozen=True, eq=False)
class HereditaryPlan:
    """How the past of a run is remembered.

    Attributes
    ----------
    compliance : ContactCompliance
        J(t) as it is used.
    instants : ndarray
        Planned ends of the steps; empty where the run chooses them [s].
    steps : int
        How many steps are expected.
    method : str
        In words.
    error : float
        Largest relative deviation of the J that is used from the material's [-].
    prony_approximation : SeriesCompliance
        J(t) as exponentials, whatever the method: for estimates and predictions, which it makes
        cheap.
    """

    compliance: ContactCompliance
    instants: NDArray[np.float64]
    steps: int
    method: str
    error: float
    prony_approximation: SeriesCompliance

    @property
    def fields_kept(self) -> int:
        """Fields that a memory keeps: one for each exponential, or one for each step."""
        if isinstance(self.compliance, SeriesCompliance):
            return self.compliance.term_count
        return self.steps

    def memory(self, shape: tuple[int, ...]) -> HereditaryIntegral:
        """Return an empty memory for a field of a shape."""
        if isinstance(self.compliance, SeriesCompliance):
            return InternalVariables(self.compliance, shape)
        chosen_as_it_goes = not self.instants.size
        room = STEP_RESERVE * self.steps if chosen_as_it_goes else self.steps
        return BoltzmannSum(self.compliance, shape, self.instants, room)


def plan_hereditary_integral(
    compliance: ContactCompliance, instants: NDArray[np.float64], numbers: int
) -> HereditaryPlan:
    """Choose how a run remembers.

    Parameters
    ----------
    compliance : ContactCompliance
        J(t).
    instants : ndarray
        Ends of the steps, a jump's twice, in order [s].
    numbers : int
        Numbers to be remembered at each step.

    Returns
    -------
    HereditaryPlan
        A recursion for a series law, which is exact. For any other law the sum over all earlier
        steps, as long as they fit into 256 MiB and are at most 2000; else a sum of exponentials,
        whose deviation from the law is part of the plan.

    Examples
    --------
    >>> series = SeriesCompliance(1.0, [1.0], [2.0])
    >>> plan_hereditary_integral(series, np.array([0.0, 1.0]), 4096).error
    0.0
    """
    if isinstance(compliance, SeriesCompliance):
        exact = "recursion, exact for a series law"
        return HereditaryPlan(compliance, instants, len(instants), exact, 0.0, compliance)
    durations = np.diff(instants)
    first = float(durations.min(initial=np.inf, where=durations > 0))
    if math.isinf(first):
        first = 1.0  # a jump alone, for which no time counts
    last = max(float(instants[-1]), 10 * first)
    series, error = as_exponentials(compliance, first, last)
    steps = len(instants)
    if steps <= MAX_SUMMED_STEPS and 8.0 * steps * numbers <= MAX_HISTORY_BYTES:
        method = "sum over all earlier steps, with the law as it stands"
        return HereditaryPlan(compliance, instants, steps, method, 0.0, series)
    method = (
        f"sum of {len(series.times)} exponentials, within {error:.1e} of the law's creep "
        f"compliance from {format_quantity(first, 's', 3)} to {format_quantity(last, 's', 3)}"
    )
    return HereditaryPlan(series, instants, steps, method, error, series)
