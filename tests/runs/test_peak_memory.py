"""The largest memory of a run does not grow with its output: fields are written as they come."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import viscontact as vc
from viscontact.cli import main

CASE = Path(vc.__file__).parent / "case" / "examples" / "roller-dogbone-e05.yaml"

#: Of the process itself: what its parent had before it began does not count here.
RUN = """
import sys
from pathlib import Path
from viscontact.cli import main
main(sys.argv[1:])
print(Path("/proc/self/status").read_text())
"""


def settings_of(cells: str, steps: int, *more: str) -> list[str]:
    """Words for a run that writes all its fields."""
    settings = (f"grid.shape={cells}", f"time.steps={steps}", "output.fields=all", *more)
    return [word for setting in settings for word in ("--set", setting)]


def peak_of(directory: Path, cells: str, steps: int, *more: str) -> float:
    """Largest resident set of such a run [bytes]."""
    words = ["run", str(CASE), "-q", "-o", str(directory / f"{steps}")]
    words += settings_of(cells, steps, *more)
    command = [sys.executable, "-c", RUN, *words]
    done = subprocess.run(command, check=True, text=True, capture_output=True)
    found = re.search(r"VmHWM:\s*(\d+) kB", done.stdout)
    assert found is not None, done.stdout + done.stderr
    return 1024.0 * int(found.group(1))


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks Linux for its memory")
def test_a_run_of_many_cells_and_steps_takes_300_mb_beyond_its_output(tmp_path: Path) -> None:
    bare = peak_of(tmp_path, "[128, 32]", 2)
    taken = peak_of(tmp_path, "[512, 512]", 150) - bare
    output = sum(file.stat().st_size for file in (tmp_path / "150").rglob("*") if file.is_file())
    assert output > 300e6, "the output must be large enough to be seen in the peak"
    assert taken < 300e6


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks Linux for its memory")
def test_a_run_without_mirror_images_takes_no_more_than_predicted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # The most arrays of the grid's size: nothing is halved, and all fields are written.
    sizes = "[1280, 1280]", 3, "load.eccentricity_y=0.01 mm"
    assert main(["check", str(CASE), *settings_of(*sizes)]) == 0
    forecast = re.search(r"about ([\d.]+) MB of", capsys.readouterr().out)
    assert forecast is not None
    # Where the contact covers little of the grid, the search needs less.
    assert 0.8e6 * float(forecast[1]) < peak_of(tmp_path, *sizes) < 1.01e6 * float(forecast[1])
