"""Display of objects and results in notebooks and terminals."""

from __future__ import annotations

import importlib.util
import math
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

import viscontact as vc
from closeness import close_to
from saturating_force import SaturatingForce
from synthetic_results import (
    ELLIPSE_MIDDLE,
    ELLIPSE_PEAK,
    ELLIPSE_TIMES,
    ellipse,
    ellipse_pressure,
    maxwell_sphere,
)
from viscontact.case import read_case
from viscontact.drawing.content.small_panels import law_span
from viscontact.units.parsing import parse_quantity

_EXAMPLES = Path(vc.__file__).parent / "case" / "examples"
_AXIS = np.linspace(-50e-6, 50e-6, 40)
_MAP = vc.HeightMap(_AXIS, _AXIS, 1e-7 * np.cos(_AXIS[:, None] * 2e5) * np.sin(_AXIS * 1e5 + 1))
_SECTION = {"y": [0, 1e-3, 3e-3], "drops": [0, 0, 2e-3], "interpolation": "linear"}

INDENTERS = [
    vc.Sphere(0.01),
    vc.Paraboloid(0.01, 0.02),
    vc.Ellipsoid(0.01, 0.02, 0.01),
    vc.Cone(math.radians(70)),
    vc.Pyramid(math.radians(68), 4),
    vc.Wedge(math.radians(80)),
    vc.Torus(5e-3, 1e-3),
    vc.FlatPunch(radius=2e-3),
    vc.FlatPunch(half_length=2e-3, half_width=1e-3),
    vc.Roller(5e-3, 9.565e-3, crown_radius=75e-3),
    vc.Roller(5e-3, 6e-3, profile="logarithmic", amplitude=1e-6),
    vc.Roller(5e-3, 9e-3).rotated(0.5).shifted(x=1e-3),
    vc.Revolved(r=[0, 1e-3, 2e-3], drops=[0, 0, 1e-4], interpolation="linear"),
    vc.Swept(half_length=5e-3, **_SECTION),
    vc.Waviness(1e-6, wavelength_x=2e-3),
    vc.Dimples(2e-6, 50e-6, 200e-6),
    _MAP,
    vc.Sphere(1e-3) + _MAP,
]
LAWS = [
    vc.Elastic(1e9),
    vc.Maxwell(1e9, 1e11),
    vc.Zener(1e9, 1e9, 1e11),
    vc.Burgers(1e9, 1e12, 1e9, 1e10),
    vc.CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.87], fluidity=1e-13),
    vc.RelaxationSeries(1e8, [1e9, 2e9], [1.0, 50.0]),
    vc.PowerLaw(1e-9, 0.3, 1.0),
    vc.FractionalMaxwell(1e6, 2.0, 0.5),
    vc.FractionalZener(3e6, 1e6, 2.0, 0.5),
    vc.TabulatedCreep([0, 1, 10, 100], [1e-9, 1.2e-9, 1.5e-9, 2e-9]),
    vc.TabulatedRelaxation([0.01, 1, 10, 100], [1e9, 8e8, 5e8, 3e8]),
]
OTHERS = [
    vc.Material(vc.Zener(1e6, 1e6, 1e6), bulk_modulus=1e9, thickness=1e-3),
    vc.step(force=1e4, eccentricity_x=4.78e-3),
    vc.step(approach=1e-4),
    vc.ramp(0.0, 1.0),
    vc.harmonic(2.0, 1.0, 0.5, 30),
    vc.triangle(10.0, 1.0, 2.0),
    vc.ApproachHistory([0, 1, 3, 3], [0, 1e-6, 1e-6, -1e-6]),
    vc.Grid((512, 128), (48e-3, 3.2e-3)),
    vc.Grid((8, 4), (1e-3, 1e-3), periodic=True),
    vc.AutomaticGrid(0.005, ["approach", "peak_pressure"]),
    vc.LogarithmicProfile(1e-6),
    vc.WLF(293.15, 17.44, 51.6),
    vc.Arrhenius(293.15, 50e3),
    vc.TabulatedShift([290.0, 300.0], [2.0, 0.5]),
    read_case(_EXAMPLES / "rough-ball.yaml"),
    read_case(_EXAMPLES / "punch-harmonic.yaml"),
]
_ZENER = vc.Zener(1e4, 1e4, 5e3)
_TIMES, _FREQUENCIES = np.geomspace(0.1, 100.0, 30), np.geomspace(0.1, 1e3, 25)
_HEIGHTS = 1e-6 * np.sin(np.arange(60.0))[:, None] * np.cos(np.arange(20.0))
_HEIGHTS[5:9, 3:6] = np.nan
_HEIGHTS[40, 15] = 5e-6
_MODULUS = _ZENER.complex_modulus(_FREQUENCIES)
#: A punch of radius a on G, nu: F = 4 G a delta / (1 - nu); pressed at 1 um/s, then held.
_PRESSED = np.linspace(0.0, 3.0, 16)
_RECORD = vc.IndentationRecord(
    vc.FlatPunch(radius=1e-5),
    _PRESSED,
    1e-6 * np.minimum(_PRESSED, 1.0),
    4e-5 / 0.5 * 1e-6 * 5e3 * np.minimum(_PRESSED, 1.0) * (1 + np.exp(-_PRESSED)),
)
_ISOTHERMS = [
    vc.Isotherm(273.15 + 10 * k, _TIMES, {"compliance": 1e-9 * (10**k * _TIMES) ** 0.2})
    for k in (1, 2, 3)
]
MEASURED = [
    vc.Surface(_HEIGHTS, (2e-6, 5e-6), name="mine <b>.npz"),
    vc.fit_creep(_TIMES, _ZENER(_TIMES), data="deviatoric"),
    vc.fit_dynamic(_FREQUENCIES, _MODULUS.real, _MODULUS.imag, data="shear"),
    _RECORD,
    vc.fit_indentation(_RECORD, "zener", poisson_ratio=0.5),
    _ISOTHERMS[0],
    vc.build_master_curve(_ISOTHERMS, 293.15),
    vc.Card("gel", vc.Material(_ZENER, 0.5), vc.WLF(293.15, 17.44, 51.6), ("*DENSITY",)),
]
_RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.49)
_STEEL = vc.Material(vc.Elastic(80e9), 0.3)
LAYERED = vc.Layered([vc.Layer(5e-3, _RUBBER), vc.Layer(1e-4, _STEEL)], "rigid", (True, False))
STORED_CLASSES = [*INDENTERS, *LAWS, *OTHERS, *MEASURED, LAYERED]
#: Half of the last digit of a path, and what it may leave out of a straight piece [px].
_ROUNDING = 0.05 + 0.03


