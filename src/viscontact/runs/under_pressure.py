"""Displacement of a body under a pressure that is given: `under_pressure`."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact import __version__
from viscontact.backend.arrays import Bools, Floats
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.clock import TIME
from viscontact.bodies.loads.motion import STANDING, Motion
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.series_body import span_of
from viscontact.mechanics.problem.surface import SurfaceTerms, clock_of, creeps, surface_of
from viscontact.results.accessor import ResultAccessor as ResultAccessor
from viscontact.results.descriptions import describe
from viscontact.results.variables import COORDINATES, FIELDS, SCALARS
from viscontact.runs.given_pressure.reading import given_pressure
from viscontact.runs.given_pressure.surface import LoadedSurface
from viscontact.units.numbers import real_array

_ERROR = {"units": "m", "long_name": "largest error of the displacement, estimated"}


def under_pressure(
    pressure: ArrayLike | Callable[..., Any] | xr.DataArray | xr.Dataset | str | Path,
    material: Material | Layered,
    grid: Grid | None = None,
    times: ArrayLike | None = None,
    *,
    motion: Motion | None = None,
    tension: bool = False,
    errors: bool = True,
) -> xr.Dataset:
    """Displacement over time of a half-space or layers under a pressure that is known.

    No contact is solved. The stresses inside follow by `section_stresses` of the result.

    Parameters
    ----------
    pressure : array_like, callable, xarray.DataArray, xarray.Dataset or path-like
        Pressure on the cells, positive in compression [Pa]: a map of shape (nx, ny), which comes at
        time 0 and is held; maps of shape (time, nx, ny), linear in time between `times`, the first
        at 0; a function of (x, y) or (x, y, t), in m and s, for arrays; an array with the
        coordinates x, y and perhaps time; a result with stored pressure, or its file or directory;
        a table (CSV or spreadsheet) with the columns x, y, pressure and perhaps time.
    material : Material or Layered
        Material of the half-space, or a body of layers.
    grid : Grid, optional
        Cells of the pressure; that of a result or of coordinates when left out.
    times : array_like, optional
        Instants of the result, increasing, none before 0 [s]; those of the maps when left out, or 0
        for a body that does not creep.
    motion : Travel or Reciprocation, optional
        Motion of the pressure over the surface: the map, or the function, is that around its axis.
    tension : bool, optional
        Allow negative pressure, which pulls at the surface.
    errors : bool, optional
        Estimate the error of the displacement.

    Returns
    -------
    xarray.Dataset
        ``pressure`` and ``displacement`` (positive into the body) over (time, x, y), ``force``,
        ``eccentricity_x``, ``eccentricity_y``, ``peak_pressure``, and the extents
        ``contact_length``, ``contact_width`` of the loaded cells over ``time``, in SI units.
        ``displacement_error`` is the largest error over the cells. Of a formula it is the change if
        that is found ten times less closely, or by larger cells if it moves or changes at many
        instants, which leaves its edges out. Of a map it is the change if it is averaged over
        twice as long and wide cells: three times the error of a pressure that is smooth over the
        cells, and about the error of one with edges between their borders, but no error for a
        pressure that is uniform in each cell, under which the displacement is exact. Added are
        the change by twice as many instants, where pressure and path are not linear between them,
        and the errors of the layers' terms and of a law that is found by numbers.

    Raises
    ------
    ValueError
        If an argument is invalid, the map does not fit the grid, the pressure leaves the grid, or
        it pulls without ``tension=True``.

    Notes
    -----
    u(t) = Σ K_m ∫ J_m(t - t') dp(t'), exact for a pressure that is uniform in each cell and linear
    in time (Love 1929 for a half-space; Boltzmann 1874). A formula is divided into polygons of
    linear pressure where it is not smooth, along its edges, which act on the cells near by one by
    one, and as multipoles on others: the displacement is exact to 1e-6. On a grid
    that is periodic along both axes the displacement of a half-space counts from the mean plane, on
    one that is periodic along one axis from a place at the distance of its size; layers on a rigid
    base need no such datum.

    Examples
    --------
    A square of 2 mm under 1 MPa: 1.122 of p a (1 - ν²)/E at its centre (Johnson 1985, eq. 3.26).

    >>> import viscontact as vc
    >>> body = vc.Material(vc.Elastic.from_uniaxial(1e9, 0.3), poisson_ratio=0.3)
    >>> ds = vc.under_pressure(np.full((9, 9), 1e6), body, vc.Grid((9, 9), (2e-3, 2e-3)))
    >>> round(float(ds.displacement[0, 4, 4]) / (2 * 1e6 * 2e-3 * 0.91 / 1e9), 3)
    0.561
    """
    if not isinstance(material, Material | Layered):
        raise ValueError(f"material must be of kind Material or Layered, got {material!r}")
    if motion is not None and not isinstance(motion, Motion):
        raise ValueError(f"motion must be of kind Motion, got {motion!r}")
    given, cells = given_pressure(pressure, grid, times)
    loaded = LoadedSurface(given, cells, STANDING if motion is None else motion, tension)
    wanted = _times(given.times if times is None else times, material)
    return _dataset(loaded, material, wanted, errors)


def _times(given: object, material: Material | Layered) -> Floats:
    """Instants of the result [s]."""
    if given is None:
        if creeps(material):
            raise ValueError(
                "times: the material creeps, so that its displacement depends on the time; give "
                "the instants of the result, such as vc.log_times(1.0, 1000.0, 30)"
            )
        return np.zeros(1)
    times = np.atleast_1d(real_array("times", given, "s"))
    increasing = times.ndim == 1 and times.size > 0 and (np.diff(times) > 0).all()
    if not increasing or not np.isfinite(times).all() or times[0] < 0:
        raise ValueError(f"times must increase, none before 0 and finite, got {times.tolist()}")
    return times


def _surface(material: Material | Layered, times: Floats) -> SurfaceTerms:
    """Terms of the body's surface, on its clock if it ages."""
    clock = clock_of(material, None)
    if clock is not TIME:
        raise ValueError(
            "material: a body that ages creeps on a clock of its own, which is not taken under a "
            "given pressure; leave out ageing="
        )
    return surface_of((material,), (span_of(times),))


