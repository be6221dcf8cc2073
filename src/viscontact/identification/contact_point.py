"""Contact point and baseline of a force curve, and the indentation record that follows."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.identification.elastic_indentation import elastic_indentation
from viscontact.identification.force_curve import ForceCurve
from viscontact.identification.least_squares import (
    Tolerances,
    central_differences,
    least_squares,
)
from viscontact.identification.record import Cantilever, IndentationRecord
from viscontact.identification.stroke import Stroke
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array, whole

_CANDIDATES = 100  # of the contact point in the first search
_LEAST_BASELINE = 0.05  # of the loading rows: fewer do not determine a line
_STEEPEST_BASELINE = 0.5  # of the mean slope in contact: steeper ones are in contact themselves
#: Longest step of the line, which is linear, of the contact over the way, and of the logarithm.
_LONGEST = np.array([np.inf, np.inf, 0.1, 2.0])
_NEWTON_STEPS = 60  # more than ever needed: each step at least approaches from one side


@dataclass(frozen=True, eq=False)
class ContactPoint:
    """Contact point and baseline of a force curve.

    Made by `find_contact`.

    Attributes
    ----------
    curve : ForceCurve
        The measured curve.
    indenter : Indenter
        The tip.
    position : float
        Position of the base at first contact [m].
    position_error : float
        Its standard error if the sample is elastic and the noise independent from row to row [m].
    offset, slope : float
        Baseline: deflection without contact at position 0 [m], and its slope [-].
    noise : float
        Root mean square of the deflection about the fitted curve [m].
    contact_modulus : float
        E* = E/(1 - nu²) of the best-fitting elastic body [Pa].

    Examples
    --------
    >>> from viscontact.identification.contact_point import deflection_in_contact
    >>> from viscontact.bodies.indenters import Sphere
    >>> z = np.linspace(0.0, 3e-6, 301)
    >>> bent = deflection_in_contact(Sphere(5e-6), 1e4, 0.1, z - 2e-6)
    >>> found = find_contact(ForceCurve(z, z, 1e-8 + 0.001 * z + bent, 0.1), Sphere(5e-6))
    >>> f"{1e6 * found.position:.4f} um, {found.slope:.5f}, {found.contact_modulus:.5g} Pa"
    '2.0000 um, 0.00100, 10000 Pa'
    """

    curve: ForceCurve
    indenter: Indenter
    position: float
    position_error: float
    offset: float
    slope: float
    noise: float
    contact_modulus: float

    def __repr__(self) -> str:
        return (
            f"ContactPoint: at {format_quantity(self.position, 'm', 5)} ± "
            f"{format_quantity(self.position_error, 'm', 2)}, baseline with a slope of "
            f"{self.slope:.3g}, noise {format_quantity(self.noise, 'm', 2)} rms, elastic "
            f"E/(1 - nu²) {format_quantity(self.contact_modulus, 'Pa', 4)}"
        )

    @property
    def bending(self) -> Floats:
        """Deflection less the baseline, of each row [m]."""
        return self.curve.deflection - self.offset - self.slope * self.curve.position

    def elastic_bending(self, position: Floats) -> Floats:
        """Return the bending of the cantilever on the best-fitting elastic body.

        Parameters
        ----------
        position : ndarray
            Positions of the base [m].

        Returns
        -------
        ndarray
            Deflection beyond the baseline, 0 before contact [m].
        """
        way = real_array("position", position, "m") - self.position
        return deflection_in_contact(
            self.indenter, self.contact_modulus, self.curve.spring_constant, way
        )

    def record(self, rows: int = 2000) -> IndentationRecord:
        """Return the whole curve as a record, as means over equal numbers of rows.

        Parameters
        ----------
        rows : int, optional
            Largest number of rows of the record.

        Returns
        -------
        IndentationRecord
            The force is spring constant times bending, the approach the position from the contact
            point on less the bending. The record keeps the baseline, so that `fit_indentation`
            finds contact point and baseline anew, together with the law.
        """
        count = whole("ContactPoint.record: rows", rows, 10)
        approach = self.curve.position - self.position - self.bending
        columns = (self.curve.times, approach, self.curve.spring_constant * self.bending)
        size = self.curve.times.size
        # Means over as many rows each have the same noise.
        cuts = np.append(np.arange(0, size, -(-size // count)), size)
        for corner in Stroke(self.curve.times, self.curve.position).corners[1:-1]:
            # A mean over a corner would round it off.
            cuts[1 + int(np.argmin(np.abs(cuts[1:-1] - corner)))] = corner
        cuts = np.unique(cuts)
        times, approach, force = (
            np.add.reduceat(column, cuts[:-1]) / np.diff(cuts) for column in columns
        )
        cantilever = Cantilever(self.curve.spring_constant, self.position, self.offset, self.slope)
        return IndentationRecord(self.indenter, times, approach, force, cantilever)


def find_contact(curve: ForceCurve, indenter: Indenter, *, reach: float = 0.3) -> ContactPoint:
    """Find contact point and baseline of a force curve by a fit to its loading part.

    Parameters
    ----------
    curve : ForceCurve
        The measured curve; it begins before contact.
    indenter : Sphere, Cone, Pyramid or FlatPunch
        The tip; a punch must be round.
    reach : float, optional
        Part of the largest deflection up to which rows count, between 0 and 1. With a smaller part
        the creep during loading matters less, and the noise more.

    Returns
    -------
    ContactPoint
        Contact point with its error, baseline, and the record for `fit_indentation`.

    Raises
    ------
    ValueError
        If no part of the curve looks like a contact after a baseline, the tip is another one, or
        `reach` is out of range.

    Notes
    -----
    Least squares of the deflection over the loading rows: a line, to which from the contact point
    on the bending y of the cantilever on an elastic body is added, k y = E* f(z - z_0 - y), with
    f of Hertz, Sneddon or Boussinesq. The noise is that of the deflection; it acts on force and
    indentation alike. The start is the best of 100 positions. Adhesion, a drag in the liquid that
    differs between approach and retraction, and a curved baseline are not modelled.

    If the sample creeps during loading, the contact is found too early, less so with a smaller
    `reach`.
    """
    if not 0 < reach <= 1:
        raise ValueError(f"find_contact: reach must lie between 0 and 1, got {reach!r}")
    z, d = (column[: curve.loading_rows] for column in (curve.position, curve.deflection))
    elastic_indentation(indenter)  # refuses other indenters
    z, d = _within_reach(z, d, reach)
    start = _first_search(indenter, curve.spring_constant, z, d)
    middle, extent = float(z.mean()), float(np.ptp(z))
    scale = float(np.ptp(d))

    def model(free: Floats) -> Floats:
        offset, slope, contact, logarithm = free
        bending = deflection_in_contact(
            indenter, np.exp(logarithm), curve.spring_constant, z - middle - extent * contact
        )
        return np.asarray(scale * (offset + slope * (z - middle) / extent) + bending)

    def misses(free: Floats) -> Floats:
        return (model(free) - d) / scale

    def slopes(free: Floats) -> Floats:
        return central_differences(misses, free)

    first = _scaled_curve(start, middle, extent, scale)
    anywhere = np.full(4, np.inf)
    bounds, sharp = (-anywhere, anywhere), Tolerances(1e-12, 1e-14)
    ended = least_squares(misses, slopes, first, bounds, sharp, _LONGEST)
    offset, slope, contact, logarithm = ended
    noise = float(np.linalg.norm(misses(ended))) / np.sqrt(max(z.size - 4, 1))
    variance = _variance_of_contact(slopes(ended), noise)
    found = ContactPoint(
        curve=curve,
        indenter=indenter,
        position=float(middle + extent * contact),
        position_error=float(extent * np.sqrt(variance)),
        offset=float(scale * (offset - slope * middle / extent)),
        slope=float(scale * slope / extent),
        noise=noise * scale,
        contact_modulus=float(np.exp(logarithm)),
    )
    _require_contact(found, z)
    return found


def _variance_of_contact(jacobian: Floats, noise: float) -> float:
    """Variance of the place of contact, the third unknown of the search."""
    return float((noise**2 * np.linalg.pinv(jacobian.T @ jacobian))[2, 2])


def deflection_in_contact(
    indenter: Indenter, contact_modulus: float, spring_constant: float, way: Floats
) -> Floats:
    """Deflection y >= 0 with k y = E* f(way - y), from the base's way after contact [m]."""
    way = np.maximum(way, 0.0)
    ratio = contact_modulus / spring_constant
    elastic = elastic_indentation(indenter)
    depth = way.copy()
    for _ in range(_NEWTON_STEPS):
        force, slope = elastic.force_and_slope(depth)
        step = (depth + ratio * force - way) / (1.0 + ratio * slope)
        depth = np.maximum(depth - step, 0.0)
        if np.abs(step).max(initial=0.0) <= 1e-15 * np.abs(way).max(initial=0.0):
            break
    return np.asarray(way - depth)


