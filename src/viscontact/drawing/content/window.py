"""Visible part of the surface, and the stretch of its axes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.snapshots import Snapshot
from viscontact.units.formatting import ReadableUnit, readable_unit

_MARGIN = 0.07
# Largest aspect ratio in true shape, and least ratio of a stretched contact, so that several panels
# fit on a page.
_TRUE_ASPECT = 3.0
_PANEL_SHAPE = 4.5
_STRETCHES = (2, 3, 4, 5, 6, 8, *(10 * n for n in (1, 1.5, 2, 3, 4, 5, 6, 8)), 100, 200, 500)


#: Limits (x_min, x_max, y_min, y_max) [m].
Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Window:
    """Visible part of the surface [m]; stretch is the scale of y over that of x."""

    x: tuple[float, float]
    y: tuple[float, float]
    stretch: float

    @property
    def unit(self) -> ReadableUnit:
        """Unit of both axes, chosen by the longer one."""
        return readable_unit("m", self.x, self.y)

    @property
    def height_to_width(self) -> float:
        """Shape of the drawing."""
        return self.stretch * (self.y[1] - self.y[0]) / (self.x[1] - self.x[0])

    @property
    def note(self) -> str:
        """Note on the stretch; empty for the true shape."""
        if self.stretch == 1:
            return ""
        return (
            f"y stretched {self.stretch:g}×"
            if self.stretch > 1
            else f"x stretched {1 / self.stretch:g}×"
        )


def window_around(snapshots: Iterable[Snapshot], *, slender: float = _PANEL_SHAPE) -> Window:
    """Window around the contact of all snapshots, with a margin, within a period."""
    # The true shape is kept up to an aspect ratio of three; a longer contact is stretched by a
    # round factor, but remains `slender` times longer than wide.
    snapshots = list(snapshots)
    boxes = [snapshot.extent() for snapshot in snapshots if snapshot.touching]
    borders = snapshots[0].borders() if any(snapshots[0].periodic) else None
    found = window_over(boxes, borders, slender=slender)
    along = _line_axis(snapshots[0])
    if along is None:
        return found
    # A part of a strip that goes on, as long as it is wide, in its true shape.
    x, y = (found.x, found.y) if along == "x" else (found.y, found.x)
    half, middle = min(y[1] - y[0], x[1] - x[0]) / 2, (x[0] + x[1]) / 2
    part = middle - half, middle + half
    return Window(part, y, 1.0) if along == "x" else Window(y, part, 1.0)


def _line_axis(snapshot: Snapshot) -> str | None:
    """Axis of a line contact, along which nothing varies; None of any other contact."""
    along_x, along_y = snapshot.periodic
    if along_x == along_y:
        return None
    lines = snapshot.pressure if along_x else snapshot.pressure.T
    return ("x" if along_x else "y") if (lines == lines[:1]).all() else None


def window_over(
    boxes: Sequence[Box], borders: Box | None = None, *, slender: float = _PANEL_SHAPE
) -> Window:
    """Window around boxes (x_min, x_max, y_min, y_max), with a margin, within the borders [m]."""
    lows = min(box[0] for box in boxes), min(box[2] for box in boxes)
    highs = max(box[1] for box in boxes), max(box[3] for box in boxes)
    x, y = (_widen(low, high) for low, high in zip(lows, highs, strict=True))
    if borders is not None:
        x_low, x_high, y_low, y_high = borders
        x = max(x[0], x_low), min(x[1], x_high)
        y = max(y[0], y_low), min(y[1], y_high)
    return Window(x, y, _stretch((x[1] - x[0]) / (y[1] - y[0]), slender))


def _widen(low: float, high: float) -> tuple[float, float]:
    margin = _MARGIN * (high - low)
    return low - margin, high + margin


def _stretch(length_to_width: float, slender: float) -> float:
    if length_to_width < 1:
        return 1 / _stretch(1 / length_to_width, slender)
    if length_to_width <= _TRUE_ASPECT:
        return 1.0
    return float(max((s for s in _STRETCHES if s <= length_to_width / slender), default=1))
