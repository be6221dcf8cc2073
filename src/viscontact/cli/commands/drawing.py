"""`plot` and `compare`: figures of one run or several."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from viscontact.cli.commands.showing import AtCreepage
from viscontact.cli.declared import argument, option
from viscontact.drawing.figures import compared_names, names_of

Picture = Annotated[
    Path | None,
    option("-o", "--output", metavar="FIG.png", help="Figure: .png, .pdf or .svg."),
]
FigureOrAnimation = Annotated[
    Path | None,
    option(
        "-o",
        "--output",
        metavar="FIG.png",
        help="Figure: .png, .pdf or .svg; animation: .gif or .mp4.",
    ),
]
Instants = Annotated[
    list[str] | None,
    option("--time", metavar="T", help="Instant such as '240 s'; may be repeated."),
]
Speeds = Annotated[
    list[str] | None,
    option(
        "--speed", metavar="V", help="Speed of steady motion such as '0.5 m/s'; may be repeated."
    ),
]

Width = Annotated[
    str | None,
    option(
        "--width",
        metavar="WIDTH",
        help="Width of the figure: single (89 mm), double (183 mm), or a length such as '120 mm'.",
    ),
]
Along = Annotated[
    str | None,
    option("--along", metavar="x|y", help="Direction of a pressure-profile's line."),
]
At = Annotated[
    str | None,
    option("--at", metavar="PLACE", help="Position of the line on the other axis, such as '2 mm'."),
]
Style = Annotated[
    str | None,
    option(
        "--style",
        metavar="contours|colours",
        help="Pressure map with contour lines, or with a colour for each cell up to the peak; "
        "by default colours for a contact of many spots.",
    ),
]
Scale = Annotated[
    str | None,
    option(
        "--scale",
        metavar="all|each",
        help="Colours of one scale in all panels of a pressure map, or of one for each.",
    ),
]
Over = Annotated[
    str | None,
    option(
        "--over", metavar="time|force|area", help="Axis of a leak-rate; by default time or speed."
    ),
]
Theory = Annotated[
    bool | None,
    option(
        "--theory",
        help="Persson's theory beside the area or friction of a rough contact on a periodic grid.",
    ),
]


def plot(
    directory: Annotated[
        Path, argument(metavar="DIR", help="Run directory, its .nc file, or a sweep.")
    ],
    figure: Annotated[
        str,
        argument(
            metavar="FIGURE",
            help=f"{', '.join(names_of('time', 'both'))}, or animation; of steady motion: "
            f"{', '.join(names_of('speed'))}; of a sweep: {', '.join(names_of('sweep'))}.",
        ),
    ],
    times: Instants = None,
    speeds: Speeds = None,
    output: FigureOrAnimation = None,
    width: Width = None,
    along: Along = None,
    at: At = None,
    style: Style = None,
    scale: Scale = None,
    theory: Theory = None,
    over: Over = None,
    seconds: Annotated[
        float | None,
        option("--seconds", help="Duration of an animation in seconds; 8 by default."),
    ] = None,
    fps: Annotated[float | None, option("--fps", help="Frames per second; 15 by default.")] = None,
    creepage: AtCreepage = None,
) -> None:
    """Draw a figure or an animation of a run, or the response of a sweep.

    A sweep:  viscontact plot forces response -o forces.png
    """
    from viscontact.cli.results.figures import draw

    options: dict[str, str | float | None] = {
        **{"width": width, "along": along, "at": at, "style": style, "theory": theory},
        **{"scale": scale, "over": over},
        **{"seconds": seconds, "fps": fps},
    }
    draw(directory, figure, times or [], output, options, speeds or [], creepage)


def compare(
    directories: Annotated[
        list[Path], argument(metavar="DIR...", help="Runs, their .nc files, or a sweep.")
    ],
    figure: Annotated[
        str | None,
        option(
            "--figure",
            help=f"{', '.join(compared_names())}; by default history, in steady motion friction.",
        ),
    ] = None,
    times: Instants = None,
    speeds: Speeds = None,
    output: Picture = None,
    width: Width = None,
    along: Along = None,
    at: At = None,
    style: Style = None,
    scale: Scale = None,
) -> None:
    """Overlay several runs in one figure."""
    from viscontact.cli.results.figures import draw_comparison

    options = {"width": width, "along": along, "at": at, "style": style, "scale": scale}
    draw_comparison(directories, figure, times or [], output, options, speeds or [])
