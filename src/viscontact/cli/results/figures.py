"""Drawing and writing of figures and animations."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from inspect import signature
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.cli.results.compared_runs import compared_runs, note_changed, note_missing
from viscontact.cli.results.stored import early_end, opened
from viscontact.cli.terminal.messages import refuse, say
from viscontact.cli.terminal.progress import counted
from viscontact.results.run_axis import SPEED, TIME, RunAxis, run_axis
from viscontact.studies.sweep.open_many import open_many
from viscontact.studies.sweep.states import State
from viscontact.units.parsing import parse_quantity

#: Name of the animation, which is written differently.
ANIMATION = "animation"
#: Name of the figure of a sweep.
RESPONSE = "response"
#: Figures of the fields at single instants; the others take times as a span.
_OF_INSTANTS = (
    *("pressure-map", "pressure-profile", "pressure-radial", "contact-outline", "contact-spots"),
    *("line-load", "pressure-3d", "surface-3d", "stress-section", "von-mises", "indenter"),
    "motion-profile",
)


def draw(
    directory: Path,
    figure: str,
    times: Sequence[str],
    output: Path | None,
    options: Mapping[str, str | float | None] | None = None,
    speeds: Sequence[str] = (),
) -> Path:
    """Draw a figure of one run."""
    plot = plot_package()
    others = {ANIMATION: plot.animation, RESPONSE: plot.response}
    draw_it = _named(figure, {**plot.FIGURES, **plot.STEADY_FIGURES, **others})
    wanted, chosen = _wanted(times, speeds), _chosen(options or {}, figure, draw_it)
    folder = directory if directory.is_dir() else directory.parent
    moves = figure == ANIMATION
    file = output or folder / f"{figure}{'.gif' if moves else '.png'}"
    _require_suffix(plot, file, plot.ANIMATION_SUFFIXES if moves else plot.FIGURE_SUFFIXES)
    place = next(
        (name for name in ("times", "speeds") if name in signature(draw_it).parameters), ""
    )
    if wanted is not None and not place:
        refuse(f"{wanted.option}: does not apply to the figure {figure}")
    if figure == RESPONSE:
        save(plot, file, draw_it, _sweep(directory), **chosen)
        return file
    with opened(directory) as ds:
        if figure != "creep":  # the law is known beyond the run
            _refuse_outside(wanted, ds, directory)
        _note(early_end(ds), _snapped(wanted, ds, figure))
        if place:
            chosen[place] = None if wanted is None else wanted.values
        if moves:
            save_animation(plot, file, ds, **chosen)
        else:
            save(plot, file, draw_it, ds, **chosen)
    return file


def _sweep(directory: Path) -> xr.Dataset:
    """Joint result of a sweep for its figure."""
    try:
        ds = open_many(directory)
    except (OSError, ValueError) as error:
        refuse(f"{directory}: {RESPONSE} is a figure of a sweep: {error}")
    if "changed" in ds:
        note_changed(directory, int((ds["changed"] != "").sum()))
    note_missing(directory, int((ds["state"] != State.DONE.value).sum()), ds["state"].size)
    return ds


def draw_comparison(
    directories: Sequence[Path],
    figure: str,
    times: Sequence[str],
    output: Path | None,
    options: Mapping[str, str | float | None] | None = None,
    speeds: Sequence[str] = (),
) -> Path:
    """Draw a figure of several runs."""
    plot = plot_package()
    directories = compared_runs(directories)
    draw_it = _named(figure, plot.COMPARISONS)
    wanted, chosen = _wanted(times, speeds), _chosen(options or {}, figure, draw_it)
    if len(directories) < 2:
        one = f"got {directories[0]} alone" if directories else "got none with a result"
        refuse(f"compare needs two runs or more, {one}; `viscontact plot DIR` draws a single run")
    file = output or Path(f"compare-{figure}.png")
    _require_suffix(plot, file, plot.FIGURE_SUFFIXES)
    with ExitStack() as stack:
        runs = [stack.enter_context(opened(directory)) for directory in directories]
        labelled = dict(zip(_labels(directories), runs, strict=True))
        if len(labelled) < len(runs):
            refuse("compare needs different runs, got one of them twice")
        for directory, (label, ds) in zip(directories, labelled.items(), strict=True):
            if figure != "creep":  # the law is known beyond the run
                _refuse_outside(wanted, ds, directory)
            notes = (early_end(ds), _snapped(wanted, ds, figure))
            _note(*(f"{label}: {note}" for note in notes if note))
        _refuse_mixed(labelled)
        times_of = None if wanted is None else wanted.values
        save(
            plot,
            file,
            draw_it,
            plot.layout.ordered_names.in_order(labelled),
            times=times_of,
            **chosen,
        )
    return file


def plot_package() -> Any:
    """Return `viscontact.plot`, or name the missing package."""
    try:
        from viscontact import plot
    except ModuleNotFoundError as error:
        if error.name != "matplotlib":
            raise
        refuse("figures need matplotlib: pip install 'viscontact[plot]'")
    return plot


def _named(figure: str, figures: dict[str, Any]) -> Any:
    if figure not in figures:
        near = difflib.get_close_matches(figure, figures, n=1)
        hint = f"; did you mean {near[0]}?" if near else "."
        refuse(f"no figure is called {figure!r}{hint} There are {', '.join(figures)}")
    return figures[figure]


@dataclass(frozen=True)
class _Wanted:
    """Instants [s] or speeds [m/s] to draw."""

    axis: RunAxis
    values: list[float]

    @property
    def option(self) -> str:
        """Option that they were given with."""
        return f"--{self.axis.name}"


def _wanted(times: Sequence[str], speeds: Sequence[str]) -> _Wanted | None:
    if times and speeds:
        refuse("--time and --speed: a run is over time or over speed; give one of them")
    axis, texts = (SPEED, speeds) if speeds else (TIME, times)
    try:
        values = [parse_quantity(text, axis.name) for text in texts]
    except ValueError as error:
        refuse(f"--{axis.name}: {error}")
    return _Wanted(axis, values) if values else None


def _refuse_mixed(runs: Mapping[str, xr.Dataset]) -> None:
    """Refuse to compare runs over time with runs over speed."""
    if len({run_axis(ds).name for ds in runs.values()}) > 1:
        steady = ", ".join(label for label, ds in runs.items() if not run_axis(ds).is_history)
        refuse(f"compare needs runs over time only, or of steady motion only; over speed: {steady}")


def _chosen(options: Mapping[str, str | float | None], figure: str, draw_it: Any) -> dict[str, Any]:
    """Options that were given, refused where they do not apply to the figure."""
    given = {name: value for name, value in options.items() if value is not None}
    for name in given:
        if name not in signature(draw_it).parameters:
            refuse(f"--{name}: does not apply to the figure {figure}")
    return {name: _read(name, value) for name, value in given.items()}


def _read(name: str, value: str | float) -> str | float:
    is_length = name == "at" or (name == "width" and value not in ("single", "double"))
    try:
        return parse_quantity(str(value), "length") if is_length else value
    except ValueError as error:
        words = "; or write single (89 mm) or double (183 mm)" if name == "width" else ""
        refuse(f"--{name}: {error}{words}")


def chosen_width(width: str | None, *, drawn: bool, switch: str) -> str | float | None:
    """Read --width before any work is done, or refuse it."""
    if width is None:
        return None
    if not drawn:
        refuse(f"--width: applies to figures only; add {switch}")
    read = _read("width", width)
    try:
        plot_package().layout.page.page_width(read, 1.0)
    except ValueError as error:
        refuse(f"--width: {error}")
    return read


def _require_suffix(plot: Any, file: Path, suffixes: Sequence[str]) -> None:
    """Refuse a file of another format, or in no directory, before any work is done for it."""
    if not file.absolute().parent.is_dir():
        refuse(f"{file}: there is no directory {file.parent}")
    try:
        plot.require_suffix(file, suffixes)
    except ValueError as error:
        refuse(f"{file}: {error}")


def _refuse_outside(wanted: _Wanted | None, ds: xr.Dataset, directory: Path) -> None:
    if wanted is None:
        return
    axis = run_axis(ds)
    if wanted.axis is not axis:
        refuse(
            f"{wanted.option}: the run {directory} is {axis.kind_of_run}; give --{axis.name} in "
            "its place"
        )
    start, end = float(axis.values(ds).min()), float(axis.values(ds).max())
    # Tolerance for rounding: "0.1 min" may differ from 6 s in the last digit.
    slack = 1e-9 * end
    for value in wanted.values:
        if not start - slack <= value <= end + slack:
            refuse(
                f"{wanted.option}: {axis.quantity(value)} lies outside the run {directory}, "
                f"which goes from {axis.quantity(start)} to {axis.quantity(end)}"
            )


def _snapped(wanted: _Wanted | None, ds: xr.Dataset, figure: str) -> str:
    """Message about stored fields drawn in place of requested ones; empty without any."""
    if wanted is None or figure not in _OF_INSTANTS or "pressure" not in ds:
        return ""
    stored, axis = ds[ds["pressure"].dims[0]].values, wanted.axis
    nearest = {each: float(stored[np.abs(stored - each).argmin()]) for each in wanted.values}
    return "; ".join(
        f"{axis.quantity(each)} is not stored; drew {axis.quantity(drawn)}"
        for each, drawn in nearest.items()
        if not np.isclose(each, drawn, rtol=1e-9, atol=0.0)
    )


def _note(*lines: str) -> None:
    for line in filter(None, lines):
        say(line)


def _labels(directories: Sequence[Path]) -> list[str]:
    names = [path.resolve().name for path in directories]
    unique = len(set(names)) == len(names)
    return names if unique else [str(path) for path in directories]


def save_animation(plot: Any, file: Path, ds: xr.Dataset, **options: Any) -> None:
    """Draw and write an animation, and print the name of its file."""
    try:
        moving = plot.animation(ds, **options)
        stored = len(set(moving.instants.tolist()))
        if stored < moving.instants.size / 4:
            say(
                f"{moving.instants.size} frames show {stored} stored instants; for smooth motion "
                "run again with --set output.fields=all"
            )
        with counted("frame") as progress:
            plot.save_animation(moving, file, progress)
    except (ValueError, OSError) as error:
        refuse(f"{file}: {error}")
    print(file)


def save(plot: Any, file: Path, draw_it: Any, results: Any, **options: Any) -> None:
    """Draw and write a figure, and print the name of its file."""
    try:
        with ExitStack() as stack:
            if "progress" in signature(draw_it).parameters:  # stresses of many cells take long
                options["progress"] = stack.enter_context(counted("depth"))
            figure = draw_it(results, **options)
        plot.save_figure(figure, file)
    except (ValueError, OSError) as error:
        refuse(f"{file}: {error}")
    print(file)
