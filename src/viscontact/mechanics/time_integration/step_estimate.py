"""Number of adaptive steps that a run is likely to take."""

from __future__ import annotations

from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.materials.compliance import ContactCompliance
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes

#: Steps from one kink of the load to the next at a tolerance of 1e-3, and for an elastic body;
#: measured on spheres, within a factor of two.
STEPS_PER_INTERVAL, ELASTIC_STEPS_PER_INTERVAL = 25.0, 7.0


def estimated_steps(
    request: AdaptiveTimes, load: LoadHistory, compliance: ContactCompliance
) -> float:
    """Estimated number of adaptive steps, within a factor of two if J(0) > 0."""
    stretches = float((load.kinks < request.end).sum())
    creeps = compliance(request.end) > compliance.instant
    # The error of a step falls with its cube, that of the run with its square.
    finer = (1e-3 / request.tolerance) ** (1 / 3)
    each = (
        max(ELASTIC_STEPS_PER_INTERVAL, STEPS_PER_INTERVAL * finer)
        if creeps
        else ELASTIC_STEPS_PER_INTERVAL
    )
    divided = compliance.clock.divisions(0.0, request.end).size
    cycles = min(request.end, float(load.kinks[-1])) / load.longest_step
    return stretches * each + divided + cycles
