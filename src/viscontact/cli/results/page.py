"""The page of a run, written or refused in one line."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from viscontact.cli.results.stored import early_end, opened
from viscontact.cli.terminal.messages import refuse, say
from viscontact.run_files import RESULT_NAME

#: The page's name in a run directory.
PAGE_NAME = "report.html"
_NEEDED = ("matplotlib", "contourpy", "plotly")
_ENDINGS = (".html", ".htm")


def write_page(directory: Path, output: Path | None) -> Path:
    """Write the page of a run, by default report.html in its directory; return the file."""
    if output is not None and output.suffix.lower() not in _ENDINGS:
        refuse(f"{output}: a report is a page of HTML; name it so, e.g. -o {output.stem}.html")
    package = _package()
    file = output or _beside(directory)
    if not file.parent.is_dir() and output is not None:
        refuse(f"{file}: there is no directory {file.parent}")
    with opened(directory) as ds:
        if ended := early_end(ds):
            say(ended)
        try:
            package.write_report(ds, file, label=_label(directory))
        except (ValueError, OSError) as error:
            refuse(f"{file}: {error}")
    return file


def _beside(directory: Path) -> Path:
    return directory.with_suffix(".html") if _is_file(directory) else directory / PAGE_NAME


def _label(directory: Path) -> str:
    """Label of a run among others: its directory's name."""
    place = directory.resolve()
    if not _is_file(place):
        return place.name
    return place.parent.name if place.name == RESULT_NAME else place.stem


def _is_file(directory: Path) -> bool:
    return directory.suffix == ".nc" and not directory.is_dir()


def _package() -> Any:
    """Import `viscontact.report`, or refuse with the extra that it needs."""
    try:
        from viscontact import report
    except ModuleNotFoundError as error:
        if error.name not in _NEEDED:
            raise
        refuse(f"a report needs {error.name}: pip install 'viscontact[plot]'")
    return report