def _within_reach(z: Floats, d: Floats, reach: float) -> tuple[Floats, Floats]:
    """Rows before the deflection stays above a part of its largest change."""
    level = d[0] + reach * (d.max() - d[0])
    end = d.size if reach == 1 else int(np.flatnonzero(d <= level)[-1]) + 1
    return z[:end], d[:end]


def _first_search(
    indenter: Indenter, spring_constant: float, z: Floats, d: Floats
) -> tuple[float, float, float, float]:
    """Offset [m], slope, contact position [m] and modulus [Pa] of the best candidate."""
    elastic = elastic_indentation(indenter)
    least = max(int(_LEAST_BASELINE * z.size), 4)
    best = (np.inf, (0.0, 0.0, 0.0, 0.0))
    for place in np.unique(np.linspace(least, z.size - 4, _CANDIDATES).astype(int)):
        slope, offset = _line(z[:place], d[:place])
        bending = d - offset - slope * z
        depth = np.maximum(z - z[place] - bending, 0.0)
        depth[:place] = 0.0
        unit = elastic.force(depth) / spring_constant
        if not unit.any():
            continue
        modulus = float(unit @ bending) / float(unit @ unit)
        misses = float(np.sum((bending - modulus * unit) ** 2))
        if modulus > 0 and misses < best[0]:
            best = (misses, (float(offset), float(slope), float(z[place]), modulus))
    if not np.isfinite(best[0]):
        raise ValueError(_no_contact("the deflection does not rise after a baseline"))
    return best[1]


