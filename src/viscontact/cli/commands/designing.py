"""`design`: values of a case for the best scalar."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.commands.running import CaseFile, Settings

Changes = Annotated[
    list[str] | None,
    typer.Option(
        "--change",
        metavar="KEY=LOW:HIGH[:log]",
        help="Range of a parameter, e.g. indenter.crown_radius='20 mm:2 m:log', or its values, "
        "KEY=A,B,...; repeated for each parameter.",
    ),
]
Scenarios = Annotated[
    list[str] | None,
    typer.Option(
        "--over",
        metavar="KEY=VALUE,VALUE,...",
        help="Scenarios, of which the worst one counts, e.g. load.eccentricity_x='0 mm,5 mm'.",
    ),
]
Scatter = Annotated[
    list[str] | None,
    typer.Option(
        "--scatter",
        metavar="KEY=LOW:HIGH",
        help="Scatter, of which the worst corner counts: values, e.g. "
        "material.poisson_ratio=0.36:0.40 or '0.38 ± 0.02', or deviations of a changed parameter, "
        "e.g. indenter.crown_radius='-2 mm:2 mm' or '± 2 mm'.",
    ),
]
Constraints = Annotated[
    list[str] | None,
    typer.Option(
        "--constraint",
        metavar="SCALAR<=VALUE",
        help="Bound that is to be kept at all instants, e.g. 'contact_length<=18mm', or with >=.",
    ),
]


def design(
    case: CaseFile,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Directory of the design.")
    ],
    change: Changes = None,
    minimise: Annotated[
        list[str] | None,
        typer.Option(
            "--minimise",
            metavar="SCALAR",
            help="Scalar to make least: peak_pressure; two or three scalars give a trade-off.",
        ),
    ] = None,
    maximise: Annotated[
        list[str] | None,
        typer.Option("--maximise", metavar="SCALAR", help="Scalar to make largest, likewise."),
    ] = None,
    at: Annotated[
        str,
        typer.Option(
            "--at",
            metavar="worst|end|TIME",
            help="Instant of the scalar: its worst value, the last one, or a time.",
        ),
    ] = "worst",
    over: Scenarios = None,
    scatter: Scatter = None,
    profile: Annotated[
        str | None,
        typer.Option(
            "--profile",
            metavar="free[:KNOTS][:asymmetric]",
            help="Find the drop curve of a roller for the least peak pressure, in place of "
            "--change; DIR gets profile.csv and profile.dxf, too.",
        ),
    ] = None,
    drop_tolerance: Annotated[
        str | None,
        typer.Option(
            "--drop-tolerance",
            metavar="LENGTH",
            help="Production tolerance of the drop, to either side, e.g. '1 um'; the worst profile "
            "within it counts.",
        ),
    ] = None,
    constraint: Constraints = None,
    settings: Settings = None,
    runs: Annotated[
        int | None,
        typer.Option(
            "--runs",
            min=1,
            metavar="N",
            help="Most runs; by default 60, several times as many for a trade-off, and 2000 "
            "for a profile.",
        ),
    ] = None,
    jobs: Annotated[
        int,
        typer.Option("-j", "--jobs", min=1, metavar="N", help="Number of runs at a time."),
    ] = 1,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue the design that DIR holds.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print the result only.")] = False,
) -> None:
    """Find the values of a case for which a scalar is least or largest.

    The search begins on coarse cells; the best trials are computed on the cells of the case. DIR
    gets best.yaml, trials.nc and report.html. With --profile free, the drop curve of a roller is
    found.
    """
    from viscontact.cli.studies.design import DesignRequest
    from viscontact.cli.studies.execution import execute_design
    from viscontact.cli.studies.profiles import ProfileRequest, execute_profile_design

    if profile is not None or drop_tolerance is not None:
        excluded = {"--change": change, "--maximise": maximise, "--constraint": constraint}
        wanted = ProfileRequest(
            *(case, output, profile, drop_tolerance, minimise or (), at, over or ()),
            *(settings or (), runs, jobs, {**excluded, "--scatter": scatter}),
        )
        execute_profile_design(wanted, resume=resume, quiet=quiet)
        return
    request = DesignRequest(
        *(case, output, change or (), minimise or (), maximise or (), at),
        *(over or (), scatter or (), constraint or (), settings or (), runs, jobs),
    )
    execute_design(request, resume=resume, quiet=quiet)
