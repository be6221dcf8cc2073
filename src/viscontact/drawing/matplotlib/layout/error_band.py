"""Error bands along curves, and their legend."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.matplotlib.layout import style

#: Legend texts: all bands are visible, some are, none is.
BAND = "band: error estimate"
BAND_IN_PARTS = "band: error estimate, where wider than the line"
NO_BAND = "error estimate within the line's width"

_OPACITY = 0.25
#: Least visible extension of a band beyond its line, to either side [points].
_SEEN = 0.4


@dataclass(frozen=True, eq=False)
class ErrorBand:
    """Shaded error of a curve: half width along y, or along x if sideways."""

    axes: Axes
    x: Floats
    y: Floats
    error: Floats
    sideways: bool

    @property
    def seen(self) -> bool:
        """True if the band is wider than the line in the current layout."""
        dots_per_point = style.figure_of(self.axes).dpi / 72
        to_points = self.axes.transData.transform
        curve = to_points(np.column_stack([self.x, self.y])) / dots_per_point
        shift = (self.error, 0 * self.error) if self.sideways else (0 * self.error, self.error)
        reach = to_points(np.column_stack([self.x, self.y]) + np.column_stack(shift))
        reach = reach / dots_per_point - curve
        along = np.gradient(curve, axis=0)
        length = np.hypot(*along.T)
        # Normal to the curve: along a steep one a high band is narrow.
        across = np.abs(along[:, 0] * reach[:, 1] - along[:, 1] * reach[:, 0])
        with np.errstate(divide="ignore", invalid="ignore"):
            return bool(np.nanmax(across / length, initial=0.0) > style.LINE_WIDTH / 2 + _SEEN)


def draw_band(
    axes: Axes,
    x: Floats,
    y: Floats,
    error: Floats | None,
    colour: str,
    *,
    sideways: bool = False,
) -> ErrorBand | None:
    """Shade the error of a curve where it is known and finite; None for no band."""
    known = np.zeros(x.shape, dtype=np.bool_) if error is None else np.isfinite(error) & (error > 0)
    if error is None or not known.any():
        return None
    # Zero errors between others keep the band continuous.
    shown = np.isfinite(error)
    middle, along = (x, y) if sideways else (y, x)
    half_width = np.where(shown, error, 0.0)
    low, high = middle - half_width, middle + half_width
    fill = axes.fill_betweenx if sideways else axes.fill_between
    fill(along, low, high, shown, color=colour, alpha=_OPACITY, linewidth=0.0, zorder=1.5)
    return ErrorBand(axes, x, y, np.where(shown, error, np.nan), sideways)


def band_key(bands: Sequence[ErrorBand], colour: str) -> list[tuple[Artist, str]]:
    """Legend entries of error bands, or of bands too narrow to be seen; empty without bands."""
    if not bands:
        return []
    style.figure_of(bands[0].axes).draw_without_rendering()
    seen = {band.axes for band in bands if band.seen}
    if not seen:
        return [(Line2D([], [], color=colour, linewidth=style.LINE_WIDTH), NO_BAND)]
    everywhere = all(band.axes in seen for band in bands)
    shade = Patch(color=colour, alpha=_OPACITY, linewidth=0.0)
    return [(shade, BAND if everywhere else BAND_IN_PARTS)]


def legend_entries(
    lines: Sequence[Artist], names: Sequence[str], bands: Sequence[ErrorBand]
) -> list[tuple[Artist, str]]:
    """Legend entries of several runs by name, and of error bands."""
    several = len(names) > 1
    runs = zip(lines, names, strict=True) if several else ()
    return [*runs, *band_key(bands, style.FAINT if several else style.LINE)]
