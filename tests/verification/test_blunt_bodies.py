"""Bodies r^n: the area of a receding contact, and the peak at an apex, with their bars."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import gamma

import viscontact as vc
from closeness import close_to
from verification.families.round_profiles import PowerBody, RoundProfile
from viscontact import reference

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

A, LAW = 1e-3, vc.Zener(1e6, 1e6, 1e6)
MATERIAL = vc.Material(LAW, poisson_ratio=0.5)


def transform(exponent: float) -> float:
    """g(s)/f(s) of a body f = r^n (Sneddon 1965)."""
    return math.sqrt(math.pi) * gamma(exponent / 2 + 1) / gamma((exponent + 1) / 2)


def blunt(exponent: float) -> tuple[PowerBody, RoundProfile]:
    """A body whose slope is 0.02 where r is 1 mm, and its transform."""
    length = A / 0.02 ** (1 / (exponent - 1))
    factor = transform(exponent) / (exponent * length ** (exponent - 1))
    profile = RoundProfile(
        lambda r: (r / length) ** (exponent - 1), lambda s: factor * s**exponent, 4 * A
    )
    return PowerBody(exponent, length), profile


class Compliance:
    """J(t) of the material with its means."""

    creep = MATERIAL.contact_compliance()

    def __call__(self, lag: np.ndarray) -> np.ndarray:
        return np.asarray(self.creep(lag))

    def mean(self, begin: np.ndarray, end: np.ndarray) -> np.ndarray:
        return np.asarray(self.creep.mean_creep(begin, end))


@pytest.mark.parametrize(
    "exponent", [5.0, *(pytest.param(n, marks=pytest.mark.slow) for n in (2.0, 3.0, 8.0))]
)
def test_area_of_a_receding_contact_is_of_second_order_within_its_bars(exponent: float) -> None:
    """The force falls, then is held. By the gap alone the rim is found too far outside.

    The area was off by 2.4e-3 for n = 5 on 104 cells, and converged with the first order.
    """
    body, profile = blunt(exponent)
    depth, swept = (float(of(np.array(A))) for of in (profile.depth, profile.depth_integral))
    force = 2 * (A * depth - swept) / float(Compliance()(1.0))
    corners, forces = np.array([0.0, 1.0, 2.0, 4.0]), force * np.array([0.0, 1.0, 0.4, 0.4])
    dense = reference.clustered_times(corners, 100)
    exact = reference.press_axisymmetric(
        profile,
        dense,
        force=np.interp(dense, corners, forces),
        creep_compliance=Compliance(),
        elements=800,
    )
    times = vc.uniform_times(4.0, 120)
    radius = np.interp(times, dense, exact.contact_radius)
    receding = (times > 1.15) & (times < 2.05)
    errors = []
    for cells in (48, 96):
        size = 2.6 * radius.max()
        grid = vc.Grid((cells, cells), (size, size))
        load = vc.ForceHistory(corners, forces)
        ds = vc.simulate(body, MATERIAL, load, grid, times, fields="none")
        off = np.abs(ds.contact_area.values - np.pi * radius**2)
        assert np.mean(off[1:] <= ds.contact_area_error.values[1:]) >= 0.9
        errors.append(off[receding].mean() / (np.pi * radius.max() ** 2))
    assert errors[1] < 1.5e-3
    assert errors[0] > 2.8 * errors[1]


@pytest.mark.parametrize(
    ("exponent", "cells"),
    [(1.3, 41), (1.5, 80), (1.8, 41), pytest.param(1.5, 160, marks=pytest.mark.slow)],
)
def test_peak_at_an_apex_is_within_its_bar(exponent: float, cells: int) -> None:
    """p(0) = E* f'(a)/π · g/f · 1/(n - 1): the apex pressure is finite, and has a cusp.

    From p(r) = E*/π ∫ g'(s)/sqrt(s² - r²) ds up to a (Sneddon 1965), with g = k s^n.
    """
    body, profile = blunt(exponent)
    modulus = 1 / float(Compliance.creep(0.0))
    depth, swept = (float(of(np.array(A))) for of in (profile.depth, profile.depth_integral))
    factor = depth / A**exponent
    peak = modulus / math.pi * factor * exponent / (exponent - 1) * A ** (exponent - 1)
    elastic = vc.Material(vc.Elastic(LAW(0.0) ** -1 / 2), poisson_ratio=0.5)
    load = vc.step(2 * modulus * (A * depth - swept))
    for aside in (0.0, 0.5):
        grid = vc.Grid((cells, cells), (2.6 * A, 2.6 * A))
        shift = aside * grid.cell_size[0]
        ds = vc.simulate(body.shifted(shift, shift), elastic, load, grid, [0.0], fields="none")
        assert float(ds.approach[0]) == close_to(depth, rel=0.02)
        found, bar = float(ds.peak_pressure[0]), float(ds.peak_pressure_error[0])
        assert abs(found - peak) <= bar < 5 * abs(found - peak)
