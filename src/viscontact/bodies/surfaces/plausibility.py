"""Plausibility of a measured surface, and its description in words."""

from __future__ import annotations

import math

import numpy as np

from viscontact.bodies.surfaces.levelling import TERMS, Level, polynomial, tilt
from viscontact.bodies.surfaces.surface import Surface
from viscontact.units.formatting import format_number, format_quantity

#: Extent [m], and heights over the extent, beyond which a unit must be wrong.
LARGEST_EXTENT, LARGEST_SPAN = 10.0, 100.0

#: Skewness below which heights look like valleys in a plateau.
SKEWED = -1.0

#: Rms heights above the mean beyond which a point is a spike rather than a peak.
SPIKE = 8.0

#: Share of the variance in a paraboloid above which a surface has a form.
FORM_SHARE = 0.5

#: Rms slope above which small-strain theory does not hold.
STEEP = 0.5

#: Difference of opposite borders, over that of neighbouring points, up to which a map repeats.
FITTING = 2.0


def surface_doubts(surface: Surface) -> tuple[str, ...]:
    """Return warnings about a surface that looks wrong before it is pressed.

    Parameters
    ----------
    surface : Surface
        The surface as it is to be pressed.

    Returns
    -------
    tuple of str
        Sentences, each with a remedy; none if nothing looks wrong.

    Notes
    -----
    That a map is upside down cannot be proved. It looks so if it is hollow, so that only its
    border would touch, or if its heights are a plateau with valleys.

    Examples
    --------
    >>> bowl = np.add.outer(np.linspace(-1, 1, 9) ** 2, np.linspace(-1, 1, 9) ** 2)
    >>> [warning.split(":")[0] for warning in surface_doubts(Surface(1e-6 * bowl, 1e-5))]
    ['surface is hollow']
    """
    if min(surface.shape) < 3 or surface.rms_height == 0:
        return ()
    found = (
        _hollow(surface) or _skewness_warning(surface),
        _tilt_warning(surface),
        _spiked(surface),
    )
    return tuple(warning for warning in (*found, _steep(surface)) if warning)


def require_possible(surface: Surface) -> None:
    """Refuse sizes that no instrument measures: a unit is wrong, in the file or in its reader."""
    extent, span = max(surface.size), surface.height_range
    if extent > LARGEST_EXTENT:
        raise ValueError(
            f"{surface.name}: is {format_quantity(extent, 'm', 4)} long, which no surface measured "
            "for contact is; a unit is wrong. Export it in another format, as text with the "
            "spacing of its points"
        )
    if span > LARGEST_SPAN * extent:
        raise ValueError(
            f"height_factor: the heights of {surface.name} span {format_quantity(span, 'm', 3)} on "
            f"no more than {format_quantity(extent, 'm', 3)}; is their unit another, or does "
            "a value stand for a point that was not measured? A factor such as 1e-6 corrects a unit"
        )


def described(surface: Surface) -> str:
    """Describe a surface in a line: points, missing ones, and its roughness."""
    nx, ny = surface.shape
    dx, dy = (format_quantity(step, "m", 3) for step in surface.spacing)
    apart = dx if dx == dy else f"{dx} and {dy}"
    fits = ", periodic" if surface.periodic else ""
    missing = f", {surface.missing_share:.2%} missing" if surface.missing.any() else ""
    return (
        f"{surface.name}: {nx} x {ny} points, {apart} apart{fits}{missing}; Sa "
        f"{format_quantity(surface.mean_deviation, 'm', 3)}, Sq "
        f"{format_quantity(surface.rms_height, 'm', 3)}, rms slope "
        f"{format_number(surface.rms_slope, 2)}{_area_text(surface)}"
    )


def _area_text(surface: Surface) -> str:
    """Developed area in words; empty for a line scan."""
    ratio = surface.developed_ratio
    return "" if math.isnan(ratio) else f", Sdr {format_number(100 * ratio, 3)} %"


