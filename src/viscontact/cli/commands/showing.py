"""`show`, `export`, `report` and `verify`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from viscontact.cli.quick_imports import quick_imports
from viscontact.cli.terminal.messages import refuse, say
from viscontact.run_files import MANIFEST_NAME, RESULT_NAME

RunDirectory = Annotated[
    Path, typer.Argument(metavar="DIR", help="Run directory, or its .nc file.")
]


def show(
    directory: RunDirectory,
    everything: Annotated[bool, typer.Option("--all", help="Print every instant.")] = False,
    errors: Annotated[
        bool, typer.Option("--errors", help="Print the error below each number.")
    ] = False,
) -> None:
    """Print the history of a run as a table."""
    with quick_imports():
        from viscontact.cli.results.history_table import print_history
        from viscontact.cli.results.stored import opened_history

    with opened_history(directory) as found:
        print_history(found, directory, everything=everything, errors=errors)


def export(
    directory: RunDirectory,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE.csv", help="CSV or XLSX file; CSV on stdout by default."
        ),
    ] = None,
    point: Annotated[
        list[str] | None,
        typer.Option(
            "--point",
            metavar="X,Y",
            help="Add the pressure at a point, e.g. '1 mm,0 mm', at the stored instants; repeated.",
        ),
    ] = None,
) -> None:
    """Write the history of a run as CSV or XLSX, in SI units."""
    from viscontact.cli.results.history_file import write_table
    from viscontact.cli.results.stored import opened

    if output is not None and output.suffix.lower() in (".nc", ".xls", ".ods"):
        refuse(f"{output}: name a CSV or an XLSX file, e.g. -o history.csv or -o history.xlsx")
    with opened(directory) as ds:
        write_table(ds, output, point or ())


def report(
    directory: Annotated[
        Path, typer.Argument(metavar="DIR", help="Run directory, its .nc file, or a sweep.")
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            *("-o", "--output"),
            metavar="OUT.html",
            help="Page, or a PDF by its suffix; by default report.html in DIR.",
        ),
    ] = None,
) -> None:
    """Write a report on a run, or on all runs of a sweep, as one HTML page or as PDF."""
    from viscontact.cli.results.stored import early_end, opened
    from viscontact.cli.results.sweep_report import write_page

    if output is not None and output.suffix.lower() not in (".html", ".htm", ".pdf"):
        stem = output.stem
        refuse(f"{output}: a report is a page or a PDF; name it {stem}.html or {stem}.pdf")
    as_pdf = output is not None and output.suffix.lower() == ".pdf"
    package = _pdf_package() if as_pdf else _report_package()
    is_file = directory.suffix == ".nc" and not directory.is_dir()
    page = output or (directory.with_suffix(".html") if is_file else directory / "report.html")
    if output is not None and not page.parent.is_dir():
        refuse(f"{page}: there is no directory {page.parent}")
    if (directory / MANIFEST_NAME).is_file():
        write_page(package, directory, page)
        print(page)
        return
    with opened(directory) as ds:
        if ended := early_end(ds):
            say(ended)
        try:
            write = package.write_pdf if as_pdf else package.write_report
            write(ds, page, label=_run_label(directory.resolve()))
        except (ValueError, OSError) as error:
            refuse(f"{page}: {error}")
    print(page)


def verify(
    fast: Annotated[
        bool, typer.Option("--fast", help="Coarse meshes only: half a minute instead of minutes.")
    ] = False,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE.md", help="Write the table: .md or .csv."),
    ] = None,
) -> None:
    """Compare with exact solutions: case, reference, ours, error, observed order."""
    from viscontact.cli.results.verification_table import print_verification

    print_verification(fast=fast, output=output)


def _report_package() -> Any:
    """Return `viscontact.report`, or name the missing package."""
    try:
        from viscontact import report as package
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "contourpy", "plotly"):
            raise
        refuse(f"a report needs {error.name}: pip install 'viscontact[plot]'")
    return package


def _pdf_package() -> Any:
    """Return `viscontact.report.pdf`, or name the missing package."""
    _report_package()
    try:
        from viscontact.report import pdf as package
    except ModuleNotFoundError as error:
        if error.name != "typst":
            raise
        refuse("a PDF needs typst: pip install 'viscontact[pdf]'")
    return package


def _run_label(place: Path) -> str:
    """Name of a run's directory, or of a file that is not in a run directory."""
    if place.is_dir() or place.suffix != ".nc":
        return place.name
    return place.parent.name if place.name == RESULT_NAME else place.stem
