"""What the system reports, read from Linux's files or by psutil."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import psutil
import pytest

from closeness import close_to
from viscontact.runs.machine.system import bound_cores, free_memory, mounted, used_memory

NOWHERE = Path("/no/such/file")


def test_free_memory_is_that_of_psutil() -> None:
    # Other programs take memory and return it between both.
    assert free_memory() == close_to(float(psutil.virtual_memory().available), rel=0.2)
    assert free_memory(NOWHERE) == close_to(free_memory(), rel=0.2)


def test_used_memory_is_positive() -> None:
    assert 1e6 < used_memory() < psutil.virtual_memory().total


def test_free_memory_is_what_linux_estimates_for_new_programs(tmp_path: Path) -> None:
    table = tmp_path / "meminfo"
    table.write_text("MemTotal: 2000 kB\nMemFree: 500 kB\nMemAvailable:    1000 kB\n")
    assert free_memory(table) == 1024e3  # proc(5): kB are kibibytes


@pytest.mark.parametrize("text", ["MemTotal: 2000 kB\n", "", "MemAvailable: many kB\n"])
def test_free_memory_without_an_estimate_of_linux_is_that_of_psutil(
    text: str, tmp_path: Path
) -> None:
    (tmp_path / "meminfo").write_text(text)
    assert free_memory(tmp_path / "meminfo") == close_to(free_memory(NOWHERE), rel=0.2)


@pytest.mark.skipif(not hasattr(psutil.Process, "cpu_affinity"), reason="binds no process")
def test_bound_cores_are_those_of_psutil() -> None:
    assert bound_cores() == len(psutil.Process().cpu_affinity())


@pytest.mark.skipif(sys.platform != "linux", reason="has no table of mounts")
def test_mounts_are_those_of_psutil() -> None:
    assert mounted()
    assert mounted() == mounted(NOWHERE)


def test_places_of_mounts_may_contain_blanks(tmp_path: Path) -> None:
    table = tmp_path / "mounts"
    table.write_text("disk /mnt/my\\040runs ext4 rw 0 0\nhost:/ /a\\134b nfs4 rw 0 0\n")
    assert mounted(table) == [("/mnt/my runs", "ext4"), ("/a\\b", "nfs4")]


@pytest.mark.parametrize("blank", [*"\u00a0\u2003\u2028\u0085\v\f\r\x1c"])
def test_places_of_mounts_may_contain_blanks_that_are_not_escaped(
    blank: str, tmp_path: Path
) -> None:
    # Linux escapes the space, tab, line feed, backslash and # alone.
    table = tmp_path / "mounts"
    lines = f"host:/ /mnt/My{blank}Disk nfs4 rw 0 0\ndisk / ext4 rw 0 0\n"
    table.write_bytes(os.fsencode(lines))
    assert mounted(table) == [(f"/mnt/My{blank}Disk", "nfs4"), ("/", "ext4")]
