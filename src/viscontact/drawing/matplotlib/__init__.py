"""Figures of a run, of several runs, of a sweep, and of a creep law.

Every figure takes a result, as ``simulate`` or ``open_results`` returned it, and gives a
`matplotlib.figure.Figure`; `FIGURES` and `COMPARISONS` list them by the names of the command
line. Nothing here uses or changes matplotlib's global state.
"""

from collections.abc import Callable
from typing import Any

try:
    from matplotlib.figure import Figure
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "figures need matplotlib, which is not installed; type: pip install 'viscontact[plot]'",
        name="matplotlib",
    ) from error

from viscontact.drawing.figures import TABLE, names_of
from viscontact.drawing.matplotlib.animations.animation import Animation, animation
from viscontact.drawing.matplotlib.animations.saving import ANIMATION_SUFFIXES, save_animation
from viscontact.drawing.matplotlib.friction.fretting import fretting_loop, slip_history
from viscontact.drawing.matplotlib.friction.stick_map import stick_map
from viscontact.drawing.matplotlib.friction.traction_profile import traction_profile
from viscontact.drawing.matplotlib.geometry.indenter_drawing import draw_indenter
from viscontact.drawing.matplotlib.geometry.indenter_figure import indenter
from viscontact.drawing.matplotlib.geometry.load_drawing import draw_load
from viscontact.drawing.matplotlib.geometry.power_spectrum import draw_power_spectrum
from viscontact.drawing.matplotlib.histories.contact_area import area_pressure, contact_area
from viscontact.drawing.matplotlib.histories.exact import exact
from viscontact.drawing.matplotlib.histories.force_curve import force_curve
from viscontact.drawing.matplotlib.histories.history import compare_histories, history
from viscontact.drawing.matplotlib.histories.hysteresis import compare_hysteresis, hysteresis
from viscontact.drawing.matplotlib.histories.leak_rate import leak_rate
from viscontact.drawing.matplotlib.histories.margins import margin_history
from viscontact.drawing.matplotlib.histories.rough_theory import rough_theory
from viscontact.drawing.matplotlib.histories.steady_motion import (
    compare_frictions,
    friction,
    motion_profile,
    traction_creepage,
)
from viscontact.drawing.matplotlib.histories.von_mises import compare_von_mises, von_mises_history
from viscontact.drawing.matplotlib.layout.saving import FIGURE_SUFFIXES, require_suffix, save_figure
from viscontact.drawing.matplotlib.materials.curve_fits import curve_fits
from viscontact.drawing.matplotlib.materials.fitted import (
    fitted_adhesion,
    fitted_indentation,
    fitted_records,
    fitted_series,
)
from viscontact.drawing.matplotlib.materials.law_curves import (
    compare_creep,
    creep,
    creep_curve,
    material_curves,
)
from viscontact.drawing.matplotlib.materials.master_curve import master_curve
from viscontact.drawing.matplotlib.pressure.contact_curves import (
    compare_line_loads,
    compare_pressure_profiles,
    line_load,
    pressure_profile,
)
from viscontact.drawing.matplotlib.pressure.contact_outline import (
    compare_contact_outlines,
    contact_outline,
)
from viscontact.drawing.matplotlib.pressure.contact_spots import contact_spots
from viscontact.drawing.matplotlib.pressure.deformed_surface import deformed_surface
from viscontact.drawing.matplotlib.pressure.given_pressure import given_pressure
from viscontact.drawing.matplotlib.pressure.leak_channel import fluid_pressure, leak_channel
from viscontact.drawing.matplotlib.pressure.pressure_map import compare_pressure_maps, pressure_map
from viscontact.drawing.matplotlib.pressure.pressure_radial import pressure_radial
from viscontact.drawing.matplotlib.pressure.pressure_surface import (
    compare_pressure_surfaces,
    pressure_surface,
)
from viscontact.drawing.matplotlib.pressure.stress_section import stress_section
from viscontact.drawing.matplotlib.result_plots import ResultPlots, add_methods
from viscontact.drawing.matplotlib.sweeps.design import profiles, trade_off, trials
from viscontact.drawing.matplotlib.sweeps.heat_balance import (
    heat_balance,
    rolling_heating,
    rolling_temperature,
)
from viscontact.drawing.matplotlib.sweeps.response import pull_off, response
from viscontact.drawing.matplotlib.sweeps.sensitivity import scatter_bands, tornado

__all__ = [
    "ANIMATION_SUFFIXES",
    "COMPARISONS",
    "FIGURES",
    "FIGURE_SUFFIXES",
    "STEADY_FIGURES",
    "Animation",
    "ResultPlots",
    "animation",
    "area_pressure",
    "compare_contact_outlines",
    "compare_creep",
    "compare_frictions",
    "compare_histories",
    "compare_hysteresis",
    "compare_line_loads",
    "compare_pressure_maps",
    "compare_pressure_profiles",
    "compare_pressure_surfaces",
    "compare_von_mises",
    "contact_area",
    "contact_outline",
    "contact_spots",
    "creep",
    "creep_curve",
    "curve_fits",
    "deformed_surface",
    "draw_indenter",
    "draw_load",
    "draw_power_spectrum",
    "exact",
    "fitted_adhesion",
    "fitted_indentation",
    "fitted_records",
    "fitted_series",
    "fluid_pressure",
    "force_curve",
    "fretting_loop",
    "friction",
    "given_pressure",
    "heat_balance",
    "history",
    "hysteresis",
    "indenter",
    "leak_channel",
    "leak_rate",
    "line_load",
    "margin_history",
    "master_curve",
    "material_curves",
    "motion_profile",
    "pressure_map",
    "pressure_profile",
    "pressure_radial",
    "pressure_surface",
    "profiles",
    "pull_off",
    "require_suffix",
    "response",
    "rolling_heating",
    "rolling_temperature",
    "rough_theory",
    "save_animation",
    "save_figure",
    "scatter_bands",
    "slip_history",
    "stick_map",
    "stress_section",
    "tornado",
    "traction_creepage",
    "traction_profile",
    "trade_off",
    "trials",
    "von_mises_history",
]

_DRAWN: dict[str, Callable[..., Any]] = {each.name: globals()[each.drawn_by] for each in TABLE}

FIGURES: dict[str, Callable[..., Figure]] = {
    name: _DRAWN[name] for name in names_of("time", "both")
}
"""Figures of one run by name: ``FIGURES[name](results, times=None)``."""

STEADY_FIGURES: dict[str, Callable[..., Figure]] = {
    name: _DRAWN[name] for name in names_of("speed")
}
"""Figures of a steady motion by name: ``STEADY_FIGURES[name](results)``."""

COMPARISONS: dict[str, Callable[..., Figure]] = {
    each.name: globals()[each.compare] for each in TABLE if each.compare
}
"""Figures of several runs by name: ``COMPARISONS[name]({label: results, ...}, times=None)``."""

add_methods(TABLE, globals())
