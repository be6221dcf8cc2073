"""Stresses near free ends, wave by wave, against finite elements."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from closeness import close_to
from mechanics.halfspace.edge_elements import EdgeSection
from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.end_stress import (
    Places,
    RowLoads,
    beside_face,
    between_faces,
)

#: Loaded part of the surface.
BEGIN, END = 0.25, 0.75


def _mirrored(ratio: float, place: Floats, *, half: float | None, odd: bool) -> Floats:
    """Stresses of a half-space under the load and its images, by waves (Johnson 1985, 13.2)."""
    x, z = place
    if half is None:
        nodes, weights = leggauss(12)
        borders = np.arange(0.0, 40.0 / z, 1.0)
        c = (borders[:, None] + (nodes + 1) / 2).ravel()
        measure = np.tile(weights / 2, len(borders)) * 2 / np.pi
    else:
        count = np.arange(1, int(40.0 / z * half / np.pi) + 2)
        c = np.append(1e-9, count * np.pi / half) if not odd else (count - 0.5) * np.pi / half
        measure = np.full(len(c), 2 / half)
        measure[0] /= 1 if odd else 2
    amplitude = measure * (np.sin(c * END) - np.sin(c * BEGIN)) / c
    q = np.hypot(1.0, c)
    decay, cos, sin = np.exp(-q * z), np.cos(c * x), np.sin(c * x)
    parts = [
        -((c / q) ** 2 * (1 - q * z) + 2 * ratio / q**2) * cos,
        -((1 / q) ** 2 * (1 - q * z) + 2 * ratio * (c / q) ** 2) * cos,
        -(1 + q * z) * cos,
        -z * cos,
        -z * c * sin,
        c / q**2 * (1 - q * z - 2 * ratio) * sin,
    ]
    return np.array([(amplitude * decay * part).sum() for part in parts])


@pytest.mark.parametrize(
    ("ratio", "half", "odd"),
    [
        (0.0, None, False),
        (0.3, None, False),
        (0.45, None, False),
        (0.3, 1.0, False),
        (0.3, 1.0, True),
    ],
)
def test_stresses_near_a_free_end_are_those_of_finite_elements(
    ratio: float, half: float | None, odd: bool
) -> None:
    section = EdgeSection(ratio, 11.0 if half is None else half, 11.0, odd=odd)
    places, expected = section.stress_under(BEGIN, END)
    near = np.flatnonzero((places[0] < 1) & (places[1] < 1.5) & (places[1] > 0.1))[::97]
    assert near.size > 10
    loads = RowLoads(np.array([BEGIN, END]), np.ones((1, 2)), END - BEGIN)
    found = []
    for x, z in places[:, near].T:
        at = Places(np.array([x]), np.array([z]))
        if half is None:
            added = beside_face(ratio, 1.0, loads, at)
        else:
            added = between_faces(ratio, 1.0, half, loads, at, odd=odd)
        found.append(_mirrored(ratio, np.array([x, z]), half=half, odd=odd) + added[:, 0, 0, 0])
    assert close_to(expected[:, near], rel=0.0, abs=3e-4) == np.array(found).T
