"""Doubts about a contact's geometry: small strains, bodies that end, and what the grid misses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from viscontact.grid import Grid
from viscontact.indenters import CombinedIndenter, HeightMap, Indenter
from viscontact.rim import Rim

#: Small-strain theory is doubtful beyond these: slope, contact half width / R, approach / R, and
#: for a body without a radius approach / half width, which a cone of that slope has at 0.47.
STEEP_SLOPE, WIDE_CONTACT, DEEP_APPROACH, DEEP_PUNCH = 0.3, 0.3, 0.1, 0.5

#: Cells across a contact whose extents can be measured against the approach.
FEW_CELLS = 4

#: A body counts as deep if the contact's half width is no larger part of its thickness.
THIN_BODY = 0.2

#: A map's peak that lies between the grid's points may be missed by this part of the approach.
MISSED_PEAK = 0.1

#: Samples along each axis, of three times the grid, where a body is looked for beyond it.
BEYOND_SAMPLES = 48


@dataclass(frozen=True, eq=False)
class Geometry:
    """What the doubts about geometry need to know.

    Attributes
    ----------
    indenter : Indenter
        The shape; its radius of curvature is the measure of depth and width.
    open_gap : ndarray, shape (nx, ny)
        Initial gap [m], +inf outside the outline.
    grid : Grid
        The cells.
    thickness : float
        Of the thinner body; inf if none is told [m].
    indenter_gives : bool
        Whether the indenter is deformable, and so taken for a half-space as well.
    """

    indenter: Indenter
    open_gap: NDArray[np.float64]
    grid: Grid
    thickness: float = math.inf
    indenter_gives: bool = False

    @cached_property
    def beyond(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Points of the body outside the grid: x, y and gap [m]."""
        found = [_outside(self.grid, *lines) for lines in self._sampled_lines()]
        x, y = (np.concatenate(coordinates) for coordinates in zip(*found, strict=True))
        gap = self.indenter.gap(x, y)
        solid = np.isfinite(gap)
        return x[solid], y[solid], gap[solid]

    @cached_property
    def missed(self) -> NDArray[np.float64]:
        """How far a map's points stand out between the grid's points, by cells [m]."""
        missed = np.zeros(self.grid.shape)
        for part in _maps(self.indenter):
            x, y = (lines.ravel() for lines in np.meshgrid(part.x, part.y, indexing="ij"))
            places = [
                (along - lines[0]) / cell
                for along, lines, cell in zip(
                    (x, y), (self.grid.x, self.grid.y), self.grid.cell_size, strict=True
                )
            ]
            # Outside the grid, and beside the body's end, nothing can be said.
            seen = ndimage.map_coordinates(
                np.nan_to_num(self.open_gap, posinf=np.nan), places, order=1, cval=np.nan
            )
            known = np.isfinite(seen)
            cells = tuple(np.rint(place[known]).astype(np.intp) for place in places)
            np.maximum.at(missed, cells, seen[known] - self.indenter.gap(x[known], y[known]))
        return missed

    def _sampled_lines(self) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
        lx, ly = self.grid.size
        part = np.linspace(-1.5, 1.5, BEYOND_SAMPLES + 1)
        yield lx * part, ly * part
        for part_map in _maps(self.indenter):
            yield part_map.x, part_map.y


def geometry_doubts(
    geometry: Geometry,
    rim: Rim,
    motion: NDArray[np.float64],
    displacement: NDArray[np.float64],
) -> dict[str, str]:
    """Doubts about small strains, about where the bodies end, and about what the grid misses.

    Parameters
    ----------
    geometry : Geometry
        The undeformed shape on its grid.
    rim : Rim
        The contact and its extents.
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad].
    displacement : ndarray, shape (nx, ny)
        Displacement of the surface [m].

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.
    """
    return (
        strain_doubts(geometry, rim, motion)
        | body_doubts(geometry, rim)
        | _missed_doubts(geometry, rim, motion, displacement)
    )


def strain_doubts(geometry: Geometry, rim: Rim, motion: NDArray[np.float64]) -> dict[str, str]:
    """Doubts about strains too large for a linear theory: slope, width, approach.

    Parameters
    ----------
    geometry, rim, motion
        As in `geometry_doubts`.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.
    """
    doubts: dict[str, str] = {}
    open_gap = geometry.open_gap[rim.rows, rim.columns]
    half_width, radius = _half_width(rim), geometry.indenter.radius_of_curvature
    slope = _steepest_slope(open_gap, rim.contact, motion, geometry.grid.cell_size)
    if slope > STEEP_SLOPE:
        doubts["slope"] = (
            f"the indenter's slope within the contact reaches {slope:.2g}; "
            f"small-strain half-space theory is meant for slopes below {STEEP_SLOPE:g}"
        )
    if half_width > WIDE_CONTACT * radius:
        doubts["width"] = (
            f"the contact's half width is {half_width / radius:.2g} of the indenter's radius of "
            f"curvature; half-space theory is meant for less than {WIDE_CONTACT:g}"
        )
    measure, named, most = radius, "indenter's radius of curvature", DEEP_APPROACH
    if math.isinf(radius):
        measure, named, most = half_width, "contact's half width", DEEP_PUNCH
    # Of a body without a radius, slopes say it already where there are any; and the extents of a
    # contact of few cells say little.
    known = math.isfinite(radius) or (slope <= STEEP_SLOPE and _spans(rim.contact, FEW_CELLS))
    if known and motion[0] > most * measure:
        doubts["approach"] = (
            f"the approach is {motion[0] / measure:.2g} of the {named}; "
            f"small-strain theory is meant for less than {most:g}"
        )
    return doubts


