"""`plot` and `compare`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.commands.showing import RunDirectory

Picture = Annotated[
    Path | None,
    typer.Option("-o", "--output", metavar="FIG.png", help="Where to: .png, .pdf or .svg."),
]
PictureOrFilm = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FIG.png",
        help="Where to: .png, .pdf or .svg; an animation: .gif or .mp4.",
    ),
]
Instants = Annotated[
    list[str] | None,
    typer.Option("--time", metavar="T", help="An instant such as '240 s'; may be repeated."),
]


Width = Annotated[
    str | None,
    typer.Option(
        "--width",
        metavar="WIDTH",
        help="A column of a journal, single (89 mm) or double (183 mm), or a width as '120 mm'.",
    ),
]
Along = Annotated[
    str | None,
    typer.Option("--along", metavar="x|y", help="Direction of a pressure-profile's line."),
]
At = Annotated[
    str | None,
    typer.Option("--at", metavar="PLACE", help="Where it crosses the other axis, such as '2 mm'."),
]


def plot(
    directory: RunDirectory,
    figure: Annotated[
        str,
        typer.Argument(
            metavar="FIGURE",
            help="pressure-map, pressure-3d, pressure-profile, pressure-radial, surface-3d, "
            "contact-outline, contact-area, history, hysteresis, exact, creep, stress-section, "
            "von-mises, indenter, or animation.",
        ),
    ],
    times: Instants = None,
    output: PictureOrFilm = None,
    width: Width = None,
    along: Along = None,
    at: At = None,
    seconds: Annotated[
        float | None, typer.Option("--seconds", help="How long an animation lasts; 8 s.")
    ] = None,
    fps: Annotated[float | None, typer.Option("--fps", help="Its frames a second; 15.")] = None,
) -> None:
    """Draw a figure of a run, or a film of it."""
    from viscontact.cli.results.figures import draw

    options = {"width": width, "along": along, "at": at, "seconds": seconds, "fps": fps}
    draw(directory, figure, times or [], output, options)


def compare(
    directories: Annotated[
        list[Path], typer.Argument(metavar="DIR...", help="Runs, or their .nc files.")
    ],
    figure: Annotated[
        str,
        typer.Option(
            "--figure",
            help="history, hysteresis, contact-outline, pressure-profile, pressure-map, "
            "pressure-3d, creep, or von-mises.",
        ),
    ] = "history",
    times: Instants = None,
    output: Picture = None,
    width: Width = None,
    along: Along = None,
    at: At = None,
) -> None:
    """Overlay several runs in one figure."""
    from viscontact.cli.results.figures import draw_comparison

    options = {"width": width, "along": along, "at": at}
    draw_comparison(directories, figure, times or [], output, options)
