"""Friction coefficient of a body in steady motion, over its speed."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact import reference
from viscontact.backend.arrays import Floats
from viscontact.indenters import Indenter, Paraboloid, Roller, Sphere
from viscontact.materials.compliance import SeriesCompliance
from viscontact.materials.material import Material
from viscontact.plot.layout import style
from viscontact.plot.layout.page import Width, page_width
from viscontact.results.recorded_case import case_of, recorded_object
from viscontact.results.variables import error_name
from viscontact.units.formatting import readable_unit

#: Bodies of constant curvature along their motion.
_ROUND = (Paraboloid, Sphere, Roller)

#: Speeds of the curves of the limits, and room above and below the values, as a factor.
_SAMPLES, _ROOM = 60, 2.0


def friction(
    results: xr.Dataset, *, axes: Axes | None = None, width: Width | None = None
) -> Figure:
    """Draw the friction coefficient over the speed, with the limits of slow and fast motion.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.steady`.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A point with its error bar for each speed, on logarithmic axes. The limit of slow motion is
        drawn for bodies that are round along the motion, on a solid; that of fast motion for round
        paraboloids and spheres; both for a law that is a series under a rigid or elastic body.

    Raises
    ------
    ValueError
        If the result is not one of steady motion, or the friction is not positive.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> ds = vc.steady(ball, rubber, load, [0.01, 0.1, 1.0], errors=False, fields="none")
    >>> axes = friction(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel(), len(axes.lines)
    ('Speed [m/s]', 'Friction coefficient', 3)
    """
    if "speed" not in results.dims:
        raise ValueError("friction: the figure needs a result of steady motion, from steady()")
    ordered = results.sortby("speed")
    speeds, values = ordered["speed"].values, ordered["friction_coefficient"].values
    if not (values > 0).any():
        raise ValueError("friction: no friction coefficient is positive, as on an elastic body")
    if axes is None:
        wide = page_width(width, style.ONE_COLUMN)
        axes = style.new_figure(wide, 0.7 * wide).subplots()
    unit = readable_unit("m/s", speeds)
    bars = ordered.get(error_name("friction_coefficient"))
    half = np.zeros(values.shape) if bars is None else np.nan_to_num(bars.values)
    style.dress(axes)
    axes.errorbar(
        unit(speeds),
        values,
        half,
        fmt="o-",
        color=style.LINE,
        markersize=3.5,
        linewidth=style.LINE_WIDTH,
        label=f"along {results.attrs.get('along', '')}".strip(),
    )
    positive = values[values > 0]
    lowest, highest = float(positive.min()) / _ROOM, float(positive.max()) * _ROOM
    span = limit_speeds(ordered)
    for name, dashes, limit in friction_limits(results, span):
        if ((limit > lowest) & (limit < highest)).any():
            axes.plot(unit(span), limit, dashes, color=style.FAINT, linewidth=1.0, label=name)
    axes.set(xscale="log", yscale="log", ylim=(lowest, highest))
    axes.tick_params(which="both", labelsize=style.TICK_SIZE, colors=style.INK)
    axes.set(xlabel=unit.label("Speed"), ylabel="Friction coefficient")
    handles, labels = axes.get_legend_handles_labels()
    if len(handles) > 1:
        style.add_legend(axes, handles, labels, loc="best")
    return style.figure_of(axes)


def limit_speeds(results: xr.Dataset) -> Floats:
    """Return the speeds at which the curves of the limits are drawn [m/s].

    >>> limit_speeds(xr.Dataset(coords={"speed": [10.0, 0.1]}))[[0, -1]].tolist()
    [0.1, 10.0]
    """
    speeds = results["speed"].values
    return np.geomspace(speeds.min(), speeds.max(), _SAMPLES)


def friction_limits(results: xr.Dataset, speeds: Floats) -> list[tuple[str, str, Floats]]:
    """Limits that hold for the body and its material: name, dashes, and values at some speeds."""
    body, series = _round_body(results), _series(results)
    if body is None or series is None:
        return []
    curvature = body.curvatures["xy".index(str(results.attrs["along"]))]
    found = []
    if curvature > 0 and not series.fluidity:
        relaxed = series.instant + float(series.amplitudes.sum())
        mean_time = float(series.amplitudes @ series.times) / relaxed
        slow = [
            reference.slow_friction_coefficient(1 / curvature, mean_time, speed)
            for speed in speeds.tolist()
        ]
        found.append(("limit of slow motion", "--", np.array(slow)))
    is_ball = not isinstance(body, Roller) and body.curvatures[0] == body.curvatures[1]
    if is_ball and series.instant > 0:
        rate = float((series.amplitudes / series.times).sum()) + series.fluidity
        force = float(results["force"].max())
        fast = [
            reference.fast_sphere_friction_coefficient(
                force, 1 / curvature, series.instant, rate, speed
            )
            for speed in speeds.tolist()
        ]
        found.append(("limit of fast motion", ":", np.array(fast)))
    return found


def _round_body(results: xr.Dataset) -> Indenter | None:
    """Indenter of a result, if its curvature is constant."""
    kind = (case_of(results).get("indenter") or {}).get("type")
    if kind not in {round_body.__name__ for round_body in _ROUND}:
        return None
    body = recorded_object(results, "indenter", "friction")
    assert isinstance(body, Indenter)
    return body


def _series(results: xr.Dataset) -> SeriesCompliance | None:
    """Contact compliance of both bodies if only the half-space creeps, and as a series."""
    material = recorded_object(results, "material", "friction")
    mate = recorded_object(results, "indenter_material", "friction")
    if not isinstance(material, Material) or not isinstance(mate, Material | None):
        return None
    found = material.contact_compliance()
    if not isinstance(found, SeriesCompliance) or not found.amplitudes.size + found.fluidity:
        return None
    if mate is None:
        return found
    other = mate.contact_compliance()
    if not isinstance(other, SeriesCompliance) or other.amplitudes.size or other.fluidity:
        return None
    both = found + other
    assert isinstance(both, SeriesCompliance)
    return both
