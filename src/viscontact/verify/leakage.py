"""Verification cases of the flow through gaps: channels with closed forms."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.results.leakage.channels import FlowAxis
from viscontact.results.leakage.flow import solved_flow
from viscontact.verify.case import Case, Comparison, Quantity, single

_PERIODIC = (True, True)
_GAP = 1e-6  # [m]


def _transmissivity(gap: Floats, axis: int) -> float:
    """T of a gap over a square of unit edges, over that of a gap of 1 µm between plates [-]."""
    cell_size = (1 / gap.shape[0], 1 / gap.shape[1])
    flow = FlowAxis(axis, "period", _PERIODIC)
    return solved_flow(gap, gap > 0, flow, cell_size).transmissivity / (_GAP**3 / 12)


def _waves(cells: int) -> tuple[Comparison, ...]:
    """Waves of the gap, with a fluid that flows over them and along them."""
    a, x = 0.8, (np.arange(cells) + 0.5) / cells
    gap = _GAP * (1 + a * np.cos(2 * math.pi * x))[:, None] * np.ones((1, 4))
    over = (1 - a * a) ** 2.5 / (1 + a * a / 2)
    along = 1 + 1.5 * a * a
    return single(over, _transmissivity(gap, 0)), single(along, _transmissivity(gap, 1))


def around_spots(cells: int, part: float) -> float:
    """T over its closed form around round spots of contact in a square array, between plates."""
    x = (np.arange(cells) + 0.5) / cells - 0.5
    gap = np.where(np.square(x)[:, None] + np.square(x) < part / math.pi, 0.0, _GAP)
    rest = 1 + part - 0.305827 * part**4 - 0.013362 * part**8
    return _transmissivity(gap, 0) / (1 - 2 * part / rest)


def _spots(cells: int) -> tuple[Comparison, ...]:
    return tuple(single(1.0, around_spots(cells, part)) for part in (0.1, 0.3, 0.5))


def through_slot(cells: int, width: float, length: float, long: float) -> float:
    """T over h³/12 of a slot between two rooms of unit width, with so many cells across."""
    count, rows = cells, round(length * cells)
    y = (np.arange(count) + 0.5) / count
    x = (np.arange(rows) + 0.5) / cells - length / 2
    is_open = (np.abs(x)[:, None] > long / 2) | (np.abs(y - 0.5) < width / 2)
    gap = np.where(is_open, 1.0, 0.0)
    flow = FlowAxis(0, "pressure", (False, False))
    return 12 * solved_flow(gap, is_open, flow, (1 / cells, 1 / cells)).transmissivity


def _slot(cells: int) -> tuple[Comparison, ...]:
    """A slot between two rooms; the length that both steps add is known by conformal mapping."""
    a, length, long = 0.25, 3.0, 0.5
    steps = (a * a + 1) / a * math.log((1 + a) / (1 - a)) - 2 * math.log(4 * a / (1 - a * a))
    exact = length / (length - long + long / a + steps / math.pi)
    return (single(exact, through_slot(cells, a, length, long)),)


CASES: tuple[Case, ...] = (
    Case(
        "flow through a wavy gap",
        "Reynolds 1886",
        (
            Quantity("transmissivity over the waves", "1", 1e-6, 1e-9, has_order=False),
            Quantity("transmissivity along them", "1", 1e-9, 1e-9),
        ),
        (16, 32, 64),
        _waves,
    ),
    Case(
        "flow around round spots",
        "Rayleigh 1892",
        tuple(
            Quantity(f"transmissivity, {share} in contact", "1", 1e-2, 1e-3, has_order=False)
            for share in ("10 %", "30 %", "50 %")
        ),
        (64, 128, 512),
        _spots,
    ),
    Case(
        "flow through a slot between rooms",
        "conformal mapping",
        (Quantity("transmissivity", "1", 5e-3, 1e-3),),
        (32, 64, 128),
        _slot,
    ),
)
