"""Figures of all shipped examples: drawn without warnings, or refused by name."""

from __future__ import annotations

import warnings
from importlib.resources import files
from pathlib import Path

import pytest
import xarray as xr

import viscontact as vc
from campaigns import tried
from viscontact.backend.errors import AccuracyWarning
from viscontact.cli import main
from viscontact.plot import FIGURES, STEADY_FIGURES

NAMES = sorted(
    entry.name.removesuffix(".yaml")
    for entry in files("viscontact.case.examples").iterdir()
    if entry.name.endswith(".yaml")
)
#: What differs from another example by its eccentricity or its law alone is drawn in a whole
#: campaign.
LIKE_OTHERS = ["roller-as-printed-e05", "roller-as-printed-e10", "roller-dogbone-e05"]
LIKE_OTHERS += ["roller-as-printed", "roller-dogbone", "sphere-zener"]
DRAWN = [name for name in NAMES if name not in LIKE_OTHERS[tried(0, 6) :]]
#: Figures that only some bodies have, and loads: no fluid flows where a body ends on the grid.
_NOT_ALWAYS = (
    *("pressure-radial", "exact", "indenter", "area-pressure", "force-curve"),
    *("leak-channel", "leak-rate", "fluid-pressure"),
    *("fretting-loop", "slip-history", "stick-map", "traction-profile", "traction-creepage"),
)


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWN)
def test_figures_of_an_example_are_drawn_without_a_warning(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["example", name, "-o", "case.yaml"]) == 0
    case = Path("case.yaml").read_text(encoding="utf-8")
    given = "shape:" in case.partition("\ngrid:")[2]
    line = "shape: [1," in case  # a line contact
    coarse = [] if given else ["--set", "grid.tolerance=10 %"]
    if given and not line and name != "rough-ball":
        coarse = ["--set", "grid.shape=[48, 32]"]
    coarse += ["--set", "motion.speed.count=7"] if "count: 19" in case else []
    coarse += ["--set", "output.fields=all"] if "fields: none" in case else []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        assert main(["run", "case.yaml", "-q", *coarse]) == 0
    with vc.open_results("case") as results, warnings.catch_warnings():
        warnings.simplefilter("error")
        figures = FIGURES | STEADY_FIGURES if "speed" in results.dims else FIGURES
        refused = {name: said for name in figures if (said := _refusal(name, results))}
    over_time = {figure for figure, said in refused.items() if "shows a run over time" in said}
    assert set(refused) - over_time <= set(_NOT_ALWAYS)
    assert ("speed" in results.dims) == bool(over_time)
    assert all(said.startswith(f"{figure}: ") for figure, said in refused.items())


def _refusal(figure: str, results: xr.Dataset) -> str:
    """Draw a figure as wide as a column, where room is scarce; what it says if it cannot."""
    try:
        (FIGURES | STEADY_FIGURES)[figure](results, width="single").draw_without_rendering()
    except ValueError as refusal:
        return str(refusal)
    return ""
