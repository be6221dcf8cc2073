"""Layout of figures: error bands, headings, legends, widths."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.content.design import parameters_of
from viscontact.drawing.content.law_curves import curve_times
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.error_band import band_key, draw_band
from viscontact.drawing.matplotlib.layout.page import page_width
from viscontact.drawing.matplotlib.layout.saving import as_svg, written
from viscontact.drawing.matplotlib.layout.style import (
    add_heading,
    arrange_headings,
    by_rows,
    new_figure,
)


def test_band_reaches_from_value_minus_to_value_plus_error() -> None:
    axes = style.new_figure(4.0, 3.0).subplots()
    assert draw_band(axes, np.arange(2.0), np.ones(2), np.array([0.1, 0.2]), "black").seen
    found = axes.collections[0].get_datalim(axes.transData).intervaly.round(12).tolist()
    assert found == [0.8, 1.2]


def test_legend_says_if_all_bands_lie_within_the_line() -> None:
    axes = style.new_figure(4.0, 3.0).subplots()
    wide, narrow = (
        draw_band(axes, np.arange(2.0), np.arange(2.0), np.full(2, each), "black")
        for each in (0.1, 1e-9)
    )
    found = [band_key(each, "black")[0][1] for each in ([wide], [wide, narrow], [narrow])]
    assert found == [
        "band: error estimate",
        "band: error estimate",
        "error estimate within the line's width",
    ]


def test_single_column_is_89_mm_wide() -> None:
    assert round(page_width("single", 7.2), 3) == 3.504


def test_figure_for_embedding_is_xml() -> None:
    assert as_svg(Figure())[:5] == b"<?xml"


def test_legend_filled_by_columns_is_read_by_rows() -> None:
    assert by_rows(["a", "b", "c", "d", "e"], columns=4) == ["a", "e", "b", "c", "d"]


def test_note_without_room_moves_above_the_heading() -> None:
    figure = new_figure(2.0, 2.0)
    axes = figure.subplots()
    add_heading(axes, "t = 1000 s")
    add_heading(axes, "peak depends on the mesh", aside=True)
    figure.draw_without_rendering()
    arrange_headings(figure)
    assert axes.get_title(loc="left").splitlines() == ["peak depends on the mesh", "t = 1000 s"]
    assert axes.get_title(loc="right") == ""


def test_creep_is_drawn_from_a_ten_thousandth_of_the_run() -> None:
    assert curve_times(10.0)[[0, -1]].round(6).tolist() == [0.001, 10.0]


def test_parameters_of_a_design_are_its_keys() -> None:
    found = parameters_of(xr.Dataset({}, {"load.x": ("trial", [1.0]), "trial": [0]}))
    assert found == ["load.x"]


def test_figure_is_written_as_pdf() -> None:
    assert written(Figure(), "pdf")[:4] == b"%PDF"
