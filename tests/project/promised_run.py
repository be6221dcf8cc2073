"""A run that passes through all that can happen, and what its result holds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 4e6), 0.5)  # retarded by 4 s: steps of 1 s are short
BALL = vc.Sphere(0.01)
GRID = vc.Grid((32, 32), (2.4e-3, 2.4e-3))
TIMES = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.1, 3.5, 4.0, 5.0]
#: A jump up at 0 s, one down at 1 s, off from 2 s to 3 s, on again.
LOAD = vc.ForceHistory([0, 1, 1, 2, 3, 4, 5], [0.1, 0.1, 0.05, 0, 0, 0.1, 0.1])


@pytest.fixture(scope="module")
def ds() -> xr.Dataset:
    """A run that passes through all that can happen."""
    return vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES)


SCALARS = {
    **{"force": "N", "eccentricity_x": "m", "eccentricity_y": "m"},
    **{"approach": "m", "tilt_x": "rad", "tilt_y": "rad"},
    **{"contact_area": "m2", "contact_length": "m", "contact_width": "m"},
    **{"peak_pressure": "Pa", "mean_pressure": "Pa", "peak_line_load": "N/m"},
    **{"work": "J", "loss_per_cycle": "J", "time_error": "1"},
    **{"iterations": "1", "residual": "1", "cells_across": "1", "outcome": "1"},
}
ERRORS = {
    f"{name}_error": unit
    for name, unit in SCALARS.items()
    if name not in ("time_error", "iterations", "residual", "cells_across", "outcome")
}
FIELDS = {"pressure": "Pa", "gap": "m", "displacement": "m", "line_load": "N/m", "in_contact": "1"}
COORDINATES = {"time": "s", "x": "m", "y": "m"}
KINDS = {"iterations": "i", "cells_across": "i", "outcome": "i", "in_contact": "i"}


def check_variables(ds: xr.Dataset, fields: type[np.floating] = np.float64) -> None:
    assert set(ds.data_vars) == {*SCALARS, *ERRORS, *FIELDS}
    assert set(ds.coords) == set(COORDINATES)
    for name, unit in {**SCALARS, **ERRORS, **FIELDS, **COORDINATES}.items():
        assert ds[name].attrs["units"] == unit, name
        assert ds[name].attrs["long_name"], name
        assert ds[name].dtype.kind == KINDS.get(name, "f"), name
        assert "axis" not in ds[name].attrs, name
    assert all(ds[name].dims == ("time",) for name in (*SCALARS, *ERRORS))
    for name in ERRORS:
        assert ds[name.removesuffix("_error")].attrs["ancillary_variables"] == name
    axes = dict.fromkeys(FIELDS, ("time", "x", "y")) | {"line_load": ("time", "x")}
    assert all(ds[name].dims == axes[name] for name in FIELDS)
    assert all(ds[name].dtype == np.float64 for name in COORDINATES)
    assert all(ds[name].dtype == fields for name in FIELDS if name not in KINDS)
    assert ds.in_contact.attrs["flag_values"].tolist() == [0, 1]
    assert ds.in_contact.attrs["flag_meanings"] == "open in_contact"
    np.testing.assert_array_equal(ds.in_contact, ds.pressure > 0)  # without adhesion
    assert ds.outcome.attrs["flag_values"].tolist() == [0, 1, 2, 3]
    assert ds.outcome.attrs["flag_meanings"] == "converged no_contact not_converged pulled_off"


CASE: dict[str, Any] = {
    "title": "Ball",
    "indenter": {"shape": "sphere", "radius": "10 mm"},
    "material": {
        **{"law": "zener", "shear_modulus": "1 MPa", "delayed_modulus": "1 MPa"},
        **{"viscosity": "4 MPa s", "poisson_ratio": 0.5},
    },
    "load": {"kind": "step", "force": "100 mN"},
    "time": {"end": "1 s", "steps": 2},
    "grid": {"shape": [32, 32], "size": ["2.4 mm", "2.4 mm"]},
    "output": {"fields": "all"},
}
