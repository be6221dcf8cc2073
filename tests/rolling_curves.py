"""Curves over speed of a rolling body, made by a formula."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

import viscontact as vc
from viscontact.results.descriptions import describe

SHIFT = vc.Arrhenius(340.0, 150e3)
RUBBER = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.49, shift=SHIFT)
STEEL = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
COVER = vc.Layered([vc.Layer(8e-3, RUBBER)], base=STEEL)
#: Roll of 60 mm radius, of which 0.5 m are computed.
ROLL, GRID = vc.Paraboloid(np.inf, 60e-3), vc.Grid((1, 64), (0.5, 24e-3), periodic=(True, False))


def rolling_curve(
    peak=40.0, *, speeds=None, material=STEEL, indenter_material=COVER, rolling=True, error=0.01
):
    """Result with the loss of one retardation time: R = 2 R_0 s/(1 + s²), R_0 at 1 m/s."""
    speeds = np.geomspace(1e-4, 1e4, 33) if speeds is None else np.asarray(speeds)
    resistance = peak * 2 * speeds / (1 + speeds**2)
    case = {
        "indenter": describe(ROLL),
        "material": describe(material),
        "indenter_material": None if indenter_material is None else describe(indenter_material),
        "grid": describe(GRID),
        "motion": {"speed": speeds.tolist(), "along": "y", "rolling": rolling},
    }
    scalars = {
        "resistance_y": ("speed", resistance),
        "resistance_y_error": ("speed", error * resistance),
    }
    attributes = {"along": "y", "case": json.dumps(case), "title": "Covered roll"}
    return xr.Dataset(scalars, {"speed": speeds}, attributes)
