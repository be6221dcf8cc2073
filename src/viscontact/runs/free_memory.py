"""Free memory of the machine, or of the container."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path


def available_memory() -> float:
    """Memory that is free for a program [bytes]; infinity where the system does not report it.

    >>> available_memory() > 1e6
    True
    """
    readers = {"linux": _linux_memory, "win32": _windows_memory}
    try:
        return readers.get(sys.platform, _physical_memory)()
    except (OSError, ValueError, AttributeError, StopIteration):
        return float("inf")


def _linux_memory() -> float:
    lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
    free = next(1024.0 * int(line.split()[1]) for line in lines if line.startswith("MemAvailable"))
    return min(free, _container_memory())


def _container_memory() -> float:
    """Memory left by the control group of the process [bytes]; infinity without a limit."""
    group = Path("/sys/fs/cgroup")
    try:
        limit = (group / "memory.max").read_text(encoding="ascii").strip()
        used = int((group / "memory.current").read_text(encoding="ascii"))
    except (OSError, ValueError):
        return float("inf")
    return float("inf") if limit == "max" else float(int(limit) - used)


def _physical_memory() -> float:
    return float(os.sysconf("SC_PAGE_SIZE")) * float(os.sysconf("SC_PHYS_PAGES"))


def _windows_memory() -> float:
    if sys.platform != "win32":  # where the rest does not exist, for type checkers either
        raise OSError("only Windows reports its memory in this way")

    class Status(ctypes.Structure):
        _fields_ = (
            ("length", ctypes.c_ulong),
            ("load", ctypes.c_ulong),
            *((name, ctypes.c_ulonglong) for name in ("total", "free", "t", "f", "v", "a", "x")),
        )

    status = Status(length=ctypes.sizeof(Status))
    if not ctypes.windll.kernel32.GlobalMemoryStatusEx(ctypes.byref(status)):
        raise OSError("the system does not report the free memory")
    return float(status.free)
