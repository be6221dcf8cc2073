"""Every figure draws, with units at its axes; which instants and panels it draws."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot, rcParams
from matplotlib.figure import Figure

from drawing.matplotlib.drawn_runs import (
    OF_ADHESION,
    OF_FRICTION,
    OF_PERIODS,
    drawn,
    legend_texts,
    long_contact,
    run_for,
    sphere,
)
from returned import some
from synthetic_results import gripping_sphere, maxwell_sphere, roller
from viscontact.plot import COMPARISONS, FIGURES, save_figure

__all__ = ["drawn", "long_contact", "sphere"]  # fixtures


@pytest.mark.parametrize("name", sorted(FIGURES))
def test_every_figure_of_a_sphere_draws(
    name: str,
    drawn: Callable[[str], Figure],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)
    path = tmp_path / f"{name}.png"
    save_figure(drawn(name), path)
    assert path.stat().st_size > 5000


#: What a contact that is long and at an edge changes most, by default.
LONG = {"history", "pressure-map", "pressure-profile"}


@pytest.mark.parametrize(
    "name",
    [
        name if name in LONG else pytest.param(name, marks=pytest.mark.slow)
        for name in sorted(
            set(FIGURES)
            - (OF_FRICTION | OF_PERIODS | OF_ADHESION)
            - {"pressure-radial", "exact", "leak-channel", "fluid-pressure"}
        )
    ],
)
def test_every_figure_of_a_roller_draws(name: str, long_contact: xr.Dataset) -> None:
    FIGURES[name](long_contact, times=[0.0, 1000.0]).draw_without_rendering()


#: Comparisons that put runs side by side or draw outlines, and hold no lines; and of steady motion.
SIDE_BY_SIDE = {"pressure-3d", "pressure-map", "contact-outline", "friction"}


@pytest.mark.parametrize("name", sorted(set(COMPARISONS) - SIDE_BY_SIDE))
def test_every_comparison_draws_every_run(name: str, long_contact: xr.Dataset) -> None:
    figure = COMPARISONS[name]({"straight": long_contact, "tilted": roller(tilt=0.2)})
    figure.draw_without_rendering()
    for axes in some(figure.axes):
        assert len(axes.get_lines()) == 2


@pytest.mark.parametrize("name", sorted(FIGURES))
def test_every_labelled_axis_states_its_unit(name: str, drawn: Callable[[str], Figure]) -> None:
    labels = [
        label
        for axes in drawn(name).axes
        for label in (axes.get_xlabel(), axes.get_ylabel())
        if label
    ]
    assert len(labels) >= 2
    for label in labels:
        assert label.endswith("]"), label


def test_plotting_leaves_global_settings_and_pyplots_figures_alone() -> None:
    pyplot.close("all")
    before = dict(rcParams)
    FIGURES["contact-outline"](maxwell_sphere(cells=8)).draw_without_rendering()
    assert dict(rcParams) == before
    assert not pyplot.get_fignums()


@pytest.mark.slow  # a process that imports everything
def test_importing_the_figures_leaves_global_settings_alone() -> None:
    program = (
        "import matplotlib, matplotlib.pyplot as pyplot; before = dict(matplotlib.rcParams)\n"
        "from synthetic_results import maxwell_sphere\n"
        "from viscontact.plot import FIGURES\n"
        "FIGURES['pressure-map'](maxwell_sphere(cells=24)).draw_without_rendering()\n"
        "assert dict(matplotlib.rcParams) == before and not pyplot.get_fignums()\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, cwd=Path(__file__).parents[2])


def test_legend_names_the_drawn_instant_not_the_requested_one(sphere: xr.Dataset) -> None:
    figure = FIGURES["pressure-profile"](sphere, times=[8.0])
    assert legend_texts(figure.axes[0]) == ["10 s"]


def test_fields_stored_at_chosen_instants_are_found_by_field_time(sphere: xr.Dataset) -> None:
    fields = sphere[["pressure", "gap"]].isel(time=[0, 3]).rename(time="field_time")
    thinned = xr.merge([sphere.drop_vars(["pressure", "gap", "displacement"]), fields])
    figure = FIGURES["pressure-profile"](thinned)
    assert legend_texts(figure.axes[0]) == ["0 s", "300 s"]


@pytest.mark.parametrize(
    "name",
    [
        *("pressure-map", "pressure-profile", "pressure-radial", "contact-outline"),
        *("pressure-3d", "surface-3d", "contact-area"),
    ],
)
def test_figures_of_fields_refuse_a_result_without_them(name: str) -> None:
    with pytest.raises(ValueError, match=rf"{name}: .*no pressure.*fields"):
        FIGURES[name](maxwell_sphere(cells=16, fields=False))


def test_figures_of_scalars_need_no_fields() -> None:
    bare = maxwell_sphere(cells=16, fields=False)
    for name in ("history", "creep"):
        FIGURES[name](bare).draw_without_rendering()


@pytest.mark.parametrize("times", [[np.nan], [], [0.0, np.inf]])
def test_times_that_are_no_numbers_are_refused(times: list[float], sphere: xr.Dataset) -> None:
    gripping = gripping_sphere(cells=8)
    for name in sorted(FIGURES):
        with pytest.raises(ValueError, match=r"times must be finite"):
            FIGURES[name](run_for(name, sphere, gripping), times=times)


def test_instants_without_contact_are_refused_by_name(sphere: xr.Dataset) -> None:
    apart = sphere.copy(deep=True)
    apart["pressure"][:] = 0.0
    apart["peak_pressure"][:] = 0.0
    for times in (None, [100.0]):
        with pytest.raises(ValueError, match=r"contact-outline: the bodies do not touch"):
            FIGURES["contact-outline"](apart, times=times)
