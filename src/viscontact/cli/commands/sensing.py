"""`sensitivity`: what the result of a case depends on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.commands.running import CaseFile, Settings


def sensitivity(
    case: CaseFile,
    of: Annotated[
        str,
        typer.Option("--of", metavar="SCALAR,...", help="Outputs, e.g. peak_pressure,approach."),
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Directory of the runs.")
    ],
    change: Annotated[
        list[str] | None,
        typer.Option(
            "--change",
            metavar="KEY",
            help="Input, e.g. indenter.radius; repeated for each. By default all numbers of "
            "bodies, load and motion.",
        ),
    ] = None,
    scatter: Annotated[
        list[str] | None,
        typer.Option(
            "--scatter",
            metavar="KEY=LOW:HIGH[:log|:normal]",
            help="Input that scatters between two bounds (normal: 95 % of it), e.g. "
            "indenter.radius='4.98 mm:5.02 mm' or '5 mm ± 0.02 mm'; repeated for each. Numbers "
            "with a tolerance in the case scatter as well.",
        ),
    ] = None,
    samples: Annotated[
        int,
        typer.Option(
            "--samples",
            metavar="N",
            help="Number of samples, a power of two; with d inputs they take N (d + 2) runs.",
        ),
    ] = 64,
    seed: Annotated[int, typer.Option("--seed", metavar="S", help="Seed of the samples.")] = 0,
    at: Annotated[
        str,
        typer.Option(
            "--at",
            metavar="worst|end|TIME",
            help="Instant of the outputs: their worst value, the last one, or a time.",
        ),
    ] = "worst",
    step: Annotated[
        float,
        typer.Option("--step", metavar="PART", help="Relative step of an input, up to 0.5."),
    ] = 0.1,
    settings: Settings = None,
    jobs: Annotated[
        int, typer.Option("-j", "--jobs", min=1, metavar="N", help="Number of runs at a time.")
    ] = 1,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue the runs that DIR holds.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print the result only.")] = False,
) -> None:
    """Find how much scalars of the result depend on each number of a case.

    The elasticity is the relative change of an output per relative change of an input; the error of
    each is stated. DIR gets the runs, sensitivity.nc and report.html.
    """
    from viscontact.cli.studies.sensitivity import SensitivityRequest, execute_sensitivity

    request = SensitivityRequest(
        *(case, output, of, change or (), scatter or (), samples, seed),
        *(at, step, settings or (), jobs),
    )
    execute_sensitivity(request, resume=resume, quiet=quiet)
