"""Warnings about half-space theory: large strains, bodies that end, singular pressure."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters.rounding import rounding_remedy
from viscontact.mechanics.contact.rim import Rim
from viscontact.simulation.checks.contact_geometry import LITTLE_TILT, STEEP_SLOPE, Geometry
from viscontact.simulation.checks.covers import cover_warnings
from viscontact.simulation.checks.sampling import local_approach, sampling_warnings
from viscontact.simulation.checks.singularities import DEPENDS_ON_MESH, is_sharp
from viscontact.units.formatting import format_quantity

#: Limits of small-strain theory: contact half width / R, approach / R, and for a body
#: without a radius approach / half width (a cone of the limiting slope has 0.47).
WIDE_CONTACT, DEEP_APPROACH, DEEP_PUNCH = 0.3, 0.1, 0.5

#: Fewest cells across a contact whose extents are compared with the approach.
FEW_CELLS = 4

#: Largest change of the gap across a period's border, in changes between neighbouring cells
#: elsewhere.
SEAM = 2.0

#: Words of the warnings of a contact at the end of a profile, which the result keeps.
AT_THE_END = "the end of the indenter's profile"

#: Kinds of warnings of extents that grow with the contact.
EXTENTS = frozenset({"slope", "width", "approach", "thickness", "cover", "squeeze"})

#: Kinds of warnings under which the peak pressure does not converge with the mesh.
SINGULAR_KINDS = frozenset({"sharp_end", "seam", "corner"})

#: Largest contact half width over thickness of a body that counts as a half-space. At that limit an
#: incompressible layer bonded to a rigid base carries 28 % more under a sphere at the same approach
#: (Dimitriadis et al. 2002, Biophys. J. 82, 2798).
THIN_BODY = 0.2


def geometry_warnings(
    geometry: Geometry,
    rim: Rim,
    motion: Floats,
    displacement: Floats,
    pressure: Floats,
) -> dict[str, str]:
    """Warn of large strains, ends of the bodies, and parts that the grid misses [m, rad, Pa]."""
    return (
        strain_warnings(geometry, rim, motion)
        | body_warnings(geometry, rim, pressure)
        | warnings_of_covers(geometry, rim, motion, geometry.grid.cell_size)
        | sampling_warnings(geometry.sampling, rim, motion, displacement)
    )


def strain_warnings(geometry: Geometry, rim: Rim, motion: Floats) -> dict[str, str]:
    """Warn of strains too large for linear theory: slope, width, approach."""
    warnings: dict[str, str] = {}
    half_width, radius = _half_width(rim), geometry.indenter.radius_of_curvature
    # A roller's length is no measure of its width, and may be less.
    extents = zip((rim.length, rim.width), geometry.indenter.curvatures, strict=True)
    wide = max(extent / 2 * curvature for extent, curvature in extents)
    be, reach = geometry.verbs
    slope = _steepest_slope(geometry, rim, motion)
    if slope > STEEP_SLOPE:
        warnings["slope"] = (
            f"the indenter's slope within the contact {reach} {slope:.2g}; "
            f"small-strain half-space theory is meant for slopes below {STEEP_SLOPE:g}"
        )
    if wide > WIDE_CONTACT:
        warnings["width"] = (
            f"the contact's half width {be} {wide:.2g} of the indenter's radius of "
            f"curvature; half-space theory is meant for less than {WIDE_CONTACT:g}"
        )
    measure, named, most = radius, "indenter's radius of curvature", DEEP_APPROACH
    if math.isinf(radius):
        measure, named, most = half_width, "contact's half width", DEEP_PUNCH
    # Without a radius, a steep slope is reported already, and the extents of a contact of few cells
    # are inaccurate.
    known = math.isfinite(radius) or (slope <= STEEP_SLOPE and _spans(rim.contact, FEW_CELLS))
    known &= geometry.grid.has_datum
    approach = local_approach(geometry.grid, motion)
    if known and approach > most * measure:
        warnings["approach"] = (
            f"the approach {be} {approach / measure:.2g} of the {named}; "
            f"small-strain theory is meant for less than {most:g}"
        )
    return warnings


def body_warnings(
    geometry: Geometry, rim: Rim, pressure: Floats, *, has_limit: bool = False
) -> dict[str, str]:
    """Warn of bodies that end where a half-space continues, by the pressure of all cells [Pa]."""
    warnings: dict[str, str] = {}
    half_width, (be, reach) = _half_width(rim), geometry.verbs
    if _touches_seam(geometry, rim):
        warnings["seam"] = (
            f"the contact {reach} the border of the period, where the body does not continue: "
            f"at the border it has a step, at which {DEPENDS_ON_MESH}; use a body that continues "
            "there, or a grid that is not periodic"
        )
    if geometry.ends:
        warnings |= _end_warnings(geometry, rim, pressure, has_limit=has_limit)
    if geometry.indenter_gives and _ends_within(geometry, rim, half_width):
        warnings["end_face"] = (
            "the indenter ends within a half width of the contact, but its material is modelled as "
            "a half-space that continues there; a free end face is more compliant, so that the "
            "pressure near it is lower and the approach larger; give its ends ('ends: free' in a "
            "case, vc.Body in Python)"
        )
    if half_width > THIN_BODY * geometry.thickness:
        warnings["thickness"] = (
            f"the contact's half width {be} {half_width / geometry.thickness:.2g} of the body's "
            f"thickness of {format_quantity(geometry.thickness, 'm', 3)}; half-space theory is "
            f"meant for less than {THIN_BODY:g}, beyond it the support of the body matters; "
            "give its layers and their base ('layers:' in a case, vc.Layered in Python)"
        )
    return warnings


def warnings_of_covers(
    geometry: Geometry, rim: Rim, motion: Floats, cell_size: tuple[float, float]
) -> dict[str, str]:
    """Warn of large strains in covers, and of cells of a size (dx, dy) [m] too long for them."""
    if not geometry.covers:
        return {}
    has_datum = geometry.grid.has_datum or geometry.is_supported
    approach = local_approach(geometry.grid, motion) if has_datum else math.nan
    be, _ = geometry.verbs
    # The cell along a line contact is as long as its period, however short that is.
    counted = zip(cell_size, geometry.grid.shape, strict=True)
    cells = tuple(each for each, count in counted if count > 1)
    return cover_warnings(geometry.covers, _half_width(rim), approach, cells or cell_size, be)


def corner_warnings(
    geometry: Geometry,
    place: tuple[float, float],
    strain: float,
    searched: tuple[float, float] | None = None,
) -> dict[str, str]:
    """Warn of a pressure peak at a tip, edge or corner near `place`, within `searched` [m]."""
    cell = geometry.grid.cell_size
    along, across = (1.5 * each for each in searched or cell)
    if not is_sharp(geometry.indenter, place, (along, across), cell, strain):
        return {}
    be = "lies" if not geometry.predicted else "will lie"
    return {
        "corner": (
            f"the largest pressure {be} at a tip, an edge or a corner of the indenter, sharp or "
            "rounded within a quarter of a cell (between two facets of a height map, say): "
            f"pressure is singular there and {DEPENDS_ON_MESH}. A rounding over several cells "
            f"would bound it; {rounding_remedy(geometry.indenter)}"
        )
    }


def _end_warnings(
    geometry: Geometry, rim: Rim, pressure: Floats, *, has_limit: bool
) -> dict[str, str]:
    """Warn of a contact that reaches the end of the profile: singular pressure, missing support."""
    at_end = float(pressure[geometry.end_cells].max(initial=0.0))
    if not at_end:
        return {}
    _, reach = geometry.verbs
    what = f"the contact {reach} {AT_THE_END}"
    support = (
        "The half-space continues beyond it; a body that ends there too is more compliant: give "
        "its ends ('ends: free' in a case, vc.Body in Python)"
    )
    if has_limit or at_end < pressure.max():
        return {
            "end": (
                f"{what}, and its largest pressure lies elsewhere: the rise of pressure at a sharp "
                f"end, over less than a cell, is not in the peak pressure. {support}"
            )
        }
    return {
        "sharp_end": (
            f"{what}, where its largest pressure lies: pressure is singular there and "
            f"{DEPENDS_ON_MESH}; {rounding_remedy(geometry.indenter)}. {support}"
        )
    }


def _touches_seam(geometry: Geometry, rim: Rim) -> bool:
    """True if contact lies at a step from a period's last cells to its first."""
    # A step is much larger than the differences between neighbouring cells elsewhere.
    for axis, lines in enumerate((rim.rows, rim.columns)):
        if not geometry.grid.periodic[axis]:
            continue
        gap = np.moveaxis(geometry.open_gap, axis, 0)
        touched = np.isin([0, len(gap) - 1], lines[rim.contact.any(axis=1 - axis)])
        with np.errstate(invalid="ignore"):  # outside the body
            seam, inner = np.abs(gap[0] - gap[-1]), np.abs(np.diff(gap, axis=0))
        known = np.isfinite(seam)
        largest = float(inner[np.isfinite(inner)].max(initial=0.0))
        if touched.any() and float(seam[known].max(initial=0.0)) > SEAM * largest:
            return True
    return False


