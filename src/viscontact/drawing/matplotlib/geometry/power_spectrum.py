"""Figure of the power spectrum of a measured surface."""

from __future__ import annotations

from matplotlib.figure import Figure

from viscontact.bodies.surfaces import Surface
from viscontact.drawing.content.measured_surface import spectrum_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel


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
    >>> import numpy as np
    >>> heights = 1e-8 * np.random.default_rng(0).standard_normal((32, 32))
    >>> figure = draw_power_spectrum(Surface(heights, 1e-6))
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('Wavelength [µm]', 'Power spectral density $C$ [m$^4$]')
    """
    panel = spectrum_panel(surface)
    across = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(across, 3.0)
    axes = figure.subplots()
    draw_panel(axes, panel)
    if across <= NARROW:
        style.add_heading(axes, panel.title.replace(": ", "\n", 1))
    return figure
