"""Execution of a study: what it continues, its progress, its failures, its result and report."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol, TypeVar

from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import CaseError
from viscontact.cli.studies.typed_options import as_typed
from viscontact.cli.terminal.messages import INTERRUPTED, put, refuse, say, stop
from viscontact.cli.terminal.progress import counted
from viscontact.studies.infeasible import InfeasibleError

T = TypeVar("T")

#: Report in the directory of a study.
REPORT_NAME = "report.html"
#: Lines of progress, where the most runs are known, and where their number is.
AT_MOST = "{done} runs of at most {total}, at most {left:.0f} s left"
OF_ALL = "{done} of {total} runs, about {left:.0f} s left"


class PrintedResult(Protocol):
    """Result of a study, which prints itself."""

    @property
    def notes(self) -> Sequence[str]:
        """Notes on the result."""

    def report(self, path: Path) -> None:
        """Write a page of HTML."""


@dataclass(frozen=True)
class Records:
    """Records of the runs of a study, from which it continues."""

    place: Path  # directory or file that messages name
    file: Path  # is there once a run is finished

    def refuse_begun(self, typed: Mapping[str, Any]) -> None:
        """Refuse to begin a study that has begun, unless it is resumed or overwritten."""
        has_begun, resume = self.file.exists(), typed["resume"]
        if resume and typed["overwrite"]:
            refuse("--resume continues runs and --overwrite starts them again: give one of them")
        if has_begun and not resume and not typed["overwrite"]:
            other = "" if self.place == self.file else ", or choose another directory with -o DIR"
            refuse(
                f"{self.place}: holds runs already; continue them with --resume, replace them with "
                f"--overwrite{other}"
            )
        if resume and not has_begun and not typed["quiet"]:
            say(f"{self.place}: nothing is saved there yet; starting at the beginning")


def performed(
    study: Callable[..., T], records: Records, typed: Mapping[str, Any], *, line: str = AT_MOST
) -> T:
    """Result of a study with the typed options; its failures end the command."""
    quiet: bool = typed["quiet"]
    records.refuse_begun(typed)
    try:
        with _workers(typed) as workers, counted("runs", quiet=quiet, line=line) as progress:
            return study(progress=progress, overwrite=typed["overwrite"], **workers)
    except CaseError as error:
        refuse(*(as_typed(each, typed) for each in error.problems))
    except (InfeasibleError, ConvergenceError, DomainError) as error:
        stop(str(error))
    except ValueError as error:
        refuse(*(as_typed(each, typed) for each in str(error).splitlines()))
    except (RuntimeError, OSError) as error:
        stop(f"{records.place}: {error}")
    except KeyboardInterrupt:
        if not records.file.exists():
            raise
        stop(
            f"interrupted; {records.place} keeps the finished runs",
            "continue with the same command and --resume",
            code=INTERRUPTED,
        )


@contextmanager
def _workers(typed: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Argument of a study for its workers: processes of this machine, or those of a cluster."""
    if typed["scheduler"] is None:
        yield {"workers": typed["jobs"]}
        return
    from viscontact.cli.sweep.cluster import connected
    from viscontact.studies.executors.executor_choice import number_of_workers

    count = number_of_workers(typed["jobs"])
    with connected(typed["scheduler"], count, quiet=typed["quiet"]) as client:
        yield {"client": client}


def conclude(
    found: PrintedResult, directory: Path, files: Iterable[str], lines: Iterable[str] = ()
) -> None:
    """Print a result, some lines about it, its notes, and the files in its directory."""
    put(found)
    for line in lines:
        put(line)
    for note in found.notes:
        say(f"note: {note}")
    write_report(found, directory / REPORT_NAME)
    for name in files:
        put(directory / name)


def write_report(found: PrintedResult, page: Path) -> None:
    """Write the report where the packages of figures are installed, and print its name."""
    try:
        found.report(page)
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "plotly"):
            raise
        say(f"without a report: it needs {error.name}: pip install 'viscontact[plot]'")
    except (ConvergenceError, DomainError, ValueError, OSError) as error:
        say(f"without a report: {error}")
    else:
        put(page)
