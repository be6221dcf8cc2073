"""Load histories of any shape, and a cycle with a jump."""

import numpy as np
from hypothesis import strategies as st

from viscontact.loads import ForceHistory

EPS = np.finfo(float).eps

# Up to 10 N in 1 s, held to 3 s, dropped to 4 N at once, taken off by 5 s.
CYCLE = ForceHistory(times=[0, 1, 3, 3, 5], force=[0, 10, 10, 4, 0])
SWING = {"amplitude": 5e-5, "period": 2.0, "cycles": 3}


@st.composite
def histories(draw):
    """Histories of any shape: some points at the same instant, some forces zero."""
    gaps = draw(st.lists(st.sampled_from([0.0, 0.1, 1.0, 7.3]), max_size=7))
    times = np.cumsum([draw(st.floats(0, 5)), *gaps])
    once_or_twice = [i for i in range(times.size) if i < 2 or times[i] > times[i - 2]]
    times = times[once_or_twice]
    force = draw(st.lists(st.floats(0, 1e5), min_size=times.size, max_size=times.size))
    return ForceHistory(times, force)
