"""Leases of other processes: one that holds its own, and one that has ended."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory.lease_file import header

#: Duration of the leases here [s].
SHORT = 0.6
#: A machine that is not this one.
ELSEWHERE = "0000-boot pid:[1] 77"
HOLDER = """
import sys
from pathlib import Path
from viscontact.runs.directory.lease import Lease
with Lease(Path(sys.argv[1]), float(sys.argv[2])) as lease:
    print("leased", flush=True)
    sys.stdin.readline()
    lease.check()
"""


@contextmanager
def holder(directory: Path, duration: float = SHORT) -> Iterator[subprocess.Popen[str]]:
    """Another process that holds the lease of a directory, and releases it on request."""
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(directory), str(duration)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == "leased\n"
        try:
            yield process
        finally:
            process.kill()


def left(directory: Path, token: str, mark: str = ELSEWHERE, duration: float = SHORT) -> str:
    """Write the lease of a process that has ended, and return its name."""
    text = header(token, "4711 on node7", duration).splitlines()
    text[3] = mark
    (directory / LOCK_NAME).write_text("\n".join([*text, "000000000007\n"]), encoding="ascii")
    return f"{LOCK_NAME}.{token}"


def names(directory: Path) -> list[str]:
    return sorted(path.name for path in directory.iterdir())
