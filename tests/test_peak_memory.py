"""The largest memory of a run does not grow with its output: fields are written as they come."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import viscontact as vc

CASE = Path(vc.__file__).parent / "examples" / "roller-dogbone-e05.yaml"

#: Of the process itself: what its parent had before it began does not count here.
RUN = """
import sys
from pathlib import Path
from viscontact.cli import main
main(sys.argv[1:])
print(Path("/proc/self/status").read_text())
"""


def peak_of(directory: Path, cells: str, steps: int) -> float:
    """Largest resident set of a run that writes all its fields [bytes]."""
    words = ["run", str(CASE), "-q", "-o", str(directory / f"{steps}")]
    for setting in (f"grid.shape={cells}", f"time.steps={steps}", "output.fields=all"):
        words += ["--set", setting]
    command = [sys.executable, "-c", RUN, *words]
    done = subprocess.run(command, check=True, text=True, capture_output=True)
    found = re.search(r"VmHWM:\s*(\d+) kB", done.stdout)
    assert found is not None, done.stdout + done.stderr
    return 1024.0 * int(found.group(1))


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks Linux for its memory")
def test_a_run_of_many_cells_and_steps_takes_300_mb_beyond_its_output(tmp_path: Path) -> None:
    bare = peak_of(tmp_path, "[128, 32]", 2)
    taken = peak_of(tmp_path, "[512, 512]", 120) - bare
    output = sum(file.stat().st_size for file in (tmp_path / "120").rglob("*") if file.is_file())
    assert output > 300e6, "the output would have to be held to be told from what is not"
    assert taken < 300e6
