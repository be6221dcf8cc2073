"""Runs that the figures are for, and what a figure shows of them."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import viscontact as vc
from synthetic_results import gripping_sphere, maxwell_sphere, roller
from viscontact.plot import FIGURES


@pytest.fixture(scope="module")
def sphere() -> xr.Dataset:
    return maxwell_sphere(cells=40)


@pytest.fixture(scope="module")
def long_contact() -> xr.Dataset:
    return roller()


def legend_texts(axes: Axes) -> list[str]:
    legend = axes.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


#: Figures that only runs under friction have.
OF_FRICTION = {"stick-map", "traction-profile", "fretting-loop", "slip-history"}


#: Figures of bodies that adhere.
OF_ADHESION = {"force-curve"}


#: Figures of contacts on a period.
OF_PERIODS = {"area-pressure"}


@cache
def pressed_waves() -> xr.Dataset:
    """Crossed waves under a force that rises."""
    grid = vc.Grid((16, 16), (1e-3, 1e-3), periodic=True)
    waves = vc.Waviness(1e-6, wavelength_x=1e-3, wavelength_y=1e-3)
    body = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.simulate(
            waves, body, vc.ramp(0.01, 1.0), grid, [0.0, 0.5, 1.0, 2.0], errors=False
        )


@cache
def sticking_sphere() -> xr.Dataset:
    """Sphere of a Tabor number of 1 that jumps into contact and is pulled off."""
    gel = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
    load = vc.ApproachHistory([0.0, 1.0, 2.0], [-2.5e-6, 1e-6, -2.5e-6])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.simulate(
            *(vc.Paraboloid(1e-3, 1e-3), gel, load, vc.Grid((32, 32), (2.4e-4, 2.4e-4))),
            np.linspace(0.0, 2.0, 21),
            adhesion=vc.Adhesion(0.05, range=1.36e-6),
            errors=False,
        )


def run_for(name: str, sphere: xr.Dataset, gripping: xr.Dataset) -> xr.Dataset:
    """Result that a figure is for."""
    if name in OF_PERIODS:
        return pressed_waves()
    if name in OF_ADHESION:
        return sticking_sphere()
    return gripping if name in OF_FRICTION else sphere


@pytest.fixture(scope="module")
def drawn(sphere: xr.Dataset) -> Callable[[str], Figure]:
    """Every figure of the sphere, drawn once; those of friction of one under friction."""
    gripping = gripping_sphere(cells=40)
    return cache(lambda name: FIGURES[name](run_for(name, sphere, gripping)))
