"""Cells of contacts in steady motion."""

from __future__ import annotations

from viscontact.simulation.steady_motion.region import _divisible


def test_number_of_cells_stays_even_when_halved() -> None:
    assert _divisible(79.0) == 80
    assert _divisible(130.5) == 136
