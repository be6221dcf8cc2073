"""Free memory by machine, control groups and SLURM."""

from __future__ import annotations

from pathlib import Path

import psutil
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from runs.machine.fake_system import V1, V2, system
from viscontact.runs.machine.memory import available_memory

FREE = 64e9


@pytest.fixture(autouse=True)
def machine(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine with 64 GB of free memory."""
    monkeypatch.setattr("viscontact.runs.machine.memory.free_memory", lambda: FREE)


#: Group, mounts and files of a process, and the memory that it has left [bytes]; the names are
#: those of admin-guide/cgroup-v2.rst and admin-guide/cgroup-v1/memory.rst of the kernel's manual.
GROUPS = {
    "no limit": ("0::/job", V2, {"job/memory.max": "max", "job/memory.current": "7"}, FREE),
    "its own": (
        "0::/job",
        V2,
        {"job/memory.max": "8000000000", "job/memory.current": "3000000000"},
        5e9,
    ),
    "an ancestor's": (
        "0::/job/step",
        V2,
        {
            "job/memory.max": "4000000000",
            "job/memory.current": "1000000000",
            "job/step/memory.max": "max",
            "job/step/memory.current": "1000000000",
        },
        3e9,
    ),
    "cached files count as free": (
        "0::/job",
        V2,
        {
            "job/memory.max": "4000000000",
            "job/memory.current": "3500000000",
            "job/memory.stat": "anon 500000000\nfile 3000000000\ninactive_file 2500000000\n",
        },
        3e9,
    ),
    "version 1": (
        "9:name=systemd:/\n4:memory:/slurm/job_7",
        V1,
        {
            "memory/slurm/job_7/memory.limit_in_bytes": "2000000000",
            "memory/slurm/job_7/memory.usage_in_bytes": "1500000000",
            "memory/slurm/job_7/memory.stat": "inactive_file 1\ntotal_inactive_file 100000000\n",
        },
        0.6e9,
    ),
    "version 1, no limit": (
        "4:memory:/",
        V1,
        {
            "memory/memory.limit_in_bytes": "9223372036854771712",
            "memory/memory.usage_in_bytes": "5000000000",
        },
        FREE,
    ),
    "used up": ("0::/", V2, {"memory.max": "1000", "memory.current": "2000"}, 0.0),
}


@pytest.mark.parametrize(("group", "mounts", "files", "expected"), GROUPS.values(), ids=GROUPS)
def test_control_group_limits_the_memory(
    group: str, mounts: str, files: dict[str, str], expected: float, tmp_path: Path
) -> None:
    assert available_memory(system(tmp_path, group, mounts, files), {}) == expected


@pytest.mark.parametrize(
    ("variables", "allocated"),
    [
        ({"SLURM_MEM_PER_NODE": "4096"}, 4 * 2**30),
        ({"SLURM_MEM_PER_CPU": "2048", "SLURM_CPUS_ON_NODE": "4"}, 8 * 2**30),
        ({"SLURM_MEM_PER_NODE": "0"}, None),  # all memory of the node
        ({"SLURM_MEM_PER_CPU": "2048"}, None),
        ({"SLURM_MEM_PER_NODE": "plenty"}, None),
    ],
)
def test_allocation_of_slurm_limits_the_memory(
    variables: dict[str, str], allocated: int | None, tmp_path: Path
) -> None:
    used = psutil.Process().memory_info().rss
    expected = FREE if allocated is None else allocated - used
    assert available_memory(tmp_path, variables) == close_to(expected, abs=0.2 * used)


@given(st.integers(0, 2**40), st.integers(0, 2**40))
def test_memory_is_never_negative_nor_more_than_the_machine_has(limit: int, used: int) -> None:
    with pytest.MonkeyPatch.context() as patched:
        reads = {"memory.max": float(limit), "memory.current": float(used)}
        patched.setattr(
            "viscontact.runs.machine.memory.number_in", lambda file: reads.get(file.name)
        )
        patched.setattr(
            "viscontact.runs.machine.memory.control_groups", lambda *_: [Path("nowhere")]
        )
        assert available_memory(environment={}) == max(0, min(FREE, limit - used))
