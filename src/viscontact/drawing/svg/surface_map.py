"""Overview of a measured surface: heights as a small map, a section, and its roughness."""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.bodies.surfaces import Surface
from viscontact.drawing.content.look import BLUE
from viscontact.drawing.content.measured_surface import section_panels
from viscontact.drawing.svg.overview import Overview
from viscontact.drawing.svg.panel_drawing import panel_drawing
from viscontact.drawing.svg.svg_panel import ColouredCells, map_panel
from viscontact.results.formatting import format_percent
from viscontact.units.formatting import format_number, format_quantity

#: Most areas of one tone along an axis.
_MOST = 40
#: From low to high; unknown heights stay empty.
_TONES = (0.12, 0.3, 0.5, 0.7, 0.95)


def surface_overview(surface: Surface) -> Overview:
    """Make the overview of a measured surface."""
    rows = [
        ("points", " × ".join(map(str, surface.shape))),
        ("size", " × ".join(format_quantity(extent, "m") for extent in surface.size)),
        ("spacing", " × ".join(format_quantity(step, "m") for step in surface.spacing)),
        ("Sa", format_quantity(surface.mean_deviation, "m")),
        ("Sq, rms height", format_quantity(surface.rms_height, "m")),
        ("height range", format_quantity(surface.height_range, "m")),
        ("rms slope", format_number(surface.rms_slope)),
        ("skewness", format_number(surface.skewness, 2)),
    ]
    if not math.isnan(surface.developed_ratio):
        rows.append(("Sdr", format_percent(surface.developed_ratio)))
    if surface.periodic:
        rows.append(("periodic", "yes"))
    if surface.missing_share > 0:
        rows.append(("not measured", f"{format_percent(surface.missing_share)} of the points"))
    sections = map(panel_drawing, section_panels(surface))
    return Overview(f"Surface: {surface.name}", rows, [_map(surface), *sections])


def _map(surface: Surface) -> Element:
    """Heights in tones, from low to high."""
    counts = [min(points, _MOST) for points in surface.shape]
    tones = _tones(_means(surface.heights, counts))
    limits = [
        (float(at[0]) - step / 2, float(at[-1]) + step / 2)
        for at, step in zip((surface.x, surface.y), surface.spacing, strict=True)
    ]
    x, y = (
        low + (np.arange(count) + 0.5) * (high - low) / count
        for (low, high), count in zip(limits, counts, strict=True)
    )
    colours = [f"{BLUE}{round(255 * opacity):02x}" for opacity in _TONES]
    cells = ColouredCells(x, y, tones, colours)
    return map_panel("heights", (limits[0], limits[1]), cells, aside="blue: high")


def _means(heights: Floats, counts: list[int]) -> Floats:
    """Means of the known heights over a number of parts along x and y; NaN where unknown."""
    known = np.isfinite(heights)
    sums, numbers = np.where(known, heights, 0.0), known.astype(np.float64)
    for axis, count in enumerate(counts):
        begins = np.arange(count) * heights.shape[axis] // count
        sums = np.add.reduceat(sums, begins, axis=axis)
        numbers = np.add.reduceat(numbers, begins, axis=axis)
    means = np.divide(sums, numbers, out=np.full(sums.shape, np.nan), where=numbers > 0)
    return np.asarray(means, dtype=np.float64)


def _tones(means: Floats) -> Integers:
    """Tone of each part, by quantiles of the known heights; -1 where the height is unknown."""
    known = means[np.isfinite(means)]
    limits = np.quantile(known, np.linspace(0, 1, len(_TONES) + 1)[1:-1])
    return np.where(np.isfinite(means), np.searchsorted(limits, means), -1)
