"""`doctor` and `cite`: the installation, and how to cite it."""

from __future__ import annotations

from typing import Annotated

from viscontact import __version__
from viscontact.cli.declared import option
from viscontact.cli.terminal.messages import put


def doctor() -> None:
    """Print what is installed and what this machine offers, for a report of a problem."""
    import platform
    import sys

    from rich.table import Table

    from viscontact.backend.compiled import kernels
    from viscontact.backend.transforms import fastest_transforms
    from viscontact.cli.terminal.console import TextConsole
    from viscontact.runs.machine.cores import usable_cores
    from viscontact.runs.machine.memory import available_memory
    from viscontact.runs.machine.packages import packages

    rows = [
        ("viscontact", __version__),
        ("Python", f"{platform.python_version()}, {sys.executable}"),
        ("system", platform.platform()),
        ("cores", str(usable_cores())),
        ("free memory", f"{available_memory() / 1e9:.3g} GB"),
        ("Fourier transforms", fastest_transforms()),
        ("inner loops", kernels()),
    ]
    missing: dict[str, list[str]] = {}
    for package in packages():
        if package.installed is None:
            missing.setdefault(",".join(package.extras[:1]), []).append(package.name)
        extra = f" ({', '.join(package.extras)})" if package.extras else ""
        rows.append((package.name, f"{package.installed or 'not installed'}{extra}"))
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    for row in rows:
        table.add_row(*row)
    TextConsole().print(table, highlight=False)
    for extra, names in missing.items():
        wanted = f"viscontact[{extra}]" if extra else "viscontact"
        put(f"{', '.join(names)} missing; to install: pip install '{wanted}'")


def cite(
    bibtex: Annotated[bool, option("--bibtex", help="As BibTeX.")] = False,
) -> None:
    """Print how to cite the program and the paper on which it is based."""
    from viscontact.results import citation

    if bibtex:
        put(citation.bibtex(__version__))
        return
    put("\n".join(citation.citations(__version__)))
