"""Parts of the drawings of objects: elements, scripts, tables, axes."""

from __future__ import annotations

from viscontact.bodies.surfaces import Surface
from viscontact.drawing.content.panel import Axis
from viscontact.drawing.svg.html import as_script, element, written
from viscontact.drawing.svg.overview import Overview, as_text
from viscontact.drawing.svg.surface_map import surface_overview
from viscontact.drawing.svg.svg_axes import linear, scale_of
from viscontact.units.formatting import ReadableUnit


def test_text_of_an_element_is_escaped() -> None:
    found = written(element("p", "1 < 2 ", element("b", "<script>"), class_="a"))
    assert found == '<p class="a">1 &lt; 2 <b>&lt;script&gt;</b></p>'


def test_controls_in_attributes_are_shown_as_escapes() -> None:
    assert written(element("img", alt="\x1b[b] \u202e <")) == '<img alt="\\x1b[b] \\u202e <">'


def test_no_text_ends_a_script() -> None:
    assert as_script({"title": "</script>"}) == '{"title":"\\u003c/script>"}'


def test_table_of_an_overview_is_aligned() -> None:
    printed = as_text([Overview("Roller", [("radius", "5 mm"), ("half length", "9 mm")])])
    assert printed.splitlines() == ["Roller", "  radius       5 mm", "  half length  9 mm"]


def test_overview_of_a_surface_states_its_roughness() -> None:
    printed = surface_overview(Surface([[0.0, 1e-6], [2e-6, 1e-6]], 1e-5, name="mine.npz")).text()
    assert printed.splitlines() == [
        "Surface: mine.npz",
        "  points          2 × 2",
        "  size            20 µm × 20 µm",
        "  spacing         10 µm × 10 µm",
        "  Sa              500 nm",
        "  Sq, rms height  707.1 nm",
        "  height range    2 µm",
        "  rms slope       0.1732",
        "  skewness        0",
        "  Sdr             1.5 %",
    ]


def test_ticks_of_a_logarithmic_axis_have_readable_units() -> None:
    def times(low: float, high: float) -> Axis:
        seconds = ReadableUnit("s", 1.0)
        return Axis("Time", seconds, (low, high), "log", low, in_clock_units=True)

    axis = scale_of(times(0.01, 10.0))
    assert axis.label == "time"
    assert [text for _, text in axis.ticks] == ["10 ms", "100 ms", "1 s", "10 s"]
    axis = scale_of(times(1.0, 604800.0))
    assert [text for _, text in axis.ticks] == ["1 s", "1 min", "1 h", "1 d"]


def test_ticks_of_a_linear_axis_are_numbers_in_one_unit() -> None:
    axis = linear("x", "m", -0.01, 0.01)
    assert axis.label == "x [mm]"
    assert [text for _, text in axis.ticks] == ["−10", "−5", "0", "5", "10"]