def levelling_note(surface: Surface, level: Level) -> str | None:
    """Sentence on the tilt and form that levelling removes; None where it removes a mean only."""
    if level not in ("plane", "quadratic") or surface.periodic:
        return None
    form = " and the paraboloid that fits best were" if level == "quadratic" else " was"
    slope = format_quantity(math.hypot(*tilt(surface)), "rad", 3)
    note = f"{surface.name}: a tilt of {slope}{form} taken off (level: {level})"
    if not _fits_at_borders(surface):
        return note
    return (
        f"{note}; the borders of the map fitted together before, as those of a surface that "
        "repeats: for a periodic grid write level: mean"
    )


def _fits_at_borders(surface: Surface) -> bool:
    """True if opposite borders differ little, and the tilt taken off leaves a step between them."""
    if min(surface.shape) < 3:
        return False
    leaves_step = False
    for axis, (slope, side) in enumerate(zip(tilt(surface), surface.size, strict=True)):
        lines = np.moveaxis(surface.heights, axis, 0)
        across = float(np.sqrt(np.nanmean((lines[-1] - lines[0]) ** 2)))
        between = float(np.sqrt(np.nanmean(np.diff(lines, axis=0) ** 2)))
        if across > FITTING * between:
            return False
        rounding = 1e-9 * surface.height_range
        leaves_step |= abs(slope) * side > max(between, rounding)
    return leaves_step


def _hollow(surface: Surface) -> str | None:
    """Warning of a form that is highest at its border."""
    try:
        form = polynomial(surface, TERMS["quadratic"])
    except ValueError:
        return None
    rest = float(np.nanvar(surface.heights - form.of(surface)))
    if rest > (1 - FORM_SHARE) * surface.rms_height**2:
        return None
    low, high = sorted((form[2, 0], form[0, 2]))
    if low < -0.1 * high:  # a cap or a saddle
        return None
    return (
        f"{surface.name} is hollow: it would touch along its border first; if it was stored "
        "upside down, flip: true turns it over, and level: quadratic takes the form off"
    )


def _skewness_warning(surface: Surface) -> str | None:
    if surface.skewness > SKEWED:
        return None
    return (
        f"{surface.name} has deep valleys below a plateau (skewness "
        f"{format_number(surface.skewness, 2)}), as worn and honed surfaces have; if it was stored "
        "upside down, flip: true turns it over"
    )


def _tilt_warning(surface: Surface) -> str | None:
    """Warning of a tilt that lifts the ends by more than the remaining heights."""
    slopes = tilt(surface)
    lift = math.hypot(*(slope * size for slope, size in zip(slopes, surface.size, strict=True)))
    # The standard deviation of a ramp is its rise over the root of twelve.
    rest = math.sqrt(max(surface.rms_height**2 - lift**2 / 12, 0.0))
    if lift / math.sqrt(12) <= max(2 * rest, 1e-9 * surface.height_range):
        return None
    return (
        f"{surface.name} is tilted by {format_quantity(math.hypot(*slopes), 'rad', 2)}, which "
        f"lifts an end by {format_quantity(lift, 'm', 3)}, much more than its rms height without "
        "it; level: plane takes it off"
    )


def _spiked(surface: Surface) -> str | None:
    height = float(np.nanmax(surface.heights) - np.nanmean(surface.heights))
    if height <= SPIKE * surface.rms_height:
        return None
    return (
        f"{surface.name} has a peak {format_number(height / surface.rms_height, 2)} rms heights "
        "above the mean, which will touch alone; if it is an artefact, remove it, or resample with "
        "a filter"
    )


def _steep(surface: Surface) -> str | None:
    if surface.rms_slope <= STEEP:
        return None
    return (
        f"{surface.name} has an rms slope of {format_number(surface.rms_slope, 2)}: small-strain "
        "theory is not meant for such slopes; is the unit of the heights right "
        "(height_factor:), or is a filter needed?"
    )
