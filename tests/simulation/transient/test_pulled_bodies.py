"""Load programs that pull bodies that adhere before they withdraw them."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to

#: A sphere of Tabor number 1, in units of its contact: force, length and depth.
RADIUS, WORK, COMPLIANCE = 1e-3, 0.05, 1e-6
GEL = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
RANGE = float(np.cbrt(RADIUS * (WORK * COMPLIANCE) ** 2))
FORCE = np.pi * WORK * RADIUS
LENGTH = float(np.cbrt(FORCE * RADIUS * 3 * COMPLIANCE / 4))
DEPTH = LENGTH**2 / RADIUS


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_bodies_that_are_only_pulled_are_withdrawn_by_their_approach() -> None:
    # No segment presses them, so that no prescribed force is a level for the error of a step.
    pull = vc.Segment(rate=-0.5 * FORCE, control="force", duration=2.0)
    withdraw = vc.Segment(rate=-0.05 * DEPTH, control="approach", duration=3.0)
    found = vc.simulate(
        *(vc.Paraboloid(RADIUS, RADIUS), GEL, vc.LoadProgram([pull, withdraw])),
        vc.Grid((32, 32), (6 * LENGTH, 6 * LENGTH)),
        [0.0, 1.0, 2.0, 3.0, 5.0],
        adhesion=vc.Adhesion(WORK, range=RANGE),
        errors=False,
        fields="none",
    )
    reached = found.force.values / FORCE
    assert reached[:3] == close_to([0.0, -0.5, -1.0], abs=1e-6)
    assert (np.diff(reached) < 0).all()
    assert (found.time_error == 0).all()
