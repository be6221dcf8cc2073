"""`fit`: a law from measured values."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from viscontact.cli.commands.drawing import Width

Table = Annotated[
    Path,
    typer.Argument(metavar="FILE.csv", help="Measured values; the headings say what they are."),
]
Test = Annotated[
    str | None,
    typer.Option(
        "--data",
        metavar="TEST",
        help="shear (G, 1/G), uniaxial (E, 1/E) or deviatoric (Phi), where the headings do not "
        "say.",
    ),
]
PoissonRatio = Annotated[
    float | None, typer.Option("--poisson-ratio", metavar="NU", help="Of the body, constant.")
]
BulkModulus = Annotated[
    str | None,
    typer.Option("--bulk-modulus", metavar="K", help="Instead, elastic, such as '4 GPa'."),
]
Terms = Annotated[
    int | None,
    typer.Option("--terms", metavar="N", help="At most so many; else as few as needed."),
]
Fluid = Annotated[bool, typer.Option("--fluid", help="It flows in the end.")]
Reference = Annotated[
    str | None,
    typer.Option(
        "--reference",
        metavar="T",
        help="Temperature of the master curve, such as '23 degC'; else the set nearest 20 degC.",
    ),
]
Temperature = Annotated[
    str | None,
    typer.Option("--temperature", metavar="T", help="Print the law at this temperature instead."),
]
Body = Annotated[
    str | None,
    typer.Option(
        "--indenter",
        metavar="SHAPE",
        help="Of an indentation record: 'sphere 5 um' (radius), 'cone 70 deg' (half angle) or "
        "'punch 2 um' (radius).",
    ),
]
LawName = Annotated[
    str,
    typer.Option(
        "--law",
        metavar="LAW",
        help="Of an indentation record: elastic, maxwell, zener, burgers, creep-series, power-law "
        "or power-law-with-instant.",
    ),
]
Figure = Annotated[
    Path | None,
    typer.Option("-o", "--output", metavar="FIG.png", help="Draw it: .png, .pdf or .svg."),
]
Section = Annotated[
    Path | None,
    typer.Option("--yaml", metavar="OUT.yaml", help="Write the material section there too."),
]


def fit(
    file: Table,
    data: Test = None,
    poisson_ratio: PoissonRatio = None,
    bulk_modulus: BulkModulus = None,
    terms: Terms = None,
    fluid: Fluid = False,
    reference: Reference = None,
    temperature: Temperature = None,
    indenter: Body = None,
    law: LawName = "zener",
    output: Figure = None,
    width: Width = None,
    section: Section = None,
) -> None:
    """Fit a law to measured creep, relaxation, oscillation or indentation.

    Several temperatures in the file are joined to a master curve, and the shift factors printed.
    """
    from viscontact.cli.material.fit_options import Wishes
    from viscontact.cli.material.fit_report import report_fit
    from viscontact.cli.results.figures import chosen_width

    wishes = Wishes(
        data=data,
        poisson_ratio=poisson_ratio,
        bulk_modulus=bulk_modulus,
        terms=terms,
        fluid=fluid,
        reference=reference,
        temperature=temperature,
        indenter=indenter,
        law=law,
    )
    page = chosen_width(width, drawn=output is not None, switch="-o FIG.png")
    report_fit(file, wishes, output, section, width=page)
