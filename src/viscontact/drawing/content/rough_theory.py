"""Persson's theory over speed, with computed contacts beside it."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.drawing.content.panel import FAINT, FIRST, SECOND, Axis, Curve, Panel, ShadedRange
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.stated_errors import errors_of
from viscontact.units.formatting import ReadableUnit, readable_unit

_NAME = "rough-theory"


def theory_panels(theory: xr.Dataset, results: xr.Dataset | None) -> tuple[Panel, Panel]:
    """Panels of the area fraction and of the friction coefficient over speed."""
    speeds = theory["speed"].values
    shown = [speeds] if results is None else [speeds, results["speed"].values]
    every = np.concatenate(shown)
    unit = readable_unit("m/s", every)
    is_log = every.max() > 10 * every.min()
    x = Axis("Speed", unit, scale="log" if is_log else "linear")
    area = [Curve(speeds, theory["area_fraction"].values, "theory", SECOND, "dashed")]
    band = theory_band(theory)
    friction = theory_curves(band)
    if results is not None:
        area.insert(0, _computed_area(results))
        where, values = results["speed"].values, results["friction_coefficient"].values
        errors = errors_of(results, "friction_coefficient")
        friction.insert(0, Curve(where, values, "computed", FIRST, "joined", error=errors))
    unitless = ReadableUnit("-", 1.0)
    return (
        Panel(x, Axis("Real over nominal area", unitless), tuple(area), name="area-fraction"),
        Panel(
            x,
            Axis("Friction coefficient", unitless, scale="log"),
            tuple(friction),
            bands=(band,),
            name="friction",
        ),
    )


def theory_band(theory: xr.Dataset) -> ShadedRange:
    """Friction coefficient of the theory between both reductions of its energy."""
    low, high = theory["friction_coefficient"].values, theory["friction_coefficient_upper"].values
    name = f"theory, γ = {float(theory.attrs.get('gamma', 0.5)):g} to 1"
    return ShadedRange(theory["speed"].values, low, high, name, FAINT)


def theory_curves(band: ShadedRange) -> list[Curve]:
    """Edges of the band of the theory."""
    edges = ((band.low, band.name), (band.high, ""))
    return [Curve(band.x, edge, name, SECOND, "dashed") for edge, name in edges]


def _computed_area(results: xr.Dataset) -> Curve:
    grid = recorded_grid(results)
    if "speed" not in results.dims or not all(grid.periodic):
        raise ValueError(
            f"{_NAME}: the theory has a nominal pressure over speed; give a result of vc.steady on "
            "a grid that is periodic along both axes, or leave the results out"
        )
    error = errors_of(results, "contact_area") / grid.area
    area = results["contact_area"].values / grid.area
    return Curve(results["speed"].values, area, "computed", FIRST, "joined", error=error)
