"""Parts of interactive figures, and figures as data."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Singles
from viscontact.drawing.content.look import Look
from viscontact.units.visible import visible

#: A trace, an axis or a frame, as Plotly reads them.
Part = dict[str, Any]

#: Steps of a pressure on a page: far finer than its colours.
STEPS = 65535
_FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif"


def drawn(
    traces: Sequence[Part], look: Look, meta: Part, *, frames: Sequence[Part] = (), **layout: Any
) -> go.Figure:
    """Make a figure; `meta` has its name, its title and what a page adds to it."""
    shared = {"template": template_of(look), "uirevision": "kept", "meta": meta}
    return go.Figure(list(map(_literal_words, traces)), shared | layout, list(frames))


def _literal_words(trace: Part) -> Part:
    """Trace whose name and texts are drawn as they are."""
    return {
        key: literal(found) if key in ("name", "text") else found for key, found in trace.items()
    }


def literal(found: Any) -> Any:
    """Text of a user, or several, as Plotly draws it unchanged: nothing in it is markup."""
    if not isinstance(found, str):
        return [*map(literal, found)]
    # A notebook that has loaded MathJax would set what is between signs of dollars as a formula.
    return escape(visible(found)).replace("$", "&#36;")


def plain(figure: go.Figure) -> Part:
    """Return a figure as data for JSON: traces, layout, frames."""
    # Maps, which are most of a page, are packed in steps of their largest magnitude, two bytes
    # each, signed where there is tension; the step is beside them, and 0 is no value. `linked.js`
    # unpacks them.
    made: Part = figure.to_dict()
    frames = made.get("frames", ())
    for part in (*made["data"], *(part for frame in frames for part in frame["data"])):
        if part.get("type") == "heatmap":
            part["z"] = _in_steps(part["z"], made["data"][0]["zmin"], made["data"][0]["zmax"])
    return made


def _in_steps(packed: Part, low: float, high: float) -> Part:
    """Values in four bytes each as steps in two bytes each; small ones do not vanish."""
    values = np.frombuffer(base64.b64decode(packed["bdata"]), "<f4")
    kind, step = ("u2", high / STEPS) if low >= 0 else ("i2", max(-low, high) / (STEPS // 2))
    sizes = np.maximum(np.rint(np.abs(values) / step), 1.0)
    steps = np.where(np.isnan(values), 0.0, np.copysign(sizes, values))
    written = base64.b64encode(steps.astype(f"<{kind}").tobytes()).decode("ascii")
    return packed | {"dtype": kind, "bdata": written, "step": step}


def numbers(values: ArrayLike) -> Singles:
    """Numbers to seven digits, which a page holds in four bytes each; NaN interrupts a line."""
    found = np.asarray(values, dtype=np.float32)
    # Plotly packs no empty array; a single NaN draws nothing either.
    return found if found.size else np.full(1, np.nan, dtype=np.float32)


def words(text: str, look: Look) -> Part:
    """Words in place of a curve."""
    centre = {"xref": "paper", "yref": "paper", "x": 0.5, "y": 0.5}
    return {"text": text, "showarrow": False, "font": {"size": 12, "color": look.faint}} | centre


def template_of(look: Look) -> Part:
    """Colours, fonts and margins of all figures, as a template of Plotly."""
    axis = {
        "color": look.ink,
        "gridcolor": look.grid,
        "zeroline": False,
        "zerolinecolor": look.edge,
        "showline": True,
        "linecolor": look.edge,
        "ticks": "outside",
        "ticklen": 3,
        "tickfont": {"size": 11},
        "title": {"standoff": 8, "font": {"size": 12}},
        "automargin": True,
    }
    clear = "rgba(0,0,0,0)"
    return {
        "layout": {
            "font": {"family": _FONT, "color": look.ink},
            "margin": {"l": 50, "r": 24, "t": 12, "b": 42},
            "paper_bgcolor": clear,
            "plot_bgcolor": clear,
            "showlegend": False,
            "hoverlabel": {
                "bgcolor": look.card,
                "bordercolor": look.edge,
                "font": {"color": look.ink},
            },
            "modebar": {"bgcolor": clear, "color": look.faint, "activecolor": look.ink},
            "xaxis": axis,
            "yaxis": axis,
        }
    }
