"""Drawing of the indenter of a checked case."""

from __future__ import annotations

from pathlib import Path

from viscontact.cli.results.figures import plot_package, save
from viscontact.runs.check_report import drawn_size
from viscontact.runs.forecast import Forecast
from viscontact.runs.preparation import PreparedRun


def draw_body(
    prepared: PreparedRun,
    expected: Forecast,
    picture: Path | None,
    width: str | float | None = None,
) -> None:
    """Draw the indenter on the grid and around it, with the expected contact shaded."""
    plot, found = plot_package(), expected.estimate
    contact = found and (found.centre_x, found.centre_y, found.length, found.width)
    path = prepared.case.document.path
    file = picture or path.with_name(f"{path.stem}-indenter.png")
    size = drawn_size(prepared.run)
    options = {"size": size, "contact": contact, "width": width}
    save(plot, file, plot.draw_indenter, prepared.case.indenter, **options)
