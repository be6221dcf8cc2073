"""End of a command or of a run with an exit code."""

from __future__ import annotations

from typing import NoReturn

from viscontact.runs.processes.request import REFUSED, STOPPED


class CommandError(Exception):
    """End of a command: exit code and lines for stderr; `resumable` if its run can go on."""

    def __init__(self, code: int, lines: tuple[str, ...], *, resumable: bool = False) -> None:
        super().__init__("; ".join(lines))
        self.code, self.lines, self.resumable = code, lines, resumable


def refuse(*lines: str) -> NoReturn:
    """End the command before anything was created, with exit code 2 and the reasons."""
    raise CommandError(REFUSED, lines)


def stop(*lines: str, code: int = STOPPED, resumable: bool = False) -> NoReturn:
    """End the command during its work, with exit code 1 or another one and the reasons."""
    raise CommandError(code, lines, resumable=resumable)
