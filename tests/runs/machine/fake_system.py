"""A directory that looks like the root of a Linux system with control groups."""

from __future__ import annotations

from pathlib import Path

#: Hierarchies of version 1 and of version 2, as systemd mounts them.
V1 = """\
22 1 0:21 / /proc rw,relatime - proc proc rw
33 31 0:30 / /sys/fs/cgroup/cpu,cpuacct rw,nosuid shared:10 - cgroup cgroup rw,cpu,cpuacct
35 31 0:32 / /sys/fs/cgroup/memory rw,relatime shared:14 - cgroup cgroup rw,memory
"""
V2 = """\
22 1 0:21 / /proc rw,relatime - proc proc rw
30 24 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate
"""


def system(root: Path, group: str, mounts: str, files: dict[str, str]) -> Path:
    """Write the files of a process in a control group; paths are relative to the groups' mount."""
    texts = {f"sys/fs/cgroup/{name}": text for name, text in files.items()}
    for name, text in {"proc/self/cgroup": group, "proc/self/mountinfo": mounts, **texts}.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="ascii")
    return root
