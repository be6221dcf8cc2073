"""Figures drawn and written, or refused in one line."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from viscontact.cli.messages import refuse
from viscontact.cli.stored import opened
from viscontact.units import parse_quantity

#: Promised, not built yet.
_LATER = ("animation", "von-mises", "stress-section")


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
    plot = _plot_package()
    draw_it = _named(figure, plot.FIGURES)
    instants = _instants(times)
    folder = directory if directory.is_dir() else directory.parent
    file = output or folder / f"{figure}.png"
    with opened(directory) as ds:
        _save(plot, file, draw_it, ds, times=instants)
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
    plot = _plot_package()
    draw_it = _named(figure, plot.COMPARISONS)
    instants = _instants(times)
    if len(directories) < 2:
        refuse("compare needs two runs or more")
    file = output or Path(f"compare-{figure}.png")
    with ExitStack() as stack:
        runs = [stack.enter_context(opened(directory)) for directory in directories]
        labelled = dict(zip(_labels(directories), runs, strict=True))
        _save(plot, file, draw_it, labelled, times=instants)
    return file


def _plot_package() -> Any:
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


def _labels(directories: Sequence[Path]) -> list[str]:
    names = [path.resolve().name for path in directories]
    unique = len(set(names)) == len(names)
    return names if unique else [str(path) for path in directories]


def _save(plot: Any, file: Path, draw_it: Any, results: Any, **options: Any) -> None:
    try:
        plot.save_figure(draw_it(results, **options), file)
    except (ValueError, OSError) as error:
        refuse(f"{file}: {error}")
    print(file)
