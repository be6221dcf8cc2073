"""Surfaces from and to objects of SurfaceTopography."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from viscontact.bodies.surfaces.surface import Surface
from viscontact.units.parsing import parse_unit

if TYPE_CHECKING:
    from SurfaceTopography import Topography


def is_topography(given: object) -> bool:
    """True for a map or line scan of SurfaceTopography, which is not imported for this."""
    names = ("heights", "physical_sizes", "nb_grid_pts", "is_periodic", "unit")
    return not isinstance(given, type) and all(hasattr(given, name) for name in names)


def surface_of(topography: Topography, *, unit: str | None = None) -> Surface:
    """Return the surface of a SurfaceTopography object.

    Parameters
    ----------
    topography : SurfaceTopography.Topography or UniformLineScan
        Heights, sizes and their unit.
    unit : str, optional
        Unit of heights and sizes, where the object has none.

    Returns
    -------
    Surface
        The same heights in metres, NaN where they are undefined; a line scan has one point along y.

    Raises
    ------
    ValueError
        If it has no sizes, no unit, or both a unit and `unit`; or if its points are unevenly
        spaced.

    Examples
    --------
    >>> from SurfaceTopography import Topography
    >>> surface = surface_of(Topography(np.eye(3), (3.0, 3.0), unit="um"))
    >>> surface.spacing[0], float(surface.heights.max())
    (1e-06, 1e-06)
    """
    found: Any = topography
    if not is_topography(found) or not getattr(found, "is_uniform", True):
        raise ValueError(
            f"topography: needs a map or an even line scan of SurfaceTopography, got {found!r}"
        )
    if found.physical_sizes is None:
        raise ValueError("topography: has no physical sizes; give them to SurfaceTopography")
    if (found.unit is None) == (unit is None):
        wrong = (
            "has no unit; give unit=, such as 'um'"
            if unit is None
            else (f"has the unit {found.unit!r} already; leave unit= out")
        )
        raise ValueError(f"topography: {wrong}")
    scale = parse_unit(str(found.unit or unit), "length")
    heights = np.ma.filled(np.ma.asarray(found.heights()).astype(np.float64), np.nan) * scale
    sizes = zip(found.physical_sizes, found.nb_grid_pts, strict=True)
    steps = [float(size) * scale / count for size, count in sizes]
    heights = heights if heights.ndim == 2 else heights[:, np.newaxis]
    return Surface(
        heights, (steps[0], steps[-1]), name="topography", periodic=bool(found.is_periodic)
    )


def topography_of(surface: Surface) -> Topography:
    """Return a surface as an object of SurfaceTopography, in metres.

    Parameters
    ----------
    surface : Surface
        The surface; points without a height are undefined data.

    Returns
    -------
    SurfaceTopography.Topography
        With its unit, sizes and periodicity.

    Raises
    ------
    ValueError
        If SurfaceTopography is not installed, or the surface is a line scan.

    Examples
    --------
    >>> float(topography_of(Surface([[0.0, 2e-6], [0.0, 2e-6]], 1e-6)).rms_height_from_area())
    1e-06
    """
    try:
        from SurfaceTopography import Topography  # takes two seconds
    except ImportError as error:
        raise ValueError(
            "topography_of: needs SurfaceTopography; type: pip install 'viscontact[surfaces]'"
        ) from error
    if min(surface.shape) < 2:
        raise ValueError(f"topography_of: {surface.name} is a line scan; widen it with swept")
    heights = np.ma.masked_invalid(surface.heights) if surface.missing.any() else surface.heights
    return Topography(
        heights, surface.size, unit="m", periodic=surface.periodic, info={"name": surface.name}
    )
