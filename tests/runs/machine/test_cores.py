"""Cores by binding, control groups and SLURM."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from math import ceil
from pathlib import Path

import psutil
import pytest
from hypothesis import given
from hypothesis import strategies as st

from runs.machine.fake_system import V1, V2, system
from viscontact.runs.machine import cores
from viscontact.runs.machine.cores import usable_cores

BOUND = 16


@pytest.fixture(autouse=True)
def sixteen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A process that is bound to 16 cores."""
    monkeypatch.setattr(cores, "bound_cores", lambda: BOUND)


#: Group, mounts and files of a process, and its cores, from the kernel's documentation:
#: Documentation/admin-guide/cgroup-v2.rst (cpu.max) and Documentation/scheduler/sched-bwc.rst.
GROUPS = {
    "no limit": ("0::/job", V2, {"job/cpu.max": "max 100000"}, BOUND),
    "its own": ("0::/job", V2, {"job/cpu.max": "300000 100000"}, 3),
    "an ancestor's": (
        "0::/job/step/task",
        V2,
        {"job/cpu.max": "200000 100000", "job/step/task/cpu.max": "max 100000"},
        2,
    ),
    "the root of a container": ("0::/", V2, {"cpu.max": "50000 100000"}, 1),
    "rounded up": ("0::/", V2, {"cpu.max": "250000 100000"}, 3),
    "more than there are": ("0::/", V2, {"cpu.max": "9000000 100000"}, BOUND),
    "version 1": (
        "4:cpu,cpuacct:/slurm/job_7",
        V1,
        {
            "cpu,cpuacct/slurm/job_7/cpu.cfs_quota_us": "400000",
            "cpu,cpuacct/slurm/job_7/cpu.cfs_period_us": "100000",
        },
        4,
    ),
    "version 1, no limit": (
        "4:cpu,cpuacct:/",
        V1,
        {"cpu,cpuacct/cpu.cfs_quota_us": "-1", "cpu,cpuacct/cpu.cfs_period_us": "100000"},
        BOUND,
    ),
    "another's": ("0::/mine", V2, {"other/cpu.max": "100000 100000"}, BOUND),
    "a group that is not mounted": ("0::/../other", V2, {"cpu.max": "500000 100000"}, 5),
    "damaged": ("0::/", V2, {"cpu.max": "many few"}, BOUND),
}


@pytest.mark.parametrize(("group", "mounts", "files", "expected"), GROUPS.values(), ids=GROUPS)
def test_quota_of_a_control_group_limits_the_cores(
    group: str, mounts: str, files: dict[str, str], expected: int, tmp_path: Path
) -> None:
    assert usable_cores(system(tmp_path, group, mounts, files), {}) == expected


def test_group_of_a_container_lies_below_what_is_mounted_there(tmp_path: Path) -> None:
    # Without a namespace of its own, a container sees its group by the path on the host.
    mounts = V2.replace("0:26 / /sys", "0:26 /docker/4f /sys")
    files = {"cpu.max": "600000 100000", "inner/cpu.max": "200000 100000"}
    assert usable_cores(system(tmp_path, "0::/docker/4f", mounts, files), {}) == 6
    assert usable_cores(system(tmp_path, "0::/docker/4f/inner", mounts, files), {}) == 2


@pytest.mark.parametrize(
    ("variables", "expected"),
    [
        ({"SLURM_CPUS_PER_TASK": "2", "SLURM_CPUS_ON_NODE": "8"}, 2),
        ({"SLURM_CPUS_ON_NODE": "8"}, 8),
        ({"SLURM_CPUS_ON_NODE": "64"}, BOUND),
        ({"SLURM_CPUS_PER_TASK": ""}, BOUND),
        ({"SLURM_CPUS_PER_TASK": "4(x2)"}, BOUND),
        ({}, BOUND),
    ],
)
def test_allocation_of_slurm_limits_the_cores(
    variables: dict[str, str], expected: int, tmp_path: Path
) -> None:
    assert usable_cores(tmp_path, variables) == expected


@given(st.lists(st.integers(1, 10**7), min_size=1, max_size=4), st.integers(0, 64))
def test_cores_are_the_least_of_all_limits(quotas: list[int], allocated: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        names = ["a/" * depth for depth in range(len(quotas))]
        files = {f"{n}cpu.max": f"{q} 100000" for n, q in zip(names, quotas, strict=True)}
        root = system(Path(folder), f"0::/{names[-1]}", V2, files)
        found = usable_cores(root, {"SLURM_CPUS_PER_TASK": str(allocated)})
    assert found == min(BOUND, *(ceil(q / 1e5) for q in quotas), allocated or BOUND)


@pytest.mark.skipif(not hasattr(psutil.Process, "cpu_affinity"), reason="binds no process")
def test_process_counts_the_cores_to_which_it_is_bound() -> None:
    program = (
        "import psutil, sys\n"
        "from viscontact.runs.machine.cores import usable_cores\n"
        "psutil.Process().cpu_affinity([psutil.Process().cpu_affinity()[0]])\n"
        "print(usable_cores())"
    )
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    assert int(done.stdout) == 1
