"""Figures of a result as methods that return axes: `ds.viscontact.plot`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.figures import FigureEntry
from viscontact.drawing.matplotlib.animations.animation import Animation

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

    if TYPE_CHECKING:  # the methods are those of the table of figures

        def __getattr__(self, figure: str) -> Callable[..., Any]: ...

    def _draw(self, draw: Callable[..., Any], how: dict[str, Any]) -> Panels | Animation:
        figure = draw(self.result, **how)
        if isinstance(figure, Animation):
            return figure
        if how.get("axes") is not None:  # a figure of the user's
            return cast(Axes, how["axes"])
        _show_to_pyplot(figure)
        panels = [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
        return panels[0] if len(panels) == 1 else np.array(panels, dtype=np.object_)


def add_methods(
    entries: Iterable[FigureEntry], functions: Mapping[str, Callable[..., Any]]
) -> None:
    """Add a method to `ResultPlots` for each figure of a run."""
    for entry in entries:
        if entry.of != "sweep":
            setattr(ResultPlots, entry.method, _method(entry, functions[entry.drawn_by]))


def _method(entry: FigureEntry, draw: Callable[..., Any]) -> Callable[..., Panels | Animation]:
    def method(self: ResultPlots, **how: Any) -> Panels | Animation:
        return self._draw(draw, how)

    method.__name__, method.__qualname__ = entry.method, f"ResultPlots.{entry.method}"
    first = str(draw.__doc__).partition("\n")[0].rstrip(".")
    method.__doc__ = f"{first}: `viscontact.plot.{entry.drawn_by}`."
    return method


def _show_to_pyplot(figure: Figure) -> None:
    # Only here: pyplot chooses a window system when it is imported, which figures do without.
    from matplotlib import pyplot

    # pyplot is asked to make a figure, and is given this one.
    def given(*_: Any, **__: Any) -> Figure:
        return figure

    pyplot.figure(FigureClass=cast(type[Figure], given))
