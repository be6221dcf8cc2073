"""First use of the libraries of the page, at its start."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Sphere
from viscontact.bodies.laws import Zener
from viscontact.bodies.loads import step
from viscontact.bodies.materials.material import Material
from viscontact.report.run_data import run_data
from viscontact.results.netcdf import open_results, save
from viscontact.results.summary import summary_rows
from viscontact.runs.single import simulate
from viscontact.units.systems import AUTOMATIC
from viscontact.web.runs.run_figures import look_of, run_figures


def use_first() -> None:
    """Compute and draw a small contact, as what the first use imports or makes takes a second."""
    material = Material(Zener(1e9, 1e9, 1e9), poisson_ratio=0.4)
    grid = Grid((48, 48), (0.6e-3, 0.6e-3))
    ds = simulate(Sphere(0.01), material, step(5.0), grid, [0.0, 0.05, 0.1], errors=False)
    with TemporaryDirectory() as folder:
        save(ds, Path(folder) / "run.nc")
        with open_results(Path(folder) / "run.nc") as read:
            run_data(read)
            summary_rows(read)
            run_figures(read, look_of(AUTOMATIC, dark=False))
