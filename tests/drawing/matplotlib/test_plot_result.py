"""`ds.viscontact.plot`, and requirements of journals: widths, fonts, formats."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from PIL import Image

import viscontact as vc
from closeness import close_to
from drawing.matplotlib.drawn_runs import OF_ADHESION, OF_FRICTION, OF_PERIODS
from synthetic_results import maxwell_sphere, roller
from viscontact.cli import main
from viscontact.plot import COMPARISONS, FIGURES, Animation, ResultPlots, draw_indenter, save_figure

assert vc.open_results  # from here on results have their figures


@pytest.fixture(scope="module")
def sphere() -> xr.Dataset:
    return maxwell_sphere(cells=16)


@pytest.fixture(autouse=True)
def _close_all() -> None:
    pyplot.close("all")


# --- from Python ------------------------------------------------------------------------------


def test_every_figure_has_its_method() -> None:
    methods = {name for name in vars(ResultPlots) if not name.startswith("_")} - {"result"}
    others = {"animation", "friction", "motion_profile", "traction_creepage"}  # of steady motion
    assert methods - others == {name.replace("-", "_") for name in FIGURES}


@pytest.mark.parametrize(
    ("name", "panels"),
    [
        pytest.param("pressure_map", 4, marks=pytest.mark.slow),
        ("pressure_3d", 2),
        ("history", 3),
        ("pressure_profile", 1),
    ],
)
def test_a_method_returns_the_axes_of_a_figure_that_pyplot_knows(
    name: str, panels: int, sphere: xr.Dataset
) -> None:
    axes = getattr(sphere.viscontact.plot, name)()
    first = axes if panels == 1 else axes[0]
    assert isinstance(first, Axes)
    assert np.size(axes) == panels
    assert pyplot.get_fignums() == [1]
    assert pyplot.figure(1) is first.figure
    labels = [label for each in np.ravel(axes) if (label := each.get_xlabel())]
    assert labels
    assert all(label.endswith("]") for label in labels)


def test_axes_of_ones_own_are_drawn_into_and_returned(sphere: xr.Dataset) -> None:
    figure, mine = pyplot.subplots()
    assert sphere.viscontact.plot.pressure_profile(axes=mine, times=[0.0]) is mine
    assert pyplot.get_fignums() == [figure.number]
    drawn = mine.get_lines()[0].get_ydata()
    unit = {"kPa": 1e3, "MPa": 1e6}[mine.get_ylabel()[-4:-1]]
    middle = sphere.pressure.isel(time=0, y=[7, 8]).mean("y")
    assert np.nanmax(drawn) == close_to(float(middle.max()) / unit)


def test_a_film_is_made_from_a_result(sphere: xr.Dataset) -> None:
    film = sphere.viscontact.plot.animation(seconds=1.0, fps=5.0)
    assert isinstance(film, Animation)
    assert film.instants.size == 5


def test_results_do_not_load_matplotlib_before_they_are_drawn() -> None:
    program = (
        "import sys, viscontact as vc; vc.simulate, vc.open_results\n"
        "import xarray as xr; plots = xr.Dataset().viscontact\n"
        "assert 'matplotlib' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


# --- what journals ask ------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(("width", "millimetres"), [("single", 89), ("double", 183), (0.12, 120)])
def test_a_figure_is_as_wide_as_the_column(width: str | float, millimetres: float) -> None:
    results = {"sphere": maxwell_sphere(cells=12), "roller": roller(shape=(32, 12))}
    for name in set(FIGURES) - (OF_FRICTION | OF_PERIODS | OF_ADHESION):
        figure = FIGURES[name](results["sphere"], width=width)
        assert figure.get_figwidth() * 25.4 == close_to(millimetres, abs=0.1), name
    for name in set(COMPARISONS) - {"friction"}:  # of steady motion
        figure = COMPARISONS[name]({"a": results["roller"]}, width=width)
        assert figure.get_figwidth() * 25.4 == close_to(millimetres, abs=0.1), name


@pytest.mark.parametrize("width", ["triple", 0.01, 5.0, float("nan")])
def test_a_width_that_is_none_is_refused(width: str | float, sphere: xr.Dataset) -> None:
    with pytest.raises(ValueError, match=r"'single', 'double' or from 60 mm to 1.2 m, got"):
        FIGURES["history"](sphere, width=width)


@pytest.mark.parametrize("name", ["history", pytest.param("pressure-map", marks=pytest.mark.slow)])
def test_fonts_are_embedded_whole_in_pdf(name: str, sphere: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "figure.pdf"
    save_figure(FIGURES[name](sphere), path)
    content = path.read_bytes()
    kinds = set(re.findall(rb"/Subtype /(Type0|Type1|Type3|TrueType|CIDFontType2)", content))
    # Type 42 (TrueType) as journals ask; never Type 3, which they refuse.
    assert kinds == {b"Type0", b"CIDFontType2"}
    assert b"/FontFile2" in content


def test_texts_are_outlines_in_svg(sphere: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "figure.svg"
    save_figure(FIGURES["history"](sphere), path)
    drawing = path.read_text(encoding="utf-8")
    assert "<text" not in drawing  # looks alike where the font is not installed
    assert "<use" in drawing


def test_a_picture_has_three_hundred_dots_an_inch(sphere: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "figure.png"
    save_figure(FIGURES["hysteresis"](sphere, width="single"), path)
    assert pyplot.imread(path).shape[1] == close_to(89 / 25.4 * 300, abs=1)


# --- figures of this kind ---------------------------------------------------------------------


def test_counted_area_is_that_of_the_cells_in_contact(sphere: xr.Dataset) -> None:
    axes = FIGURES["contact-area"](sphere).axes[0]
    counted, smooth = axes.get_lines()
    unit = {"mm²": 1e-6, "µm²": 1e-12}[re.search(r"\[(.*)\]", axes.get_ylabel())[1]]
    np.testing.assert_allclose(smooth.get_ydata(), sphere.contact_area / unit)
    cell = float(sphere.x[1] - sphere.x[0]) ** 2
    cells = (sphere.pressure > 0).sum(("x", "y"))
    np.testing.assert_allclose(counted.get_ydata(), cells * cell / unit)
    assert counted.get_marker() == "o"


def test_the_indenter_is_drawn_with_the_contact_found() -> None:
    results = roller(shape=(48, 16))
    sections = FIGURES["indenter"](results, times=[1000.0]).axes
    labels = sections[3].texts[0].get_text().replace("\n   ", " ")
    assert "contact at 1000 s" in labels
    body = vc.Roller(radius=5e-3, half_length=9.565e-3, crown_radius=7.5)
    expected = draw_indenter(body, (0.15, 1.5e-3)).axes[0].get_lines()[0]
    drawn = sections[0].get_lines()[0]
    # The grid's extent is read from its coordinates, which are rounded.
    np.testing.assert_allclose(drawn.get_ydata(), expected.get_ydata(), atol=1e-9)


def test_outlines_of_runs_lie_over_one_another_at_one_instant() -> None:
    runs = {"straight": roller(shape=(48, 16)), "tilted": roller(shape=(48, 16), tilt=0.2)}
    figure = COMPARISONS["contact-outline"](runs)
    axes = figure.axes[0]
    outlines = [patch for patch in axes.patches if isinstance(patch, PathPatch)]
    assert len(outlines) == 2
    for outline, run in zip(outlines, runs.values(), strict=True):
        inside = run.x.where((run.pressure[-1] > 0).any("y"), drop=True)
        box = outline.get_path().get_extents()
        cell = float(run.x[1] - run.x[0])
        assert box.x0 * 1e-3 == close_to(float(inside.min()), abs=cell)
        assert box.x1 * 1e-3 == close_to(float(inside.max()), abs=cell)
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert (names, axes.get_title(loc="left")) == (["straight", "tilted"], "t = 1000 s")
    runs["tilted"] = roller(times=(0.0, 500.0), shape=(48, 16), tilt=0.2)
    later = COMPARISONS["contact-outline"](runs)
    names = [text.get_text() for text in later.legends[0].get_texts()]
    assert names == ["straight, t = 1000 s", "tilted, t = 500 s"]
    with pytest.raises(ValueError, match="contact-outline: runs are compared at one instant"):
        COMPARISONS["contact-outline"](runs, times=[0.0, 1000.0])


def test_maps_of_runs_share_levels_and_axes() -> None:
    runs = {"straight": roller(shape=(48, 16)), "tilted": roller(shape=(48, 16), tilt=0.2)}
    first, second = COMPARISONS["pressure-map"](runs).axes[:2]
    assert first.get_title(loc="left") == "straight, t = 1000 s"
    assert second.get_title(loc="left") == "tilted, t = 1000 s"
    levels = [axes.collections[0].levels for axes in (first, second)]
    np.testing.assert_array_equal(*levels)
    assert first.get_xlim() == second.get_xlim()


@pytest.mark.parametrize(
    "words",
    [
        pytest.param(
            ["material", "pmma-paper", "-o", "it.png"], id="material", marks=pytest.mark.slow
        ),
        pytest.param(["check", "ball.yaml", "--plot", "it.png"], id="check"),
        pytest.param(["fit", "creep.csv", "--data", "shear", "-o", "it.png"], id="fit"),
    ],
)
def test_every_figure_of_the_command_line_takes_a_width(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(
        "indenter: {shape: sphere, radius: 5 mm}\n"
        "material: {law: elastic, shear_modulus: 700 MPa, poisson_ratio: 0.3}\n"
        "load: {kind: step, force: 20 N}\ntime: {end: 1 s, steps: 2}\n"
        "grid: {shape: [32, 32], size: [0.8 mm, 0.8 mm]}\n"
    )
    rows = (f"{t},{2 - np.exp(-t)}" for t in np.geomspace(0.1, 10, 12))
    Path("creep.csv").write_text("\n".join(["time [s],creep_compliance [1/GPa]", *rows]))
    assert main([*words, "--width", "single"]) == 0
    with Image.open("it.png") as picture:
        assert picture.width == round(89 / 25.4 * 300)
    capsys.readouterr()
    for wrong in ("3 m", "5 kg", "wide"):
        assert main([*words, "--width", wrong]) == 2
        assert "--width" in capsys.readouterr().err
    drawn = [word for word in words if word not in ("-o", "--plot", "it.png")]
    assert main([*drawn, "--width", "single"]) == 2
    assert capsys.readouterr().err.startswith("--width: applies to figures only; add")
