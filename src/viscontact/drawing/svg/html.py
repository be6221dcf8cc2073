"""HTML made of elements, so that users' names are always escaped, and controls visible."""

from __future__ import annotations

import json
from typing import Any
from xml.etree.ElementTree import Element, tostring

from viscontact.units.visible import visible


def element(name: str, *content: str | Element | None, **attributes: str) -> Element:
    """Make an element of HTML."""
    named = {key.rstrip("_").replace("_", "-"): visible(text) for key, text in attributes.items()}
    made = Element(name, named)
    for part in content:
        if isinstance(part, Element):
            made.append(part)
        elif part is not None:
            _add_text(made, visible(part))
    return made


def written(made: Element) -> str:
    """Write an element as HTML."""
    return tostring(made, encoding="unicode", method="html")


def as_script(data: Any) -> str:
    """Write data as JSON that is safe inside a script of a page: no text can end the script."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    # Both begin what could end a script; in JSON they occur in texts only.
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _add_text(made: Element, text: str) -> None:
    if len(made):
        made[-1].tail = (made[-1].tail or "") + text
    else:
        made.text = (made.text or "") + text
