"""Animation of a run: pressure map, section and histories."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.along_run import along_run, suits_log_time, within_span
from viscontact.drawing.content.history import drawn_scalars, history_panel, needed_variables
from viscontact.drawing.content.scene import Scene, scene_of
from viscontact.drawing.matplotlib.animations.sheet import AnimationSheet, new_sheet
from viscontact.drawing.matplotlib.histories.history import draw_histories
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_time import BEFORE_FIRST
from viscontact.drawing.matplotlib.layout.map_axes import mark_body, show_window
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.pressure.pressure_map import draw_contours, fill_colour_bar
from viscontact.results.snapshots import Snapshot, field_times
from viscontact.results.stated_errors import lacks_curve
from viscontact.results.variables import Place, shown_in
from viscontact.units.formatting import format_quantity, time_labels

_NAME = "animation"

#: The least width of a history [inch].
_HISTORY_WIDTH = 1.7
_MOST_FRAMES = 5000


@dataclass(frozen=True, eq=False)
class Animation:
    """Animation: a figure that shows one instant after the other.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The figure as drawn by `show`; initially the first instant.
    instants : ndarray
        The stored instant that each frame shows, shape (frames,) [s].
    frames_per_second : float
        Frames per second [1/s].
    show : callable
        ``show(instant)`` draws a stored instant [s].

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> moving = animation(ds, seconds=2.0, fps=5.0)
    >>> moving.seconds, moving.instants.size
    (2.0, 10)
    """

    figure: Figure
    instants: Floats
    frames_per_second: float
    show: Callable[[float], None]

    @property
    def seconds(self) -> float:
        """Duration of the animation [s]."""
        return self.instants.size / self.frames_per_second


def animation(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    seconds: float = 8.0,
    fps: float = 15.0,
    width: Width | None = None,
) -> Animation:
    """Animate a run: pressure map, section and markers on the histories.

    Of a moving contact, the map has the body's axis and the direction of its motion. The section is
    along the motion, with a full marker at the leading edge and a hollow one at the trailing edge.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored; at
        all instants for a smooth animation.
    times : array_like, optional
        Show the span between the least and the largest of these instants [s]; by default all of
        the run.
    seconds : float, optional
        Duration of the animation [s].
    fps : float, optional
        Frames a second [1/s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    Animation
        To be written by `save_animation`. Frames are at equal steps along the time axis of the
        histories, which is logarithmic where the run's steps are and the load is held; each
        shows the stored instant that is nearest there, and names it. Nothing is interpolated in
        time.

    Raises
    ------
    ValueError
        If fewer than two fields are stored in the span, the bodies never touch in it, or
        `seconds` and `fps` do not make two frames or more.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> moving = animation(ds, seconds=2.0, fps=5.0)
    >>> moving.instants[[0, -1]].tolist()
    [0.0, 1.0]
    """
    count = _frames(seconds, fps)
    run = within_span(results, needed_variables(results), times, _NAME, "")
    first, last = run["time"].values[[0, -1]]
    stored = field_times(results, _NAME)
    shown = stored[(stored >= first) & (stored <= last)]
    if shown.size < 2:
        raise ValueError(
            f"{_NAME}: needs fields stored at two instants or more between "
            f"{format_quantity(first, 's')} and {format_quantity(last, 's')}, got {shown.size}; "
            "run again with 'output: fields: all'"
        )
    scene = scene_of(results, stored, shown, _NAME)
    wide = page_width(width, style.TWO_COLUMNS)
    names = _histories(run, wide)
    sheet = new_sheet(scene.window, wide, len(names), scene.along)
    show = _stage(sheet, scene, run, names)
    chosen = _spread_evenly(shown, run, count)
    show(float(chosen[0]))
    return Animation(sheet.figure, chosen, fps, show)


def _frames(seconds: float, fps: float) -> int:
    for name, value in (("seconds", seconds), ("fps", fps)):
        if not (np.isfinite(value) and value > 0):
            raise ValueError(f"{_NAME}: {name} must be above 0, got {value:g}")
    count = round(seconds * fps)
    if not 2 <= count <= _MOST_FRAMES:
        raise ValueError(
            f"{_NAME}: seconds times fps must make 2 to {_MOST_FRAMES} frames, got "
            f"{seconds:g} s with {fps:g} a second"
        )
    return count


def _histories(run: xr.Dataset, width: float) -> list[str]:
    """Key scalars that fit on the page: the contact's response first, then the load."""
    worthwhile = [name for name in drawn_scalars({"": run}) if not lacks_curve(run, name)]
    names = [name for name in reversed(shown_in(Place.KEY)) if name in worthwhile]
    return names[: max(1, int(width / _HISTORY_WIDTH))]


def _spread_evenly(shown: Floats, run: xr.Dataset, count: int) -> Floats:
    """Stored instants nearest to equal steps along the time axis."""
    along = _place_on_axis(shown, run)
    wanted = np.linspace(along[0], along[-1], count)
    return np.asarray(shown[np.abs(along - wanted[:, None]).argmin(axis=1)])


def _place_on_axis(instants: Floats, run: xr.Dataset) -> Floats:
    """Positions of instants along the time axis of histories, up to a constant factor."""
    if not suits_log_time(run):
        return instants
    times = run["time"].values
    first = float(times[times > 0][0])
    decades = np.log10(np.maximum(instants, first) / first)
    # Length of matplotlib's linear part in decades of base 10, with the part below 1.
    before = BEFORE_FIRST * np.log10(times[-1] / first) / (1 - 1 / 10)
    return np.asarray(np.minimum(instants / first, 1.0) * before + decades)


def _stage(
    sheet: AnimationSheet, scene: Scene, run: xr.Dataset, names: list[str]
) -> Callable[[float], None]:
    """Draw the fixed parts; return a function that draws the rest at an instant."""
    curve, edges = _set_up_fields(sheet, scene)
    body: list[Artist] = []
    panels = [history_panel({"": run}, name) for name in names]
    draw_histories(sheet.histories, panels)
    time_unit = along_run([run]).unit
    markers = []
    for axes in sheet.histories:
        # Time as a bar behind the curve and a dot on it.
        bar = axes.axvline(0.0, color=style.BODY, linewidth=0.8, alpha=0.6, zorder=1)
        (dot,) = axes.plot([], [], "o", color=style.BODY, ms=4.5, clip_on=False, zorder=5)
        markers.append((bar, dot))
    labels = dict(zip(scene.stored.tolist(), time_labels(scene.stored), strict=True))
    times = run["time"].values

    def show(instant: float) -> None:
        shown = scene.at(instant)
        snapshot = shown.snapshot
        for artist in [*sheet.surface.collections, *sheet.surface.patches, *body]:
            artist.remove()
        draw_contours(sheet.surface, shown, scene.window, scene.scale)
        apart = "" if snapshot.touching else ", no contact"
        style.add_heading(sheet.surface, f"t = {labels[snapshot.time]}{apart}")
        body[:] = mark_body(sheet.surface, shown.body, scene.window)
        curve.set_data(*_section(snapshot, scene))
        found = scene.edges(shown) or (np.nan, np.nan)
        for dot, edge in zip(edges, found, strict=True):
            dot.set_data([float(scene.window.unit(edge))], [0.0])
        at = float(time_unit(snapshot.time))
        nearest = int(np.abs(times - snapshot.time).argmin())
        for (bar, dot), panel in zip(markers, panels, strict=True):
            bar.set_xdata([at, at])
            dot.set_data([at], [float(panel.y.unit(panel.curves[0].y[nearest]))])

    return show


def _set_up_fields(sheet: AnimationSheet, scene: Scene) -> tuple[Line2D, list[Line2D]]:
    """Prepare map and section; return its empty curve, and markers of leading and trailing edge."""
    window, unit = scene.window, scene.scale.unit
    show_window(sheet.surface, window)
    sheet.surface.set_ylabel(window.unit.label("y"))
    if sheet.is_long and scene.along == "x":  # the section below shares the axis
        sheet.surface.tick_params(labelbottom=False)
    else:
        sheet.surface.set_xlabel(window.unit.label("x"))
    style.add_heading(sheet.surface, "; ".join(filter(None, (window.note, scene.note))), aside=True)
    fill_colour_bar(sheet.bar, scene.scale)
    limits = window.x if scene.along == "x" else window.y
    sheet.section.set(xlim=window.unit(limits), xlabel=window.unit.label(scene.along))
    ends = 1.05 * scene.scale.limits[0], 1.05 * scene.top
    sheet.section.set(ylim=unit(ends), ylabel=scene.scale.label)
    across = "y" if scene.along == "x" else "x"
    middle = scene.read(0).middle[1 if scene.along == "x" else 0]
    style.add_heading(
        sheet.section, f"at {across} = {format_quantity(middle, 'm') if middle else 0}"
    )
    (curve,) = sheet.section.plot([], [], color=style.LINE, linewidth=style.LINE_WIDTH)
    edges = [
        sheet.section.plot(
            [], [], "o", color=style.LINE, mfc=face, ms=4.5, clip_on=False, zorder=5.0
        )[0]
        for face in (style.LINE, "white")
    ]
    return curve, edges


def _section(snapshot: Snapshot, scene: Scene) -> tuple[Floats, Floats]:
    """Pressure along the middle line, as drawn."""
    wide = snapshot.with_border(1) if any(snapshot.periodic) else snapshot
    positions, pressure = wide.section(scene.along)
    return scene.window.unit(positions), scene.scale.unit(pressure)
