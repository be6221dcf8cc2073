"""Which part of the plane to show, and how far to stretch it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes

from viscontact.results.snapshots import Snapshot
from viscontact.units.formatting import ReadableUnit, readable_unit

_MARGIN = 0.07
# A contact up to three times as long as wide is shown as it is. One that is stretched is left
# at least this much longer than wide, so that several panels fit on a page.
_TRUE_ASPECT = 3.0
_PANEL_SHAPE = 4.5
_STRETCHES = (2, 3, 4, 5, 6, 8, *(10 * n for n in (1, 1.5, 2, 3, 4, 5, 6, 8)), 100, 200, 500)


#: Limits (x_min, x_max, y_min, y_max) [m].
Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Window:
    """A part of the surface, as drawn.

    Parameters
    ----------
    x, y : tuple of float
        Limits [m].
    stretch : float
        How many times larger y is drawn than x; 1 for the true shape.
    """

    x: tuple[float, float]
    y: tuple[float, float]
    stretch: float

    @property
    def unit(self) -> ReadableUnit:
        """The unit of both axes: the longer one decides."""
        return readable_unit("m", self.x, self.y)

    @property
    def height_to_width(self) -> float:
        """Shape of the drawing."""
        return self.stretch * (self.y[1] - self.y[0]) / (self.x[1] - self.x[0])

    @property
    def note(self) -> str:
        """What to tell the reader about the stretch; empty for the true shape."""
        if self.stretch == 1:
            return ""
        return (
            f"y stretched {self.stretch:g}×"
            if self.stretch > 1
            else f"x stretched {1 / self.stretch:g}×"
        )

    def show(self, axes: Axes) -> None:
        """Set limits and aspect of axes that are drawn in the window's unit."""
        axes.set(xlim=self.unit(self.x), ylim=self.unit(self.y), aspect=self.stretch)


def window_around(snapshots: Iterable[Snapshot], *, slender: float = _PANEL_SHAPE) -> Window:
    """Find the window that holds the contact of all snapshots, with a margin.

    Parameters
    ----------
    snapshots : iterable of Snapshot
        At least one of them in contact.
    slender : float, optional
        Length against width that a contact is left with at least when it is stretched.

    Returns
    -------
    Window
        In true shape if the contact is at most three times longer than wide, else with its
        shorter side stretched by a round factor. It ends at the border of a period.
    """
    snapshots = list(snapshots)
    boxes = [snapshot.extent() for snapshot in snapshots if snapshot.touching]
    borders = snapshots[0].borders() if snapshots[0].periodic else None
    return window_over(boxes, borders, slender=slender)


def window_over(
    boxes: Sequence[Box], borders: Box | None = None, *, slender: float = _PANEL_SHAPE
) -> Window:
    """Find the window that holds boxes, with a margin.

    Parameters
    ----------
    boxes : sequence of tuple
        At least one (x_min, x_max, y_min, y_max) [m].
    borders : tuple, optional
        The period's, beyond which the window does not go [m].
    slender : float, optional
        Length against width that is left at least when the window is stretched.

    Returns
    -------
    Window
        As `window_around` says.

    Examples
    --------
    >>> window_over([(-1.0, 1.0, -0.5, 0.5), (-2.0, 0.0, -0.5, 0.5)]).x
    (-2.21, 1.21)
    """
    lows = min(box[0] for box in boxes), min(box[2] for box in boxes)
    highs = max(box[1] for box in boxes), max(box[3] for box in boxes)
    x, y = (_widened(low, high) for low, high in zip(lows, highs, strict=True))
    if borders is not None:
        x_low, x_high, y_low, y_high = borders
        x = max(x[0], x_low), min(x[1], x_high)
        y = max(y[0], y_low), min(y[1], y_high)
    return Window(x, y, _stretch((x[1] - x[0]) / (y[1] - y[0]), slender))


def _widened(low: float, high: float) -> tuple[float, float]:
    margin = _MARGIN * (high - low)
    return low - margin, high + margin


def _stretch(length_to_width: float, slender: float) -> float:
    if length_to_width < 1:
        return 1 / _stretch(1 / length_to_width, slender)
    if length_to_width <= _TRUE_ASPECT:
        return 1.0
    return float(max((s for s in _STRETCHES if s <= length_to_width / slender), default=1))
