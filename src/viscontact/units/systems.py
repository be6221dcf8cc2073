"""Systems of units to show results in, beside the units that read best."""

from __future__ import annotations

from numpy.typing import ArrayLike

from viscontact.units.formatting import ReadableUnit, readable_unit

#: Unit in which each value reads best.
AUTOMATIC = "auto"

_SMALL_ANGLE, _SECOND = {"rad": ReadableUnit("mrad", 1e-3)}, {"s": ReadableUnit("s", 1.0)}
_METRIC = {
    "m": ReadableUnit("mm", 1e-3),
    "m/s": ReadableUnit("mm/s", 1e-3),
    "m2": ReadableUnit("mm²", 1e-6),
    "Pa": ReadableUnit("MPa", 1e6),
}
#: Name of each system.
SYSTEM_NAMES = {
    AUTOMATIC: "readable units",
    "mm": "mm, N, MPa",
    "kn": "mm, kN, MPa",
    "um": "µm, mN, kPa",
    "us": "in, lbf, psi",
    "si": "SI: m, N, Pa",
}
#: Units of each system by SI unit; what a system leaves out reads best in the automatic unit.
SYSTEMS: dict[str, dict[str, ReadableUnit]] = {
    AUTOMATIC: {},
    "mm": _METRIC
    | _SMALL_ANGLE
    | _SECOND
    | {
        "N": ReadableUnit("N", 1.0),
        "N/m": ReadableUnit("N/mm", 1e3),
        "J": ReadableUnit("mJ", 1e-3),
    },
    "kn": _METRIC
    | _SMALL_ANGLE
    | _SECOND
    | {
        "N": ReadableUnit("kN", 1e3),
        "N/m": ReadableUnit("kN/mm", 1e6),
        "J": ReadableUnit("J", 1.0),
    },
    "um": _SMALL_ANGLE
    | _SECOND
    | {
        "m": ReadableUnit("µm", 1e-6),
        "m/s": ReadableUnit("µm/s", 1e-6),
        "m2": ReadableUnit("µm²", 1e-12),
        "Pa": ReadableUnit("kPa", 1e3),
        "N": ReadableUnit("mN", 1e-3),
        "N/m": ReadableUnit("N/m", 1.0),
        "J": ReadableUnit("µJ", 1e-6),
    },
    "us": _SMALL_ANGLE
    | _SECOND
    | {
        "m": ReadableUnit("in", 0.0254),
        "m/s": ReadableUnit("in/s", 0.0254),
        "m2": ReadableUnit("in²", 0.0254**2),
        "Pa": ReadableUnit("psi", 4.4482216152605 / 0.0254**2),
        "N": ReadableUnit("lbf", 4.4482216152605),
        "N/m": ReadableUnit("lbf/in", 4.4482216152605 / 0.0254),
        "J": ReadableUnit("in·lbf", 0.0254 * 4.4482216152605),
        "W": ReadableUnit("in·lbf/s", 0.0254 * 4.4482216152605),
    },
    "si": {
        si: ReadableUnit("m²" if si == "m2" else si, 1.0)
        for si in ("m", "m2", "m/s", "Pa", "N", "N/m", "J", "rad", "s")
    },
}


def unit_in(system: str, si: str, *values: ArrayLike) -> ReadableUnit:
    """Return the unit of a system for values in SI."""
    return SYSTEMS[system].get(si) or readable_unit(si, *values)
