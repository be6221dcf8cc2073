"""Drawings of indenters."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.cli import main
from viscontact.mechanics.problem.problem import Problem
from viscontact.plot import draw_indenter
from viscontact.runs.check_report import drawn_size
from viscontact.runs.over_time import OverTime
from viscontact.simulation.transient.setup import prepare_run

ROLLER = vc.Roller(5e-3, 6e-3, profile="logarithmic", amplitude=2e-6, end_drop=30e-6)
SIZE = (14e-3, 1e-3)


SHAPES: dict[str, tuple[vc.Indenter, tuple[float, float]]] = {
    "roller": (ROLLER, SIZE),
    "crowned": (vc.Roller(5e-3, 9.565e-3, crown_radius=75e-3), (48e-3, 3e-3)),
    "punch": (vc.FlatPunch(half_length=1e-3, half_width=5e-4), (3e-3, 3e-3)),
    "ellipsoid": (vc.Ellipsoid(3e-3, 2e-3, 1e-3).rotated(0.5), (8e-3, 6e-3)),
    "rough ball": (
        vc.Sphere(5e-3) + vc.Waviness(1e-6, wavelength_x=1e-4, wavelength_y=2e-4).shifted(x=2e-5),
        (1e-3, 1e-3),
    ),
}


def facts_of(figure: Figure) -> str:
    """The facts beside a drawing, each in a line of its own."""
    return texts(figure).replace("\n   ", " ")


def texts(figure: Figure) -> str:
    return "\n".join(text.get_text() for axes in figure.axes for text in axes.texts)


def drawn_lines(figure: Figure, panel: int) -> list[np.ndarray]:
    return [np.asarray(line.get_xydata()) for line in figure.axes[panel].lines]


@pytest.mark.parametrize(
    ("body", "size", "at"),
    [
        (ROLLER, SIZE, (0.0, 0.0)),
        (vc.Cone(1.3).shifted(1.03e-4, -2.02e-4), (1e-3, 1e-3), (1.03e-4, -2.02e-4)),
        (vc.Torus(3e-3, 1e-3), (9e-3, 9e-3), (0.0, 0.0)),
    ],
    ids=["roller", "moved cone", "ring"],
)
def test_sections_run_through_the_deepest_point_and_show_the_gap(
    body: vc.Indenter, size: tuple[float, float], at: tuple[float, float]
) -> None:
    figure = draw_indenter(body, size)
    units = {"nm": 1e-9, "µm": 1e-6, "mm": 1e-3}
    for panel in (0, 1):
        axes = figure.axes[panel]
        along, up = (
            units[re.findall(r"\[(\w+)\]", label)[0]]
            for label in (axes.get_xlabel(), axes.get_ylabel())
        )
        line = drawn_lines(figure, panel)[0] * (along, up)
        place = np.full(len(line), at[1 - panel])
        gap = body.gap(line[:, 0], place) if panel == 0 else body.gap(place, line[:, 0])
        shown = np.isfinite(line[:, 1])
        assert np.array_equal(shown, np.isfinite(gap))
        # The deepest point between the mesh's is found to 1e-6 of its step.
        assert line[shown, 1] == close_to(gap[shown], rel=1e-5, abs=1e-12)
        assert line[shown, 1].min() < 1e-3 * line[shown, 1].max()


def test_ends_of_the_profile_are_marked_and_noted() -> None:
    figure = draw_indenter(ROLLER, SIZE)
    dashed = [line[0, 0] for line in drawn_lines(figure, 0)[2:]]
    assert dashed == close_to([-6.0, 6.0], rel=1e-12)
    said = facts_of(figure)
    assert said.startswith("Roller, logarithmic profile, radius 5 mm, half length 6 mm, amplitude")
    assert "dashed: ends at x = ±6 mm\n" in said
    assert "continues beyond the drawing along y" in said
    assert "profile drop at the ends: 30 µm" in said


def test_drop_is_noted_at_the_ends_of_the_drawing_or_before_it_is_unbounded() -> None:
    crowned = vc.Roller(5e-3, 9.565e-3, crown_radius=75e-3)
    drop = 75e-3 - math.sqrt(75e-3**2 - (20e-3 - 9.565e-3) ** 2)
    said = facts_of(draw_indenter(crowned, (40e-3, 3e-3)))
    assert f"profile drop at x = ±20 mm: {1e6 * drop:.0f} µm" in said
    endless = vc.Roller(5e-3, 6e-3, profile="logarithmic", amplitude=2e-6)
    said = facts_of(draw_indenter(endless, SIZE))
    # 2 µm times the logarithm of 1/(1 - 0.9²)
    assert f"profile drop at x = ±5.4 mm: {-2 * math.log(1 - 0.81):.2f} µm" in said


@pytest.mark.parametrize(
    ("name", "width"),
    [
        *(("rough ball", "single"), ("roller", "double")),
        *(
            pytest.param(name, "single", marks=pytest.mark.slow)
            for name in ("roller", "crowned", "punch", "ellipsoid")
        ),
        *(pytest.param(name, "double", marks=pytest.mark.slow) for name in [*SHAPES][1:]),
    ],
)
def test_no_text_of_a_drawing_is_cut_off_or_runs_into_it(name: str, width: str | float) -> None:
    body, size = SHAPES[name]
    figure = draw_indenter(body, size, contact=(0.0, 0.0, *size), width=width)
    figure.draw_without_rendering()
    [facts] = figure.axes[3].texts
    box = facts.get_window_extent()
    assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
    assert figure.bbox.y0 <= box.y0
    for axes in figure.axes[:3]:
        assert not box.overlaps(axes.get_tightbbox())


@pytest.mark.parametrize("body", [ROLLER, pytest.param(vc.Sphere(5e-3), marks=pytest.mark.slow)])
def test_noted_exaggeration_is_the_drawn_one(body: vc.Indenter) -> None:
    """A metre up and a metre along, measured in dots."""
    figure = draw_indenter(body, SIZE)
    figure.draw_without_rendering()
    units = {"nm": 1e-9, "µm": 1e-6, "mm": 1e-3}
    for panel in (0, 1, 2):
        axes = figure.axes[panel]
        noted = float(re.findall(r"([\d.]+)×", axes.get_title(loc="right"))[0])
        x, y = (
            units[re.findall(r"\[(\w+)\]", label)[0]]
            for label in (axes.get_xlabel(), axes.get_ylabel())
        )
        corner, other = axes.transData.transform([(0, 0), (1e-3 / x, 1e-3 / y)])
        drawn = (other[1] - corner[1]) / (other[0] - corner[0])
        # Noted with one or two digits.
        assert noted == close_to(drawn, rel=0.1 if drawn > 100 else 0.06)


def test_plan_that_is_not_slender_is_drawn_in_its_true_shape() -> None:
    figure = draw_indenter(vc.Ellipsoid(3e-3, 2e-3, 1e-3).rotated(0.5), (8e-3, 6e-3))
    axes = figure.axes[2]
    assert axes.get_title(loc="right") == "true shape"
    figure.draw_without_rendering()
    corner, other = axes.transData.transform([(0, 0), (1, 1)])
    assert other[1] - corner[1] == close_to(other[0] - corner[0], rel=1e-6)
    assert "turned by 28.6°" in texts(figure)


def test_parts_of_a_sum_are_named_and_a_contact_is_shaded() -> None:
    body = vc.Sphere(5e-3) + vc.Waviness(1e-6, wavelength_x=1e-4).shifted(x=2e-5)
    figure = draw_indenter(body, (1e-3, 1e-3), contact=(0.0, 0.0, 4e-4, 3e-4), title="Ball")
    said = facts_of(figure)
    assert said.startswith(
        "Ball\nSphere, radius 5 mm\n+ Waviness, amplitude 1 µm, wavelength x 100 µm\n"
        "moved by 20 µm along x"
    )
    assert "shaded: extent of the expected contact, 400 µm × 300 µm" in said
    [shade] = [each for each in figure.axes[2].patches if each.get_alpha()]
    assert shade.get_bbox().bounds == close_to((-0.2, -0.15, 0.4, 0.3))


def test_nothing_to_draw_is_refused() -> None:
    with pytest.raises(ValueError, match=r"nothing of the body lies within 1 mm x 1 mm"):
        draw_indenter(vc.Sphere(1e-3).shifted(1.0), (1e-3, 1e-3))
    with pytest.raises(ValueError, match="size must be a length in m, or one along x"):
        draw_indenter(vc.Sphere(1e-3), (1e-3, math.inf))


# -- check --plot ------------------------------------------------------------------------------

CASE = """\
indenter: {shape: roller, radius: 5 mm, half_length: 6 mm, profile: iso-16281}
material: {law: elastic, shear_modulus: 700 MPa, poisson_ratio: 0.3}
load: {kind: step, force: 20 N}
time: {end: 1 s, steps: 2, spacing: uniform}
grid: {shape: [32, 40], size: [14 mm, 0.4 mm]}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)
    Path("case.yaml").write_text(CASE)
    return tmp_path


