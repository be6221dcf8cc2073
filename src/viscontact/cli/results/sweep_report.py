"""Report on all runs of a sweep."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from viscontact.cli.terminal.messages import refuse
from viscontact.studies.sweep.filed_sweep import filed_attributes
from viscontact.studies.sweep.open_many import open_many


def write_page(package: Any, directory: Path, page: Path) -> None:
    """Write the page or PDF of a sweep by the package of reports; refuse it with a message."""
    try:
        as_pdf = page.suffix.lower() == ".pdf"
        write = package.write_sweep_pdf if as_pdf else package.write_sweep_report
        runs = open_many(directory).assign_attrs(filed_attributes(directory))
        write(runs, page, title=directory.resolve().name)
    except (ValueError, OSError) as error:
        refuse(f"{page}: {error}")
