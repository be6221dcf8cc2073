"""`run` and `check`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.messages import INTERRUPTED, stop

CaseFile = Annotated[Path, typer.Argument(metavar="CASE.yaml", help="The case file.")]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a value, e.g. load.force=20kN."),
]
Threads = Annotated[int, typer.Option(min=1, help="Threads of one Fourier transform.")]


def run(
    case: CaseFile,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="DIR", help="Where to; CASE/ beside the file."),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the result that DIR holds.")
    ] = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the run that DIR holds.")
    ] = False,
    settings: Settings = None,
    threads: Threads = 1,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Only errors.")] = False,
) -> None:
    """Run a case and write its result to a directory."""
    from viscontact.cli.interruption import watched_interruption

    try:
        with watched_interruption() as interruption:
            # An import that is interrupted may end in any error: the request waits for its end.
            with interruption.postponed():
                from viscontact.cli.execution import execute
            execute(
                case,
                output,
                overwrite=overwrite,
                resume=resume,
                settings=settings,
                threads=threads,
                quiet=quiet,
            )
    except KeyboardInterrupt:
        stop("interrupted", code=INTERRUPTED)


def check(
    case: CaseFile,
    figure: Annotated[
        Path | None,
        typer.Argument(metavar="FIG.png", help="With --plot: where to; CASE-indenter.png."),
    ] = None,
    plot: Annotated[bool, typer.Option("--plot", help="Draw the indenter, too.")] = False,
    settings: Settings = None,
) -> None:
    """Check a case, and say how large it is, how long it takes and what to expect."""
    from viscontact.cli.inspection import draw_body, print_forecast
    from viscontact.cli.messages import refuse
    from viscontact.cli.preparation import prepare

    if figure is not None and not plot:
        refuse(f"{figure}: a picture goes with --plot, as in: check {case} --plot {figure}")
    prepared = prepare(case, settings or [])
    expected = print_forecast(prepared)
    if plot:
        draw_body(prepared, expected, figure)
