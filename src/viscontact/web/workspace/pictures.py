"""Figures as image files for a light or a dark page."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from colorsys import hls_to_rgb, rgb_to_hls
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import xarray as xr
from matplotlib.figure import Figure

from viscontact.plot.layout.saving import written
from viscontact.results.netcdf import open_results
from viscontact.run_files import RESULT_NAME
from viscontact.units.formatting import format_quantity
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
    """Choice of a figure: name, format, instants and colours."""

    name: str
    kind: Kind = "svg"
    times: tuple[str, ...] = ()
    is_dark: bool = False

    def instants(self) -> list[float] | None:
        """Return the instants [s]; None for the default of the figure."""
        try:
            return [parse_quantity(text, "time") for text in self.times] or None
        except ValueError as error:
            raise RequestError(422, f"time: {error}") from error


def figure_of(
    directory: Path, figures: Mapping[str, Callable[..., Figure]], choice: FigureChoice
) -> bytes:
    """Draw a figure of a run."""
    draw, instants = _named(figures, choice.name), choice.instants()
    with opened(directory) as ds:
        _refuse_outside(instants, ds)
        return _drawn(draw, ds, instants, choice)


def comparison_of(
    runs: Mapping[str, Path], figures: Mapping[str, Callable[..., Figure]], choice: FigureChoice
) -> bytes:
    """Draw a figure of several runs."""
    draw, instants = _named(figures, choice.name), choice.instants()
    with ExitStack() as stack:
        results = {label: stack.enter_context(opened(path)) for label, path in runs.items()}
        for ds in results.values():
            _refuse_outside(instants, ds)
        return _drawn(draw, results, instants, choice)


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
    if not ds.sizes.get("time"):
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
    instants: Sequence[float] | None,
    choice: FigureChoice,
) -> bytes:
    try:
        return picture(draw(results, times=instants), choice)
    except ValueError as error:
        raise RequestError(422, str(error)) from error


def _refuse_outside(instants: Sequence[float] | None, ds: xr.Dataset) -> None:
    start, end = (float(ds["time"][index]) for index in (0, -1))
    slack = 1e-9 * end
    for instant in instants or ():
        if not start - slack <= instant <= end + slack:
            raise RequestError(
                422,
                f"time: {format_quantity(instant, 's')} lies outside the run, which goes from "
                f"{format_quantity(start, 's')} to {format_quantity(end, 's')}",
            )
