"""Von Mises stress on planes below the contact."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.stress_lines import Progress, part_of
from viscontact.results.snapshots import Snapshot
from viscontact.results.stress_source import StressSource
from viscontact.units.formatting import format_quantity

#: Depth of the section, and its extent to each side, in half widths of the contact.
_DEEP, _ASIDE = 2.0, 2.0
#: Below small spots, a section ends where this fraction of the largest stress is left, if that is
#: in its upper half, and reaches this many depths to each side of the largest pressure. (Two half
#: widths below a smooth contact, a third is left.)
_FADED, _UPPER, _DEPTHS_ASIDE = 0.25, 0.5, 2.0
#: Ratio of half widths from which on instants have axes of their own.
_GROWN = 3.0
# Relative difference of equal pressures, from the tolerance of runs.
_EQUAL = 1e-5

#: Longer over shorter extent of a contact that counts as round.
_ROUND = 1.2


@dataclass(frozen=True)
class StressPlane:
    """Von Mises stress on the plane across the contact through its largest pressure."""

    time: float  # [s]
    across: Floats  # positions along the shorter extent of the contact [m], shape (n,)
    depths: Floats  # [m], shape (m,)
    stress: Floats  # [Pa], shape (m, n)
    axis: str  # of `across`, "x" or "y"
    place: float | None  # of the plane on the other axis [m]; None if nothing varies along it
    half_width: float  # of the largest shown contact along that axis [m]
    interfaces: tuple[float, ...] = ()  # depths of interfaces of layers [m]

    @property
    def place_in_words(self) -> str:
        """Position of the plane, such as "x = 2 mm"; empty if nothing varies along that axis."""
        if self.place is None:
            return ""
        # Cell centres that are zero up to rounding are zero.
        place = self.place if abs(self.place) > 1e-9 * self.half_width else 0.0
        at = format_quantity(place, "m", 3).replace("-", "−")
        return f"{'x' if self.axis == 'y' else 'y'} = {at}"

    @property
    def reach(self) -> float:
        """Depth to which at least a quarter of the largest stress is found [m]."""
        rows = self.stress.max(axis=1)
        return float(self.depths[np.flatnonzero(rows >= _FADED * rows.max())[-1]])

    @property
    def largest(self) -> tuple[float, float, float]:
        """Largest stress [Pa], and its depth and position across [m]."""
        row, column = np.unravel_index(int(self.stress.argmax()), self.stress.shape)
        depth = float(self.depths[row])
        steps = np.diff(self.depths)[max(row - 1, 0) : row + 1]
        if 0 < row < len(self.depths) - 1 and np.ptp(steps) < 1e-5 * steps[0]:
            # Not at an interface: vertex of a parabola; discrete depths would give steps over time.
            before, here, after = self.stress[row - 1 : row + 2, column]
            depth += float(steps[0] * (before - after) / (2 * (before - 2 * here + after)))
        return float(self.stress.max()), depth, float(self.across[column])


def grouped_sections(
    source: StressSource, snapshots: list[Snapshot], progress: Progress | None = None
) -> list[list[StressPlane]]:
    """Sections at the instants with contact; those of a group have common axes."""
    touching = [snapshot for snapshot in snapshots if snapshot.touching]
    widths = [_half_width(snapshot) for snapshot in touching]
    alike = max(widths) <= _GROWN * min(widths)
    groups = [touching] if alike else [[snapshot] for snapshot in touching]
    return [
        stress_sections(source, group, part_of(progress, number, len(groups)))
        for number, group in enumerate(groups)
    ]


def stress_sections(
    source: StressSource, snapshots: list[Snapshot], progress: Progress | None = None
) -> list[StressPlane]:
    """Sections at the given instants with contact, all to one depth."""
    # Below small spots they are computed again to smaller depths, and `progress` begins again.
    touching = [snapshot for snapshot in snapshots if snapshot.touching]
    half_width = max(_half_width(snapshot) for snapshot in touching)
    sections = _sections_down_to(
        source, touching, source.depths(_DEEP * half_width), progress=progress
    )
    while True:
        deepest = float(sections[0].depths[-1])  # a rigid base may limit it
        reach = max(section.reach for section in sections)
        if reach > _UPPER * deepest or deepest < 2 * min(source.grid.cell_size):
            return sections
        # Compute anew: the depths are too far apart for the spots.
        depths = source.depths(max(reach, deepest / 9))
        aside = _DEPTHS_ASIDE * float(depths[-1])
        sections = _sections_down_to(source, touching, depths, aside, progress)


def _sections_down_to(
    source: StressSource,
    touching: list[Snapshot],
    depths: Floats,
    aside: float = np.inf,
    progress: Progress | None = None,
) -> list[StressPlane]:
    """Sections to some depths [m] and to each side of the largest pressure [m]."""
    half_width = max(_half_width(snapshot) for snapshot in touching)
    # The instants of one plane together: their influence coefficients are the same.
    planes: dict[tuple[float | None, float | None], list[int]] = {}
    for index, snapshot in enumerate(touching):
        planes.setdefault(_plane(source, snapshot), []).append(index)
    found: dict[int, StressPlane] = {}
    for number, ((x, y), members) in enumerate(planes.items()):
        own = [touching[index] for index in members]
        places = [int(np.flatnonzero(source.stored == each.time)[0]) for each in own]
        part = part_of(progress, number, len(planes))
        stresses = source.on_section(places, depths, x, y, part).von_mises
        for index, snapshot, stress in zip(members, own, stresses, strict=True):
            found[index] = _section(source, snapshot, half_width, depths, stress, aside)
    return [found[index] for index in range(len(touching))]


def _plane(source: StressSource, snapshot: Snapshot) -> tuple[float | None, float | None]:
    """The x or the y [m] of the plane through the largest pressure, along y or along x."""
    i, j = _place_of_peak(snapshot)
    is_along_y = _is_along_y(source, snapshot)
    return (float(snapshot.x[i]), None) if is_along_y else (None, float(snapshot.y[j]))


def _is_along_y(source: StressSource, snapshot: Snapshot) -> bool:
    """True if a plane along y says more than one along x.

    Planes run across the longer extent, in about round contacts along the friction, if any.
    """
    length, width = _extents(snapshot)
    along_x, along_y = source.largest_pulls
    if max(length, width) < _ROUND * min(length, width) and along_x != along_y:
        return along_y > along_x
    return length >= width


def _extents(snapshot: Snapshot) -> tuple[float, float]:
    """Extents of the contact along x and y, infinite along the only period if it fills it [m]."""
    left, right, front, back = snapshot.extent()
    length, width = right - left, back - front
    grid = snapshot.grid
    filled = np.array([length, width]) > np.array(grid.size) - np.array(grid.cell_size) / 2
    endless = filled & np.array(grid.periodic) & (not grid.has_datum)
    return np.inf if endless[0] else length, np.inf if endless[1] else width


def _half_width(snapshot: Snapshot) -> float:
    extents, grid = _extents(snapshot), snapshot.grid
    # Contact across the border has no width: the section is as wide as the period.
    pairs = zip(grid.size, grid.periodic, extents, strict=True)
    periods = [size for size, repeats, extent in pairs if repeats and extent < np.inf]
    return min(*extents, *(period / _ASIDE for period in periods)) / 2


def _section(
    source: StressSource,
    snapshot: Snapshot,
    half_width: float,
    depths: Floats,
    stress: Floats,
    aside: float,
) -> StressPlane:
    """The part near the contact of the stresses on the plane of an instant."""
    left, right, front, back = snapshot.extent()
    is_along_y = _is_along_y(source, snapshot)
    pressure, normal = snapshot.pressure, 0 if is_along_y else 1
    is_uniform = np.ptp(pressure, axis=normal).max() <= _EQUAL * pressure.max()
    across = snapshot.y if is_along_y else snapshot.x
    middle = (front + back) / 2 if is_along_y else (left + right) / 2
    peak = across[_place_of_peak(snapshot)[is_along_y]]
    near = (np.abs(across - middle) <= _ASIDE * half_width) & (np.abs(across - peak) <= aside)
    near &= np.isfinite(stress[0])  # within the ends of a body
    return StressPlane(
        snapshot.time,
        across[near],
        depths,
        stress[:, near],
        "y" if is_along_y else "x",
        next((at for at in _plane(source, snapshot) if at is not None and not is_uniform), None),
        half_width,
        tuple(depth for depth in source.interfaces if depth < depths[-1]),
    )


def _place_of_peak(snapshot: Snapshot) -> tuple[int, int]:
    """Cell of the largest pressure; the middle one of equal peaks, up to rounding."""
    i, j = np.nonzero(snapshot.pressure >= (1 - _EQUAL) * snapshot.pressure.max())
    nearest = int(np.hypot(snapshot.x[i], snapshot.y[j]).argmin())
    return int(i[nearest]), int(j[nearest])
