"""Measured surfaces: a section, and the power spectrum with the roughness."""

from __future__ import annotations

import math

import numpy as np

from viscontact.bodies.surfaces import Surface, power_spectrum
from viscontact.drawing.content.panel import Axis, Curve, Panel, Units
from viscontact.units.formatting import ReadableUnit, format_number, format_quantity, readable_unit

#: Part of its largest value below which the density is rounding, as of a single wave.
_ROUNDING = 1e-30
#: Most points of a section.
_POINTS = 240


def spectrum_panel(surface: Surface, units: Units = readable_unit) -> Panel:
    """Panel of the density over the wavelength, long waves left, as over the wave number."""
    spectrum = power_spectrum(surface)
    wavelength = 2 * np.pi / spectrum.wave_number
    found = spectrum.density > _ROUNDING * spectrum.density.max()
    roughness = (
        f"Sa {format_quantity(surface.mean_deviation, 'm', 3)}, Sq "
        f"{format_quantity(surface.rms_height, 'm', 3)}, rms slope "
        f"{format_number(surface.rms_slope, 2)}"
    )
    return Panel(
        Axis("Wavelength", units("m", wavelength), scale="log", is_reversed=True),
        Axis("Power spectral density $C$", ReadableUnit("m$^4$", 1.0), scale="log"),
        (Curve(wavelength[found], spectrum.density[found], look="joined"),),
        title=f"{surface.name}: {roughness}",
    )


def section_panels(surface: Surface) -> list[Panel]:
    """Panel of the heights along x through the highest point; none of a flat line.

    Heights count from the lowest of the section.
    """
    highest = int(np.nanargmax(surface.heights))
    line = surface.heights[:, highest % surface.shape[1]]
    known = np.isfinite(line)
    if np.count_nonzero(known) < 2 or not np.ptp(line[known]) > 0:
        return []
    every = math.ceil(line.size / _POINTS)
    low, span = float(line[known].min()), float(np.ptp(line[known]))
    return [
        Panel(
            Axis.between("x", "m", float(surface.x[0]), float(surface.x[-1])),
            Axis.between("Height", "m", -0.06 * span, 1.1 * span),
            (Curve(surface.x[::every], line[::every] - low),),
            title="along x",
            note="through the highest",
        )
    ]
