"""Control groups of this process on Linux, with their limits."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

#: Directory that contains `proc` and `sys`.
ROOT = Path("/")


def control_groups(controller: str, root: Path = ROOT) -> Iterator[Path]:
    """Directories of the control groups (v1, v2) of this process, its own first; empty without."""
    try:
        groups = _lines(root / "proc/self/cgroup")
        mounts = _lines(root / "proc/self/mountinfo")
    except (OSError, ValueError):
        return
    for line in groups:
        number, controllers, group = line.split(":", 2)
        is_unified = number == "0" and not controllers
        if is_unified or controller in controllers.split(","):
            wanted = "cgroup2" if is_unified else controller
            for mount, top in _mounts(mounts, wanted, root):
                yield from _with_ancestors(mount, group, top)


def number_in(file: Path) -> float | None:
    """Number in a file of a control group; None if it is missing or says ``max``."""
    try:
        return float(int(file.read_text(encoding="ascii")))
    except (OSError, ValueError):
        return None


def _lines(file: Path) -> list[str]:
    return file.read_text(encoding="utf-8").splitlines()


def _mounts(lines: list[str], wanted: str, root: Path) -> Iterator[tuple[Path, str]]:
    """Directories at which a hierarchy is mounted, each with the group that it begins with."""
    for line in lines:
        place, _, source = line.partition(" - ")
        kind, _, options = [*source.split(" ", 2), "", ""][:3]
        if kind == wanted or (kind == "cgroup" and wanted in options.split(",")):
            _, _, _, top, directory, *_ = place.split(" ")
            yield root / directory.lstrip("/"), top


def _with_ancestors(mount: Path, group: str, top: str) -> Iterator[Path]:
    """Directory of a group and its ancestors, up to the mounted one."""
    # In a container the path of the group may begin above what is mounted there.
    below = Path(group).relative_to(top) if Path(group).is_relative_to(top) else Path()
    own = mount if ".." in below.parts else mount / below
    yield own
    while own != mount:
        own = own.parent
        yield own