def _parsed(shown: Any) -> ElementTree.Element:
    """The HTML of an object; it is written with every element closed, which XML is stricter on."""
    return ElementTree.fromstring(shown._repr_html_())


def _text(element: ElementTree.Element) -> str:
    return " ".join(" ".join(element.itertext()).split())


def _ticks(drawing: ElementTree.Element, axis: str) -> tuple[NDArray[Any], list[str]]:
    """Places [px] and texts of the ticks that a reader sees."""
    ticks = [each for each in drawing.iter("text") if each.get("class") == f"{axis}-tick"]
    # A label of the vertical axis stands 3.5 px below the place of its tick.
    places = [float(t.get(axis, "")) - (3.5 if axis == "y" else 0) for t in ticks]
    return np.array(places), ["".join(t.itertext()).replace("\N{MINUS SIGN}", "-") for t in ticks]


def _unit(drawing: ElementTree.Element, axis_label: str) -> float:
    """The unit in the brackets of an axis' label [SI]."""
    found = re.search(re.escape(axis_label) + r" \[([^]]+)\]", _text(drawing))
    assert found, _text(drawing)
    symbol = found[1].removeprefix("1/")
    size = parse_quantity(f"1 {symbol}", "length" if symbol.endswith("m") else "pressure")
    return 1 / size if found[1].startswith("1/") else size


