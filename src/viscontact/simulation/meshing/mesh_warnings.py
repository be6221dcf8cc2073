"""Warnings that an automatic grid does not meet the requested tolerance."""

from __future__ import annotations

from viscontact.units.formatting import format_number

#: Warnings of a pressure that grows as cells become smaller, and of a contact that is too small for
#: the grid at the beginning.
PEAK_WARNING = (
    "the peak pressure depends on the mesh here: at a sharp edge or tip it grows on as cells get "
    "smaller, and the grid was not chosen for it; "
)
EXTENT_WARNING = (
    "the {extent} depends on the mesh here: towards a sharp end the contact becomes wider as cells "
    "get smaller, and the grid was not chosen for it; "
)
EARLY_WARNING = {
    "early": (
        "the contact is much smaller when the load is first largest than it becomes: the grid does "
        "not keep the tolerance until it has grown; give a grid, or make the run shorter"
    )
}


def spacing_warning(name: str, error: float, points: tuple[float, float]) -> dict[str, str]:
    """Warning that the spacing of a map limits the accuracy; `points` along and across."""
    return {
        "map spacing": (
            f"cells as small as the steps of the height map leave {_error_text(error, points)} "
            f"in the {name.replace('_', ' ')}; a map of smaller steps would be more accurate"
        )
    }


def facet_warning(error: float, points: tuple[float, float]) -> dict[str, str]:
    """Warning that the facets of a map limit the accuracy; `points` along and across."""
    return {
        "facets": (
            "between its points the height map is taken as straight, which leaves "
            f"{_error_text(error, points)} in the peak pressure however small the cells are; a map "
            "of smaller steps would be more accurate"
        )
    }


def ring_warning(error: float) -> dict[str, str]:
    """Warning that an automatic grid does not resolve the ring, with the error of the peak [-]."""
    return {
        "ring": (
            "the contact grows on a body that relaxes, and carries a ring of high pressure along "
            "its edge, which is narrower than the cells of the automatic grid: the peak pressure "
            f"has an error of up to about {format_number(100 * error, 1)} % of its largest value, "
            "which smaller cells reduce slowly; ask for such a tolerance, or give a grid"
        )
    }


def _error_text(error: float, points: tuple[float, float]) -> str:
    """Relative error in words; one as large as the value itself is not known any closer."""
    if error < 1:
        return f"a relative error of about {error:.1g}"
    along, across = points
    return (
        f"an error of unknown size (the contact is only {along:.0f} x {across:.0f} of its points)"
    )
