"""What `run` is asked for when it is asked for several runs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from viscontact.cli.many.variations import variations
from viscontact.cli.run.run_directory import chosen_directory
from viscontact.cli.terminal.messages import refuse
from viscontact.runs.processes.request import RunRequest, command, no_option


@dataclass(frozen=True)
class ManyRequest:
    """The words behind ``viscontact run`` with several cases, or values that are varied."""

    cases: tuple[Path, ...]
    common: RunRequest
    varied: tuple[str, ...] = ()
    jobs: int = 1

    def runs(self) -> list[RunRequest]:
        """Every run on its own."""
        found = []
        for case in self.cases:
            for variation in variations(self.varied, self.common.settings):
                settings = (*self.common.settings, *variation.settings)
                output = self._output(case, variation.name)
                found.append(replace(self.common, case=case, output=output, settings=settings))
        return found

    @property
    def resuming(self) -> str:
        """The command that goes on with all of them, to be copied into a shell.

        Examples
        --------
        >>> common = RunRequest(Path("a.yaml"), output=Path("all"))
        >>> ManyRequest((Path("a.yaml"), Path("b.yaml")), common, jobs=2).resuming
        'viscontact run a.yaml b.yaml -o all -j 2 --resume'
        """
        return command(*self._words(), "--resume")

    def _words(self) -> Iterator[str]:
        yield from (no_option(case) for case in self.cases)
        _, *options = replace(self.common, resume=False, overwrite=False).words()
        yield from options
        for text in self.varied:
            yield from ("--vary", text)
        if self.jobs != 1:
            yield from ("-j", str(self.jobs))

    def _output(self, case: Path, name: str) -> Path | None:
        """Where a run goes: CASE/ or CASE_KEY=VALUE/, beside the case or in the directory given."""
        if self.common.output is None and not name:
            return None
        if not case.stem:
            refuse(f"{case}: there is no name in it for a directory; give the file another one")
        beside = chosen_directory(case, None)
        parent = beside.parent if self.common.output is None else self.common.output
        return parent / "_".join(filter(None, (beside.name, name)))
