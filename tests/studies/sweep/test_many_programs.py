"""Load programs in several runs at once: kept, found again, and not taken for one another."""

import numpy as np
import pytest

import viscontact as vc

BALL, MATERIAL = vc.Paraboloid(0.01, 0.01), vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)
GRID, TIMES = vc.Grid((24, 24), (1.8e-3, 1.8e-3)), vc.uniform_times(0.5, 20)


def runs(*set_points):
    return [
        {
            **{"indenter": BALL, "material": MATERIAL, "grid": GRID, "times": TIMES},
            **{"load": vc.LoadProgram(f"move at 0.1 mm/s until force reaches {each}")},
            **{"errors": False},
        }
        for each in set_points
    ]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_results_of_programs_are_found_again(tmp_path):
    first = vc.simulate_many(runs("10 mN", "20 mN"), directory=tmp_path / "runs")
    assert np.allclose(first.force.max("step"), [0.01, 0.02], rtol=1e-6, atol=0)
    again = vc.simulate_many(runs("10 mN", "20 mN"), directory=tmp_path / "runs")
    assert np.array_equal(first.force, again.force, equal_nan=True)
    with pytest.raises(ValueError, match="other arguments"):
        vc.simulate_many(runs("10 mN", "30 mN"), directory=tmp_path / "runs")
