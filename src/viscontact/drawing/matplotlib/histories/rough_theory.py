"""Persson's theory over speed, with computed contacts beside it."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.content.rough_theory import theory_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import stacked_panels


def rough_theory(
    theory: xr.Dataset, results: xr.Dataset | None = None, *, width: Width | None = None
) -> Figure:
    """Draw contact area and friction of a rough surface by Persson's theory, beside computed ones.

    Parameters
    ----------
    theory : xarray.Dataset
        From `viscontact.surfaces.persson_sliding`.
    results : xarray.Dataset, optional
        From `viscontact.steady`, of the same surface, material and mean pressure on a grid that is
        periodic along both axes.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Real over nominal area, and the friction coefficient as a band from γ to γ = 1, which is no
        error bar: outside full contact the theory may be off by more.

    Raises
    ------
    ValueError
        If the results are not over speed, or have no nominal pressure.

    Examples
    --------
    >>> import numpy as np, viscontact as vc
    >>> waves = 1e-6 * np.cos(2 * np.pi * np.arange(64) / 64) * np.ones((64, 1))
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> speeds, surface = [1e-4, 1e-2, 1.0], vc.Surface(waves, 1e-5, periodic=True)
    >>> theory = vc.surfaces.persson_sliding(surface, rubber, 1e4, speeds)
    >>> [axes.get_ylabel() for axes in rough_theory(theory).axes]
    ['Real over nominal area [-]', 'Friction coefficient [-]']
    """
    panels = theory_panels(theory, results)
    wide = page_width(width, style.ONE_COLUMN)
    figure = stacked_panels(panels, wide, 1.15 * wide)
    figure.axes[0].set_ylim(0.0, None)
    return figure
