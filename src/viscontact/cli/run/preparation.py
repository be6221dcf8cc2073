"""From a case file to a run that has been checked, or a refusal."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from viscontact.case import CaseError, read_case
from viscontact.cli.terminal.messages import refuse
from viscontact.runs.preparation import Prepared, prepared


def prepare(path: Path, settings: Sequence[str], threads: int = 1) -> Prepared:
    """Read and check everything that can be checked before the first step.

    Parameters
    ----------
    path : Path
        The case file.
    settings : sequence of str
        The values of ``--set``.
    threads : int
        Threads of one Fourier transform.

    Returns
    -------
    Prepared
        Ready to run.

    Raises
    ------
    typer.Exit
        With code 2, after all problems have been printed.
    """
    try:
        return prepared(read_case(path, settings), threads)
    except CaseError as error:
        refuse(*error.problems)
