"""`run` and `check`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.commands.drawing import Width
from viscontact.cli.terminal.interruption import Interruption, watched_interruption
from viscontact.cli.terminal.messages import INTERRUPTED, stop
from viscontact.runs.processes.request import RunRequest

CaseFiles = Annotated[
    list[Path], typer.Argument(metavar="CASE.yaml...", help="The case file, or several.")
]
CaseFile = Annotated[Path, typer.Argument(metavar="CASE.yaml", help="The case file.")]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a value, e.g. load.force=20kN."),
]
Output = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="DIR",
        help="Where to; CASE/ beside the file. Of several runs each gets a directory in DIR.",
    ),
]
Varied = Annotated[
    list[str] | None,
    typer.Option(
        "--vary",
        metavar="KEY=VALUE,VALUE,...",
        help="A run for each value, e.g. load.force=5kN,10kN; given again, for each pair.",
    ),
]
Threads = Annotated[int, typer.Option(min=1, help="Threads of one Fourier transform.")]


def run(
    cases: CaseFiles,
    output: Output = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the result that DIR holds.")
    ] = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the run that DIR holds.")
    ] = False,
    settings: Settings = None,
    varied: Varied = None,
    jobs: Annotated[
        int, typer.Option("-j", "--jobs", min=1, metavar="N", help="So many runs at once.")
    ] = 1,
    threads: Threads = 1,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Only errors.")] = False,
) -> None:
    """Run a case and write its result to a directory; or several, each to its own.

    Several:  viscontact run my.yaml --vary load.force=5kN,10kN,20kN -j 2 -o forces
    """
    given = tuple(settings or ())
    request = RunRequest(cases[0], output, overwrite, resume, given, threads, quiet)
    try:
        with watched_interruption() as interruption:
            if len(cases) == 1 and not varied:
                _run_one(request, interruption)
            else:
                _run_many(cases, request, varied or [], jobs, interruption)
    except KeyboardInterrupt:
        stop("interrupted", code=INTERRUPTED)


def _run_one(request: RunRequest, interruption: Interruption) -> None:
    # An import that is interrupted may end in any error: the request waits for its end.
    with interruption.postponed():
        from viscontact.cli.run.execution import execute
    execute(
        request.case,
        request.output,
        overwrite=request.overwrite,
        resume=request.resume,
        settings=request.settings,
        threads=request.threads,
        quiet=request.quiet,
    )


def _run_many(
    cases: list[Path], common: RunRequest, varied: list[str], jobs: int, interruption: Interruption
) -> None:
    with interruption.postponed():
        from viscontact.cli.many.request import ManyRequest
        from viscontact.cli.many.schedule import execute_many
    execute_many(ManyRequest(tuple(cases), common, tuple(varied), jobs))


def check(
    case: CaseFile,
    figure: Annotated[
        Path | None,
        typer.Argument(metavar="FIG.png", help="With --plot: where to; CASE-indenter.png."),
    ] = None,
    plot: Annotated[bool, typer.Option("--plot", help="Draw the indenter, too.")] = False,
    width: Width = None,
    settings: Settings = None,
) -> None:
    """Check a case, and say how large it is, how long it takes and what to expect."""
    from viscontact.cli.results.figures import chosen_width
    from viscontact.cli.run.check import draw_body, print_forecast
    from viscontact.cli.run.preparation import prepare
    from viscontact.cli.terminal.messages import refuse

    if figure is not None and not plot:
        refuse(f"{figure}: a picture goes with --plot, as in: check {case} --plot {figure}")
    page = chosen_width(width, drawn=plot, switch="--plot")
    prepared = prepare(case, settings or [])
    expected = print_forecast(prepared)
    if plot:
        draw_body(prepared, expected, figure, page)
