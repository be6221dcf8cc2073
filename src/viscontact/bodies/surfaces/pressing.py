"""Conversion of a measured surface to an indenter."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscontact.bodies.indenters import HeightMap
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.topographies import surface_of
from viscontact.units.formatting import format_quantity

if TYPE_CHECKING:
    from SurfaceTopography import Topography


def indenter_of(surface: Surface | Topography, *, holes: bool = False) -> HeightMap:
    """Return the indenter of a surface that is turned over and pressed, peaks first.

    Parameters
    ----------
    surface : Surface or SurfaceTopography.Topography
        The surface, levelled.
    holes : bool, optional
        True if missing points are holes, which never touch; otherwise they are refused.

    Returns
    -------
    HeightMap
        Around the middle of the map.

    Raises
    ------
    ValueError
        If it is a line scan, points are missing, or the heights cannot be in the unit of the
        lengths.

    Examples
    --------
    >>> float(indenter_of(Surface([[0.0, 1e-6], [0.0, 0.0]], 1e-5)).gap(5e-6, -5e-6))
    1e-06
    """
    if not isinstance(surface, Surface):
        surface = surface_of(surface)
    require_map(surface)
    if not holes:
        require_complete(surface)
    _require_lengths(surface)
    return HeightMap(surface.x, surface.y, surface.heights, holes=holes)


def require_complete(surface: Surface) -> None:
    """Refuse a surface with missing points."""
    if surface.missing.any():
        raise ValueError(
            f"missing: {surface.name} has no height at {int(surface.missing.sum())} of "
            f"{surface.missing.size} points ({surface.missing_share:.2%}); choose their height: "
            "a hole that never touches, the lowest height, or a smooth film over the neighbours"
        )


def require_map(surface: Surface) -> None:
    """Refuse a line scan."""
    if min(surface.shape) < 2:
        nx, ny = surface.shape
        raise ValueError(
            f"width: {surface.name} is a line scan ({nx} x {ny} points), which has no second "
            "direction; give the width over which it is to be swept, as ridges are"
        )


def _require_lengths(surface: Surface) -> None:
    """Refuse heights that exceed the size of the map: their unit is wrong."""
    span, extent = surface.height_range, max(surface.size)
    if span > extent:
        raise ValueError(
            f"height_factor: the heights of {surface.name} span {format_quantity(span, 'm', 3)} on "
            f"a map of no more than {format_quantity(extent, 'm', 3)}; is their unit another, or "
            "the map not levelled? A factor such as 1e-3 corrects a unit"
        )
