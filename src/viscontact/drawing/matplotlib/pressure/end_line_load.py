"""Line load of bodies that end, beside that of half-spaces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import (
    FAINT,
    FIRST,
    Axis,
    Curve,
    Ink,
    LineLook,
    Mark,
    Panel,
)
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.units.formatting import readable_unit


def end_line_load(x: Floats, loads: Mapping[str, Floats], ends: Sequence[float]) -> Figure:
    """Draw line loads [N/m] over x [m], the first one in full and others dashed, with the ends.

    >>> axes = end_line_load(np.array([0.0, 1e-3]), {"with ends": np.ones(2)}, [1e-3]).axes[0]
    >>> axes.get_xlabel(), len(axes.lines)
    ('x [mm]', 2)
    """
    loaded = np.flatnonzero(np.sum(list(loads.values()), axis=0))
    low, high = (x[[0, -1]] if not loaded.size else x[loaded[[0, -1]]]).tolist()
    margin = 0.06 * (high - low)
    limits = min(low, *ends) - margin, max(high, *ends) + margin
    looks: tuple[tuple[Ink, LineLook], ...] = ((FIRST, "line"), (FAINT, "dashed"))
    curves = tuple(
        Curve(x, np.where(load > 0, load, np.nan), name, ink, look)
        for (name, load), (ink, look) in zip(loads.items(), looks, strict=False)
    )
    panel = Panel(
        Axis("x", readable_unit("m", limits), limits),
        Axis.of("Line load", "N/m", *loads.values()),
        curves,
        marks=tuple(Mark(place, look="dotted") for place in dict.fromkeys(ends)),
    )
    figure = style.new_figure(style.ONE_COLUMN, 2.6)
    axes = figure.subplots()
    draw_panel(axes, panel)
    axes.set_ylim(bottom=0.0)
    style.add_legend_below(figure, *named_keys(panel.curves))
    return figure
