"""Values written on contours, where there is room for them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from numpy.typing import NDArray

_LABEL_SIZE = 6.5
# Room to be left between labels [pixels].
_APART = 4.0


def label_contours(
    axes: Axes,
    lines: QuadContourSet,
    texts: Mapping[float, str],
    fits: Callable[[NDArray[np.float64]], bool] = lambda corners: True,
) -> None:
    """Write on contours what they are, once the figure is laid out.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where they are drawn.
    lines : matplotlib.contour.QuadContourSet
        The contours.
    texts : mapping of float to str
        What to write, by level.
    fits : callable, optional
        Whether a label may stand there, by the corners of its box, shape (4, 2), in the units of
        the axes. Besides, it must lie wholly in the axes and on no other label.
    """
    if not texts:
        return
    how: dict[str, Any] = {"fmt": dict(texts), "fontsize": _LABEL_SIZE}
    tried = axes.clabel(lines, list(texts), inline=False, **how)
    places = _places_with_room(axes, tried, fits)
    for text in tried:
        text.remove()
    if places:
        # Lines are interrupted only for the labels that stay.
        axes.clabel(lines, list(texts), inline_spacing=2, manual=places, **how)


def _places_with_room(
    axes: Axes, texts: Iterable[Text], fits: Callable[[NDArray[np.float64]], bool]
) -> list[tuple[float, float]]:
    """Where those texts are that fit, lie wholly in the panel, and on no other."""
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
