"""Shift factors of a master curve, printed with their intervals."""

from __future__ import annotations

from viscontact import identification
from viscontact.cli.terminal.messages import put
from viscontact.identification.shift_rows import celsius, shift_head, shift_notes, shift_row

#: Widths of the columns, of a_T with its interval and of b_T with its own, and of what follows.
_WIDTHS, _VERTICAL_WIDTHS = (9, 15), (13, 6, 11)
#: Where the number would end before the sign of its interval.
_NO_INTERVAL = "        "


def print_shifts(curve: identification.MasterCurve, rules: list[identification.ShiftFit]) -> None:
    """Print a_T and b_T of each set with their 95 % intervals, and rules through a_T."""
    sets, reference = len(curve.isotherms), celsius(curve.reference_temperature)
    put(f"{sets} sets, shifted to {reference}; intervals are those of 95 %:")
    put(_line(curve, shift_head(curve)))
    for k in range(sets):
        put(_line(curve, _aligned(curve, shift_row(curve, k))))
    for note in shift_notes(curve, rules):
        put(note)


def _line(curve: identification.MasterCurve, cells: list[str]) -> str:
    """Cells in columns; the last one is not aligned."""
    widths = _WIDTHS if curve.vertical == "none" else (*_WIDTHS, *_VERTICAL_WIDTHS)
    return "  ".join([*map(str.rjust, cells, widths), cells[-1]])


def _aligned(curve: identification.MasterCurve, cells: list[str]) -> list[str]:
    """Cells in which numbers without an interval stand below those with one."""
    factors = (1,) if curve.vertical == "none" else (1, 2)
    alone = {n for n in factors if "±" not in cells[n] and cells[n] != "unknown"}
    return [cell + _NO_INTERVAL if n in alone else cell for n, cell in enumerate(cells)]
