"""Reports on a run, or on all runs of a sweep."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from viscontact.cli.results.stored import checked_result, early_end
from viscontact.cli.terminal.messages import refuse, say
from viscontact.results.run_files import MANIFEST_NAME, RESULT_NAME

if TYPE_CHECKING:
    import xarray as xr


def write_report(directory: Path, output: Path | None, creepage: str | None = None) -> Path:
    """Write a page or, by its suffix, a PDF; return its path."""
    if output is not None and output.suffix.lower() not in (".html", ".htm", ".pdf"):
        stem = output.stem
        refuse(f"{output}: a report is a page or a PDF; name it {stem}.html or {stem}.pdf")
    as_pdf = output is not None and output.suffix.lower() == ".pdf"
    package = _pdf_package() if as_pdf else _report_package()
    is_file = directory.suffix == ".nc" and not directory.is_dir()
    page = output or (directory.with_suffix(".html") if is_file else directory / "report.html")
    if output is not None and not page.parent.is_dir():
        refuse(f"{page}: there is no directory {page.parent}")
    kind = "pdf" if as_pdf else "report"
    try:
        if (directory / MANIFEST_NAME).is_file():
            if creepage is not None:
                refuse("--creepage: applies to the report on one run; leave it out")
            write = getattr(package, f"write_sweep_{kind}")
            write(_joined(directory), page, title=directory.resolve().name)
            return page
        with checked_result(directory, creepage) as ds:
            if ended := early_end(ds):
                say(ended)
            getattr(package, f"write_{kind}")(ds, page, label=_run_label(directory.resolve()))
    except (ValueError, OSError) as error:
        refuse(f"{page}: {error}")
    return page


def _joined(directory: Path) -> xr.Dataset:
    """Joint result of a sweep."""
    from viscontact.studies.sweep.filed_sweep import filed_attributes
    from viscontact.studies.sweep.open_many import open_many

    return open_many(directory).assign_attrs(filed_attributes(directory))


def _report_package() -> Any:
    """Return `viscontact.report`, or name the missing package."""
    try:
        from viscontact import report as package

        _ = package.write_report  # imports what it needs, which is named if it is missing
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "plotly"):
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
