"""A map is the same in Matplotlib, Plotly and SVG: range, unit, levels, colours, outline."""

from __future__ import annotations

import base64
import re
from functools import cache
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from closeness import close_to
from synthetic_results import ellipse, roller
from viscontact import plot
from viscontact.drawing.content.map import Maps, maps_over
from viscontact.drawing.plotly.parts import plain
from viscontact.drawing.plotly.pressure_map import pressure_map as interactive_map
from viscontact.drawing.svg.result_overview import map_drawing

FloatArray = NDArray[np.float64]


@cache
def content() -> Maps:
    return maps_over(ellipse())


@cache
def still_map(style: str) -> list[plot.Figure]:
    """Panels and colour bar of all instants."""
    return plot.pressure_map(ellipse(), times=ellipse().time.values, style=style).axes


@cache
def small_map() -> Element:
    return map_drawing(content())


def paths(kind: str) -> list[Element]:
    return [each for each in small_map().iter("path") if each.get("class") == kind]


def texts(kind: str = "") -> list[tuple[float, float, str]]:
    """Places and texts of labels of a kind [px]."""
    found = (each for each in small_map().iter("text") if each.get("class", "") == kind)
    return [(float(each.get("x", "")), float(each.get("y", "")), each.text or "") for each in found]


def length_unit(label: str) -> float:
    return {"mm": 1e-3, "µm": 1e-6}[label[-3:-1]]


def placed_on(kind: str, pixels: FloatArray) -> FloatArray:
    """Positions of pixels on an axis of the small map [m]."""
    side = "xy".index(kind)
    ticks = [(tick[side], float(tick[2].replace("−", "-"))) for tick in texts(f"{kind}-tick")]
    at, values = np.array(ticks).T
    at = at - 3.5 * side  # texts stand below their ticks
    label = next(text for *_, text in texts() if text.startswith(f"{kind} ["))
    return np.asarray(np.polyval(np.polyfit(at, values, 1), pixels) * length_unit(label))


def test_unit_is_the_same() -> None:
    still = still_map("contours")[-1].get_ylabel()
    interactive = interactive_map(content()).data[0].colorbar.title.text
    assert still == interactive == content().scale().label == "Pressure [MPa]"
    assert texts()[0][2] == "pressure [MPa]"


def test_range_is_the_same() -> None:
    scale = content().scale()
    heat, bar = interactive_map(content()).data[0], still_map("colours")[-1]
    assert (heat.zmin, heat.zmax) == close_to(scale.unit(scale.limits))
    assert bar.get_ylim() == close_to(scale.unit(scale.limits))


def test_levels_are_the_same() -> None:
    scale = content().scale()
    levels = scale.unit(scale.levels)
    bar = still_map("contours")[-1]
    np.testing.assert_allclose(bar.get_yticks(), levels)
    assert texts()[1][2].startswith(f"{levels[0]:.0f} to {levels[-1]:.0f}, ")
    # A band that no cell of the last instant lies in has no cells.
    bands = np.searchsorted(levels, scale.unit(content().snapshots[-1].pressure), side="right") - 1
    present = sorted(set(bands[content().snapshots[-1].pressure > 0].tolist()))
    colours = scale.colours(levels.size - 1)
    assert [each.get("stroke") for each in paths("cells")] == [colours[n] for n in present]


def test_colours_are_the_same() -> None:
    scale, heat = content().scale(), interactive_map(content()).data[0]
    ends = [colour for _, colour in heat.colorscale][:: len(heat.colorscale) - 1]
    assert ends == scale.colours(2)
    for style in ("contours", "colours"):
        bar = still_map(style)[-1].collections[-1]
        drawn = [to_hex(colour) for colour in bar.get_cmap().colors]
        assert drawn == scale.colours(len(drawn))


def test_stretch_is_the_same_and_noted() -> None:
    run = roller(times=(0.0, 1.0))
    maps = maps_over(run)
    note = maps.window.note
    assert note.startswith("y stretched")
    assert interactive_map(maps).layout.meta["note"].endswith(f"MPa; {note}")
    assert f"x [mm]; {note}" in "".join(map_drawing(maps).itertext())
    still = plot.pressure_map(run).axes[0]
    assert still.get_title(loc="right") == note
    assert still.get_aspect() == interactive_map(maps).layout.yaxis.scaleratio


def test_outline_is_the_same() -> None:
    [outline] = content().maps[-1].outline
    panel = still_map("contours")[2]
    scale = length_unit(panel.get_xlabel())
    vertices = panel.patches[-1].get_path().vertices
    np.testing.assert_allclose(vertices[: len(outline)] * scale, outline, atol=1e-12)
    frame = interactive_map(content()).frames[-1].data[1]
    drawn = np.column_stack([frame.x, frame.y])[:-1]
    np.testing.assert_allclose(drawn * scale, outline, atol=1e-9)
    [rim] = paths("rim")
    pairs = re.findall(r"([\d.-]+),([\d.-]+)", rim.get("d", ""))
    x, y = np.array(pairs, dtype=float).T
    curve = np.column_stack([placed_on("x", x), placed_on("y", y)])
    distance = np.hypot(*(curve[:, None] - outline[None]).T).min(axis=0)
    assert distance.max() < 3e-6  # a tenth of a pixel is 1 µm


@pytest.mark.slow
def test_tension_is_drawn_in_colours_that_diverge_from_zero() -> None:
    ds = ellipse()
    touched = ds.pressure > 0
    tensile = ds.assign(
        pressure=ds.pressure.where(ds.pressure > 0.5e6, -0.3e6).where(touched, 0.0),
        in_contact=touched.astype("i1"),
    )
    maps = maps_over(tensile)
    scale = maps.scale()
    low, high = scale.unit(scale.limits)
    assert (low, high) == close_to((-0.3, 3.0), rel=1e-3)
    assert scale.unit(scale.levels)[[0, -1]].tolist() == close_to([-0.5, 3.0])
    heat = plain(interactive_map(maps))["data"][0]
    assert (heat["zmin"], heat["zmax"]) == close_to((low, high))
    shown = np.frombuffer(base64.b64decode(heat["z"]["bdata"]), "<i2") * heat["z"]["step"]
    assert shown.min() == close_to(-0.3, rel=1e-3)
    # White at zero, red below it, blue above.
    red, blue = (colour[1:3] > colour[5:7] for colour in scale.colours(3)[::2])
    assert (red, blue) == (True, False)
    figure = plot.pressure_map(tensile, style="contours")
    assert figure.axes[-1].get_ylim() == close_to((-0.5, 3.0))
    _, bar, section, *_ = plot.animation(tensile, seconds=1.0, fps=2.0).figure.axes
    assert bar.get_ylim() == close_to((-0.5, 3.0))
    assert section.get_ylim()[0] == close_to(1.05 * low)


def test_levels_end_below_peaks_that_depend_on_the_mesh() -> None:
    ds = ellipse()
    ds["peak_pressure_error"] = "time", np.full(ds.sizes["time"], np.inf)
    ds["pressure"] = ds.pressure.where(ds.pressure < 0.93 * ds.pressure.max(), 3 * ds.pressure)
    maps = maps_over(ds)
    scale = maps.scale()
    high = np.quantile(maps.snapshots[-1].pressure[maps.snapshots[-1].in_contact], 0.97)
    assert scale.levels[-1] < high < scale.limits[1]
    figure = plot.pressure_map(ds, style="contours")
    assert figure.axes[-1].get_ylim()[1] == close_to(scale.unit(scale.levels[-1]))
    assert "peak depends on the mesh" in figure.axes[0].get_title(loc="left")