def _dataset(
    loaded: LoadedSurface, material: Material | Layered, times: Floats, errors: bool
) -> xr.Dataset:
    grid, surface = loaded.grid, _surface(material, times)
    displacement, error = loaded.displacement_and_error(surface, times, errors=errors)
    pressure = loaded.mean_pressures(times)
    scalars = {
        name: ("time", values, SCALARS[name].attributes)
        for name, values in _resultants(pressure, grid).items()
    }
    for name, axis, meaning in (("contact_length", 0, "x"), ("contact_width", 1, "y")):
        attributes = {"units": "m", "long_name": f"extent of the loaded cells along {meaning}"}
        scalars[name] = ("time", _extents(pressure != 0, axis, grid), attributes)
    if errors:
        error += _relative_error(surface) * np.abs(displacement).max(axis=(1, 2))
        scalars["displacement_error"] = ("time", error, _ERROR)
    fields = {"pressure": pressure, "displacement": displacement}
    arrays = {
        name: (("time", "x", "y"), values, FIELDS[name].attributes)
        for name, values in fields.items()
    }
    along, across = loaded.given.axes or (grid.x, grid.y)
    places = {"time": times, "x": along, "y": across}
    coordinates = {
        name: (name, each, COORDINATES[name].attributes) for name, each in places.items()
    }
    return xr.Dataset({**scalars, **arrays}, coordinates, _attributes(loaded, material, surface))


def _resultants(pressure: Floats, grid: Grid) -> dict[str, Floats]:
    """Force and its eccentricities, and the largest pressure, over time."""
    force = pressure.sum(axis=(1, 2)) * grid.cell_area
    moments = (
        (pressure.sum(axis=2) @ grid.x) * grid.cell_area,
        (pressure.sum(axis=1) @ grid.y) * grid.cell_area,
    )
    along, across = (
        np.divide(each, force, out=np.full(force.shape, np.nan), where=force != 0)
        for each in moments
    )
    return {
        "force": force,
        "eccentricity_x": along,
        "eccentricity_y": across,
        "peak_pressure": pressure.max(axis=(1, 2)),
    }


def _extents(occupied: Bools, axis: int, grid: Grid) -> Floats:
    """Extents along an axis of the cells that are loaded, over time [m]."""
    lines = np.asarray(occupied.any(axis=2 - axis))
    count = lines.shape[1] - np.argmax(lines, axis=1) - np.argmax(lines[:, ::-1], axis=1)
    return np.asarray(np.where(lines.any(axis=1), count * grid.cell_size[axis], 0.0))


def _relative_error(surface: SurfaceTerms) -> float:
    """Relative error of the terms of layers and of a law that is found by numbers [-]."""
    return surface.splitting_error + surface.compliance.inversion_error


def _attributes(
    loaded: LoadedSurface, material: Material | Layered, surface: SurfaceTerms
) -> dict[str, Any]:
    motion = {} if loaded.motion.stands else {"motion": describe(loaded.motion)}
    case = {"material": describe(material), **motion, "grid": describe(loaded.grid)}
    return {
        "Conventions": "CF-1.11",
        "source": f"viscontact {__version__}",
        "version": __version__,
        "case": json.dumps(case),
        "splitting_error": surface.splitting_error,
        "inversion_error": surface.compliance.inversion_error,
    }
