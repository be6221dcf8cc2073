"""Study of the calculator page: a sweep or a design of one case, which makes many runs."""

from __future__ import annotations

import time as clock
from contextlib import suppress
from dataclasses import asdict
from typing import Any

from viscontact.results.run_files import MANIFEST_NAME
from viscontact.runs.directory.lock import is_locked
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.progress import RunProgress
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.journal import JOURNAL_NAME
from viscontact.studies.study_files import TRIALS_NAME
from viscontact.studies.sweep.states import State
from viscontact.studies.sweep.status import SweepStatus, sweep_status
from viscontact.web.runs.run import ManagedRun
from viscontact.web.runs.status import problems_of
from viscontact.web.workspace.folder import StudyEntry
from viscontact.web.workspace.problems import lines_of

#: Least time between two looks at the progress [s], and as a multiple of that of one look.
_PAUSE, _SHARE = 0.2, 20.0

_ITS = "their results are kept"


class SweepProgress(RunProgress):
    """Number of finished runs of a sweep, read from their directories."""

    status = SweepStatus()

    @property
    def part(self) -> float:
        """Fraction of all runs that is finished, running ones included."""
        return self.status.part if self.status.total else 0.0

    def look(self) -> None:
        """Read the states of all runs."""
        with suppress(OSError, ValueError):  # before the manifest is written, or damaged
            self.status = sweep_status(self._job.directory)
            self.instants = self.status.counts[State.DONE] + self.status.counts[State.FAILED]


class DesignProgress(RunProgress):
    """Number of finished runs of a design, the lines of its journal behind the first."""

    def look(self) -> None:
        """Count the lines."""
        with suppress(OSError):
            lines = (self._job.directory / JOURNAL_NAME).read_bytes().count(b"\n")
            self.instants = max(lines - 1, 0)


class StudyRun(ManagedRun):
    """Study with its entry, its process and its progress."""

    _looked = _took = 0.0  # instant of the latest look at the progress, and its time [s]

    @property
    def study(self) -> StudyEntry:
        """Command of the study."""
        assert self.entry.study is not None
        return self.entry.study

    @property
    def is_sweep(self) -> bool:
        """True for a sweep, false for a design."""
        return self.study.command == "run"

    @property
    def workers(self) -> int:
        """Number of runs that it computes at the same time."""
        return self.study.workers

    @property
    def has_answer(self) -> bool:
        """True if there are runs to show: some of a sweep, all of a design."""
        if self.is_sweep:
            return self.course.instants > 0
        return (self.directory / TRIALS_NAME).is_file()

    def _look(self) -> None:
        # The states of many runs are not read each time that the end of the process is awaited.
        began = clock.monotonic()
        if began - self._looked < max(_PAUSE, _SHARE * self._took):
            return
        super()._look()
        self._looked, self._took = clock.monotonic(), clock.monotonic() - began

    def _keep_pace(self) -> None:
        if self._pace is None:  # work of earlier processes is left out of the estimate
            self._pace = clock.monotonic(), self.course.part

    def _job(self, standing: RunStage) -> Job:
        entry, study = self.entry, self.study
        options = (*study.options, "-j", str(study.workers))
        request = RunRequest(
            self._folder.given(self.name),
            self.directory,
            resume=True,
            settings=entry.settings,
            command=study.command,
            options=options,
        )
        return Job(
            *(request, self.directory, self.name, standing),
            *(entry.instants, entry.end, entry.work, entry.memory),
        )

    def _new_course(self, job: Job) -> RunProgress:
        return SweepProgress(job) if self.is_sweep else DesignProgress(job)

    def _is_saved(self) -> bool:
        return (self.directory / (MANIFEST_NAME if self.is_sweep else JOURNAL_NAME)).is_file()

    def _is_in_use(self) -> bool:
        if not isinstance(self.course, SweepProgress):
            return is_locked(self.directory)
        self.course.look()
        return self.course.status.counts[State.RUNNING] > 0

    def _is_complete(self) -> bool:
        if not isinstance(self.course, SweepProgress):
            return (self.directory / TRIALS_NAME).is_file()
        status = self.course.status
        return status.total > 0 and status.counts[State.DONE] == status.total


def study_status(run: StudyRun) -> dict[str, Any]:
    """Return the status of a study, with the entries that all runs have."""
    entry, left = run.entry, run.seconds_left
    problems = problems_of(run)
    return {
        **{"id": run.name, "title": entry.title, "label": run.label},
        "quality": entry.quality,
        **{"created": entry.created, "state": entry.state, "over": run.is_over},
        **{"resumable": run.is_resumable, "stage": _stage(run), "part": round(run.part, 4)},
        **{"step": run.course.instants, "steps": entry.instants, "reached": None},
        "seconds_left": None if left is None else round(left, 1),
        "message": _message(run, [*lines_of(problems)]),
        "problems": [asdict(each) for each in problems],
        **{"warnings": [], "figures": []},
        "study": {
            **{"kind": "sweep" if run.is_sweep else "design", "keys": run.study.keys},
            "has_answer": run.has_answer,
        },
    }


def _stage(run: StudyRun) -> str:
    return "over" if run.is_over else "waiting" if run.entry.state == "waiting" else "runs"


def _message(run: StudyRun, problems: list[str]) -> str:
    made, most = run.course.instants, run.entry.instants
    of = f"{made} of {most} runs" if run.is_sweep else f"{made} runs of at most {most}"
    kept = f"after {of}; {_ITS}" if made else "before its first run; there is nothing to show yet"
    return {
        "waiting": "waiting for its turn",
        "running": of,
        "done": f"done: {made} runs",
        "cancelled": f"cancelled {kept}",
        "interrupted": f"the server was stopped {kept}",
        "failed": problems[0] if problems else "the study stopped without a message",
    }[run.entry.state]