def _spans(contact: Bools, cells: int) -> bool:
    """True if a contact extends over a number of cells along both axes."""
    return all(int(contact.any(axis=axis).sum()) >= cells for axis in (0, 1))


def _half_width(rim: Rim) -> float:
    """Half the smaller extent of a contact [m]."""
    return rim.breadth / 2


def _ends_within(geometry: Geometry, rim: Rim, distance: float) -> bool:
    """True if the indenter ends within a distance [m] of the box around the contact."""
    block = []
    for axis, lines in enumerate((rim.rows, rim.columns)):
        touched = lines[rim.contact.any(axis=1 - axis)]
        if not touched.size:
            return False
        near = math.ceil(distance / geometry.grid.cell_size[axis])
        block.append(_lines_around(touched, near, geometry.grid, axis))
    return bool(geometry.beyond[np.ix_(*block)].any())


def _lines_around(lines: Integers, distance: int, grid: Grid, axis: int) -> Integers:
    """Lines of the grid from `distance` before the first given line to as many after the last."""
    count = grid.shape[axis]
    first, last = int(lines[0]) - distance, int(lines[-1]) + distance
    if grid.periodic[axis]:
        return np.arange(first, first + min((last - first) % count + 1, count)) % count
    return np.arange(max(first, 0), min(last + 1, count))


def _steepest_slope(geometry: Geometry, rim: Rim, motion: Floats) -> float:
    """Steepest slope in contact; an upper bound where that is not steep."""
    tilt = max(abs(float(motion[1])), abs(float(motion[2])))
    if geometry.steepest + tilt <= STEEP_SLOPE:
        return geometry.steepest + tilt
    if tilt <= LITTLE_TILT and not (rim.cut(geometry.nearly_steep) & rim.contact).any():
        return STEEP_SLOPE
    steepest, cell_size = 0.0, geometry.grid.cell_size
    for axis in (0, 1):
        shape = np.moveaxis(rim.cut(geometry.open_gap), axis, 0)
        touched = np.moveaxis(rim.contact, axis, 0)
        pairs = touched[1:] & touched[:-1]
        slope = (shape[1:][pairs] - shape[:-1][pairs]) / cell_size[axis]
        steepest = max(steepest, float(np.abs(slope - motion[1 + axis]).max(initial=0.0)))
    return steepest
