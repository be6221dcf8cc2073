"""Error bars of moving contacts hold against finer runs."""

import numpy as np
import pytest

from campaigns import tried
from verification.families.moving_runs import QUANTITIES, compared, drawn

#: Part of the errors within the bars: of all, and of each scalar. Largest median of bar over error.
COVERED, COVERED_EACH, MEDIAN = 0.95, 0.9, 15.0


@pytest.mark.slow
def test_bars_of_random_moving_runs_hold_the_errors_in_95_of_100(campaign) -> None:
    runs = [compared(run) for run in drawn(seed=4102, count=tried(3, 6))]
    found = {name: np.concatenate([run[name] for run in runs]) for name in QUANTITIES}
    found = {name: ratios[np.isfinite(ratios)] for name, ratios in found.items()}
    for name, ratios in found.items():
        campaign(
            f"  {name:22s} {len(ratios):5d} values, {np.mean(ratios >= 1):.1%} within, "
            f"median bar/error {np.median(ratios):.1f}"
        )
    pooled = np.concatenate([*found.values()])
    assert np.mean(pooled >= 1) >= COVERED
    assert np.median(pooled) <= MEDIAN
    for name, ratios in found.items():
        assert np.mean(ratios >= 1) >= COVERED_EACH, name