def test_check_draws_next_to_the_case_or_to_the_given_file(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml"]) == 0
    assert [each.name for each in folder.iterdir()] == ["case.yaml"]
    assert main(["check", "case.yaml", "--plot"]) == 0
    assert capsys.readouterr().out.rstrip().endswith("case-indenter.png")
    assert Path("case-indenter.png").read_bytes()[:4] == b"\x89PNG"
    assert main(["check", "case.yaml", "--plot", "mine.svg", "--set", "load.force=5 N"]) == 0
    assert Path("mine.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize(("length", "drawn"), [(4e-3, 4e-3), (10e-3, 12.6e-3), (14e-3, 14e-3)])
def test_body_that_ends_a_little_beyond_the_grid_is_drawn_to_its_end(
    length: float, drawn: float
) -> None:
    rubber, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((32, 32), (length, 1e-3))
    run = OverTime(prepare_run(Problem(ROLLER, rubber, vc.step(1e-3), grid, [0.0])))
    # The end is looked for in steps of 1e-3 of the length.
    assert drawn_size(run) == close_to((drawn, 1e-3), rel=2e-3)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["mine.png"], "a picture goes with --plot, as in: check case.yaml --plot mine.png"),
        (["--plot", "mine.tiff"], "must end in .png, .pdf or .svg"),
        (["--plot", "no/such/folder.png"], "folder.png"),
    ],
)
def test_check_refuses_a_picture_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert main(["check", "case.yaml", *words]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    "body",
    [
        pytest.param(
            vc.Cone(1.5).shifted(-1.2345e-5, 9.8765e-5), id="cone", marks=pytest.mark.slow
        ),
        pytest.param(
            vc.Sphere(5e-3).shifted(-2.6613e-4, 1.2345e-4), id="sphere", marks=pytest.mark.slow
        ),
        pytest.param(ROLLER.shifted(x=1.2345e-3, y=-9.876e-5), id="roller"),
    ],
)
def test_headings_keep_apart(body: vc.Indenter) -> None:
    """Odd places are long to write, and a section across is narrow."""
    figure = draw_indenter(body, (4e-3, 1.5e-3), contact=(0.0, 0.0, 1.234e-3, 5.678e-4))
    figure.draw_without_rendering()
    for axes in some(figure.axes[:3]):
        left, right = (
            next(
                each.get_window_extent()
                for each in axes.findobj(Text)
                if isinstance(each, Text) and each.get_text() == axes.get_title(loc=side)
            )
            for side in ("left", "right")
        )
        assert left.x1 + 4 < right.x0


def test_ends_of_bodies_are_marked_in_the_section_along_them_and_in_the_plan() -> None:
    figure = draw_indenter(vc.Roller(0.01, 3e-3), (8e-3, 2e-3), ends=[2e-3, -2e-3, 0.1])
    for axes, marks in zip(figure.axes[:3], (True, False, True), strict=True):
        dotted = [line for line in axes.get_lines() if line.get_linestyle() == ":"]
        places = [float(np.asarray(line.get_xdata())[0]) for line in dotted]
        assert places == ([-2.0, 2.0] if marks else [])
    texts = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert any("bodies end at x" in text for text in texts)
