"""Figures of a result as methods that return axes: `ds.viscontact.plot`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from viscontact.plot.animations.animation import Animation, animation
from viscontact.plot.geometry.indenter_figure import indenter
from viscontact.plot.histories.contact_area import contact_area
from viscontact.plot.histories.exact import exact
from viscontact.plot.histories.history import history
from viscontact.plot.histories.hysteresis import hysteresis
from viscontact.plot.histories.von_mises import von_mises_history
from viscontact.plot.materials.creep import creep
from viscontact.plot.motion.friction import friction
from viscontact.plot.motion.motion_profile import motion_profile
from viscontact.plot.pressure.contact_outline import contact_outline
from viscontact.plot.pressure.contact_spots import contact_spots
from viscontact.plot.pressure.deformed_surface import deformed_surface
from viscontact.plot.pressure.line_load import line_load
from viscontact.plot.pressure.pressure_map import pressure_map
from viscontact.plot.pressure.pressure_profile import pressure_profile
from viscontact.plot.pressure.pressure_radial import pressure_radial
from viscontact.plot.pressure.pressure_surface import pressure_surface
from viscontact.plot.pressure.stress_section import stress_section

#: One panel, or those of a figure in reading order.
Panels = Axes | NDArray[np.object_]


@dataclass(frozen=True, eq=False)
class ResultPlots:
    """Figures of a result, for notebooks and scripts.

    Each method draws a figure of `viscontact.plot`, takes its keywords, and returns its axes: one
    ``Axes``, or an array of them where there are several panels. pyplot knows the figure, as it
    knows those of pandas and xarray, so that a notebook shows it and ``pyplot.show()`` opens it;
    ``axes.figure`` is the figure.

    Parameters
    ----------
    result : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`.

    Examples
    --------
    >>> import viscontact as vc
    >>> material = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((32, 32), (4e-3, 4e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), material, vc.step(force=0.1), grid, [0.0, 1.0])
    >>> ds.viscontact.plot.pressure_profile(along="y").get_xlabel()
    'y [µm]'
    """

    result: xr.Dataset

    def __call__(self, figure: str, **how: Any) -> Panels | Animation:
        """Draw a figure by its name on the command line, such as ``"pressure-map"``."""
        method = getattr(self, figure.replace("-", "_"), None)
        if figure.startswith("_") or figure == "result" or method is None:
            names = [name.replace("_", "-") for name in vars(type(self)) if name[0] != "_"]
            raise ValueError(f"no figure is called {figure!r}; there are {', '.join(names)}")
        drawn: Panels | Animation = method(**how)
        return drawn

    def pressure_map(self, **how: Any) -> Panels:
        """Draw contours of pressure: `viscontact.plot.pressure_map`."""
        return self._panels(pressure_map, how)

    def pressure_3d(self, **how: Any) -> Panels:
        """Draw the pressure as a surface: `viscontact.plot.pressure_surface`."""
        return self._panels(pressure_surface, how)

    def surface_3d(self, **how: Any) -> Panels:
        """Draw the deformed surface under the indenter: `viscontact.plot.deformed_surface`."""
        return self._panels(deformed_surface, how)

    def pressure_profile(self, **how: Any) -> Panels:
        """Draw sections through the pressure: `viscontact.plot.pressure_profile`."""
        return self._panels(pressure_profile, how)

    def pressure_radial(self, **how: Any) -> Panels:
        """Draw pressure against distance from the axis: `viscontact.plot.pressure_radial`."""
        return self._panels(pressure_radial, how)

    def line_load(self, **how: Any) -> Panels:
        """Draw the line load along x: `viscontact.plot.line_load`."""
        return self._panels(line_load, how)

    def contact_outline(self, **how: Any) -> Panels:
        """Draw outlines of the contact at several instants: `viscontact.plot.contact_outline`."""
        return self._panels(contact_outline, how)

    def contact_area(self, **how: Any) -> Panels:
        """Draw the contact area over time: `viscontact.plot.contact_area`."""
        return self._panels(contact_area, how)

    def contact_spots(self, **how: Any) -> Panels:
        """Draw the sizes of the contact spots: `viscontact.plot.contact_spots`."""
        return self._panels(contact_spots, how)

    def history(self, **how: Any) -> Panels:
        """Draw area, approach, tilts and peak pressure over time: `viscontact.plot.history`."""
        return self._panels(history, how)

    def hysteresis(self, **how: Any) -> Panels:
        """Draw force over approach: `viscontact.plot.hysteresis`."""
        return self._panels(hysteresis, how)

    def creep(self, **how: Any) -> Panels:
        """Draw creep and relaxation of the half-space: `viscontact.plot.creep`."""
        return self._panels(creep, how)

    def exact(self, **how: Any) -> Panels:
        """Draw the history of a sphere with the exact solution: `viscontact.plot.exact`."""
        return self._panels(exact, how)

    def stress_section(self, **how: Any) -> Panels:
        """Draw von Mises stress below the contact: `viscontact.plot.stress_section`."""
        return self._panels(stress_section, how)

    def von_mises(self, **how: Any) -> Panels:
        """Draw the largest von Mises stress over time: `viscontact.plot.von_mises_history`."""
        return self._panels(von_mises_history, how)

    def friction(self, **how: Any) -> Panels:
        """Draw the friction coefficient over the speed: `viscontact.plot.friction`."""
        return self._panels(friction, how)

    def motion_profile(self, **how: Any) -> Panels:
        """Draw the pressure along a steady motion: `viscontact.plot.motion_profile`."""
        return self._panels(motion_profile, how)

    def indenter(self, **how: Any) -> Panels:
        """Draw sections and plan of the indenter: `viscontact.plot.indenter`."""
        return self._panels(indenter, how)

    def animation(self, **how: Any) -> Animation:
        """Make an animation, for `viscontact.plot.save_animation`: `viscontact.plot.animation`."""
        return animation(self.result, **how)

    def _panels(self, draw: Callable[..., Figure], how: dict[str, Any]) -> Panels:
        figure = draw(self.result, **how)
        if how.get("axes") is not None:  # a figure of the user's
            return cast(Axes, how["axes"])
        _show_to_pyplot(figure)
        panels = [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
        return panels[0] if len(panels) == 1 else np.array(panels, dtype=np.object_)


def _show_to_pyplot(figure: Figure) -> None:
    # Only here: pyplot chooses a window system when it is imported, which figures do without.
    from matplotlib import pyplot

    # pyplot is asked to make a figure, and is given this one.
    def given(*_: Any, **__: Any) -> Figure:
        return figure

    pyplot.figure(FigureClass=cast(type[Figure], given))
