"""Labels of contours, where there is room for them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from viscontact.backend.arrays import Floats

_LABEL_SIZE = 6.5
# Space between labels [pixels].
_APART = 4.0


def label_contours(
    axes: Axes,
    lines: QuadContourSet,
    texts: Mapping[float, str],
    fits: Callable[[Floats], bool] = lambda corners: True,
) -> None:
    """Label contours with texts by level, once the figure is laid out."""
    # A label must lie wholly in the axes, on no other label, and within `fits`: a test of its
    # corners, shape (4, 2), in the units of the axes.
    if not texts:
        return
    how: dict[str, Any] = {"fmt": dict(texts), "fontsize": _LABEL_SIZE}
    tried = axes.clabel(lines, list(texts), inline=False, **how)
    places = _places_with_room(axes, tried, fits)
    for text in tried:
        text.remove()
    if places:
        # Lines are interrupted only for the labels that are kept.
        axes.clabel(lines, list(texts), inline_spacing=2, manual=places, **how)


def _places_with_room(
    axes: Axes, texts: Iterable[Text], fits: Callable[[Floats], bool]
) -> list[tuple[float, float]]:
    """Positions of the texts that fit, lie wholly in the panel, and on no other."""
    kept: list[Bbox] = []
    places = []
    for text in texts:
        box = text.get_window_extent()
        low, high = axes.bbox.min, axes.bbox.max
        corners = axes.transData.inverted().transform(box.corners())
        if (
            np.all((low <= box.min) & (box.max <= high))
            and fits(corners)
            and box.padded(_APART).count_overlaps(kept) == 0
        ):
            kept.append(box)
            places.append(text.get_position())
    return places