def _line(drawing: ElementTree.Element, kind: str) -> tuple[NDArray[Any], NDArray[Any]]:
    """Points of a path without its vertical walls [px]."""
    [path] = [each for each in drawing.iter("path") if each.get("class") == kind]
    pairs = re.findall(r"(?<=[ML ])([\d.-]+),([\d.-]+)", path.get("d", ""))
    return np.array(pairs, dtype=float).T[0], np.array(pairs, dtype=float).T[1]


@pytest.mark.parametrize("item", STORED_CLASSES, ids=lambda item: type(item).__name__)
def test_what_is_shown_is_small_whole_and_asks_for_nothing(item: Any) -> None:
    page = item._repr_html_()
    assert len(page) < 30_000
    root = _parsed(item)
    assert not re.search(r"https?:|url\(|@import|src=|href=|<script|<style", page)
    assert not re.search(r"\b(nan|inf|None|SI)\b", _text(root), re.IGNORECASE)
    drawn = len(list(root.iter("svg")))
    bare = vc.Elastic | vc.Grid | vc.AutomaticGrid | vc.LogarithmicProfile
    assert (drawn == 0) == isinstance(item, bare | vc.WLF | vc.Arrhenius | vc.TabulatedShift)
    paths = " ".join(path.get("d", "") for path in root.iter("path"))
    numbers = [float(number) for number in re.findall(r"-?[\d.]+|nan|inf", paths)]
    assert all(-10 < number < 230 for number in numbers)


@pytest.mark.parametrize("item", [*INDENTERS[:16], *LAWS], ids=lambda item: type(item).__name__)
def test_repr_can_still_be_typed_in(item: Any) -> None:
    names = {name: getattr(vc, name) for name in vc.__all__ if name[0].isupper()}
    names |= {type(item).__name__: type(item), "Roller": vc.Roller}
    assert repr(item).startswith(f"{type(item).__name__}(")
    assert eval(repr(item), names) == item


@pytest.mark.parametrize(
    ("item", "expected"),
    [
        (INDENTERS[9], ["radius 5 mm", "half length 9.565 mm", "crown radius 75 mm"]),
        (INDENTERS[10], ["profile amplitude 1 µm"]),
        (INDENTERS[11], ["turned by 500 mrad (28.65°)", "moved along x by 1 mm"]),
        (LAWS[4], ["instant compliance 0.5545 / GPa", "retardation times 10 s, 133.87 s"]),
        (LAWS[1], ["viscosity 100 GPa s"]),
        (OTHERS[0], ["law Zener", "shear modulus 1 MPa", "bulk modulus 1 GPa", "thickness 1 mm"]),
        (OTHERS[1], ["force 10 kN", "eccentricity x 4.78 mm"]),
        (OTHERS[7], ["shape 512 × 128", "size 48 mm × 3.2 mm", "cell 93.75 µm × 25 µm"]),
        (OTHERS[12], ["activation energy 50 kJ/mol", "reference temperature 293.15 K"]),
        (
            OTHERS[14],
            ["Rough ball", "part 1 radius 2 mm", "force 0 N, 60 mN", "steps 63,"],
        ),
        (MEASURED[0], ["mine <b>.npz", "size 120 µm × 100 µm", "not measured 1.0 % of the points"]),
        (MEASURED[1], ["data deviatoric", "misses the compliance by <0.01 %", "times 500 ms"]),
        (MEASURED[2], ["angular frequency 0.1000 rad/s to 1000 rad/s", "misses the loss by"]),
        (MEASURED[3], ["indenter flat punch", "largest approach 1 µm", "duration 3 s"]),
        (MEASURED[4], ["(95 %: ", "given approach over 3 s", "Poisson's ratio 0.5"]),
        (MEASURED[5], ["temperature 10 °C", "time 100 ms to 100 s"]),
        (MEASURED[6], ["reference temperature 20 °C", "made of 3 sets", "at 30 °C 0.1000"]),
        (MEASURED[7], ["Material card: gel", "note *DENSITY", "law Zener", "c1 17.44"]),
    ],
    ids=lambda value: type(value).__name__,
)
def test_tables_have_readable_units(item: Any, expected: list[str]) -> None:
    shown, printed = _text(_parsed(item)), " ".join(str(item).split())
    for words in expected:
        assert words in shown
        assert words in printed


