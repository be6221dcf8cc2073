"""Warnings about a coarse mesh, and the mean chord of a contact."""

from __future__ import annotations

import math
from collections.abc import Sequence

from viscontact.backend.arrays import Bools
from viscontact.mechanics.contact.rim_extent import mean_chords

#: Fewer cells across the largest contact than these cause a warning.
WARNING_CELLS = 10


#: Largest shorter edge of a cell over the thickness of the thinnest layer.
MOST_CELL = 1.0

#: A smaller mean chord causes a warning. A disc of d cells has a mean chord of pi/4 d: 4 belong to
#: a disc of 5 cells.
WARNING_SPOT_CELLS = 4.0


def layer_warnings(thickness: float, cell_size: tuple[float, float]) -> dict[str, str]:
    """Warn of cells that are long against the thinnest layer [m]."""
    shorter = min(cell_size) / thickness  # along rollers, and along lines, cells may be long
    if shorter <= MOST_CELL:
        return {}
    return {
        "layers": (
            f"the shorter edges of the cells are {shorter:.2g} times the thickness of the thinnest "
            "layer: near the edge of the contact the gap is not that of a half-space, so that the "
            "contact area may be off by about 1 %, and the approach on a nearly incompressible "
            "layer more; use smaller cells"
        )
    }


def mesh_warnings(cells_across: int, across_spots: float = math.inf) -> dict[str, str]:
    """Warn of few cells across the run's largest contact, or across the spots it consists of."""
    if cells_across < WARNING_CELLS:
        return {
            "mesh": (
                f"only {cells_across} cells lie across the largest contact, "
                f"{WARNING_CELLS} or more are wanted; use a finer or smaller grid"
            )
        }
    if across_spots >= WARNING_SPOT_CELLS:
        return {}
    return {
        "spots": (
            f"the largest contact consists of spots or strips that are {across_spots:.1f} cells "
            f"across in the mean, {WARNING_SPOT_CELLS:g} or more are wanted: their pressure and "
            "area depend on the mesh; use a finer grid"
        )
    }


def cells_across_spots(contact: Bools, *, periodic: Sequence[bool] = (False, False)) -> float:
    """Mean chord of a contact along the axis where it is smaller, in cells; 0 without contact."""
    # It shows what the extents of a contact hide: the spots of a rough surface, or a strip that
    # lies askew on the grid.
    if any(periodic) and contact.all():
        return float(max(contact.shape))
    return float(mean_chords(contact, periodic=periodic).min())
