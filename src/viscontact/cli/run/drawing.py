"""Drawing of the indenter of a checked case, and of the spectra of its measured surfaces."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from viscontact.cli.results.figure_files import plot_package, save
from viscontact.cli.terminal.messages import say
from viscontact.runs.check_report import drawn_size
from viscontact.runs.forecast import Forecast
from viscontact.runs.preparation import PreparedRun


def draw_body(
    prepared: PreparedRun,
    expected: Forecast,
    picture: Path | None,
    width: str | float | None = None,
) -> None:
    """Draw the indenter with the expected contact, and the spectrum of a measured surface."""
    plot, found = plot_package(), expected.estimate
    contact = found and (found.centre_x, found.centre_y, found.length, found.width)
    path = prepared.case.document.path
    file = picture or path.with_name(f"{path.stem}-indenter.png")
    size = drawn_size(prepared.run)
    options: dict[str, Any] = {"size": size, "contact": contact, "width": width}
    save(plot, file, plot.draw_indenter, prepared.case.indenter, **options)
    for number, surface in enumerate(prepared.case.surfaces, start=1):
        if surface.missing.any():
            say(f"{surface.name}: no power spectrum is drawn, because points are missing")
            continue
        count = f"-{number}" if len(prepared.case.surfaces) > 1 else ""
        of_waves = file.with_name(f"{file.stem.removesuffix('-indenter')}-spectrum{count}")
        save(
            plot, of_waves.with_suffix(file.suffix), plot.draw_power_spectrum, surface, width=width
        )
