"""A measured load that a coarse look does not see the farthest contact of."""

from __future__ import annotations

from pathlib import Path

import numpy as np

#: Rows of the table; more of them differ than the automatic grid looks at.
ROWS = 41


def write_swing(path: Path) -> None:
    """Write a noisy force that is centred but for two rows.

    In one of them it acts farthest out, and is next to nothing; in the other it acts not quite so
    far out, and is not quite so large, and that contact reaches farthest.
    """
    time = np.linspace(0.0, 1.0, ROWS)
    force = 0.2 + 1e-3 * np.random.default_rng(1).random(ROWS)
    offset = np.zeros(ROWS)
    force[0] = 0.0
    force[8], offset[8] = 0.18, 6e-4
    force[20], offset[20] = 1e-4, 7e-4
    rows = zip(time, force, offset, strict=True)
    lines = "".join(f"{t:.4f}, {w:.6f}, {e:.6g}\n" for t, w, e in rows)
    path.write_text("time [s], force [N], eccentricity_x [m]\n" + lines, encoding="utf-8")
