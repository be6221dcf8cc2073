"""Instants of the first and of the last contact."""

from __future__ import annotations

import numpy as np

from viscontact.simulation.accuracy.first_and_last_contact import before_loss


def test_contact_is_lost_after_its_last_instant_and_not_at_the_end_of_the_run() -> None:
    """Two contacts, the second of which lasts to the end."""
    area = np.array([0.0, 1.0, 2.0, 1.0, 0.0, 0.0, 3.0, 3.0])
    assert before_loss({"contact_area": area}).tolist() == [False] * 3 + [True] + [False] * 4
