"""Request for the runs of one command: cases, varied keys and directories."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.cli.sweep.plan_options import PlanOptions
from viscontact.cli.terminal.messages import refuse
from viscontact.runs.execution.run_directory import chosen_directory
from viscontact.runs.processes.request import RunRequest, command, no_option
from viscontact.studies.sweep.designs import Design


@dataclass(frozen=True)
class PlannedRun:
    """One of several runs: its request, the design of its case, and its row there."""

    request: RunRequest
    design: Design
    row: int


@dataclass(frozen=True)
class ManyRequest:
    """Arguments of ``viscontact run`` with several cases or varied values."""

    cases: tuple[Path, ...]
    common: RunRequest  # its case is ignored, its output holds the run directories
    options: PlanOptions = field(default_factory=PlanOptions)
    jobs: int | None = None  # as many as there are cores
    scheduler: str | None = None  # of a cluster: address, file, or local
    array: Path | None = None  # script of a job array, which is written in place of the runs
    task: int | None = None  # number of the only run in a manifest, which is the case

    @property
    def is_elsewhere(self) -> bool:
        """True if the runs are computed by a scheduler, on other machines."""
        return self.scheduler not in (None, "local")

    def planned(self) -> list[PlannedRun]:
        """Return each combination of a case and a row of its design."""
        if self.common.output is None and self.options.option != "--vary":
            refuse(f"{self.options.option}: name a directory for the runs, with -o DIR")
        planned = []
        for case in self.cases:
            design = self.options.design(case, self.common.settings)
            for row in range(len(design.rows)):
                settings = (*self.common.settings, *design.settings(row))
                output = self._output(case, design.name(row))
                request = replace(self.common, case=case, output=output, settings=settings)
                planned.append(PlannedRun(request, design, row))
        return planned

    @property
    def resuming(self) -> str:
        """Command that resumes all of them, quoted for a shell."""
        return command(*self._words(), "--resume")

    def _words(self) -> Iterator[str]:
        yield from (no_option(case) for case in self.cases)
        _, *options = replace(self.common, resume=False, overwrite=False).words()
        yield from options
        yield from self.options.words()
        if self.jobs is not None:
            yield from ("-j", str(self.jobs))
        if self.scheduler is not None:
            yield from ("--scheduler", self.scheduler)

    def _output(self, case: Path, name: str) -> Path | None:
        """Directory of a run: CASE/, CASE_KEY=VALUE/ or CASE_NUMBER/."""
        if self.common.output is None and not name:
            return None
        if not case.stem:
            refuse(f"{case}: there is no name in it for a directory; give the file another one")
        beside = chosen_directory(case, None)
        parent = beside.parent if self.common.output is None else self.common.output
        return parent / "_".join(filter(None, (beside.name, name)))
