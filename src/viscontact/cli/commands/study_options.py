"""Options that several commands share."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any

from viscontact.cli.declared import argument, option

CaseFile = Annotated[Path, argument(metavar="CASE.yaml", help="Case file.")]
Settings = Annotated[
    list[str] | None,
    option("--set", metavar="KEY=VALUE", help="Replace a value, e.g. load.force=20kN."),
]
StudyDirectory = Annotated[
    Path, option("-o", "--output", metavar="DIR", help="Directory of the study.")
]
Instant = Annotated[
    str,
    option(
        "--at",
        metavar="worst|end|TIME|SPEED",
        help="Instant of the scalars: their worst value, the last one, or a time; in steady motion "
        "a speed.",
    ),
]


def jobs(panel: str | None = None) -> Any:
    """Option of the number of parallel runs, in a panel of the help."""
    words = "Number of runs at the same time; by default that of the cores."
    return option("-j", "--jobs", min=1, metavar="N", help=words, panel=panel)


def scheduler(panel: str | None = None) -> Any:
    """Option of a cluster that computes the runs."""
    words = (
        "Compute the runs on a Dask cluster: the address or the file of its scheduler; local "
        "starts -j N workers here."
    )
    where = "ADDRESS|FILE|local"
    return option("--scheduler", metavar=where, help=words, panel=panel)


def runs(words: str, panel: str | None = None) -> Any:
    """Option of the budget of runs."""
    return option("--runs", min=1, metavar="N", help=words, panel=panel)


def resume(words: str = "Continue what DIR holds.", panel: str | None = None) -> Any:
    """Option to continue."""
    return option("--resume", help=words, panel=panel)


def overwrite(words: str, panel: str | None = None) -> Any:
    """Option to begin again."""
    return option("--overwrite", help=words, panel=panel)


def quiet(words: str = "Print the result only.", panel: str | None = None) -> Any:
    """Option without messages."""
    return option("--quiet", "-q", help=words, panel=panel)


Overwrite = Annotated[bool, overwrite("Replace the result that DIR holds.")]
Scheduler = Annotated[str | None, scheduler()]
Jobs = Annotated[int | None, jobs()]
Resume = Annotated[bool, resume()]
Quiet = Annotated[bool, quiet()]
QuietRun = Annotated[bool, quiet("Print errors only.")]


def _of_all_studies(
    case: CaseFile,
    output: StudyDirectory,
    *,
    settings: Settings = None,
    jobs: Jobs = None,
    scheduler: Scheduler = None,
    resume: Resume = False,
    overwrite: Overwrite = False,
    quiet: Quiet = False,
) -> None:
    """Options of every command of a study, those without a name before its own ones."""


def study(module: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Command of a study by its own options; the function `execute` of a module takes all."""

    def command(own: Callable[..., None]) -> Callable[..., None]:
        @wraps(own)
        def typed(**options: Any) -> None:
            import_module(module).execute(options)

        shared, others = (
            inspect.signature(each, eval_str=True).parameters.values()
            for each in (_of_all_studies, own)
        )
        first = [each for each in shared if each.kind is not each.KEYWORD_ONLY]
        last = [each for each in shared if each.kind is each.KEYWORD_ONLY]
        options = [each.replace(kind=each.KEYWORD_ONLY) for each in (*first, *others, *last)]
        typed.__signature__ = inspect.Signature(options)  # type: ignore[attr-defined]
        return typed

    return command