@pytest.mark.parametrize(
    ("indenter", "gap"),
    [
        (vc.Sphere(0.01), lambda s: 0.01 - np.sqrt(1e-4 - s * s)),
        (vc.Cone(math.radians(70)), lambda s: np.abs(s) / math.tan(math.radians(70))),
        (vc.FlatPunch(radius=2e-3), np.zeros_like),
    ],
)
def test_outline_of_a_round_body_is_its_gap(
    indenter: vc.Indenter, gap: Callable[[NDArray[Any]], NDArray[Any]]
) -> None:
    [drawing] = _parsed(indenter).iter("svg")
    _check_outline(drawing, "x", gap)


def test_outlines_of_a_roller_are_those_of_eq13() -> None:
    R, L, R_c = 5e-3, 9.565e-3, 75e-3
    along, across = _parsed(vc.Roller(R, L, crown_radius=R_c)).iter("svg")
    _check_outline(
        along, "x", lambda x: R_c - np.sqrt(R_c**2 - np.maximum(np.abs(x) - L, 0.0) ** 2)
    )
    _check_outline(across, "y", lambda y: R - np.sqrt(R**2 - y**2))


def _check_outline(
    drawing: ElementTree.Element, axis: str, gap: Callable[[NDArray[Any]], NDArray[Any]]
) -> None:
    """Read the outline off with the ticks and units that stand beside it."""
    px, py = _line(drawing, "outline")
    (at_x, x_text), (at_y, y_text) = _ticks(drawing, "x"), _ticks(drawing, "y")
    x_of = np.polyfit(at_x, np.array(x_text, dtype=float) * _unit(drawing, axis), 1)
    y_of = np.polyfit(at_y, np.array(y_text, dtype=float) * _unit(drawing, "gap"), 1)
    whole = py > 24.0 + 1e-6  # what runs into the upper edge is cut there
    at = np.linspace(px[whole].min(), px[whole].max(), 97)
    height = np.polyval(y_of, np.interp(at, px[whole], py[whole]))
    position = np.polyval(x_of, at)
    exact = gap(np.clip(position, *np.polyval(x_of, [at[0] + 0.05, at[-1] - 0.05])))
    # Along a slope a point moves up by as much as it is moved aside.
    slope = np.abs(np.gradient(exact, position) * x_of[0])
    assert np.all(np.abs(height - exact) <= 2 * _ROUNDING * (abs(y_of[0]) + slope))


def test_section_of_layers_is_to_scale_and_names_them() -> None:
    layers = [vc.Layer(4e-3, _RUBBER), vc.Layer(2e-3, _STEEL), vc.Layer(1e-6, _RUBBER)]
    section, *curves = _parsed(vc.Layered(layers, _STEEL, (True, False, True))).iter("svg")
    heights = [float(each.get("height", "")) for each in section.iter("rect")]
    assert heights[0] == close_to(2 * heights[1], abs=0.2)  # rounded to 0.1
    assert heights[2] == 18  # room for its label
    assert _text(section) == "section 4 mm Zener 2 mm elastic 1 µm Zener slides base: elastic"
    dashed = [each for each in section.iter("path") if "stroke-dasharray" in each.attrib]
    assert len(dashed) == 1
    assert ["layer 1" in _text(each) for each in curves] == [True, True, False, False]


