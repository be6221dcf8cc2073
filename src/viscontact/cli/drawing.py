"""`plot` and `compare`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.showing import RunDirectory

Picture = Annotated[
    Path | None,
    typer.Option("-o", "--output", metavar="FIG.png", help="Where to: .png, .pdf or .svg."),
]
Instants = Annotated[
    list[str] | None,
    typer.Option("--time", metavar="T", help="An instant such as '240 s'; may be repeated."),
]


def plot(
    directory: RunDirectory,
    figure: Annotated[
        str,
        typer.Argument(
            metavar="FIGURE",
            help="pressure-map, pressure-profile, pressure-radial, contact-outline, history, "
            "hysteresis, or creep.",
        ),
    ],
    times: Instants = None,
    output: Picture = None,
) -> None:
    """Draw a figure of a run."""
    from viscontact.cli.figures import draw

    draw(directory, figure, times or [], output)


def compare(
    directories: Annotated[
        list[Path], typer.Argument(metavar="DIR...", help="Runs, or their .nc files.")
    ],
    figure: Annotated[
        str, typer.Option("--figure", help="history, hysteresis or pressure-profile.")
    ] = "history",
    times: Instants = None,
    output: Picture = None,
) -> None:
    """Overlay several runs in one figure."""
    from viscontact.cli.figures import draw_comparison

    draw_comparison(directories, figure, times or [], output)
