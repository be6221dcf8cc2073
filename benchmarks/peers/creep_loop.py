"""Time loop for creep around an elastic solver, as a user would write it; NumPy only.

The pressure is linear in time within a step, and each exponential of the compliance is integrated
exactly, as in the package, so the error in time is the same and only the cost differs. The initial
guess of each solution is extrapolated from the last two steps.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

#: Gap [m] and start [Pa] to pressure [Pa] and its deflection under unit compliance [Pa m]; with
#: unit compliance gaps are in Pa m too.
Elastic = Callable[[np.ndarray, np.ndarray | None], tuple[np.ndarray, np.ndarray]]


def march(problem: Mapping[str, np.ndarray], solve: Elastic) -> np.ndarray:
    """Pressures [Pa] at the recorded instants of the problem."""
    amplitudes, times = problem["amplitudes"], problem["times"]
    relaxation = problem["relaxation_times"]
    fields = np.zeros((len(amplitudes), *problem["gap"].shape))
    pressure, deflection = solve(problem["gap"] / problem["instant"], None)
    before, recorded = None, []
    for step, duration in enumerate(np.diff(times), start=1):
        ratio = duration / relaxation
        decay = np.exp(-ratio)
        new = amplitudes * (1 - (1 - decay) / ratio)
        old = amplitudes * (1 - decay) - new
        kept = [d * field + o * deflection for d, field, o in zip(decay, fields, old, strict=True)]
        compliance = problem["instant"] + new.sum()
        start = pressure if before is None else np.maximum(2 * pressure - before, 0.0)
        before = pressure
        pressure, deflection = solve((problem["gap"] + sum(kept)) / compliance, start)
        fields = np.stack([k + n * deflection for k, n in zip(kept, new, strict=True)])
        if step in problem["recorded"]:
            recorded.append(pressure)
    return np.stack(recorded)