def test_curves_of_a_law_are_the_law() -> None:
    law = vc.Zener(1e9, 1e9, 1e11)  # Phi = (1/G1 + (1 - exp(-t/100 s))/G2)/2
    compliance, modulus = _parsed(law).iter("svg")
    for drawing, name, exact in (
        (compliance, "Φ", lambda t: (1e-9 + 1e-9 * (1 - np.exp(-t / 100))) / 2),
        (modulus, "G", lambda t: 1e9 / 2 * (1 + np.exp(-t / 50))),  # series: half of G1, τ/2
    ):
        px, py = _line(drawing, "curve")
        (at_x, x_text), (at_y, y_text) = _ticks(drawing, "x"), _ticks(drawing, "y")
        decades = [math.log10(parse_quantity(text, "time")) for text in x_text]
        times = 10 ** np.polyval(np.polyfit(at_x, decades, 1), px)
        y_of = np.polyfit(at_y, np.array(y_text, dtype=float) * _unit(drawing, name), 1)
        values = np.polyval(y_of, py)
        # 0.1 px of 160 px over six decades, and of 98 px up.
        np.testing.assert_allclose(values, exact(times), rtol=0.004)


def test_law_is_drawn_over_the_times_among_its_arguments() -> None:
    @dataclass(frozen=True)
    class Ageing(vc.PowerLaw):
        onset: float = field(default=1e5, metadata={"unit": "s"})

    # 100 times shorter than 1 s, and 100 times longer than 1e5 s
    assert law_span(Ageing(1e-9, 0.3, 1.0, 1e-9)) == (1e-2, 1e7)


def test_map_of_a_surface_has_its_strongest_tone_on_its_peak_and_holes_where_it_has() -> None:
    heights = np.zeros((8, 4))
    heights[6, 1], heights[0, 3] = 1e-6, np.nan
    drawing = next(_parsed(vc.Surface(heights, 1e-6)).iter("svg"))
    cells = [path for path in drawing.iter("path") if path.get("class") == "cells"]
    strokes = {path.get("stroke"): path.get("d", "") for path in cells}
    # 8 x 4 points in 164 x 82 px, which begin 46 px from the left and 24 px from the top.
    side = 164 / 8
    [(left, at, width)] = re.findall(r"M([\d.]+),([\d.]+)h([\d.]+)", strokes["#2f80c3f2"])
    assert float(left) == close_to(46 + 6 * side, abs=0.1)
    assert float(at) == close_to(24 + (4 - 1.5) * side, abs=0.1)  # y goes upwards
    assert float(width) == close_to(side, abs=0.1)
    drawn = sum(float(w) for d in strokes.values() for w in re.findall(r"h([\d.]+)", d))
    assert drawn == close_to(31 * side, abs=1.0)


def test_section_of_a_surface_runs_along_x_through_its_highest_point() -> None:
    x, y = np.arange(30), np.arange(47)
    heights = 1e-6 * np.outer(np.sin(np.pi * x / 29), 1 - ((y - 40) / 40) ** 2)
    _, section = _parsed(vc.Surface(heights, (1e-6, 2e-6))).iter("svg")
    at, text = _ticks(section, "y")
    _, places = _line(section, "curve")
    found = np.polyval(np.polyfit(at, np.array(text, dtype=float), 1), places)
    # From 0 to the height at x = 14 or 15, whose sine is 0.9985.
    assert np.ptp(found) * _unit(section, "height") == close_to(0.9985e-6, rel=0.02)
    at, text = _ticks(section, "x")
    ends = np.polyval(np.polyfit(at, np.array(text, dtype=float), 1), _line(section, "curve")[0])
    assert np.ptp(ends) * _unit(section, "x") == close_to(29e-6, rel=0.02)


def test_dots_of_a_fit_lie_on_its_curve_where_it_misses_nothing() -> None:
    drawing = next(_parsed(MEASURED[1]).iter("svg"))
    [curve] = [path for path in drawing.iter("path") if path.get("class") == "curve"]
    line = np.array(re.findall(r"([\d.]+),([\d.]+)", curve.get("d", "")), dtype=float)
    dots = [(float(d.get("cx", "")), float(d.get("cy", ""))) for d in drawing.iter("circle")]
    assert len(dots) == 30
    for across, up in dots:
        assert up == close_to(np.interp(across, line[:, 0], line[:, 1]), abs=0.3)


