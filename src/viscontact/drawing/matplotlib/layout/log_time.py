"""Logarithmic time axis from the instant of loading, marked in s, min, h and d."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter

from viscontact.drawing.matplotlib.layout import style
from viscontact.units.formatting import ReadableUnit, clock_ticks

#: Width of a panel beside its axis, mean width of a letter, and gap between labels [inch].
_BESIDE, _LETTER, _GAP = 0.7, 0.065, 0.07
#: Length of a logarithmic time axis before the first step, against the rest of it.
BEFORE_FIRST = 0.2


def label_log_time(
    axes: Axes, unit: ReadableUnit, first: float, end: float, quantity: str = "Time"
) -> str:
    """Mark s, min, h and d on a logarithmic axis over hours or days; return the axis label."""
    is_whole = axes.get_xscale() == "symlog"
    ticks = clock_ticks(unit, first, end)
    if not ticks:
        return unit.label(quantity)
    before = BEFORE_FIRST / (1 + BEFORE_FIRST) if is_whole else 0.0
    width, decades = _axis_width(axes), math.log10(end / first)
    along = {
        place: width * (before + (1 - before) * math.log10(place / first) / decades)
        for place in ticks
    }
    start = {0.0: "0"} if is_whole else {}
    labelled = _separate_labels(start | ticks, {0.0: 0.0} | along)
    axes.set_xticks(list(labelled), list(labelled.values()))
    axes.set_xticks([place for place in ticks if place not in labelled], minor=True)
    axes.xaxis.set_minor_formatter(NullFormatter())
    return quantity


def _axis_width(axes: Axes) -> float:
    """Width of an axis [inch], an estimate before the layout is known."""
    figure, place = style.figure_of(axes), axes.get_subplotspec()
    if place is None:
        return float(axes.get_position().width * figure.get_figwidth())
    return max(figure.get_figwidth() / place.get_gridspec().ncols - _BESIDE, 0.5)


def _separate_labels(texts: Mapping[float, str], along: Mapping[float, float]) -> dict[float, str]:
    """Labels that do not touch, at positions along an axis [inch]; whole units come first."""
    ranks = {place: number for number, place in enumerate(sorted(texts, reverse=True))}
    order = sorted(
        (place for place in texts if texts[place]),
        key=lambda place: (place != 0, not texts[place].startswith("1 "), ranks[place]),
    )
    kept: dict[float, str] = {}
    for place in order:
        half = _LETTER * len(texts[place]) / 2
        others = ((along[each], _LETTER * len(text) / 2) for each, text in kept.items())
        if all(abs(along[place] - at) > half + other + _GAP for at, other in others):
            kept[place] = texts[place]
    return dict(sorted(kept.items()))


def set_log_time(axes: Axes, first: float, end: float) -> None:
    """Make a time axis logarithmic from the first step on, with zero at its beginning."""
    # Linear up to the first step, so that the instant of loading is on the axis too, over a
    # fifth of its length, so that the tick labels there keep apart.
    share = BEFORE_FIRST * math.log10(end / first)
    axes.set_xscale("symlog", linthresh=first, linscale=share)
    decades = 10.0 ** np.arange(math.floor(math.log10(first)), math.ceil(math.log10(end)) + 1)
    between = np.outer(decades, range(2, 10)).ravel()
    # matplotlib would mark decades below the first step too, on top of the zero.
    axes.set_xticks([0.0, *decades[(decades >= first) & (decades <= end)]])
    axes.set_xticks(between[(between >= first) & (between <= end)], minor=True)
    axes.xaxis.set_minor_formatter(NullFormatter())
