"""Figures as a browser receives them: data of Plotly, with arrays packed in base64."""

from __future__ import annotations

import base64
import json
import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Figure or trace, as Plotly reads it.
Data = dict[str, Any]


def array_of(packed: Any) -> NDArray[np.float64]:
    """Return the numbers of a packed array, or of a list."""
    if not isinstance(packed, dict):
        return np.array(packed, dtype=float)
    found = np.frombuffer(base64.b64decode(packed["bdata"]), packed["dtype"])
    shape = [int(size) for size in str(packed.get("shape", found.size)).split(",")]
    values = found.reshape(shape).astype(float)
    return np.where(values > 0, values * packed["step"], np.nan) if "step" in packed else values


def figures_in(page: str) -> dict[str, Data]:
    """Return the figures of a report by their names."""
    script = re.search(r'<script[^>]*id="figures"[^>]*>(.*?)</script>', page, re.DOTALL)
    assert script
    return {each["layout"]["meta"]["name"]: each for each in json.loads(script[1])}


def shown_at(figure: Data, name: str) -> Data:
    """Return a figure after one of its frames, by name, has been shown."""
    frame = next(each for each in figure["frames"] if each["name"] == name)
    data = [dict(trace) for trace in figure["data"]]
    for number, part in zip(frame["traces"], frame["data"], strict=True):
        data[number] |= part
    return {"data": data, "layout": figure["layout"] | frame["layout"]}


def title_of(figure: Data, axis: str) -> str:
    """Return the title of the axis x or y."""
    return str(figure["layout"][f"{axis}axis"]["title"]["text"])


def unit_of(title: str) -> str:
    """Return the unit in a title."""
    found = re.search(r"\[(.*)\]", title)
    assert found
    return found[1]