def test_a_jump_of_a_load_is_drawn_upright() -> None:
    history = vc.ForceHistory([0, 1, 3, 3, 10], [0, 10, 10, 4, 4])
    [drawing] = _parsed(history).iter("svg")
    px, py = _line(drawing, "curve")
    at, text = _ticks(drawing, "y")
    force = np.polyval(np.polyfit(at, np.array(text, dtype=float), 1), py)
    jump = np.flatnonzero(np.diff(px) == 0)
    assert force[jump].round(1).tolist()[-1] == 10
    assert force[jump + 1].round(1).tolist()[-1] == 4


def test_a_curved_load_is_drawn_as_a_curve() -> None:
    load = SaturatingForce(10.0, 2.0)
    [drawing] = _parsed(load).iter("svg")
    px, py = _line(drawing, "curve")
    (at_x, x_text), (at_y, y_text) = _ticks(drawing, "x"), _ticks(drawing, "y")
    times = np.polyval(np.polyfit(at_x, np.array(x_text, dtype=float), 1), px)
    force = np.polyval(np.polyfit(at_y, np.array(y_text, dtype=float), 1), py)
    held = np.clip(times, 0.0, 24.0)
    # 0.05 px of 98 px up, and the steepest slope, 5 N/s, over 0.05 px of 164 px.
    np.testing.assert_allclose(force, 10 * (1 - np.exp(-held / 2)), atol=0.1)
    assert "kind" not in _text(_parsed(load))


def test_titles_are_text_and_never_markup(tmp_path: Path) -> None:
    attack = "</div><script>alert(1)</script><img src=x onerror=alert(2)>"
    case = tmp_path / "case.yaml"
    source = (_EXAMPLES / "punch-harmonic.yaml").read_text(encoding="utf-8")
    case.write_text(re.sub(r"(?m)^title:.*", f"title: '{attack}'", source), encoding="utf-8")
    for shown in (read_case(case), maxwell_sphere(cells=40).assign_attrs(title=attack).viscontact):
        root = _parsed(shown)
        assert {each.tag for each in root.iter()}.isdisjoint({"script", "img"})
        assert attack in _text(root)


def test_a_result_shows_its_key_numbers() -> None:
    ds = maxwell_sphere((0.0, 1.0, 10.0, 100.0, 300.0))
    ds["contact_area"][-1] = 57.634e-6
    ds["contact_area_error"] = "time", np.full(5, 0.149e-6)
    root = _parsed(ds.viscontact)
    assert "After 300 s the contact covers 57.63 ± 0.15 mm² under 50 N" in _text(root)
    assert "57.63 ± 0.15 mm²" in str(ds.viscontact)
    pressure, area, surface = root.iter("svg")
    assert _text(surface).startswith("pressure [MPa]")
    assert _text(area).startswith("contact area")
    at, text = _ticks(pressure, "y")
    drawn = [p for p in pressure.iter("path") if p.get("class") == "curve"]
    peaks = [min(float(y) for y in re.findall(r",([\d.]+)", p.get("d", ""))) for p in drawn]
    found = np.polyval(np.polyfit(at, np.array(text, dtype=float) * 1e6, 1), peaks)
    exact = [float(ds.pressure[k].max()) for k in (0, -1)]  # first dashed, then the last
    np.testing.assert_allclose(found, exact, rtol=0.005)


