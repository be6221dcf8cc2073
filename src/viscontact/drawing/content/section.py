"""Pressure along a line through the contact, and line load, at each instant of some maps."""

from __future__ import annotations

from typing import Literal

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.map import Maps
from viscontact.drawing.content.panel import Axis, Units
from viscontact.drawing.figures import entry_of
from viscontact.results.recorded_motion import contact_edges
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit

#: Direction of a line.
Along = Literal["x", "y"]
_TITLES = {"x": "Along x", "y": "Across, along y"}


@dataclass(frozen=True, eq=False)
class Lines:
    """A quantity along an axis at each instant."""

    name: str
    title: str
    quantity: str
    si: str
    along: Along
    positions: Floats  # of the cells [m], shape (n,)
    values: tuple[Floats, ...]  # [SI], each of shape (n,)
    crossings: tuple[float, ...] = ()  # positions of the line on the other axis [m]
    #: Leading and trailing edge of a moving contact [m], None without them.
    edges: tuple[tuple[float, float] | None, ...] = ()

    def axis(self, units: Units = readable_unit) -> Axis:
        """Axis of the quantity."""
        return Axis.of(self.quantity, self.si, *self.values, units=units)

    def place(self, unit: ReadableUnit, crossing: float | None = None) -> str:
        """Position of the line, such as ``"at y = 0 mm"``; by default that of all instants."""
        if crossing is None and len(set(self.crossings)) > 1:
            return "through each resultant"
        at = self.crossings[0] if crossing is None else crossing
        other = "y" if self.along == "x" else "x"
        return f"at {other} = {format_compact(float(unit(at)), 4)} {unit.symbol}"


def section(maps: Maps, along: Along) -> Lines:
    """Pressure on a line through the resultant of each instant [Pa]."""
    crossings = tuple(through[1 if along == "x" else 0] for through in maps.through)
    pairs = list(zip(maps.snapshots, crossings, strict=True))
    lines = [snapshot.section(along, at) for snapshot, at in pairs]
    touched = [snapshot.contact_section(along, at) for snapshot, at in pairs]
    ways = [0.0 if each.body is None else each.body.way(along) for each in maps.maps]
    edges = tuple(contact_edges(*line, way) for line, way in zip(touched, ways, strict=True))
    values, name = tuple(values for _, values in lines), f"section-{along}"
    title = f"Along {along}, the direction of motion" if along == maps.motion else _TITLES[along]
    return Lines(name, title, "Pressure", "Pa", along, lines[0][0], values, crossings, edges)


def line_load(maps: Maps) -> Lines:
    """Pressure integrated over y [N/m]."""
    lines = [each.line_load() for each in maps.snapshots]
    values = tuple(values for _, values in lines)
    title = entry_of("line-load").heading
    return Lines("line-load", title, "Line load", "N/m", "x", lines[0][0], values)
