"""Files of figures: the package that draws, widths and suffixes, refused before any work."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from viscontact.cli.terminal.messages import put, refuse
from viscontact.cli.terminal.progress import counted
from viscontact.units.parsing import parse_quantity


def plot_package() -> Any:
    """Return `viscontact.plot`, or name the missing package."""
    try:
        from viscontact.drawing import matplotlib as plot
    except ModuleNotFoundError as error:
        if error.name != "matplotlib":
            raise
        refuse("figures need matplotlib: pip install 'viscontact[plot]'")
    return plot


def read_place(name: str, value: str | float) -> str | float:
    """Read a place or a width of a figure, or refuse it."""
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
    read = read_place("width", width)
    try:
        plot_package().layout.page.page_width(read, 1.0)
    except ValueError as error:
        refuse(f"--width: {error}")
    return read


def require_suffix(plot: Any, file: Path, suffixes: Sequence[str]) -> None:
    """Refuse a file of another format, or in no directory, before any work is done for it."""
    if not file.absolute().parent.is_dir():
        refuse(f"{file}: there is no directory {file.parent}")
    try:
        plot.require_suffix(file, suffixes)
    except ValueError as error:
        refuse(f"{file}: {error}")


def save(
    plot: Any, file: Path, draw_it: Any, results: Any, *, counts: bool = False, **options: Any
) -> None:
    """Draw and write a figure, and print the name of its file."""
    try:
        with ExitStack() as stack:
            if counts:  # stresses of many cells take long
                options["progress"] = stack.enter_context(counted("depth"))
            figure = draw_it(results, **options)
        plot.save_figure(figure, file)
    except (ValueError, OSError) as error:
        refuse(f"{file}: {error}")
    put(file)
