"""Type checkers and editors see the public names: mypy reads scripts as users write them."""

from __future__ import annotations

import ast
import importlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import viscontact as vc

STUB = Path(vc.__file__).with_suffix(".pyi")
GALLERY = sorted((Path(__file__).parents[2] / "docs" / "gallery").glob("plot_*.py"))
# A comment at the end of a line gives the type that mypy must reveal there, or the code of the
# error that it must report. All other lines must pass.
SCRIPT = """\
import numpy as np
import viscontact as vc

ball = vc.Sphere(0.01)
law = vc.Zener.from_uniaxial(2e6, 1e6, 1e6, poisson_ratio=0.5)
rubber = vc.Material(law, poisson_ratio=0.5)
ds = vc.simulate(
    ball,
    rubber,
    vc.step(0.1),
    vc.Grid(shape=(64, 64), size=(2e-3, 2e-3)),
    times=vc.uniform_times(5.0, 20),
    fields=[0.0, 5.0],
    progress=lambda state, done, total: print(state.time, done / total),
)
vc.simulate(ball, rubber, vc.ramp(0.1, 1.0), times=[0, 1, 2], fields="none")
reveal_type(vc.simulate(ball, rubber, vc.step(0.1)))  # reveals: xarray.core.dataset.Dataset
for state in vc.march(ball, rubber, vc.step(0.1), times=np.linspace(0.0, 1.0, 5)):
    reveal_type(state)  # reveals: viscontact.mechanics.state.ContactState
    reveal_type(state.approach)  # reveals: float
reveal_type(law(1.0))  # reveals: float
reveal_type(law([1, 2]))  # reveals: numpy.ndarray[tuple[Any, ...], numpy.dtype[numpy.float64]]
reveal_type(law.complex_modulus(1.0))  # reveals: complex
reveal_type(vc.read_table("creep.csv"))  # reveals: viscontact.tables.table.Table
surface = vc.Surface(np.zeros((8, 8)), 1e-6)
reveal_type(surface)  # reveals: viscontact.bodies.surfaces.surface.Surface
reveal_type(vc.plot.pressure_map(ds, times=[5.0]))  # reveals: matplotlib.figure.Figure
reveal_type(vc.reference.hertz_sphere(10.0, 0.01, 2e9).approach)  # reveals: float
vc.save(ds, "result.nc")
reveal_type(vc.open_results("result.nc"))  # reveals: xarray.core.dataset.Dataset

vc.Spere(1.0)  # error: attr-defined
vc.plot.presure_map(ds)  # error: attr-defined
vc.Sphere("5 mm")  # error: arg-type
vc.simulate(ball, rubber, 0.1)  # error: arg-type
vc.simulate(ball, rubber, vc.step(0.1), nonsense=3)  # error: call-arg
vc.simulate(ball, rubber, vc.step(0.1), fields="al")  # error: arg-type
vc.Revolved([0, 1e-3], [0, 1e-4], interpolation="cubic")  # error: arg-type
law("1 s")  # error: arg-type
"""


def checked(*files: Path, cache: Path) -> set[tuple[str, int, str]]:
    """Return what mypy finds: file, line, and the error's code or the revealed type."""
    above = STUB.parents[1]
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--output=json"]
    done = subprocess.run(
        [*command, "--follow-imports=silent", f"--cache-dir={cache}", *map(str, files)],
        env=os.environ | {"MYPYPATH": "" if above.name == "site-packages" else str(above)},
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    assert done.stderr == ""
    found = set()
    for message in map(json.loads, done.stdout.splitlines()):
        revealed = re.fullmatch('Revealed type is "(.+)"', message["message"])
        if revealed or message["severity"] == "error":
            what = revealed[1] if revealed else message["code"]
            found.add((Path(message["file"]).name, message["line"], what))
    return found


@pytest.mark.slow
def test_mypy_accepts_correct_scripts_and_refuses_wrong_ones(
    tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    pytest.importorskip("mypy")
    script = tmp_path / "script.py"
    script.write_text(SCRIPT, encoding="utf-8")
    marks = [re.search(r"  # (?:reveals|error): (.+)", line) for line in SCRIPT.splitlines()]
    expected = {("script.py", n, mark[1]) for n, mark in enumerate(marks, 1) if mark}
    # Kept between test runs: the first one reads the types of NumPy, xarray and Matplotlib as well.
    cache = request.config.cache.mkdir("mypy")
    assert checked(script, *GALLERY, cache=cache) == expected


def test_the_stub_names_every_public_name_and_where_it_comes_from() -> None:
    named = {"__version__"}
    for statement in ast.parse(STUB.read_text(encoding="ascii")).body:
        if not isinstance(statement, ast.ImportFrom):
            continue
        for alias in statement.names:
            assert alias.asname == alias.name, "type checkers export `import x as x` only"
            module = importlib.import_module(f"viscontact.{statement.module or alias.name}")
            imported = getattr(module, alias.name) if statement.module else module
            assert getattr(vc, alias.name) is imported
            named.add(alias.name)
    assert sorted(named) == sorted(vc.__all__)
