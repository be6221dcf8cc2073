"""Elements of a page as plain blocks for a PDF: headings, texts, lists, tables and drawings."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from typing import Any
from xml.etree.ElementTree import Element

#: Elements without a meaning on paper, and classes of such elements.
_LEFT_OUT = ("nav", "noscript", "script", "button", "input", "output", "svg")
_LEFT_OUT_CLASSES = ("narrow", "download", "downloads", "controls", "plot")
_HEADINGS = {"h1": 1, "h2": 2, "h3": 3}
#: CSS pixels are a 96th of an inch, points a 72nd.
_POINTS = 72 / 96
_SVG = "data:image/svg+xml;base64,"


def blocks(part: Element) -> Iterator[dict[str, Any]]:
    """Yield the blocks of an element, plain data in the order of the page."""
    # Texts are data: nothing in them is markup.
    tag, classes = part.tag, part.get("class", "").split()
    if tag in _LEFT_OUT or any(each in _LEFT_OUT_CLASSES for each in classes):
        return
    if tag in _HEADINGS:
        yield {"kind": "heading", "level": _HEADINGS[tag], "text": _text(part)}
    elif tag in ("p", "figcaption", "summary"):
        faint = "faint" in classes or tag == "figcaption"
        yield {"kind": "text", "faint": faint, "text": _text(part)}
    elif tag == "ul":
        yield {"kind": "list", "items": [_text(each) for each in part]}
    elif tag == "dl":
        names, values = ([_text(each) for each in part.iter(kind)] for kind in ("dt", "dd"))
        rows = [list(pair) for pair in zip(names, values, strict=True)]
        yield {"kind": "pairs", "boxed": "account" not in classes, "rows": rows}
    elif tag == "table":
        yield _table(part)
    elif tag == "pre":
        yield {"kind": "code", "text": "".join(part.itertext())}
    elif tag == "img":
        yield from _image(part)
    else:
        for each in part:
            yield from blocks(each)


def _table(part: Element) -> dict[str, Any]:
    head, body = part.find("thead"), part.find("tbody")
    rows = [[_text(cell) for cell in row] for row in (body if body is not None else ())]
    heads = [] if head is None else [_text(cell) for cell in head.iter("th")]
    caption = part.find("caption")
    return {
        "kind": "table",
        "caption": "" if caption is None else _text(caption),
        "heads": heads,
        "rows": rows,
    }


def _image(part: Element) -> Iterator[dict[str, Any]]:
    source = part.get("src", "")
    if source.startswith(_SVG):
        svg = base64.b64decode(source.removeprefix(_SVG)).decode("utf-8")
        width, height = (float(part.get(side, "600")) * _POINTS for side in ("width", "height"))
        size = {"width": width, "height": height}
        yield {"kind": "image", "svg": svg, "about": part.get("alt", ""), **size}


def _text(part: Element) -> str:
    """Text of an element; a remark in it follows in parentheses."""
    found = [part.text or ""]
    for each in part:
        inner = _text(each)
        found += [f" ({inner})" if each.tag == "small" and inner else inner, each.tail or ""]
    return " ".join("".join(found).split())