@pytest.mark.parametrize("transposed", [False, True])
def test_section_of_a_result_runs_along_the_longer_extent(transposed: bool) -> None:
    """Through the middle of Hertz's ellipse, at the first instant and at the last."""
    drawing = next(_parsed(ellipse(transposed=transposed).viscontact).iter("svg"))
    along = "x" if transposed else "y"
    assert _text(drawing).startswith(f"along {along}")
    scales = []
    for axis in ("x", "y"):
        at, text = _ticks(drawing, axis)
        scales.append(np.polyfit(at, np.array(text, dtype=float), 1))
    length, pressure = _unit(drawing, along), _unit(drawing, "pressure")
    curves = [path for path in drawing.iter("path") if path.get("class") == "curve"]
    for curve, t in zip(curves, (ELLIPSE_TIMES[0], ELLIPSE_TIMES[-1]), strict=True):
        pairs = re.findall(r"(?<=[ML ])([\d.-]+),([\d.-]+)", curve.get("d", ""))
        places = np.array(pairs, dtype=float).T
        position, found = (np.polyval(fit, at) for fit, at in zip(scales, places, strict=True))
        x, y = np.full(position.size, ELLIPSE_MIDDLE[0]), position * length
        exact = ellipse_pressure(x, y, t)
        inner = exact > 0.4 * ELLIPSE_PEAK
        assert np.count_nonzero(inner) >= 10
        # A pixel is about a hundredth of the panel.
        np.testing.assert_allclose(found[inner] * pressure, exact[inner], atol=0.03 * exact.max())


def test_result_over_speed_is_shown_from_the_slowest_to_the_fastest() -> None:
    ball, grid = vc.Paraboloid(0.01, 0.01), vc.Grid((32, 32), (6e-3, 6e-3))
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e4), poisson_ratio=0.5)
    load = vc.step(1.0, tilt_y=0.0)
    ds = vc.steady(ball, rubber, load, [1.0, 0.01], grid=grid, errors=False)
    text, root = str(ds.viscontact), _parsed(ds.viscontact)
    assert re.search(r"^ +10 mm/s +1 m/s$", text, re.MULTILINE)
    drawn = [_text(drawing) for drawing in root.iter("svg")]
    assert any(each.startswith("contact area") and "speed" in each for each in drawn)
    assert not any("t =" in each for each in drawn)


def test_a_dataset_that_is_no_result_is_reported() -> None:
    assert "It has no time" in str(xr.Dataset().viscontact)
    empty = maxwell_sphere(cells=40).isel(time=slice(0, 0))
    assert "holds no instant" in empty.viscontact._repr_html_()
    lost = maxwell_sphere(fields=False)
    lost["contact_area"][:] = 0.0
    assert "do not touch" in str(lost.viscontact)


def test_a_long_table_stays_small() -> None:
    times = np.geomspace(1e-3, 1e6, 20_000)
    assert len(vc.TabulatedCreep(times, 1e-9 * (1 + times**0.2))._repr_html_()) < 30_000


def test_a_body_that_cannot_be_drawn_is_described_in_words() -> None:
    @dataclass(frozen=True)
    class Narrow(vc.Indenter):
        radius: float

        def gap(self, x: Any, y: Any) -> NDArray[Any]:
            if np.abs(x).max() > 1e-3:
                raise ValueError("too far out")
            return np.asarray(x) ** 2 / (2 * self.radius) + 0 * np.asarray(y)

    root = _parsed(Narrow(radius=0.01))
    assert (_text(root), list(root.iter("svg"))) == ("Narrow radius 10 mm", [])


def test_it_works_by_itself_and_without_plotting_libraries() -> None:
    code = (
        "import sys\n"
        "sys.modules.update(dict.fromkeys(['matplotlib', 'plotly', 'contourpy']))\n"
        "import viscontact as vc\n"
        "assert '<svg' in vc.Sphere(0.01)._repr_html_()\n"
        "assert '10 mm' in str(vc.Sphere(0.01))\n"
        "assert repr(vc.Sphere(0.01)) == 'Sphere(radius=0.01)'\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr == ""


@pytest.mark.skipif(importlib.util.find_spec("IPython") is None, reason="there is no IPython")
def test_ipython_displays_drawing_and_table() -> None:
    from IPython.core.formatters import DisplayFormatter

    shown, _ = DisplayFormatter(active_types=["text/plain", "text/html"]).format(vc.Sphere(0.01))
    assert shown["text/plain"] == "Sphere(radius=0.01)"
    assert "<svg" in shown["text/html"]


def test_an_isotherm_shows_its_temperature_with_all_digits() -> None:
    glass = vc.Isotherm(1273.15, _TIMES, {"compliance": 1e-11 * _TIMES**0.2})
    assert "1000 °C" in glass._repr_html_()
