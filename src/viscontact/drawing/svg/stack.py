"""Small drawing of a body of layers: a section through it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate
from xml.etree.ElementTree import Element

from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.drawing.svg.html import element
from viscontact.drawing.svg.svg_panel import WIDTH
from viscontact.results.argument_table import in_plain_words
from viscontact.units.formatting import format_quantity

#: Heights of all layers together, of the base, and of the thinnest layer that holds its label [px].
_LAYERS, _BASE, _LEAST = 110, 44, 18
_TOP, _EDGE = 20, 4
#: Opacities of layers, alternating, and of the base, which is darker if it is rigid.
_SHADES, _SOFT, _RIGID = ("0.08", "0.16"), "0.28", "0.45"


def stack_drawing(body: Layered) -> Element:
    """Section through the layers, their thicknesses to scale where there is room for the label."""
    heights: list[float] = [
        max(_LEAST, _LAYERS * layer.thickness / body.thickness) for layer in body.layers
    ]
    tops = list(accumulate(heights, initial=float(_TOP)))
    bottom = tops[-1] + _BASE
    return element(
        "svg",
        element("text", "section", x="4", y="13", font_weight="600"),
        *_layers(body, tops),
        *_base(body, tops[-1]),
        viewBox=f"0 0 {WIDTH} {bottom + _EDGE:.0f}",
        width=str(WIDTH),
        height=f"{bottom + _EDGE:.0f}",
        role="img",
        aria_label=f"section through the body: layers {len(body.layers)}",
        style="font:11px system-ui,sans-serif;overflow:visible;max-width:100%",
        fill="currentColor",
    )


def _layers(body: Layered, tops: list[float]) -> Iterator[Element]:
    for index, layer in enumerate(body.layers):
        top, bottom = tops[index], tops[index + 1]
        thickness = format_quantity(layer.thickness, "m", 3)
        yield _block(top, bottom, _SHADES[index % 2])
        yield _label((top + bottom) / 2, f"{thickness} {_law(layer.material)}")
    # The surface, and the interface below each layer; dashed where the layer slides.
    assert isinstance(body.bonded, tuple)  # one for each interface
    for top, bonded in zip(tops, (True, *body.bonded), strict=True):
        dashes = {} if bonded else {"stroke_dasharray": "5 4"}
        path = f"M{_EDGE},{top:.1f}H{WIDTH - _EDGE}"
        yield element("path", d=path, fill="none", stroke="currentColor", **dashes)
    for top, bonded in zip(tops[1:], body.bonded, strict=True):
        if not bonded:
            yield element("text", "slides", x=f"{WIDTH - 8}", y=f"{top - 4:.1f}", text_anchor="end")


def _base(body: Layered, top: float) -> Iterator[Element]:
    is_rigid = isinstance(body.base, str)
    yield _block(top, top + _BASE, _RIGID if is_rigid else _SOFT)
    yield _label(top + _BASE / 2, "rigid base" if is_rigid else f"base: {_law(body.base)}")


def _block(top: float, bottom: float, opacity: str) -> Element:
    place = {"x": str(_EDGE), "y": f"{top:.1f}", "width": str(WIDTH - 2 * _EDGE)}
    return element("rect", **place, height=f"{bottom - top:.1f}", fill_opacity=opacity)


def _label(middle: float, text: str) -> Element:
    return element("text", text, x="12", y=f"{middle + 4:.1f}")


def _law(material: Material | str) -> str:
    assert isinstance(material, Material)
    return in_plain_words(type(material.law).__name__)