def body_doubts(geometry: Geometry, rim: Rim) -> dict[str, str]:
    """Doubts about bodies that end where a half-space goes on: profile, end face, thickness.

    Parameters
    ----------
    geometry, rim
        As in `geometry_doubts`.

    Returns
    -------
    dict of str to str
        Sentences by kind of doubt; empty if there is none.
    """
    doubts: dict[str, str] = {}
    half_width = _half_width(rim)
    if _touches_end(geometry.open_gap[rim.rows, rim.columns], rim.contact):
        doubts["end"] = (
            "the contact reaches the end of the indenter's profile: pressure is singular there "
            "and the peak pressure depends on the mesh"
        )
    if geometry.indenter_gives and _ends_within(geometry, rim, half_width):
        doubts["end_face"] = (
            "the indenter ends within a half width of the contact, but its material is taken for a "
            "half-space that goes on there; a free end face gives way more, so that pressure near "
            "it is lower and the approach larger"
        )
    if half_width > THIN_BODY * geometry.thickness:
        doubts["thickness"] = (
            f"the contact's half width is {half_width / geometry.thickness:.2g} of the body's "
            f"thickness of {geometry.thickness:.3g} m; half-space theory is meant for less than "
            f"{THIN_BODY:g}, beyond it what the body rests on counts"
        )
    return doubts


def _missed_doubts(
    geometry: Geometry,
    rim: Rim,
    motion: NDArray[np.float64],
    displacement: NDArray[np.float64],
) -> dict[str, str]:
    doubts: dict[str, str] = {}
    missed = float(geometry.missed[rim.rows, rim.columns][rim.contact].max(initial=0.0))
    if missed > MISSED_PEAK * motion[0]:
        doubts["map"] = (
            f"between the grid's points the height map stands out by up to {missed:.3g} m, "
            f"{missed / motion[0]:.0%} of the approach, which the grid does not see; use cells as "
            "small as the map's, or a smoother map"
        )
    x, y, gap = geometry.beyond
    # Pressure is all within the grid, so displacement falls from its rim outwards.
    rim_displacement = max(displacement[[0, -1]].max(), displacement[:, [0, -1]].max())
    reached = float((motion[0] + motion[1] * x + motion[2] * y - gap).max(initial=-math.inf))
    if reached > rim_displacement * (1 + 1e-9):
        doubts["beyond"] = (
            "the body would touch outside the grid, too, where nothing is computed: the contact "
            "carries a part of the load only; enlarge grid.size"
        )
    return doubts


def _spans(contact: NDArray[np.bool_], cells: int) -> bool:
    return all(int(contact.any(axis=axis).sum()) >= cells for axis in (0, 1))


def _half_width(rim: Rim) -> float:
    return min(rim.length, rim.width) / 2


def _outside(
    grid: Grid, x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points of a mesh that lie outside a grid."""
    points = np.meshgrid(x, y, indexing="ij")
    lx, ly = grid.size
    outside = (np.abs(points[0]) > lx / 2) | (np.abs(points[1]) > ly / 2)
    return points[0][outside], points[1][outside]


def _maps(indenter: Indenter) -> tuple[HeightMap, ...]:
    parts = indenter.parts if isinstance(indenter, CombinedIndenter) else (indenter,)
    return tuple(part for part in parts if isinstance(part, HeightMap))


def _ends_within(geometry: Geometry, rim: Rim, distance: float) -> bool:
    """Whether the indenter ends near the box around the contact, within the grid."""
    block = []
    for axis, lines in enumerate((rim.rows, rim.columns)):
        touched = np.flatnonzero(rim.contact.any(axis=1 - axis)) + lines.start
        if not touched.size:
            return False
        near = math.ceil(distance / geometry.grid.cell_size[axis])
        block.append(slice(max(int(touched[0]) - near, 0), int(touched[-1]) + near + 1))
    return bool(np.isinf(geometry.open_gap[block[0], block[1]]).any())


def _steepest_slope(
    open_gap: NDArray[np.float64],
    contact: NDArray[np.bool_],
    motion: NDArray[np.float64],
    cell_size: tuple[float, float],
) -> float:
    steepest = 0.0
    for axis in (0, 1):
        shape = np.moveaxis(open_gap, axis, 0)
        touched = np.moveaxis(contact, axis, 0)
        pairs = touched[1:] & touched[:-1]
        slope = (shape[1:][pairs] - shape[:-1][pairs]) / cell_size[axis]
        steepest = max(steepest, float(np.abs(slope - motion[1 + axis]).max(initial=0.0)))
    return steepest


def _touches_end(open_gap: NDArray[np.float64], contact: NDArray[np.bool_]) -> bool:
    outside = np.isinf(open_gap)
    return bool(
        (contact[1:] & outside[:-1]).any()
        or (contact[:-1] & outside[1:]).any()
        or (contact[:, 1:] & outside[:, :-1]).any()
        or (contact[:, :-1] & outside[:, 1:]).any()
    )