def _line(z: Floats, d: Floats) -> tuple[float, float]:
    """Slope and offset of the best line; level where the base has not moved."""
    way = z - z.mean()
    moved = float(np.ptp(z)) > 1e-9 * float(np.abs(z).max())
    slope = float(way @ d) / float(way @ way) if moved else 0.0
    return slope, float(d.mean()) - slope * float(z.mean())


def _scaled_curve(
    start: tuple[float, float, float, float], middle: float, extent: float, scale: float
) -> Floats:
    offset, slope, contact, modulus = start
    free = [(offset + slope * middle) / scale, slope * extent / scale]
    return np.array([*free, (contact - middle) / extent, np.log(modulus)])


def _require_contact(found: ContactPoint, z: Floats) -> None:
    bent = found.bending[: z.size].max()
    if not z[3] < found.position < z[-4]:
        raise ValueError(_no_contact("the contact point lies at an end of the loading part"))
    last = found.curve.loading_rows - 1
    way = found.curve.position[last] - found.position
    if found.slope > _STEEPEST_BASELINE * found.bending[last] / way:
        raise ValueError(_no_contact("the baseline rises nearly as steeply as the contact"))
    if bent < 5 * found.noise:
        raise ValueError(_no_contact("the bending is within the noise"))


def _no_contact(why: str) -> str:
    return (
        f"find_contact: no contact is found: {why}; the curve must begin before contact, with "
        "a positive deflection where the cantilever is pushed away"
    )
