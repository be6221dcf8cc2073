"""A program that lets calls of the system fail in runs, and resumes them.

`LD_PRELOAD=LIBRARY python disk_faults.py FOLDER STRIDE [SEED]`: LIBRARY is compiled from
disk_faults.c. Each run is a process that does what ``viscontact run`` does; the n-th call of a kind
fails in it, once or from then on, with n up to the number of calls in steps of STRIDE. Prints a
line of JSON: how many calls have failed, how often the run went on, and all that was not as it
should be.
"""

from __future__ import annotations

import errno
import json
import os
import random
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import xarray as xr

from interrupted_runs import CASE
from killed_run import complete, differing, nothing, process
from viscontact.runs.directory import recorder

#: Errors of each call: 0 is a write of half of the bytes.
ERRORS = {
    "write": (errno.ENOSPC, errno.EIO, errno.EDQUOT, 0),
    "copy": (errno.ENOSPC, errno.EIO, errno.EDQUOT, 0),
    "fsync": (errno.EIO, errno.ENOSPC, errno.EDQUOT),
    "truncate": (errno.EIO, errno.EFBIG),
    "rename": (errno.EIO, errno.ENOSPC, errno.EACCES),
    "open": (errno.EIO, errno.ENOSPC, errno.EMFILE, errno.EACCES),
    "close": (errno.EIO, errno.ENOSPC, errno.EDQUOT),
}

_COUNTED = ("tried", "stopped", "ended by netCDF")


@dataclass(frozen=True)
class Fault:
    """The n-th call of a kind, which fails; later ones too if it lasts."""

    call: str
    number: int
    error: int
    lasts: bool

    @property
    def name(self) -> str:
        """Text about the fault."""
        what = errno.errorcode.get(self.error, "half written")
        return f"{self.call} {self.number} {what}{' and later' if self.lasts else ''}"

    def prepare(self, place: Path, note: Path) -> Callable[[], None]:
        """Let the fault happen in a process."""
        given = {"PLACE": place, "CALL": self.call, "NUMBER": self.number, "ERROR": self.error}
        given |= {"LASTS": int(self.lasts), "NOTE": note}

        def set_up() -> None:
            recorder.PAUSE = recorder.SHARE = 0.0
            os.environ.update({f"FAULT_{name}": str(value) for name, value in given.items()})

        return set_up


class Faults:
    """Runs with faults, and what was not as it should be."""

    def __init__(self, folder: Path) -> None:
        os.chdir(folder)
        Path("case.yaml").write_text(CASE, encoding="utf-8")
        code, said = process(nothing, "-o", "whole")
        assert code == 0, said
        with xr.open_dataset("whole/result.nc") as ds:
            self.whole = ds.load()
        self.counts: dict[str, dict[str, int]] = {}
        self.wrong: list[str] = []

    def try_one(self, fault: Fault, name: str) -> bool:
        """Run with a fault and then without; return whether the fault happened."""
        note, directory = Path("note").absolute(), Path(name)
        note.unlink(missing_ok=True)
        code, said = process(fault.prepare(directory.absolute(), note), "-o", name)
        if not note.exists():
            return False
        counts = self.counts.setdefault(fault.call, dict.fromkeys(_COUNTED, 0))
        counts["tried"] += 1
        counts["stopped"] += code > 0
        counts["ended by netCDF"] += code < 0
        wrong = self._judge_end(fault.call, directory, code, said)
        again, said_again = process(nothing, "-o", name, "--resume")
        if again:
            wrong.append(f"is not resumed: {said_again}")
        else:
            wrong += complete(directory, self.whole)
        self.wrong += [f"{fault.name}: {each}" for each in wrong]
        return True

    def _judge_end(self, call: str, directory: Path, code: int, said: str) -> list[str]:
        """What is wrong with the end of a run with a fault."""
        if code == 0:
            return complete(directory, self.whole)
        if code == -signal.SIGSEGV and call == "close":
            # netCDF does not survive that HDF5 cannot close a file; what the run has kept does.
            return differing(directory / "result.nc", self.whole) if _is_there(directory) else []
        wrong = [] if code in (1, 2) else [f"ended with {code}: {said}"]
        if "Traceback" in said or "fault of viscontact" in said:
            wrong.append(f"said {said}")
        if len(said.splitlines()) > 30 or not said:
            wrong.append(f"said {said!r}")
        if _is_there(directory):
            wrong += differing(directory / "result.nc", self.whole)
        return wrong


def _is_there(directory: Path) -> bool:
    return (directory / "result.nc").exists()


def main(folder: Path, stride: int, seed: int) -> None:
    """Try all kinds of calls."""
    made, chance = Faults(folder), random.Random(seed)
    for call, errors in ERRORS.items():
        # There are many more writes than other calls.
        step = stride if call == "write" else max(1, stride // 10)
        number = chance.randint(1, step)
        while made.try_one(
            Fault(call, number, chance.choice(errors), lasts=chance.random() < 0.5),
            f"{call}-{number}",
        ):
            number += chance.randint(1, 2 * step - 1)
    print(json.dumps({"counts": made.counts, "wrong": made.wrong}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int((*sys.argv, 1)[3]))
