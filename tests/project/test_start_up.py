"""What is imported before it is needed: nothing, which is what makes the start quick."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import viscontact

CASE = Path(viscontact.__file__).parent / "examples" / "roller-dogbone-e05.yaml"
# Not pydantic, which newer versions of Typer read options with.
HEAVY = ("numpy", "scipy", "xarray", "netCDF4", "pint", "matplotlib")
# a third of a second together, on a machine of 2026
SLOW_PARTS = ("scipy.interpolate", "scipy.optimize", "scipy.special", "scipy.ndimage", "xarray")


@pytest.mark.parametrize(
    ("code", "unwanted"),
    [
        ("import viscontact", (*HEAVY, "pydantic", "typer", "rich")),
        ("from viscontact.cli import main; main(['--help'])", HEAVY),
        ("from viscontact.cli import main; main(['run', '--help'])", HEAVY),
        (
            f"from viscontact.case import read_case; read_case({str(CASE)!r})",
            (*SLOW_PARTS, "pint"),
        ),
        (f"from viscontact.cli import main; main(['check', {str(CASE)!r}])", ("xarray", "pint")),
        (
            "import viscontact as vc; vc.simulate",
            ("scipy.interpolate", "scipy.optimize", "pint", "rich"),
        ),
    ],
)
def test_start_imports_nothing_it_does_not_need(code: str, unwanted: tuple[str, ...]) -> None:
    run = f"{code}\nimport sys\nsys.stderr.write(' '.join(set({unwanted}) & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True, check=True)
    assert done.stderr == ""
