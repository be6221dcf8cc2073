"""Cells in contact of a stored result."""

from __future__ import annotations

from typing import Any

from viscontact.results.stored_result import Result


def cells_in_contact(results: Result, rows: Any = ...) -> Any:
    """Mask of the cells where the bodies touch, of some or all stored rows, as stored."""
    # Results from before the mask was stored are without adhesion: in these, cells in contact are
    # those under pressure.
    return results["in_contact" if "in_contact" in results else "pressure"][rows] > 0
