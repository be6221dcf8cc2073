"""Figures drawn and written, or refused in one line."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.cli.messages import refuse, say
from viscontact.cli.stored import early_end, opened
from viscontact.units import in_words, parse_quantity

#: Promised, not built yet.
_LATER = ("animation",)


#: Figures of the fields at single instants; the others take times as a span.
_OF_INSTANTS = (
    *("pressure-map", "pressure-profile", "pressure-radial", "contact-outline"),
    *("pressure-3d", "surface-3d", "stress-section", "von-mises"),
)


def draw(directory: Path, figure: str, times: Sequence[str], output: Path | None) -> Path:
    """Draw a figure of one run.

    Parameters
    ----------
    directory : Path
        The run.
    figure : str
        Name of the figure.
    times : sequence of str
        Instants in words; empty for the figure's own choice.
    output : Path or None
        The file; None for FIGURE.png in the run's directory.

    Returns
    -------
    Path
        The file.
    """
    plot = plot_package()
    draw_it = _named(figure, plot.FIGURES)
    instants = _instants(times)
    folder = directory if directory.is_dir() else directory.parent
    file = output or folder / f"{figure}.png"
    with opened(directory) as ds:
        if figure != "creep":  # the law goes on after the run
            _refuse_outside(instants, ds, directory)
        _note(early_end(ds), _snapped(instants, ds, figure))
        save(plot, file, draw_it, ds, times=instants)
    return file


def draw_comparison(
    directories: Sequence[Path], figure: str, times: Sequence[str], output: Path | None
) -> Path:
    """Draw a figure of several runs.

    Parameters
    ----------
    directories : sequence of Path
        The runs, two or more.
    figure : str
        Name of the figure.
    times : sequence of str
        Instants in words; empty for the figure's own choice.
    output : Path or None
        The file; None for compare-FIGURE.png here.

    Returns
    -------
    Path
        The file.
    """
    plot = plot_package()
    draw_it = _named(figure, plot.COMPARISONS)
    instants = _instants(times)
    if len(directories) < 2:
        refuse("compare needs two runs or more")
    file = output or Path(f"compare-{figure}.png")
    with ExitStack() as stack:
        runs = [stack.enter_context(opened(directory)) for directory in directories]
        labelled = dict(zip(_labels(directories), runs, strict=True))
        for directory, (label, ds) in zip(directories, labelled.items(), strict=True):
            _refuse_outside(instants, ds, directory)
            notes = (early_end(ds), _snapped(instants, ds, figure))
            _note(*(f"{label}: {note}" for note in notes if note))
        save(plot, file, draw_it, labelled, times=instants)
    return file


def plot_package() -> Any:
    """Return `viscontact.plot`, or say what it needs."""
    try:
        from viscontact import plot
    except ModuleNotFoundError as error:
        if error.name != "matplotlib":
            raise
        refuse("figures need matplotlib: pip install 'viscontact[plot]'")
    return plot


def _named(figure: str, figures: dict[str, Any]) -> Any:
    if figure in _LATER:
        refuse(f"the figure {figure} is not built yet; built: {', '.join(figures)}")
    if figure not in figures:
        near = difflib.get_close_matches(figure, figures, n=1)
        hint = f"; did you mean {near[0]}?" if near else "."
        refuse(f"no figure is called {figure!r}{hint} There are {', '.join(figures)}")
    return figures[figure]


def _instants(times: Iterable[str]) -> list[float] | None:
    try:
        return [parse_quantity(text, "time") for text in times] or None
    except ValueError as error:
        refuse(f"--time: {error}")


def _refuse_outside(instants: list[float] | None, ds: xr.Dataset, directory: Path) -> None:
    start, end = (float(ds["time"][index]) for index in (0, -1))
    # A last digit of slack: "0.1 min" and the run's own 6 s may differ by it.
    slack = 1e-9 * end
    for instant in instants or ():
        if not start - slack <= instant <= end + slack:
            refuse(
                f"--time: {in_words(instant, 's')} lies outside the run {directory}, "
                f"which goes from {in_words(start, 's')} to {in_words(end, 's')}"
            )


def _snapped(instants: list[float] | None, ds: xr.Dataset, figure: str) -> str:
    """Say which instants are drawn in place of those that are not stored."""
    if not instants or figure not in _OF_INSTANTS or "pressure" not in ds:
        return ""
    stored = ds[ds["pressure"].dims[0]].values
    nearest = {wanted: float(stored[np.abs(stored - wanted).argmin()]) for wanted in instants}
    return "; ".join(
        f"{in_words(wanted, 's')} is not stored; drew {in_words(drawn, 's')}"
        for wanted, drawn in nearest.items()
        if not np.isclose(wanted, drawn, rtol=1e-9, atol=0.0)
    )


def _note(*lines: str) -> None:
    for line in filter(None, lines):
        say(line)


def _labels(directories: Sequence[Path]) -> list[str]:
    names = [path.resolve().name for path in directories]
    unique = len(set(names)) == len(names)
    return names if unique else [str(path) for path in directories]


def save(plot: Any, file: Path, draw_it: Any, results: Any, **options: Any) -> None:
    """Draw and write a figure, or say in one line why not; print the file's name."""
    try:
        plot.save_figure(draw_it(results, **options), file)
    except (ValueError, OSError) as error:
        refuse(f"{file}: {error}")
    print(file)
