"""Axis of a varied key of a sweep in Matplotlib: its label and ticks."""

from __future__ import annotations

from textwrap import fill

from matplotlib.axes import Axes
from matplotlib.axis import XAxis, YAxis
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from viscontact.drawing.content.panel import Axis
from viscontact.drawing.matplotlib.layout.style import literal
from viscontact.units.formatting import format_compact

#: Ratio of the ends from which a logarithmic axis has powers of ten only.
_FEW_DECADES = 1e2
#: Most texts at an axis; of more values, some have a mark only.
_MOST_TEXTS = 16


def label_key(axes: Axes, key: Axis, letters: int) -> None:
    """Label the horizontal axis in lines of some letters, and choose its scale."""
    axes.set_xlabel(fill(key.label, letters))
    if key.scale == "log":
        axes.set_xscale("log")
        place_log_ticks(axes.xaxis)
    if key.texts:
        every = -(-len(key.texts) // _MOST_TEXTS)
        axes.set_xticks(range(0, len(key.texts), every))
        texts = list(map(literal, key.texts[::every]))
        axes.set_xticklabels(texts, rotation=30, ha="right")


def place_log_ticks(axis: XAxis | YAxis) -> None:
    """Place plain numbers at the ticks of a logarithmic axis."""
    low, high = axis.get_data_interval()
    subs = (1.0, 2.0, 5.0) if high < _FEW_DECADES * low else (1.0,)
    axis.set_major_locator(LogLocator(subs=subs))
    axis.set_major_formatter(FuncFormatter(lambda value, _: format_compact(value)))
    axis.set_minor_formatter(NullFormatter())
