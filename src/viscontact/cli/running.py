"""`run` and `check`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.messages import refuse

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
        bool, typer.Option("--resume", help="Continue a run (not built yet).")
    ] = False,
    settings: Settings = None,
    threads: Threads = 1,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Only errors.")] = False,
) -> None:
    """Run a case and write its result to a directory."""
    from viscontact.cli.execution import execute

    if resume:
        refuse("--resume is not built yet; start the run again, with --overwrite if DIR exists")
    execute(case, output, overwrite=overwrite, settings=settings, threads=threads, quiet=quiet)


def check(case: CaseFile, settings: Settings = None) -> None:
    """Check a case, and say how large it is, how long it takes and what to expect."""
    from viscontact.cli.inspection import print_forecast
    from viscontact.cli.preparation import prepare

    print_forecast(prepare(case, settings or []))
