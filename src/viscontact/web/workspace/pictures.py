"""Figures as image files for a light or a dark page."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from colorsys import hls_to_rgb, rgb_to_hls
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, Literal

import xarray as xr
from matplotlib.figure import Figure

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.choice import FigureChoice, UnknownFigureError, require_one_axis
from viscontact.drawing.matplotlib.layout.saving import written
from viscontact.results.netcdf import open_results
from viscontact.results.run_axis import run_axis
from viscontact.results.run_files import RESULT_NAME
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
class PictureChoice(FigureChoice):
    """Choice of a figure, its format and colours."""

    kind: Kind = "svg"
    is_dark: bool = False


def figure_of(
    directory: Path, figures: Mapping[str, Callable[..., Figure]], choice: PictureChoice
) -> bytes:
    """Draw a figure of a run."""
    with result_in(directory) as ds:
        return _draw(figures, ds, [ds], choice)


def comparison_of(
    runs: Mapping[str, Path], figures: Mapping[str, Callable[..., Figure]], choice: PictureChoice
) -> bytes:
    """Draw a figure of several runs."""
    with ExitStack() as stack:
        results = {label: stack.enter_context(result_in(path)) for label, path in runs.items()}
        with _as_answer():
            require_one_axis(results)
        return _draw(figures, results, list(results.values()), choice)


def picture(figure: Figure, choice: PictureChoice) -> bytes:
    """Return a figure as an image file."""
    if choice.kind != "svg":
        return written(figure, choice.kind)
    figure.patch.set_alpha(0.0)
    for axes in figure.axes:
        axes.patch.set_alpha(0.0)
    drawn = written(figure, "svg")
    return on_dark(drawn) if choice.is_dark else drawn


def on_dark(drawing: bytes) -> bytes:
    """Return a drawing in colours for a dark page: lightness inverted, hue unchanged."""
    recoloured = _COLOUR.sub(lambda found: _opposite(found[1].decode()).encode(), drawing)
    # Parts without a colour are black by default.
    return recoloured.replace(b"<svg ", f'<svg fill="{_opposite("000000")}" '.encode(), 1)


def _opposite(colour: str) -> str:
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (0, 2, 4))
    hue, lightness, saturation = rgb_to_hls(red, green, blue)
    turned = hls_to_rgb(hue, 1 - (1 - _WHITE) * lightness, saturation)
    return "#" + "".join(f"{round(255 * part):02x}" for part in turned)


def result_in(directory: Path) -> xr.Dataset:
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


def _draw(
    figures: Mapping[str, Callable[..., Figure]],
    results: Any,
    runs: Sequence[xr.Dataset],
    choice: PictureChoice,
) -> bytes:
    """Draw results, which are those of some runs."""
    with _as_answer():
        places = choice.keywords(choice.entry_in(figures))
        for run in runs:
            choice.require_within(run)
        return picture(figures[choice.name](results, **places), choice)


@contextmanager
def _as_answer() -> Iterator[None]:
    """Turn a refused choice into the answer to a request."""
    try:
        yield
    except ValueError as error:
        status = 404 if isinstance(error, UnknownFigureError) else 422
        raise RequestError(status, str(error)) from error
