"""Leakage of a contact: the fluid that flows through its gap."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.results.leakage.channels import Ends, FlowAxis
from viscontact.results.leakage.closing import (
    changes,
    closing_force,
    contact_shares,
    scalar_at_fields,
)
from viscontact.results.leakage.fluid import Fluid, flow_axis, fluid_of
from viscontact.results.leakage.instant import InstantLeakage
from viscontact.results.leakage.variables import VARIABLES
from viscontact.results.leakage.warnings import leakage_warnings
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import field_times
from viscontact.results.stored_contact import cells_in_contact
from viscontact.results.variables import SCALARS

#: Tolerance of a run that does not state its own.
_TOLERANCE = 1e-6


def leakage(  # noqa: PLR0913
    ds: xr.Dataset,
    *,
    viscosity: float,
    pressure_difference: float | None = None,
    along: Literal["x", "y", "both"] = "x",
    ends: Ends | None = None,
    length: float | None = None,
    width: float | None = None,
    gas: float | None = None,
    fields: Literal["none", "all"] = "none",
) -> xr.Dataset:
    """Flow of a fluid through the gap of a contact, at its stored instants or speeds.

    Parameters
    ----------
    ds : xarray.Dataset
        Result of `simulate`, `steady` or `open_results`, with stored fields.
    viscosity : float
        Of the fluid [Pa s].
    pressure_difference : float, optional
        Between both sides of the seal, positive [Pa]; without it the leak rate is NaN.
    along : {"x", "y", "both"}, optional
        Direction of the flow; "both" gives the dimension ``direction``.
    ends : {"period", "pressure"}, optional
        "period": the pressure falls evenly from period to period, and a channel has to close on
        itself; the default where the grid is periodic along the flow. "pressure": it is given on
        the two outer faces. Both differ; do not mix them in one curve.
    length, width : float, optional
        Of the seal along and across the flow [m]; those of the grid when left out.
    gas : float, optional
        Absolute pressure at the outlet of an ideal gas [Pa], whose leak rate is the volume at this
        pressure; a liquid when left out.
    fields : {"none", "all"}, optional
        "all": with ``fluid_pressure``, ``flux_x``, ``flux_y`` and ``channel``.

    Returns
    -------
    xarray.Dataset
        Over ``time`` or ``speed``: ``transmissivity`` T [m³], which is h³/12 between parallel
        plates and depends on the gap alone, ``leak_rate`` = T dp width/(viscosity length) [m³/s],
        both with ``_error``; ``percolates``; ``critical_gap`` [m], the gap at the narrowest place
        of the widest channel, at ``critical_x``, ``critical_y``, with ``critical_gap_error``;
        ``effective_gap`` (12 T)^(1/3), ``mean_gap`` [m], ``contact_fraction``, the share of
        cells in contact, ``area_fraction``, the real over the nominal area [-], ``flux_imbalance``
        [-] and ``transmissivity_effective_medium``, an estimate from the distribution of gaps
        alone. A contact without any channel has T, leak rate and critical gap 0, and as the error
        of this gap how open it might be. ``closing_force`` [N] is the force at which the flow first
        stops, with half the step of the stored instants as its error, NaN if it does not.
        Attributes: ``changes``, a sentence for each closing and opening, and ``warnings``.

    Raises
    ------
    ValueError
        If no gap is stored, an argument is invalid, or the channels are too large.

    Notes
    -----
    Reynolds' equation div(h³ grad p) = 0, without flow into cells in contact. The fluid does not
    push the bodies apart, and has no inertia; in steady motion the fluid that the moving surface
    drags along is left out. The error is the difference of two discretisations, which deviate to
    opposite sides on rough gaps.

    References
    ----------
    O. Reynolds, Phil. Trans. R. Soc. 177 (1886) 157; B. N. J. Persson, C. Yang, J. Phys.: Condens.
    Matter 20 (2008) 315011.

    Examples
    --------
    Waves that are pressed by a small force leave room for a fluid, along their valleys:

    >>> import viscontact as vc
    >>> waves = vc.Waviness(1e-6, wavelength_y=1e-4)
    >>> grid = vc.Grid((4, 64), (1e-4, 1e-4), periodic=True)
    >>> steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
    >>> ds = vc.simulate(waves, steel, vc.step(1e9 * grid.area), grid, [0.0], errors=False)
    >>> leak = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e5, along="both")
    >>> leak.percolates[0].values.tolist(), f"{float(leak.leak_rate[0, 0]) * 1e9:.3f} mm3/s"
    ([1.0, 0.0], '0.006 mm3/s')
    """
    given = {"viscosity": viscosity, "pressure_difference": pressure_difference, "gas": gas}
    fluid = fluid_of({**given, "length": length, "width": width})
    if along not in ("x", "y", "both"):
        raise ValueError(f"along must be 'x', 'y' or 'both', got {along!r}")
    if fields not in ("none", "all"):
        raise ValueError(f"fields must be 'none' or 'all', got {fields!r}")
    places, grid = field_times(ds, "leakage"), recorded_grid(ds)
    axes = [0, 1] if along == "both" else ["xy".index(along)]
    flows = [flow_axis("xy"[axis], ends, grid) for axis in axes]
    instants = list(_instants(ds, grid, flows))
    found = _dataset(ds, instants, fluid, keep=fields == "all")
    if along != "both":
        found = found.isel(direction=0, drop=True)
    name = run_axis(ds).name
    found = found.assign_coords({name: (name, places, ds[ds["pressure"].dims[0]].attrs)})
    found = found.assign(force=(name, scalar_at_fields(ds, "force"), SCALARS["force"].attributes))
    area = (name, contact_shares(ds), VARIABLES["area_fraction"].attributes)
    found = found.assign(area_fraction=area).assign(_closing(found))
    notes = leakage_warnings(found, ds, instants, fluid)
    described = {"viscosity": viscosity, "ends": [each.ends for each in flows], "along": along}
    said = {"warnings": "\n".join(notes), "changes": "\n".join(changes(found))}
    return found.assign_attrs({**described, **said})


def _closing(found: xr.Dataset) -> dict[str, Any]:
    """Force at which the flow stops, with its error, in each direction."""
    opened, force = found["percolates"].values > 0, found["force"].values
    names = ("closing_force", "closing_force_error")
    if opened.ndim == 1:
        values = closing_force(opened, force)
        return {n: ((), v, VARIABLES[n].attributes) for n, v in zip(names, values, strict=True)}
    both = zip(*(closing_force(each, force) for each in opened.T), strict=True)
    return {
        name: ("direction", np.array(values), VARIABLES[name].attributes)
        for name, values in zip(names, both, strict=True)
    }


def instant_leakage(ds: xr.Dataset, index: int, along: str, ends: Ends | None) -> InstantLeakage:
    """Leakage of one stored instant, by its index, along one axis."""
    grid = recorded_grid(ds)
    return _instant(ds, grid, flow_axis(along, ends, grid), index)


def _instants(ds: xr.Dataset, grid: Grid, flows: list[FlowAxis]) -> Iterator[list[InstantLeakage]]:
    """Leakage at each stored instant along some axes, which share what they have in common."""
    for index in range(ds.sizes[ds["pressure"].dims[0]]):
        first = _instant(ds, grid, flows[0], index)
        yield first.along(flows)


def _instant(ds: xr.Dataset, grid: Grid, flow: FlowAxis, index: int) -> InstantLeakage:
    # Files hold single precision, whose cube of a gap underflows.
    gap = np.asarray(ds["gap"].values[index], dtype=np.float64)
    touched = np.asarray(cells_in_contact(ds, index), dtype=bool)
    if np.isnan(gap).any():
        raise ValueError(
            "leakage: the gap is not known on the whole grid at all instants or speeds, as their "
            "grids differ; run again on a given grid ('grid' with shape and size), or choose those "
            "on the last grid"
        )
    return InstantLeakage(gap, touched, grid, flow, float(ds.attrs.get("tolerance", _TOLERANCE)))


def _dataset(
    ds: xr.Dataset, instants: list[list[InstantLeakage]], fluid: Fluid, *, keep: bool
) -> xr.Dataset:
    name = run_axis(ds).name
    dims = (name, "direction")
    rows = [[each.row for each in at] for at in instants]
    values = {
        key: np.array([[row[key] for row in at] for at in rows], dtype=float) for key in rows[0][0]
    }
    for key in ("", "_error"):
        rates = [
            fluid.rate(values[f"transmissivity{key}"][:, k], *each.extents)
            for k, each in enumerate(instants[0])
        ]
        values[f"leak_rate{key}"] = np.stack(rates, axis=1)
    found: dict[str, Any] = {
        key: (dims, each, VARIABLES[key].attributes) for key, each in values.items()
    }
    fraction = np.array([at[0].touched.mean() for at in instants])
    found["contact_fraction"] = (name, fraction, VARIABLES["contact_fraction"].attributes)
    if keep:
        found |= _fields(name, instants, fluid)
    directions = ["xy"[each.flow.axis] for each in instants[0]]
    places = {each: (each, ds[each].values, ds[each].attrs) for each in "xy"} if keep else {}
    return xr.Dataset(found, {"direction": directions, **places})


def _fields(name: str, instants: list[list[InstantLeakage]], fluid: Fluid) -> dict[str, Any]:
    """Pressure of the fluid, its flow in each cell, and the channels."""
    drop = fluid.pressure_difference
    if drop is None:
        raise ValueError("fields: the pressure and flow of the fluid need pressure_difference=")
    found = [[fields_of(each, drop, fluid.viscosity) for each in at] for at in instants]
    dims = (name, "direction", "x", "y")
    return {
        key: (
            dims,
            np.array([[each[key] for each in at] for at in found]),
            VARIABLES[key].attributes,
        )
        for key in found[0][0]
    }


def fields_of(each: InstantLeakage, drop: float = 1.0, viscosity: float = 1.0) -> dict[str, Floats]:
    """Fields of one instant; over the pressure difference and viscosity by default."""
    solution, shape = each.solution, each.gap.shape
    if solution is None:
        nothing = np.zeros(shape)
        return {
            "fluid_pressure": np.full(shape, np.nan),
            "flux_x": nothing,
            "flux_y": nothing,
            "channel": nothing,
        }
    dx, dy = each.grid.cell_size
    return {
        "fluid_pressure": drop * solution.pressure,
        "flux_x": drop / viscosity * _in_cells(solution.flux_x, 0, each.flow) / dy,
        "flux_y": drop / viscosity * _in_cells(solution.flux_y, 1, each.flow) / dx,
        "channel": each.cells.astype(float),
    }


def _in_cells(flux: Floats, axis: int, flow: FlowAxis) -> Floats:
    """Mean of the flows through both faces of each cell."""
    before = np.roll(flux, 1, axis)
    if flow.ends == "pressure" and axis == flow.axis:  # what leaves a cell at an end came into it
        flux, before = flux.copy(), before.copy()
        np.moveaxis(before, axis, 0)[0] = np.moveaxis(flux, axis, 0)[0]
        np.moveaxis(flux, axis, 0)[-1] = np.moveaxis(before, axis, 0)[-1]
    return np.asarray((flux + before) / 2)
