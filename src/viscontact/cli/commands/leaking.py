"""`leakage`: flow of a fluid through the gap of a contact."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from viscontact.cli.commands.showing import RunDirectory
from viscontact.cli.declared import option

Viscosity = Annotated[
    str | None,
    option("--viscosity", metavar="ETA", help="Of the fluid, e.g. '1 mPa s'."),
]
Difference = Annotated[
    str | None,
    option("--pressure-difference", metavar="DP", help="Across the seal, e.g. '1 bar'."),
]
Along = Annotated[
    str | None,
    option("--along", metavar="x|y|both", help="Direction of the flow, by default x."),
]
Ends = Annotated[
    str | None,
    option(
        "--ends",
        metavar="period|pressure",
        help="By default the period, if the grid has one along the flow.",
    ),
]
Length = Annotated[
    str | None,
    option("--length", metavar="L", help="Of the seal along the flow, e.g. '2 mm'."),
]
Width = Annotated[
    str | None,
    option("--width", metavar="W", help="Of the seal across the flow, e.g. '300 mm'."),
]
Gas = Annotated[
    str | None,
    option("--gas", metavar="P", help="Absolute pressure at the outlet of a gas: '1 bar'."),
]
Written = Annotated[
    Path | None,
    option("-o", "--output", metavar="FILE", help="Table (.csv) or figure (.png, .pdf)."),
]


def leakage(
    directory: RunDirectory,
    viscosity: Viscosity = None,
    pressure_difference: Difference = None,
    along: Along = None,
    ends: Ends = None,
    length: Length = None,
    width: Width = None,
    gas: Gas = None,
    output: Written = None,
) -> None:
    """Find how much fluid leaks through the gap of a run, at its stored instants.

    The widest channel and its narrowest place, the transmissivity of the gap, and the leak rate
    with a pressure difference. Without a channel nothing leaks. What is left out is taken from the
    section `leakage` of the case, if it has one. The figure is the leak rate over
    time; `viscontact plot DIR leak-channel` shows the channel.
    """
    from viscontact.cli.results.leakage import print_leakage

    texts = {
        "viscosity": viscosity,
        "pressure_difference": pressure_difference,
        "length": length,
        "width": width,
        "gas": gas,
        "along": along,
        "ends": ends,
    }
    print_leakage(directory, texts, output)
