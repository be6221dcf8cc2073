"""Stated error of the operators of ends against finer panels, further waves and functions."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

from closeness import close_to
from returned import some
from viscontact.backend.arrays import Floats
from viscontact.backend.transforms import transforms_by
from viscontact.mechanics.halfspace import (
    end_correction,
    ended_rows,
    free_end,
    plane_strip,
    strip,
    strip_basis,
)
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.periodic_ends import PeriodicEndCorrection

#: Settings of a finer operator, by module.
FINER = {
    strip: {
        "WAVES": 40,
        "SERIES": strip.LogChebyshev(0.04, 12.0, 40),
        "LOWEST_WAVE": 0.04,
        "HIGHEST_WAVE": 12.0,
        "RATIO": 5.0,
        "RATIO_ON_FACE": 5.0,
        "ON_FACE": 1e-12,
        "ON_SURFACE": 1e-11,
        "DEEPEST": 32.0,
        "IMAGE_RATIO": 1.6,
        "FACE_RATIO": 3.0,
    },
    free_end: {
        "RATIO": 2.0,
        "LOWEST": 1e-15,
        "NEAREST": 1e-8,
        "HIGHEST": 32.0,
        "NEGLECTED": 1e-10,
    },
    end_correction: {
        "HIGHEST": 32.0,
        "NEGLECTED": 1e-12,
        "FIRST_WAVE": 1e-5,
        "NEAREST": 1e-6,
        "RATIO": 3.0,
    },
    strip_basis: {"HIGHEST": 32.0, "NEGLECTED": 1e-13, "FIRST_WAVE": 1e-5},
}

#: Rows, columns, and size along y over the length.
GRIDS = ((40, 32, 0.3), (160, 32, 2.0), (64, 48, 5.0))
ENDS = {"one": ((0.0, None), (True, False)), "both": ((0.0, 1.0), (True, True))}


@pytest.fixture
def finer() -> Iterator[pytest.MonkeyPatch]:
    """Patches that make the operators finer, once they are applied, and leave no trace."""
    with pytest.MonkeyPatch.context() as patch:
        yield patch
    _forget()


def _refine(patch: pytest.MonkeyPatch) -> None:
    for module, settings in FINER.items():
        for name, value in settings.items():
            patch.setattr(module, name, value)
    _forget()


def _forget() -> None:
    kept = (strip.surface_panels, strip.face_of_strips, strip._parts_of, strip.strip_table)
    others = (free_end.images, free_end.end_functions, plane_strip.plane_strip)
    basis = strip_basis._of_short_waves
    rows = (ended_rows._kept_rows, ended_rows._kept_period)
    for function in (*kept, *others, basis, *rows):
        function.cache_clear()


def _pressures(shape: tuple[int, int]) -> dict[str, Floats]:
    """Pressures that are even or odd about the middle, or at the end; over the grid [Pa]."""
    x = (np.arange(shape[0]) + 0.5) / shape[0] * 2 - 1
    y = (np.arange(shape[1]) + 0.5) / shape[1] * 2 - 1
    across = np.sqrt(np.maximum(1 - (y / 0.6) ** 2, 0.0))
    along = {"even": x**0, "odd": x, "tilted": 1 + 0.8 * x, "first cells": np.exp(-40 * (1 + x))}
    return {name: each[:, None] * across for name, each in along.items()}


def _added(ratio: float, ends: str, grid: tuple[int, int, float]) -> dict[str, Floats]:
    """Displacement that the free ends of a body of length 1 add, by pressure [m Pa]."""
    planes, free = ENDS[ends]
    nx, ny, width = grid
    cell = 1 / nx, width / ny
    borders = (0, None if planes[1] is None else nx)
    rows = ended_rows.ended_rows(EndedResponse(ratio, planes, free), (nx, ny), cell, borders)
    found = {}
    for name, pressure in _pressures((nx, ny)).items():
        parts = (end_correction.EndCorrection(b, slice(0, nx), ny, cell) for b in rows.bases)
        found[name] = np.sum([part.apply(pressure) for part in parts], axis=0)
    return found


def _stated(ratio: float, ends: str) -> float:
    """Error of the displacement that is stated."""
    found = end_correction.ends_error(ratio)
    if ends == "both":
        found += max(strip_basis.strip_error(ratio, odd=odd) for odd in (False, True))
    return found


@pytest.mark.parametrize("ends", ENDS)
@pytest.mark.parametrize(
    "ratio", [0.3, *(pytest.param(r, marks=pytest.mark.slow) for r in (0.0, 0.15, 0.45, 0.5))]
)
def test_what_operators_of_ends_miss_is_within_their_stated_error(
    finer: pytest.MonkeyPatch, ratio: float, ends: str
) -> None:
    coarse, stated = [_added(ratio, ends, grid) for grid in GRIDS], _stated(ratio, ends)
    _refine(finer)
    fine = [_added(ratio, ends, grid) for grid in GRIDS]
    missed = []
    for (nx, ny, width), one, other in zip(GRIDS, coarse, fine, strict=True):
        half_space = Convolution(influence_table((nx, ny), (1 / nx, width / ny)))
        for name, pressure in _pressures((nx, ny)).items():
            sunk = half_space.apply(pressure)
            largest = max(float(np.abs(each).max()) for each in (sunk, other[name]))
            missed.append(float(np.abs(one[name] - other[name]).max()) / largest)
    assert 1e-8 < max(some(missed)) < stated
    assert stated < 1e-4


@pytest.mark.parametrize("free", [(True, True), (True, False)])
@pytest.mark.parametrize("rows", [40, 160])
def test_what_the_operator_of_plane_strain_misses_is_within_its_stated_error(
    finer: pytest.MonkeyPatch, free: tuple[bool, bool], rows: int
) -> None:
    x = (np.arange(rows) + 0.5) / rows * 2 - 1

    def added() -> Floats:
        response = EndedResponse(0.3, (0.0, 1.0), free)
        whole = ended_rows.ended_rows(
            response, (rows, 1), (1 / rows, 1.0), (0, rows), periodic=True
        )
        pressures = np.stack([x**0, x, np.exp(-40 * (1 + x))])
        options = {"single": False, "transforms": transforms_by("scipy")}
        parts = [PeriodicEndCorrection(b, slice(0, rows), 1, **options) for b in whole.periodic]
        return np.stack([sum(part.apply(p[:, None]) for part in parts) for p in pressures])

    coarse, stated = added(), max(plane_strip.plane_strip(odd=o).error for o in (False, True))
    _refine(finer)
    fine = added()
    missed = np.abs(coarse - fine).max(axis=(1, 2))
    # The half-plane sinks by about 2/π times the load, on a length of 1/80 by ln 80 times that.
    half_plane = 2 / math.pi * np.array([1.0, 0.5, math.log(80) / 80])
    assert (missed < stated * np.maximum(np.abs(fine).max(axis=(1, 2)), half_plane)).all()
    assert stated == close_to(2e-5, rel=0.2)
