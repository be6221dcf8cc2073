"""Drawing and writing of figures and animations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import xarray as xr

from viscontact.cli.results.compared_runs import compared_runs, note_changed, note_missing
from viscontact.cli.results.figure_files import plot_package, read_place, require_suffix, save
from viscontact.cli.results.stored import checked_result, early_end
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.cli.terminal.progress import counted
from viscontact.drawing.choice import FigureChoice, require_one_axis
from viscontact.drawing.content.ordered_names import in_order
from viscontact.drawing.figures import TABLE, FigureEntry, compared_names
from viscontact.results.run_axis import run_axis
from viscontact.studies.sweep.open_many import open_many
from viscontact.studies.sweep.states import State

#: Options of a figure by their names, None where not given.
Options = Mapping[str, str | float | None]


def draw(
    directory: Path,
    figure: str,
    times: Sequence[str],
    output: Path | None,
    options: Options | None = None,
    speeds: Sequence[str] = (),
    creepage: str | None = None,
) -> Path:
    """Draw a figure of one run."""
    plot = plot_package()
    choice = FigureChoice(figure, tuple(times), tuple(speeds), "--")
    entry, given = _choose_figure(choice, [each.name for each in TABLE], options or {})
    folder = directory if directory.is_dir() else directory.parent
    file = output or folder / f"{figure}{'.gif' if entry.is_animation else '.png'}"
    suffixes = plot.ANIMATION_SUFFIXES if entry.is_animation else plot.FIGURE_SUFFIXES
    require_suffix(plot, file, suffixes)
    draw_it, counts = getattr(plot, entry.drawn_by), "progress" in entry.takes
    if entry.of == "sweep":
        if creepage is not None:
            choice.refuse("creepage")
        save(plot, file, draw_it, _sweep(figure, directory), **given)
        return file
    with checked_result(directory, creepage, several=entry.over_creepage) as ds:
        _require_within(choice, ds, directory)
        _note(early_end(ds), choice.drawn_instead(ds))
        if entry.is_animation:
            save_animation(plot, file, ds, **given)
        else:
            save(plot, file, draw_it, ds, counts=counts, **given)
    return file


def _sweep(figure: str, directory: Path) -> xr.Dataset:
    """Joint result of a sweep for its figure."""
    try:
        ds = open_many(directory)
    except (OSError, ValueError) as error:
        refuse(f"{directory}: {figure} is a figure of a sweep: {error}")
    if "changed" in ds:
        note_changed(directory, int((ds["changed"] != "").sum()))
    note_missing(directory, int((ds["state"] != State.DONE.value).sum()), ds["state"].size)
    return ds


def draw_comparison(
    directories: Sequence[Path],
    figure: str | None,
    times: Sequence[str],
    output: Path | None,
    options: Options | None = None,
    speeds: Sequence[str] = (),
) -> Path:
    """Draw a figure of several runs; by default their histories, or friction over speed."""
    plot = plot_package()
    directories = compared_runs(directories)
    figure = figure or _usual_comparison(directories)
    choice = FigureChoice(figure, tuple(times), tuple(speeds), "--")
    entry, given = _choose_figure(choice, compared_names(), options or {})
    if len(directories) < 2:
        one = f"got {directories[0]} alone" if directories else "got none with a result"
        refuse(f"compare needs two runs or more, {one}; `viscontact plot DIR` draws a single run")
    file = output or Path(f"compare-{figure}.png")
    require_suffix(plot, file, plot.FIGURE_SUFFIXES)
    with ExitStack() as stack:
        runs = [stack.enter_context(checked_result(directory)) for directory in directories]
        labelled = dict(zip(_labels(directories), runs, strict=True))
        if len(labelled) < len(runs):
            refuse("compare needs different runs, got one of them twice")
        for directory, (label, ds) in zip(directories, labelled.items(), strict=True):
            _require_within(choice, ds, directory)
            notes = (early_end(ds), choice.drawn_instead(ds))
            _note(*(f"{label}: {note}" for note in notes if note))
        try:
            require_one_axis(labelled)
        except ValueError as error:
            refuse(str(error))
        save(
            plot,
            file,
            plot.COMPARISONS[figure],
            in_order(labelled),
            counts="progress" in entry.takes,
            **given,
        )
    return file


def _usual_comparison(directories: Sequence[Path]) -> str:
    """Figure that suits the first of several runs."""
    if not directories:
        return "history"
    with checked_result(directories[0]) as ds:
        return "history" if run_axis(ds).is_history else "friction"


def _choose_figure(
    choice: FigureChoice, names: Sequence[str], options: Options
) -> tuple[FigureEntry, dict[str, Any]]:
    """Entry of a figure, and the keywords to draw it with; refused where they do not apply."""
    try:
        entry = choice.entry_in(names)
        given: dict[str, Any] = dict(choice.keywords(entry))
        wanted = {name: value for name, value in options.items() if value is not None}
        for name in wanted:
            if name not in (*entry.takes, "width"):
                choice.refuse(name)
    except ValueError as error:
        refuse(str(error))
    return entry, given | {name: read_place(name, value) for name, value in wanted.items()}


def _require_within(choice: FigureChoice, ds: xr.Dataset, directory: Path) -> None:
    try:
        choice.require_within(ds, str(directory))
    except ValueError as error:
        refuse(str(error))


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
    put(file)
