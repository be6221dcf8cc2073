"""`design`: values of a case for the best scalar."""

from __future__ import annotations

from typing import Annotated

from viscontact.cli.commands import study_options
from viscontact.cli.commands.study_options import Instant
from viscontact.cli.declared import option

Changes = Annotated[
    list[str] | None,
    option(
        "--change",
        metavar="KEY=LOW:HIGH[:log]",
        help="Range of a parameter, e.g. indenter.radius='5 mm:50 mm:log', or its values, "
        "KEY=A,B,...; repeated for each parameter.",
    ),
]
Scenarios = Annotated[
    list[str] | None,
    option(
        "--over",
        metavar="KEY=VALUE,VALUE,...",
        help="Scenarios, of which the worst one counts, e.g. load.eccentricity_x='0 mm,5 mm'.",
    ),
]
Scatter = Annotated[
    list[str] | None,
    option(
        "--scatter",
        metavar="KEY=LOW:HIGH",
        help="Scatter, of which the worst corner counts: values, e.g. "
        "load.force='9 N:11 N' or '10 N ± 1 N', or deviations of a changed parameter, e.g. "
        "indenter.radius='-2 mm:2 mm' or '± 2 mm'.",
    ),
]
Constraints = Annotated[
    list[str] | None,
    option(
        "--constraint",
        metavar="SCALAR<=VALUE",
        help="Bound that is to be kept at all instants, e.g. 'contact_length<=18mm', or with >=.",
    ),
]
ClearOfEnds = Annotated[
    bool,
    option(
        "--clear-of-ends",
        help="Leave out trials whose contact reaches a sharp end of the body at any instant.",
    ),
]
Minimised = Annotated[
    list[str] | None,
    option(
        "--minimise",
        metavar="SCALAR|KEY",
        help="Scalar to make least, as peak_pressure, or a parameter of --change, as "
        "material.layers[1].thickness; two or three give a trade-off.",
    ),
]
Maximised = Annotated[
    list[str] | None,
    option("--maximise", metavar="SCALAR|KEY", help="Make largest, likewise."),
]
Profile = Annotated[
    str | None,
    option(
        "--profile",
        metavar="free[:KNOTS][:asymmetric]",
        help="Find the drop curve of a roller for the least peak pressure, in place of --change; "
        "DIR gets profile.csv and profile.dxf, too.",
    ),
]
DropTolerance = Annotated[
    str | None,
    option(
        "--drop-tolerance",
        metavar="LENGTH",
        help="Production tolerance of the drop, to either side, e.g. '1 um'; the worst profile "
        "within it counts.",
    ),
]
Runs = Annotated[
    int | None,
    study_options.runs(
        "Most runs; by default 60, several times as many for a trade-off, and 2000 for a profile."
    ),
]


@study_options.study("viscontact.cli.studies.design")
def design(
    change: Changes = None,
    minimise: Minimised = None,
    maximise: Maximised = None,
    at: Instant = "worst",
    over: Scenarios = None,
    scatter: Scatter = None,
    profile: Profile = None,
    drop_tolerance: DropTolerance = None,
    constraint: Constraints = None,
    clear_of_ends: ClearOfEnds = False,
    runs: Runs = None,
) -> None:
    """Find the values of a case for which a scalar, or one of them, is least or largest.

    The search begins on coarse cells; the best trials are computed on the cells of the case. DIR
    gets best.yaml, trials.nc and report.html. With --profile free, the drop curve of a roller is
    found.
    """
