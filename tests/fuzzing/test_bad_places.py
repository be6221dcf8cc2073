"""Files that are none, names that lead elsewhere, and what grows without end, by the real command.

Each is run in a process of its own, which may take no more memory than the command announces.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from fuzzing.families import CASE, LOADED
from fuzzing.places import furnish
from fuzzing.watch import LONGEST, contents

#: Address space of the program itself with its libraries, which is more than it ever touches.
PROGRAM = 3 * 2**30

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="special files and limits are those of Linux"
)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working directory with good files and with what is none."""
    monkeypatch.chdir(furnish(tmp_path))
    (tmp_path / "good.yaml").write_text(CASE, encoding="utf-8")
    return tmp_path


def command(*arguments: str, room: int = PROGRAM) -> Any:
    """Run the command as a user does, its standard input left open and silent."""
    from fuzzing import forked  # Windows lacks what it imports

    with tempfile.TemporaryDirectory() as papers:
        done = forked.command(arguments, room, 6 * LONGEST, Path(papers))
    assert "Traceback" not in done.stderr, done.stderr
    assert "fault of viscontact" not in done.stderr, done.stderr
    return done


def _load(file: str) -> str:
    return LOADED.replace("given.csv", file)


BOMB = "\n".join(
    ["a0: &a0 [1]", *(f"a{k + 1}: &a{k + 1} [{', '.join([f'*a{k}'] * 9)}]" for k in range(30))]
)

#: By what is bad: the case file's text or name, and words of the refusal.
REFUSED = {
    "a load from a device without end": (_load("/dev/zero"), "is no file"),
    "a load from a pipe": (_load("fifo"), "is no file"),
    "a load from standard input": (_load("/dev/stdin"), "is no file"),
    "a load from a socket": (_load("socket"), "is no file"),
    "a load from the process's memory": (_load("/proc/self/mem"), "cannot read"),
    "a load from a link to itself": (_load("loop"), "load.file: "),
    "a load from 10 GB": (_load("huge.csv"), "larger than 50 MB"),
    "a load from a folder": (_load(".."), "is a directory"),
    "YAML that expands without end": (BOMB, "expands to more than"),
    "a grid of 10 GB": (CASE.replace("[16, 16]", "[16000, 16000]"), "of memory"),
    "a grid of a million millions": (CASE.replace("[16, 16]", "[1000000, 1000000]"), "of memory"),
    "1e12 steps": (CASE.replace("steps: 3", "steps: 1e12"), "steps"),
    "1e15 cycles": (
        CASE.replace(
            "kind: step, force: 4 N",
            "kind: harmonic, mean: 4 N, amplitude: 1 N, period: 1 s, cycles: 1000000000000000",
        ),
        "cycles",
    ),
    "a case of 10 GB": ("huge.yaml", "larger than 1 MB"),
    "a case from a pipe": ("fifo", "is no file"),
    "a case from a device": ("/dev/zero", "is no file"),
}


@pytest.mark.parametrize("bad", REFUSED)
def test_what_has_no_end_is_refused_by_the_command(bad: str, place: Path) -> None:
    text, why = REFUSED[bad]
    path = text
    if "\n" in text:
        path = "bad.yaml"
        (place / path).write_text(text, encoding="utf-8")
    before = contents(place)
    done = command("run", path, "-o", "ran")
    assert done.returncode == 2, done.stderr
    assert why in done.stderr
    assert contents(place) == before


def test_table_from_a_pipe_is_refused_by_the_command(place: Path) -> None:
    done = command("material", "fifo", "--data", "shear")
    assert done.returncode == 2
    assert "is no file" in done.stderr


LAWS = {
    "a series": CASE,
    "a power": re.sub(
        r"material: \{.*?\}",
        "material: {law: power-law, compliance: 1e-3 / MPa, exponent: 0.3, poisson_ratio: 0.4, "
        "reference_time: 1 s, instant: 1e-4 / MPa, data: shear}",
        CASE.replace("steps: 3", "steps: 20"),
        flags=re.DOTALL,
    ),
}
LAWS["a power in steps of its own"] = re.sub(
    r"steps: 20", "spacing: adaptive, tolerance: 1e-4", LAWS["a power"]
)


@pytest.mark.slow  # five runs by the real command
@pytest.mark.parametrize(
    ("law", "cells"),
    [*product(("a series", "a power"), (64, 400)), ("a power in steps of its own", 96)],
)
def test_run_takes_no_more_memory_than_check_announces(law: str, cells: int, place: Path) -> None:
    text = LAWS[law].replace("[16, 16]", f"[{cells}, {cells}]") + "output: {fields: all}\n"
    (place / "large.yaml").write_text(text, encoding="utf-8")
    said = command("check", "large.yaml")
    assert said.returncode == 0, said.stderr
    found = re.search(r"about ([\d.]+) (MB|GB) of [\d.]+ [MG]B free", said.stdout)
    assert found is not None, said.stdout
    announced = float(found[1]) * {"MB": 1e6, "GB": 1e9}[found[2]]
    peak = subprocess.run(
        [sys.executable, "-c", _WITH_PEAK, "run", "large.yaml", "-q"],
        capture_output=True,
        text=True,
        timeout=6 * LONGEST,
    )
    assert peak.returncode == 0, peak.stderr
    # The announcement is rounded to a megabyte; what a system counts as taken varies a little.
    assert 1024 * int(peak.stdout.split()[-2]) <= 1.05 * announced


# A process reports its own peak memory: its parent would count what it began as.
_WITH_PEAK = """
import sys
from pathlib import Path
from typing import Any
from viscontact.cli import main
code = main(sys.argv[1:])
print(*[line for line in Path("/proc/self/status").read_text().splitlines() if "VmHWM" in line])
sys.exit(code)
"""
