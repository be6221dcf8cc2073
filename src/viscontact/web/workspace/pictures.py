"""Figures as image files for a light or a dark page."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from colorsys import hls_to_rgb, rgb_to_hls
from contextlib import ExitStack
from dataclasses import dataclass
from inspect import signature
from pathlib import Path
from typing import Any, Literal

import xarray as xr
from matplotlib.figure import Figure

from viscontact.plot.layout.saving import written
from viscontact.results.netcdf import open_results
from viscontact.results.run_axis import SPEED, TIME, RunAxis, run_axis
from viscontact.run_files import RESULT_NAME
from viscontact.units.parsing import parse_quantity
from viscontact.web.workspace.problems import RequestError

Kind = Literal["svg", "png", "pdf"]
MEDIA_TYPES: dict[str, str] = {
    **{"svg": "image/svg+xml", "png": "image/png", "pdf": "application/pdf"},
}

_NO_RESULT = "the run has no result; there is one after its first step"
#: Message about a result that cannot be read.
DAMAGED = "the result of this run is damaged; delete the run, and run its case again"

#: Colours in a drawing, and no names of its parts.
_COLOUR = re.compile(rb"""(?<=[:\s"'])#([0-9a-fA-F]{6})(?=[;\s"'])""")
#: Lightness that white becomes on a dark page [-].
_WHITE = 0.12


@dataclass(frozen=True)
class FigureChoice:
    """Choice of a figure: name, format, instants or speeds, and colours."""

    name: str
    kind: Kind = "svg"
    times: tuple[str, ...] = ()
    is_dark: bool = False
    speeds: tuple[str, ...] = ()

    @property
    def axis(self) -> RunAxis:
        """Quantity of the places."""
        return SPEED if self.speeds else TIME

    def places(self) -> list[float] | None:
        """Return the instants [s] or speeds [m/s]; None for the default of the figure."""
        name = self.axis.name
        if self.times and self.speeds:
            raise RequestError(
                422, "time and speed: a run is over one of them; leave out the other"
            )
        try:
            return [parse_quantity(text, name) for text in self.speeds or self.times] or None
        except ValueError as error:
            raise RequestError(422, f"{name}: {error}") from error


def figure_of(
    directory: Path, figures: Mapping[str, Callable[..., Figure]], choice: FigureChoice
) -> bytes:
    """Draw a figure of a run."""
    draw, places = _named(figures, choice.name), choice.places()
    with opened(directory) as ds:
        _refuse_outside(choice.axis, places, ds)
        return _drawn(draw, ds, places, choice)


def comparison_of(
    runs: Mapping[str, Path], figures: Mapping[str, Callable[..., Figure]], choice: FigureChoice
) -> bytes:
    """Draw a figure of several runs."""
    draw, places = _named(figures, choice.name), choice.places()
    with ExitStack() as stack:
        results = {label: stack.enter_context(opened(path)) for label, path in runs.items()}
        if len({run_axis(ds).name for ds in results.values()}) > 1:
            raise RequestError(422, "runs over time and runs over speed cannot be compared")
        for ds in results.values():
            _refuse_outside(choice.axis, places, ds)
        return _drawn(draw, results, places, choice)


def picture(figure: Figure, choice: FigureChoice) -> bytes:
    """Return a figure as an image file."""
    if choice.kind != "svg":
        return written(figure, choice.kind)
    figure.patch.set_alpha(0.0)
    for axes in figure.axes:
        axes.patch.set_alpha(0.0)
    drawn = written(figure, "svg")
    return on_dark(drawn) if choice.is_dark else drawn


def on_dark(drawing: bytes) -> bytes:
    """Return a drawing in colours for a dark page: lightness inverted, hue unchanged.

    Examples
    --------
    >>> on_dark(b'<svg ><path style="fill: #ffffff; stroke: #000000"/></svg>')
    b'<svg fill="#ffffff" ><path style="fill: #1f1f1f; stroke: #ffffff"/></svg>'
    """
    recoloured = _COLOUR.sub(lambda found: _opposite(found[1].decode()).encode(), drawing)
    # Parts without a colour are black by default.
    return recoloured.replace(b"<svg ", f'<svg fill="{_opposite("000000")}" '.encode(), 1)


def _opposite(colour: str) -> str:
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (0, 2, 4))
    hue, lightness, saturation = rgb_to_hls(red, green, blue)
    turned = hls_to_rgb(hue, 1 - (1 - _WHITE) * lightness, saturation)
    return "#" + "".join(f"{round(255 * part):02x}" for part in turned)


def opened(directory: Path) -> xr.Dataset:
    """Open the result of a run, or raise RequestError."""
    try:
        ds = open_results(directory)
    except (OSError, ValueError) as error:
        raise RequestError(409, _why_none(directory)) from error
    if not ds.sizes.get(run_axis(ds).name):
        ds.close()
        raise RequestError(409, _NO_RESULT)
    return ds


def _why_none(directory: Path) -> str:
    """Reason why a result cannot be read."""
    if not directory.parent.exists():
        return "the files of this run are no longer in the folder; delete the run here"
    if (directory / RESULT_NAME).exists():
        return DAMAGED
    return _NO_RESULT


def _named(figures: Mapping[str, Callable[..., Figure]], name: str) -> Callable[..., Figure]:
    if name not in figures:
        raise RequestError(
            404, f"no figure is called {name[:40]!r}. There are {', '.join(figures)}"
        )
    return figures[name]


def _drawn(
    draw: Callable[..., Figure],
    results: Any,
    places: Sequence[float] | None,
    choice: FigureChoice,
) -> bytes:
    taken = [name for name in ("times", "speeds") if name in signature(draw).parameters]
    if places is not None and not taken:
        raise RequestError(422, f"{choice.axis.name}: does not apply to the figure {choice.name}")
    try:
        return picture(draw(results, **dict.fromkeys(taken, places)), choice)
    except ValueError as error:
        raise RequestError(422, str(error)) from error


def _refuse_outside(given: RunAxis, places: Sequence[float] | None, ds: xr.Dataset) -> None:
    if places is None:
        return
    axis = run_axis(ds)
    if given is not axis:
        raise RequestError(422, f"{given.name}: the run is over {axis.name}; give {axis.name}")
    start, end = float(axis.values(ds).min()), float(axis.values(ds).max())
    slack = 1e-9 * end
    for place in places:
        if not start - slack <= place <= end + slack:
            raise RequestError(
                422,
                f"{axis.name}: {axis.quantity(place, 6)} lies outside the run, which goes from "
                f"{axis.quantity(start, 6)} to {axis.quantity(end, 6)}",
            )
