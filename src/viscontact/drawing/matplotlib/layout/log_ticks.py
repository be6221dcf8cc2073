"""Ticks of logarithmic axes: plain numbers, several a decade where there are few decades."""

from __future__ import annotations

from matplotlib.axis import XAxis, YAxis
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullFormatter

from viscontact.units.formatting import format_compact

#: Ratio of the ends from which an axis has powers of ten only, and below which it has more ticks.
_FEW_DECADES, _LESS_THAN_ONE = 1e2, 8.0
#: Range of the ends within which all numbers are written without powers.
_PLAIN = 9e-4, 1.1e4


class _Locator(LogLocator):
    """Powers of ten, and their multiples where the axis has few of them."""

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        """Places of the ticks between two values."""
        low, high = sorted((vmin, vmax))
        subs = (
            (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0)
            if high < _LESS_THAN_ONE * low
            else ((1.0, 2.0, 5.0) if high < _FEW_DECADES * low else (1.0,))
        )
        self.set_params(subs=subs)
        return [float(each) for each in super().tick_values(vmin, vmax)]


class _Formatter(LogFormatterSciNotation):
    """Plain numbers, or powers of ten over many decades."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        """Text at a tick."""
        assert self.axis is not None  # set by the axis
        low, high = sorted(self.axis.get_view_interval())
        is_plain = (_PLAIN[0] <= low and high <= _PLAIN[1]) or high < _FEW_DECADES * low
        return format_compact(float(x)) if is_plain else str(super().__call__(x, pos))


def plain_log_ticks(axis: XAxis | YAxis) -> None:
    """Place ticks on a logarithmic axis whose ends may still change."""
    axis.set_major_locator(_Locator())
    axis.set_major_formatter(_Formatter())
    axis.set_minor_formatter(NullFormatter())
