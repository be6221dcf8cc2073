"""Free memory, bound cores and mounted file systems, as the system reports them."""

from __future__ import annotations

import os
import re
from pathlib import Path

# Linux states them in files; elsewhere psutil finds them, which takes a fiftieth of the start of a
# command to import.
_MEMORY, _MOUNTS = Path("/proc/meminfo"), Path("/proc/self/mounts")
#: Blanks and others in the path of a mount, as "\040".
_ESCAPED = re.compile(r"\\([0-7]{3})")


def free_memory(table: Path = _MEMORY) -> float:
    """Memory of the machine that programs can still take [bytes]."""
    try:
        rows = (line.split() for line in table.read_text(encoding="ascii").splitlines())
        return next(1024.0 * int(row[1]) for row in rows if row[0] == "MemAvailable:")
    except (OSError, ValueError, LookupError, StopIteration):
        import psutil

        return float(psutil.virtual_memory().available)


def used_memory() -> float:
    """Memory that this process takes [bytes]."""
    import psutil

    return float(psutil.Process().memory_info().rss)


def bound_cores() -> int:
    """Number of cores to which this process is bound."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    import psutil

    process = psutil.Process()
    # macOS binds no process.
    return len(process.cpu_affinity()) if hasattr(process, "cpu_affinity") else os.cpu_count() or 1


def mounted(table: Path = _MOUNTS) -> list[tuple[str, str]]:
    """Place and kind of each mounted file system."""
    try:
        # The paths of mounts may hold other blanks and ends of lines, such as U+00A0 and U+0085.
        lines = os.fsdecode(table.read_bytes()).split("\n")
        rows = [line.split(" ") for line in lines if line]
        return [(_unescaped(place), kind) for _, place, kind, *_ in rows]
    except (OSError, ValueError):
        import psutil

        return [(each.mountpoint, each.fstype) for each in psutil.disk_partitions(all=True)]


def _unescaped(place: str) -> str:
    return _ESCAPED.sub(lambda code: chr(int(code[1], 8)), place)
