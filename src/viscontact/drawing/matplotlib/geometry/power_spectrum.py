"""Figure of the power spectrum of a measured surface."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from viscontact.bodies.surfaces import Surface, power_spectrum
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.units.formatting import format_number, format_quantity, readable_unit


def draw_power_spectrum(surface: Surface, *, width: Width | None = None) -> Figure:
    """Draw the power spectral density of a surface over the wavelength, with its roughness.

    Parameters
    ----------
    surface : Surface
        Levelled, and without missing points.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The density of `viscontact.surfaces.power_spectrum`; long waves left, as over the wave
        number.

    Examples
    --------
    >>> heights = 1e-8 * np.random.default_rng(0).standard_normal((32, 32))
    >>> figure = draw_power_spectrum(Surface(heights, 1e-6))
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('Wavelength [µm]', 'Power spectral density $C$ [m$^4$]')
    """
    spectrum = power_spectrum(surface)
    across = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(across, 3.0)
    axes = figure.subplots()
    wavelength = 2 * np.pi / spectrum.wave_number
    unit = readable_unit("m", wavelength)
    found = spectrum.density > 1e-30 * spectrum.density.max()  # a single wave leaves rounding
    axes.loglog(
        unit(wavelength[found]),
        spectrum.density[found],
        color=style.LINE,
        linewidth=style.LINE_WIDTH,
        marker="o",
        markersize=3.2,
    )
    axes.invert_xaxis()
    axes.set_xlabel(unit.label("Wavelength"))
    axes.set_ylabel("Power spectral density $C$ [m$^4$]")
    roughness = f"Sa {format_quantity(surface.mean_deviation, 'm', 3)}, Sq "
    roughness += f"{format_quantity(surface.rms_height, 'm', 3)}, rms slope "
    roughness += format_number(surface.rms_slope, 2)
    between = "\n" if across <= NARROW else ": "
    style.add_heading(axes, f"{surface.name}{between}{roughness}")
    style.dress(axes)
    return figure
