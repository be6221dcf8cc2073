"""`status` and `collect`: the runs of a sweep."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from viscontact.cli.commands.study_options import QuietRun
from viscontact.cli.declared import argument, option

SweepDirectory = Annotated[
    Path, argument(metavar="DIR", help="Directory of a sweep, which holds runs.jsonl.")
]


def status(
    directory: Annotated[
        Path, argument(metavar="DIR", help="Directory of a sweep, or of a single run.")
    ],
    watch: Annotated[
        bool, option("--watch", help="Renew the lines until all runs have ended.")
    ] = False,
) -> None:
    """Print how many runs of a sweep are done, running, waiting, stopped or failed."""
    from viscontact.cli.sweep.status import print_status

    print_status(directory, watch=watch)


def collect(
    directory: SweepDirectory,
    output: Annotated[
        Path,
        option(
            "-o",
            "--output",
            metavar="FILE.nc",
            help="netCDF file with the scalars of all runs over time, or CSV or XLSX file "
            "with a row for each run.",
        ),
    ],
    fields: Annotated[
        bool, option("--fields", help="Write the fields, too, if all runs have one grid.")
    ] = False,
    quiet: QuietRun = False,
) -> None:
    """Write the results of all runs of a sweep to one file."""
    from viscontact.cli.sweep.collect import collect_results

    collect_results(directory, output, fields=fields, quiet=quiet)
